//! What a query remembers of a primitive pair.

use std::cmp::Ordering;

use crate::convex::Closest;

/// Names a primitive pair among all the pairs of a query: `pair` is the body pair's rank, in order of ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HitKey {
    pub pair: u32,
    pub primitives: [u32; 2],
}

/// A primitive pair with its closest points, in the centred frame of body A.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance less the pair's margin, at least 0.
    pub distance: f64,
    pub key: HitKey,
    pub closest: Closest,
}

impl Hit {
    /// Nearest first; ties go to the lowest ids.
    pub fn order(&self, other: &Hit) -> Ordering {
        self.distance
            .total_cmp(&other.distance)
            .then(self.key.cmp(&other.key))
    }
}
