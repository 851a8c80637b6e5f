//! What a query remembers of a primitive pair.

use std::cmp::Ordering;

use super::shortlist::Ranked;

/// Names a primitive pair among all the pairs of a query: `pair` is the body pair's rank, in order of ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HitKey {
    pub pair: u32,
    pub primitives: [u32; 2],
}

/// Which of two bodies has a piece inside the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Inner {
    A,
    B,
}

impl Inner {
    pub fn other(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }
}

/// A primitive pair with its distance; or a piece of one body wholly inside the other, at distance 0.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance less the pair's margin, at least 0.
    pub distance: f64,
    /// The distance itself.
    pub apart: f64,
    pub key: HitKey,
    /// Where the bodies hold the two primitives; it means nothing for a piece inside.
    pub places: [u32; 2],
    /// The primitives do not meet: they stand for a piece, and for what of the other body's boundary is around it.
    pub contained: Option<Inner>,
}

impl Ranked for Hit {
    /// Nearest first; ties go to the lowest ids.
    fn order(&self, other: &Hit) -> Ordering {
        self.distance
            .total_cmp(&other.distance)
            .then(self.key.cmp(&other.key))
            .then(self.contained.cmp(&other.contained))
    }
}

impl Hit {
    /// The primitives from which on no pair of a body pair comes before this one, where sets meet; none if it is farther.
    pub fn settles(&self, pair: u32) -> Option<[u32; 2]> {
        if self.distance > 0.0 {
            return None;
        }
        match self.key.pair.cmp(&pair) {
            Ordering::Less => Some([0, 0]),
            Ordering::Greater => None,
            Ordering::Equal => {
                // The same primitives come before a piece that they stand for.
                let [a, b] = self.key.primitives;
                let next = u32::from(self.contained.is_some());
                Some([a, b.saturating_add(next)])
            }
        }
    }
}
