//! A primitive pair found by a query.

use std::cmp::Ordering;

use super::shortlist::Ranked;

/// Identifies a primitive pair among all pairs of a query; `pair` is the rank of the body pair, in order of ids.
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

/// A primitive pair with its distance, or a piece of one body wholly inside the other, at distance 0.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// The distance minus the pair's margin, at least 0.
    pub distance: f64,
    /// The distance itself.
    pub apart: f64,
    pub key: HitKey,
    /// The indices of the two primitives in the bodies' packed trees; meaningless for a contained piece.
    pub places: [u32; 2],
    /// Set for a contained piece: the primitives then do not meet, but represent the piece and the piece of the other body
    /// around it.
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
    /// The only primitives of two bodies at a distance, which counts as 0 where they are not known to be apart.
    #[inline(always)]
    pub(super) fn of_singles(apart: f64, is_apart: bool) -> Self {
        Self {
            distance: if is_apart { apart } else { 0.0 },
            apart,
            key: HitKey {
                pair: 0,
                primitives: [0; 2],
            },
            places: [0; 2],
            contained: None,
        }
    }

    /// The primitives of the body pair `pair` from which on, in order of ids, no pair can rank before this hit. `None` if there
    /// are none: this hit is at a distance above 0, or its body pair ranks behind `pair`.
    pub fn outranks_from(&self, pair: u32) -> Option<[u32; 2]> {
        if self.distance > 0.0 {
            return None;
        }
        match self.key.pair.cmp(&pair) {
            Ordering::Less => Some([0, 0]),
            Ordering::Greater => None,
            Ordering::Equal => {
                // A primitive pair ranks before the contained piece that it represents.
                let [a, b] = self.key.primitives;
                let next = u32::from(self.contained.is_some());
                Some([a, b.saturating_add(next)])
            }
        }
    }
}
