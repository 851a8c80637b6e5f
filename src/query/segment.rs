//! A proof that a way of constant velocity through C-space is free, by distances and motion bounds (Quinlan 1994, ch. 4).

use super::context::QueryContext;
use super::scene::Configuration;
use crate::cobject::{CObject, Term};
use crate::error::Result;

/// So many distances may be computed for one proof; a way that needs more counts as not free.
const MOST_DISTANCES: usize = 400;

/// The part of the distance that a step uses up: the rest covers the rounding of kinematics and motion bounds.
const STEP_FRACTION: f64 = 0.99;

impl QueryContext {
    /// Whether the robot keeps clear of the C-object on the way from q with velocity v for a unit of time, from parameter
    /// `start` on. `false` may also mean that it comes too near for a proof of reasonable length.
    pub(super) fn way_is_free(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        v: &[f64],
        start: f64,
    ) -> Result<bool> {
        let motion = motion_bound(cobject, q, v);
        if motion.is_infinite() {
            return Ok(false);
        }
        // What rests may be as near as it likes.
        let space = cobject.space();
        let Some(cobject) = &cobject.moving(|link| space.motion_bound(link, q, v) > 0.0) else {
            return Ok(true);
        };
        let mut t = start;
        for _ in 0..MOST_DISTANCES {
            let way: Vec<f64> = v.iter().map(|x| x * t).collect();
            let at = cobject.space().step(q, &way);
            let here = self.distance(cobject, Configuration::Coordinates(&at), f64::INFINITY)?;
            if here.lower <= 0.0 {
                return Ok(false);
            }
            if t == 1.0 {
                return Ok(true);
            }
            // Up to the next parameter no distance can have fallen to 0.
            t = (t + STEP_FRACTION * here.lower / motion).min(1.0);
        }
        Ok(false)
    }
}

/// No distance of the C-object changes by more than this on the way. Infinite where a joint does not state its speeds.
pub(super) fn motion_bound(cobject: &CObject, q: &[f64], v: &[f64]) -> f64 {
    let space = cobject.space();
    let of_link = |link: usize| space.motion_bound(link, q, v);
    cobject
        .terms()
        .iter()
        .map(|term| match &**term {
            Term::Objects { links, .. } => links.iter().map(|&l| of_link(l)).fold(0.0, f64::max),
            Term::Links { pairs, .. } => {
                let of_pair = |pair: &[usize; 2]| of_link(pair[0]) + of_link(pair[1]);
                pairs.iter().map(of_pair).fold(0.0, f64::max)
            }
        })
        .fold(0.0, f64::max)
}
