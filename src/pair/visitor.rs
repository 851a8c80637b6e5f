//! What a query is to the traversal: its pruning bound and its action for each pair of primitives.

use std::ops::ControlFlow;

use super::hit::{Hit, HitKey};
use crate::convex::PrimitiveDistance;
use crate::work_meter::WorkMeter;

/// A query, as the traversal sees it: its pruning bound and its action per primitive pair.
pub trait Visitor {
    /// Whether the traversal sharpens the bounds of boxes. That takes longer, and pays where `bound` is well above 0.
    const REFINES: bool;

    /// Pairs farther apart than this are skipped; pairs at exactly this distance are not.
    fn bound(&self) -> f64;

    /// Distances up to this need not be computed more accurately.
    fn enough(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// Primitive pairs from this one on, in order of ids, cannot change the result, however near they are.
    fn irrelevant_from(&self) -> Option<[u32; 2]> {
        None
    }

    /// Visits a primitive pair. Further work on it is counted by the meter.
    fn visit(&mut self, pair: &PrimitivePair, meter: &mut WorkMeter) -> ControlFlow<()>;
}

/// A primitive pair that the traversal visits.
#[derive(Clone, Copy, Debug)]
pub struct PrimitivePair<'m> {
    pub primitives: [u32; 2],
    /// The indices of the two in the bodies' packed trees.
    pub places: [u32; 2],
    /// Their distance, known to `error`.
    pub apart: f64,
    pub error: f64,
    /// The full result of the distance, where it was computed.
    pub measured: Option<&'m PrimitiveDistance>,
}

impl PrimitivePair<'_> {
    pub fn hit(&self, pair: u32, distance: f64) -> Hit {
        Hit {
            distance,
            apart: self.apart,
            key: HitKey {
                pair,
                primitives: self.primitives,
            },
            places: self.places,
            contained: None,
        }
    }
}
