//! The limits of a configuration: the coordinates' ranges and the world box.

use std::f64::consts::TAU;

use super::Space;
use super::rigid_step::{entries, rotation};
use crate::error::Result;
use crate::robot::{BlockKind, Coordinate};

impl Space {
    /// The first coordinate outside its range, if any.
    pub fn beyond_limits(&self, q: &[f64]) -> Option<usize> {
        let mut pairs = self.coordinates().iter().zip(q);
        pairs.position(|(coordinate, x)| !coordinate.contains(*x))
    }

    /// The first link whose origin is outside the world box, if any.
    pub fn beyond_world(&self, q: &[f64]) -> Result<Option<usize>> {
        let poses = self.link_poses(q)?;
        let outside = |pose: &crate::pose::Pose| !self.world().contains(&pose.translation);
        Ok(poses.iter().position(outside))
    }

    /// Whether every coordinate is in its range and every link's origin in the world box.
    pub fn contains(&self, q: &[f64]) -> Result<bool> {
        Ok(self.beyond_limits(q).is_none() && self.beyond_world(q)?.is_none())
    }

    /// The nearest configuration with all coordinates in range; quaternions are normalized.
    pub fn clamp(&self, q: &[f64]) -> Vec<f64> {
        let mut clamped = q.to_vec();
        for (x, coordinate) in clamped.iter_mut().zip(self.coordinates()) {
            if let Coordinate::Interval { lower, upper } = *coordinate {
                *x = x.clamp(lower, upper);
            }
        }
        self.make_unit(&mut clamped);
        clamped
    }

    /// The same configuration with circles in [0, 2 pi), as in §4.4, and unit quaternions with w >= 0.
    pub fn wrap(&self, q: &[f64]) -> Vec<f64> {
        let mut wrapped = q.to_vec();
        for (x, coordinate) in wrapped.iter_mut().zip(self.coordinates()) {
            if *coordinate == Coordinate::Circle && !(0.0..TAU).contains(x) {
                let round = x.rem_euclid(TAU);
                // A tiny negative angle rounds to a whole turn.
                *x = if round >= TAU { 0.0 } else { round };
            }
        }
        self.make_unit(&mut wrapped);
        for at in self.quaternions() {
            if wrapped[at + 3] < 0.0 {
                wrapped[at..at + 4].iter_mut().for_each(|x| *x = -*x);
            }
        }
        wrapped
    }

    fn make_unit(&self, q: &mut [f64]) {
        for at in self.quaternions() {
            let unit = entries(&rotation(&q[at..at + 4]));
            q[at..at + 4].copy_from_slice(&unit);
        }
    }

    /// The first coordinate of each quaternion.
    pub(super) fn quaternions(&self) -> impl Iterator<Item = usize> {
        self.blocks().iter().filter_map(|block| match block.kind {
            BlockKind::Line => None,
            kind => Some(block.coordinate + kind.nq() - 4),
        })
    }
}
