//! Bounds of how fast links move in the world, and what rounding does to their places: all of them in one pass, by the lengths along
//! their chains alone. [`RatesFrom`](super::RatesFrom) says more, and takes longer.

use super::course::CourseBounds;
use super::link_motions::{Element, LinkMotions};
use super::motion_rates::ChainRounding;
use crate::pose::{Pose, Vec3};

/// Bounds of how fast a link moves in the world on a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct LinkSpeed {
    /// Of its turn, in radians per unit of time.
    pub turn: f64,
    /// Of its origin.
    pub origin: f64,
    /// What the rounding of its places comes from, but for custom joints that move.
    pub rounding: ChainRounding,
    /// Whether a custom joint moves it, of which these say nothing.
    pub is_unknown: bool,
}

impl LinkSpeed {
    /// The speed of no point within `radius` of the link's origin is larger.
    pub fn at_radius(&self, radius: f64) -> f64 {
        self.origin + self.turn * radius
    }

    /// Goes on through one element: what comes before turns all of an arm, whichever way that points.
    fn push(&mut self, element: &Element, controls: &[f64]) {
        match element {
            Element::Fixed(pose) => {
                let length = pose.translation.norm();
                self.rounding.take_in_arm(length);
                self.origin += self.turn * length;
            }
            Element::Turn { angle, .. } => self.turn_by(&angle.bounds(controls)),
            Element::Shift { axis, length } => self.shift_along(axis, &length.bounds(controls)),
            Element::CircularArc(arc) => {
                self.shift_along(&arc.axis, &arc.way_bounds());
                self.turn_by(&arc.angle_bounds());
            }
        }
    }

    fn turn_by(&mut self, angle: &CourseBounds) {
        self.rounding.take_in_turn(angle);
        self.turn += angle.derivatives[0];
    }

    fn shift_along(&mut self, axis: &Vec3, length: &CourseBounds) {
        let unit = axis.norm();
        self.rounding.take_in_shift(unit, length);
        self.origin += unit * (self.turn * length.farthest + length.derivatives[0]);
    }
}

/// The speeds of all links.
pub struct LinkSpeeds<'a> {
    motions: &'a LinkMotions,
    links: Vec<LinkSpeed>,
}

impl<'a> LinkSpeeds<'a> {
    /// Of these motions.
    pub fn new(motions: &'a LinkMotions) -> Self {
        Self::in_memory(motions, Vec::new())
    }

    /// The same, in memory that is used again.
    pub fn in_memory(motions: &'a LinkMotions, mut links: Vec<LinkSpeed>) -> Self {
        links.clear();
        for link in 0..motions.len() {
            let mut speed = motions
                .parent(link)
                .map_or_else(LinkSpeed::default, |parent| links[parent]);
            speed.is_unknown |= !motions.is_joint_known(link);
            for element in motions.elements_of(link) {
                speed.push(element, motions.controls());
            }
            links.push(speed);
        }
        Self { motions, links }
    }

    /// What [`LinkSpeeds::in_memory`] takes.
    pub fn into_memory(self) -> Vec<LinkSpeed> {
        self.links
    }

    /// Of a link.
    pub fn of(&self, link: usize) -> &LinkSpeed {
        &self.links[link]
    }

    /// What the rounding of a link's places comes from, custom joints that move included, given the poses of all links.
    pub fn rounding(&self, link: usize, poses: &[Pose]) -> ChainRounding {
        let mut rounding = self.links[link].rounding;
        rounding.size += self
            .motions
            .lengths_of_unknown_joints(link, |link| &poses[link]);
        rounding
    }
}
