//! What a query remembers of a primitive pair.

use std::cmp::Ordering;

/// Names a primitive pair among all the pairs of a query: `pair` is the body pair's rank, in order of ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HitKey {
    pub pair: u32,
    pub primitives: [u32; 2],
}

/// A primitive pair with its distance.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance less the pair's margin, at least 0.
    pub distance: f64,
    /// The distance itself.
    pub apart: f64,
    pub key: HitKey,
    /// Where the bodies hold the two primitives.
    pub places: [u32; 2],
}

impl Hit {
    /// Nearest first; ties go to the lowest ids.
    pub fn order(&self, other: &Hit) -> Ordering {
        self.distance
            .total_cmp(&other.distance)
            .then(self.key.cmp(&other.key))
    }
}
