//! What a query is to the traversal: which pairs of primitives it wants to see, and what it does with each.

use std::ops::ControlFlow;

use super::hit::{Hit, HitKey};
use crate::convex::PrimitiveDistance;
use crate::work_meter::WorkMeter;

/// A query, as the traversal sees it.
pub trait Visitor {
    /// What it wants to see. That changes only while it visits a pair.
    fn wanted(&self) -> Wanted;

    /// Visits a primitive pair. Further work on it is counted by the meter.
    fn visit(&mut self, pair: &PrimitivePair, meter: &mut WorkMeter) -> ControlFlow<()>;
}

/// The primitive pairs that a query wants to see.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Pairs farther apart than this are skipped; pairs at exactly this distance are not.
    pub bound: f64,
    /// Distances up to this need not be computed more accurately.
    pub enough: f64,
    /// Primitive pairs from this one on, in order of ids, cannot change the result, however near they are.
    pub irrelevant_from: Option<[u32; 2]>,
    /// Whether the traversal sharpens the bounds of boxes. That takes longer, and pays where `bound` is well above 0.
    pub refines: bool,
}

impl Wanted {
    /// All pairs that meet.
    pub const MEETING: Wanted = Wanted {
        bound: 0.0,
        enough: f64::NEG_INFINITY,
        irrelevant_from: None,
        refines: false,
    };
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
