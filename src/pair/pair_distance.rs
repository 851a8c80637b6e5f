//! How far apart two primitives of a pair of bodies are.

use super::pairing::{EMPTY, Pairing};
use crate::convex::{
    Beyond, Closest, DistanceScratch, NearestFeatures, Outline, PlacedBuffer, PolygonDistance,
    PrimitiveDistance, measure, meeting_or_beyond, parts, polygon_distance,
};
use crate::gjk::{DistanceLimits, Proved};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;

/// Scratch memory of primitive distances, reused from pair to pair.
#[derive(Default)]
pub struct PrimitiveScratch {
    pub(super) buffer: PlacedBuffer,
    pub(super) distance: DistanceScratch,
}

/// The distance of two primitives, with what was computed on the way.
pub struct PairDistance {
    pub distance: f64,
    /// The nearest features, for polygons that do not cross.
    pub nearest: Option<NearestFeatures>,
    /// The full result, for other primitives.
    pub measured: Option<PrimitiveDistance>,
    /// How far the distance may exceed the true one, beyond the pair's error.
    pub doubt: f64,
}

/// The result for two primitives that are farther apart than the cutoff.
pub enum BeyondCutoff {
    /// Polygons with outlines; their nearest features, if these were computed.
    Outlines(Option<NearestFeatures>),
    /// Others; what proves it.
    Others(Beyond),
}

impl PairDistance {
    /// For primitives that meet.
    const NONE: Self = Self {
        distance: 0.0,
        nearest: None,
        measured: None,
        doubt: 0.0,
    };
}

impl Pairing<'_> {
    /// The distance of the primitives at two places, unless it is above `cutoff`: a pure function of the primitives and
    /// the relative pose. 0 where they touch to within the pair's error.
    pub fn distance(
        &self,
        places: [u32; 2],
        cutoff: f64,
        scratch: &mut PrimitiveScratch,
    ) -> Option<f64> {
        with_widest(DistanceOfPair {
            pairing: self,
            places,
            cutoff,
            scratch,
        })
    }

    /// The same as `distance`, given the outline of B's primitive and a separating direction to try first.
    #[inline(always)]
    pub fn distance_to<I: Instructions>(
        &self,
        lanes: I,
        places: [u32; 2],
        outline_b: &Option<Outline<I>>,
        direction: &Vec3,
        limits: DistanceLimits,
        scratch: &mut PrimitiveScratch,
    ) -> std::result::Result<PairDistance, BeyondCutoff> {
        let outline_a = self.outline_a(lanes, places[0]);
        let found = match (&outline_a, outline_b) {
            (Some(a), Some(b)) => polygon_distance(a, b, limits.cutoff, self.precision.size),
            _ => PolygonDistance::Doubt,
        };
        let apart = match found {
            PolygonDistance::Beyond(nearest) => return Err(BeyondCutoff::Outlines(nearest)),
            PolygonDistance::Apart(distance, nearest) => PairDistance {
                distance: self.above_error(distance),
                nearest: Some(nearest),
                ..PairDistance::NONE
            },
            PolygonDistance::Cross => PairDistance::NONE,
            PolygonDistance::Doubt => {
                let measured = self.measured_apart(places, direction, limits, scratch);
                return measured.map_err(BeyondCutoff::Others);
            }
        };
        if apart.distance <= limits.cutoff {
            Ok(apart)
        } else {
            Err(BeyondCutoff::Outlines(apart.nearest))
        }
    }

    /// The same for primitives of which at least one has no outline. `direction`, a unit vector from B to A or zero, is first
    /// tried as a separating direction.
    pub fn measured_apart(
        &self,
        places: [u32; 2],
        direction: &Vec3,
        limits: DistanceLimits,
        scratch: &mut PrimitiveScratch,
    ) -> std::result::Result<PairDistance, Beyond> {
        let PrimitiveScratch { buffer, distance } = scratch;
        let [a, b] = &self.placed(places, buffer);
        let is_aimed = *direction != Vec3::zeros();
        if is_aimed && parts(a, b, direction, &self.precision, limits.cutoff) {
            return Err(Beyond::SOMEHOW);
        }
        if limits.enough >= 0.0
            && let Some(proved) = meeting_or_beyond(a, b, &self.precision, limits)
        {
            return match proved {
                Proved::Meet => Ok(PairDistance::NONE),
                Proved::Beyond { direction, lowest } => Err(Beyond::along(&direction, &lowest)),
            };
        }
        let measured = measure(a, b, &self.precision, limits, distance)?;
        let Closest {
            distance, doubt, ..
        } = measured.closest;
        let distance = self.above_error(distance);
        if distance - doubt > limits.cutoff {
            let [on_a, on_b] = measured.closest.points;
            let across = on_a - on_b;
            return Err(Beyond::along(&across, &across));
        }
        Ok(PairDistance {
            distance,
            nearest: None,
            measured: Some(measured),
            doubt,
        })
    }
}

struct DistanceOfPair<'a> {
    pairing: &'a Pairing<'a>,
    places: [u32; 2],
    cutoff: f64,
    scratch: &'a mut PrimitiveScratch,
}

impl Work for DistanceOfPair<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Option<f64> {
        let Self {
            pairing, places, ..
        } = self;
        let mut buffer = EMPTY;
        let b = pairing.outline_b(lanes, places[1], &mut buffer);
        let limits = DistanceLimits {
            cutoff: self.cutoff,
            ..DistanceLimits::EXACT
        };
        let apart = pairing.distance_to(lanes, places, &b, &Vec3::zeros(), limits, self.scratch);
        Some(apart.ok()?.distance)
    }
}
