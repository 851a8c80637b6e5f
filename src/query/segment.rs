//! A proof that a straight segment of C-space is free, by distances and motion bounds (Quinlan 1994, ch. 4).

use super::candidates::Configuration;
use super::context::QueryContext;
use crate::cobject::{CObject, Term};
use crate::error::Result;

/// A segment is not halved more often than this; what is then unproven counts as not free.
const DEEPEST: u32 = 12;

impl QueryContext {
    /// Whether the robot keeps clear of the C-object on the whole segment from q0 to q1. `false` may also mean that it
    /// comes too near for a proof.
    pub(super) fn segment_is_free(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
    ) -> Result<bool> {
        let motion = motion_bound(cobject, q0, q1);
        let at = |t: f64| -> Vec<f64> { q0.iter().zip(q1).map(|(a, b)| a + (b - a) * t).collect() };
        let mut clearance = |t: f64| -> Result<f64> {
            let q = at(t);
            Ok(self
                .distance(cobject, Configuration::Coordinates(&q), f64::INFINITY)?
                .lower)
        };
        let mut open = vec![(0.0, clearance(0.0)?, 1.0, clearance(1.0)?, 0)];
        while let Some((t0, d0, t1, d1, depth)) = open.pop() {
            if d0 <= 0.0 || d1 <= 0.0 {
                return Ok(false);
            }
            // Within the segment no distance falls below both d0 - motion (t - t0) and d1 - motion (t1 - t).
            if d0 + d1 > motion * (t1 - t0) {
                continue;
            }
            if depth == DEEPEST {
                return Ok(false);
            }
            let middle = 0.5 * (t0 + t1);
            let d = clearance(middle)?;
            open.push((middle, d, t1, d1, depth + 1));
            open.push((t0, d0, middle, d, depth + 1));
        }
        Ok(true)
    }
}

/// No distance of the C-object changes by more than this on the segment.
fn motion_bound(cobject: &CObject, q0: &[f64], q1: &[f64]) -> f64 {
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
