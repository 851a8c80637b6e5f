//! The bodies of a space's links.

use std::sync::Arc;

use crate::body::Body;
use crate::body_bounds::{Bounds, BoundsByEight};
use crate::lanes::Plain;
use crate::pose::Pose;

/// The bodies of links, numbered in the links' order. Immutable.
#[derive(Debug)]
pub struct LinkBodies {
    /// Of each link, if it has one.
    bodies: Vec<Option<Arc<Body>>>,
    carriers: Vec<usize>,
    /// The place of each link among them.
    numbers: Vec<Option<u32>>,
    own_bounds: BoundsByEight,
}

impl LinkBodies {
    /// Of the links in order, those without a body among them.
    pub(super) fn new(bodies: Vec<Option<Arc<Body>>>) -> Self {
        let has_body = |&link: &usize| bodies[link].is_some();
        let carriers: Vec<usize> = (0..bodies.len()).filter(has_body).collect();
        let mut numbers = vec![None; bodies.len()];
        for (number, &link) in (0..).zip(&carriers) {
            numbers[link] = Some(number);
        }
        let mut own_bounds = BoundsByEight::default();
        for body in bodies.iter().flatten() {
            own_bounds.push(&Bounds::of(Plain, body, &Pose::IDENTITY));
        }
        Self {
            bodies,
            carriers,
            numbers,
            own_bounds,
        }
    }

    /// The body of a link, if it has one.
    #[inline]
    pub(super) fn get(&self, link: usize) -> Option<&Body> {
        self.bodies.get(link)?.as_deref()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.carriers.len()
    }

    /// The links with bodies, in order. A body's number is its link's place here.
    pub fn carriers(&self) -> &[usize] {
        &self.carriers
    }

    /// The number of a link's body, if it has one.
    #[inline]
    pub fn number(&self, link: usize) -> Option<usize> {
        let number = *self.numbers.get(link)?;
        number.map(|number| number as usize)
    }

    /// The bounds of the bodies, by their numbers, in the frames of their links.
    pub fn own_bounds(&self) -> &BoundsByEight {
        &self.own_bounds
    }
}
