//! The distance of two primitives: that of their cores, by the form of these, less the radii.

use super::beyond::Beyond;
use super::closest::Closest;
use super::core::{Core, is_smooth};
use super::cuboids_within::cuboids_within;
use super::every_feature::DistanceScratch;
use super::placed::{PlacedPrimitive, Precision};
use super::polytope_distance::{closed_form, closest_polytopes, cuboid};
use super::smooth_distance::smooth_closest;
use crate::gjk::{DistanceLimits, Proved, Support, meeting};
use crate::pose::Vec3;
use crate::tolerance;

/// The closest points of two primitives, and what their contacts are computed from.
#[derive(Clone, Copy, Debug)]
pub struct PrimitiveDistance {
    /// The distance is 0 if it is at most the pair's error.
    pub closest: Closest,
    /// The closest points of the cores: the same for primitives without a radius.
    pub cores: Closest,
    /// The unit direction from B to A that proves smooth cores apart; zero if there is none.
    pub direction: Vec3,
}

impl PrimitiveDistance {
    /// For two primitives that are the hulls of their vertices.
    pub fn of_hulls(closest: Closest) -> Self {
        Self {
            closest,
            cores: closest,
            direction: Vec3::zeros(),
        }
    }
}

/// The closest points of two primitives in a common frame, unless they are proved to be farther apart than the cutoff.
#[inline(always)]
pub fn measure(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
    scratch: &mut DistanceScratch,
) -> Result<PrimitiveDistance, Beyond> {
    let radii = [a.shape.radius(), b.shape.radius()];
    let limits = limits.of_cores(radii[0] + radii[1]);
    let (cores, direction) = core_closest(a, b, pair, limits, scratch)?;
    let mut closest = grown(&cores, radii);
    if closest.distance <= pair.error {
        closest.distance = 0.0;
    }
    Ok(PrimitiveDistance {
        closest,
        cores,
        direction,
    })
}

/// The closest points of the cores, and for smooth cores the unit direction from B to A that certifies their distance; zero if
/// there is none.
#[inline(always)]
fn core_closest(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
    scratch: &mut DistanceScratch,
) -> Result<(Closest, Vec3), Beyond> {
    if is_smooth(a, b) {
        smooth_closest(a, b, pair, limits)
    } else {
        let found = closest_polytopes(a, b, pair, limits, scratch)?;
        Ok((found, Vec3::zeros()))
    }
}

/// The distance of two sets, from that of their cores; 0 where they meet.
#[inline(always)]
pub fn beyond_radii(cores: f64, [a, b]: [f64; 2]) -> f64 {
    if cores >= a + b { cores - a - b } else { 0.0 }
}

/// How far the middle of the overlap of two sets is from the core of the first, along the line between the cores, which are `apart`.
#[inline(always)]
pub fn middle_of_overlap(apart: f64, [a, b]: [f64; 2]) -> f64 {
    0.5 * ((apart - b).max(0.0) + a.min(apart))
}

/// The closest points of two sets, from those of their cores. Where the sets overlap, both are the same common point, between
/// the cores.
#[inline(always)]
fn grown(cores: &Closest, radii: [f64; 2]) -> Closest {
    let apart = cores.distance;
    let [on_a, on_b] = cores.points;
    if apart == 0.0 || radii == [0.0; 2] {
        return *cores;
    }
    let normal = (on_a - on_b) / apart;
    let [a, b] = radii;
    if apart >= a + b {
        return Closest {
            distance: beyond_radii(apart, radii),
            points: [on_a - normal * a, on_b + normal * b],
            ..*cores
        };
    }
    let middle = on_a - normal * middle_of_overlap(apart, radii);
    Closest {
        doubt: cores.doubt,
        depth: cores.depth,
        ..Closest::meeting_at(middle, cores.features)
    }
}

/// Whether a unit direction from B to A proves two primitives to be farther apart than the cutoff.
pub fn parts(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    direction: &Vec3,
    pair: &Precision,
    cutoff: f64,
) -> bool {
    let Some(cutoff) = proved_cutoff(a, b, pair, cutoff) else {
        return false;
    };
    let cutoff = cutoff + a.shape.radius() + b.shape.radius();
    let [a, b] = [(a, -direction), (b, *direction)]
        .map(|(placed, direction)| Core::of(placed).support(&direction));
    direction.dot(&(a - b)) > cutoff
}

/// The cutoff that a separating direction must exceed to prove what the full distance would also say, so that the order of the
/// tests does not change the answer: where one primitive is smooth, more than `cutoff` by the error of the full distance. `None`
/// for the caller's support functions, which have an error of their own.
fn proved_cutoff(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    cutoff: f64,
) -> Option<f64> {
    if !is_smooth(a, b) {
        return Some(cutoff);
    }
    let has_function = a.shape.is_function() || b.shape.is_function();
    (!has_function).then_some(cutoff + tolerance::SMOOTH_ERROR * pair.size)
}

/// Whether two primitives meet or are farther apart than the cutoff; `None` where only the full distance decides.
pub fn meeting_or_beyond(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
) -> Option<Proved> {
    let radii = a.shape.radius() + b.shape.radius();
    if let (Some(on_a), Some(on_b)) = (cuboid(a), cuboid(b)) {
        let cutoff = limits.of_cores(radii).cutoff;
        return Some(
            match cuboids_within([a, b], [on_a, on_b], pair.size, cutoff)? {
                true => Proved::Meet,
                false => Proved::Beyond {
                    direction: Vec3::zeros(),
                    lowest: Vec3::zeros(),
                },
            },
        );
    }
    // Rounded primitives, or ones that only need to be near, may be within the limits without their cores meeting.
    if pair.planar || limits.enough > 0.0 || radii > 0.0 {
        return None;
    }
    let cutoff = proved_cutoff(a, b, pair, limits.cutoff)?;
    let (size, start) = (pair.size, a.middle() - b.middle());
    if is_smooth(a, b) {
        meeting(&Core::of(a), &Core::of(b), start, size, cutoff)
    } else {
        meeting(a, b, start, size, cutoff)
    }
}

/// The distance of two primitives, if their cores have a closed form. It is not set to 0 below the pair's error.
#[inline(always)]
pub fn closed_distance(a: &PlacedPrimitive, b: &PlacedPrimitive, pair: &Precision) -> Option<f64> {
    if is_smooth(a, b) {
        return None;
    }
    let cores = closed_form(a, b, pair)?;
    let radii = [a.shape.radius(), b.shape.radius()];
    Some(beyond_radii(cores.distance, radii))
}
