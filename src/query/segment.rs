//! A proof that a straight segment of C-space is free, by distances and motion bounds (Quinlan 1994, ch. 4).

use super::context::QueryContext;
use super::scene::Configuration;
use crate::cobject::{CObject, Term};
use crate::error::Result;

/// So many distances may be computed for one proof; a segment that needs more counts as not free.
const MOST_DISTANCES: usize = 400;

/// The part of the distance that a step uses up: the rest covers the rounding of kinematics and motion bounds.
const STEP_FRACTION: f64 = 0.99;

impl QueryContext {
    /// Whether the robot keeps clear of the C-object on the segment from q0 to q1, from parameter `start` on. `false` may
    /// also mean that it comes too near for a proof of reasonable length.
    pub(super) fn segment_is_free(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        start: f64,
    ) -> Result<bool> {
        let motion = motion_bound(cobject, q0, q1);
        let mut t = start;
        for _ in 0..MOST_DISTANCES {
            let q = at(q0, q1, t);
            let here = self.distance(cobject, Configuration::Coordinates(&q), f64::INFINITY)?;
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

/// The configuration at a parameter from 0 to 1; exactly q1 at 1.
fn at(q0: &[f64], q1: &[f64], t: f64) -> Vec<f64> {
    if t == 1.0 {
        return q1.to_vec();
    }
    q0.iter().zip(q1).map(|(a, b)| a + (b - a) * t).collect()
}

/// No distance of the C-object changes by more than this on the segment.
pub(super) fn motion_bound(cobject: &CObject, q0: &[f64], q1: &[f64]) -> f64 {
    let space = cobject.space();
    let of_link = |link: usize| space.motion_bound(link, q0, q1);
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
