//! A translation that parts two sets, as long as they need it along one direction.

use std::cmp::Ordering;

use super::placed::PlacedPrimitive;
use crate::pose::Vec3;

/// A translation of r after which it is clear of s.
#[derive(Clone, Copy)]
pub struct Way {
    pub depth: f64,
    /// A unit vector from s to r.
    pub direction: Vec3,
    /// The number of the direction's line, and whether it is the opposite of its normal. Ties of the depth go to the lowest
    /// rank.
    pub rank: (u64, bool),
}

impl Way {
    /// Shortest first.
    pub fn order(&self, other: &Self) -> Ordering {
        let by_depth = self.depth.total_cmp(&other.depth);
        by_depth.then(self.rank.cmp(&other.rank))
    }
}

/// Lines without a number come after all others.
pub const NO_NUMBER: u64 = u64::MAX;

/// The ways along a unit normal and against it.
pub fn ways_along([r, s]: [&PlacedPrimitive; 2], number: u64, normal: &Vec3) -> [Way; 2] {
    let [(low_r, high_r), (low_s, high_s)] = [r, s].map(|placed| placed.extent_along(normal));
    let ways = [(high_s - low_r, *normal), (high_r - low_s, -normal)];
    let way = |i: usize| Way {
        depth: ways[i].0,
        direction: ways[i].1,
        rank: (number, i == 1),
    };
    [way(0), way(1)]
}

/// A half-space { t : normal . t >= offset } of translations t of r that keep r clear of s. `normal` is a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    pub normal: Vec3,
    pub offset: f64,
}

impl From<Way> for HalfSpace {
    fn from(way: Way) -> Self {
        Self {
            normal: way.direction,
            offset: way.depth,
        }
    }
}
