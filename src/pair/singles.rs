//! Two bodies of one primitive each: measured without a traversal.

use super::hit::Hit;
use super::pair_contacts::WorldContact;
use super::pair_distance::PrimitiveScratch;
use super::pairing::Pairing;
use crate::convex::{
    DistanceScratch, PlacedPrimitive, PrimitiveDistance, closed_distance, first_contact, measure,
    meeting_or_beyond,
};
use crate::gjk::{DistanceLimits, Proved};
use crate::pose::Vec3;

/// The nearest points of two singles, in the world.
pub struct SinglesNearest {
    pub hit: Hit,
    /// A safe lower bound of the distance.
    pub lower: f64,
    pub points: [Vec3; 2],
    pub contact: Option<WorldContact>,
}

/// Whether a distance in closed form, given its error, may be at most `threshold`; doubt counts as within.
#[inline(always)]
pub(super) fn is_within(distance: f64, error: f64, threshold: f64) -> bool {
    let is_apart = distance > error;
    !is_apart || distance - error <= threshold
}

/// The only primitives of two bodies, in the centred frame of A.
pub struct Singles<'a> {
    pairing: &'a Pairing<'a>,
    a: PlacedPrimitive<'a>,
    b: PlacedPrimitive<'a>,
    scratch: &'a mut DistanceScratch,
}

impl<'a> Singles<'a> {
    /// For bodies of exactly one primitive each.
    #[inline(always)]
    pub fn new(pairing: &'a Pairing<'a>, scratch: &'a mut PrimitiveScratch) -> Self {
        let PrimitiveScratch { buffer, distance } = scratch;
        let [a, b] = pairing.placed([0, 0], buffer);
        Self {
            pairing,
            a,
            b,
            scratch: distance,
        }
    }

    /// Whether their distance may be at most `threshold`; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&mut self, threshold: f64) -> bool {
        let limits = DistanceLimits {
            enough: threshold,
            cutoff: threshold + self.pairing.slack(),
        };
        let precision = &self.pairing.precision;
        if let Some(distance) = closed_distance(&self.a, &self.b, precision) {
            return is_within(distance, precision.error, threshold);
        }
        if let Some(proved) = meeting_or_beyond(&self.a, &self.b, precision, limits) {
            return matches!(proved, Proved::Meet);
        }
        self.measure(limits)
            .is_some_and(|(hit, measured)| self.lower(&hit, &measured) <= threshold)
    }

    /// Their nearest points and contact; `None` if they are proved to be farther apart than `max_distance`.
    #[inline(always)]
    pub fn nearest(&mut self, max_distance: f64) -> Option<SinglesNearest> {
        let (hit, measured) = self.measure(DistanceLimits {
            cutoff: max_distance + self.pairing.slack(),
            ..DistanceLimits::EXACT
        })?;
        Some(SinglesNearest {
            lower: self.lower(&hit, &measured),
            points: self.pairing.world_points(&measured.closest),
            contact: self.first_contact(&measured),
            hit,
        })
    }

    /// Their distance and the full result; `None` if they are proved to be beyond the limits' cutoff.
    #[inline(always)]
    fn measure(&mut self, limits: DistanceLimits) -> Option<(Hit, PrimitiveDistance)> {
        let precision = &self.pairing.precision;
        let measured = measure(&self.a, &self.b, precision, limits, self.scratch).ok()?;
        let apart = self.pairing.above_error(measured.closest.distance);
        if apart - measured.closest.doubt > limits.cutoff {
            return None;
        }
        let is_apart = apart > precision.error + measured.closest.doubt;
        Some((Hit::of_singles(apart, is_apart), measured))
    }

    /// A safe lower bound of a measured distance.
    fn lower(&self, hit: &Hit, measured: &PrimitiveDistance) -> f64 {
        if hit.distance == 0.0 {
            return 0.0;
        }
        hit.distance - (self.pairing.precision.error + measured.closest.doubt)
    }

    /// The contact at the closest points, if the two are apart.
    #[inline(always)]
    fn first_contact(&self, measured: &PrimitiveDistance) -> Option<WorldContact> {
        let found = first_contact(&self.a, &self.b, measured, &self.pairing.precision)?;
        Some(self.pairing.in_world(found))
    }
}
