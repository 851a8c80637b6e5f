//! The shortest translation that separates the hulls of two primitives' vertices.
//!
//! A translation of r along n separates the sets when it is at least the highest projection of s on n minus the lowest of r.
//! The shortest one goes along the normal of a facet of the sets' Minkowski difference (see `ways_out.rs`), and is exact to rounding.

use super::closest::{FeatureSet, closest_features};
use super::every_feature::DistanceScratch;
use super::placed::{PlacedPrimitive, Precision};
use super::polytope_distance::closest_polytopes;
use super::way::Way;
use super::ways_out::shortest_way;
use crate::gjk::DistanceLimits;
use crate::pose::Vec3;
use crate::tolerance;
use crate::work_meter::WorkMeter;

/// The shortest translation of r that leaves r and s touching: by `depth` along `direction`, a unit vector from s to r.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    /// 0 for sets that only touch, or whose interiors do not overlap, such as flat sets in one plane.
    pub depth: f64,
    pub direction: Vec3,
    /// A point of r and one of s that the translation brings together: s = r + depth * direction.
    pub points: [Vec3; 2],
}

/// The penetration of the hulls of two primitives' vertices that meet. Meaningless if the meter's limit is exceeded.
pub fn polytope_penetration(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Penetration {
    let Way {
        depth, direction, ..
    } = shortest_way(r, s, precision, meter);
    let depth = depth.max(0.0);
    let points = match meter.is_exceeded() {
        true => [Vec3::zeros(); 2],
        false => coinciding_points(r, s, depth, &direction, precision),
    };
    Penetration {
        depth,
        direction,
        points,
    }
}

/// Points of both sets that coincide after r has moved by `depth` along `direction`. The sets then touch in the supporting
/// planes normal to `direction`. The points are found by moving r a little farther and taking the closest points of the
/// features in these planes. Where features are nearly parallel some may be missed; then the slack is increased, and finally
/// all features are compared.
fn coinciding_points(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    depth: f64,
    direction: &Vec3,
    precision: &Precision,
) -> [Vec3; 2] {
    let way = direction * depth;
    let moved_by = |shift: Vec3| -> Vec<Vec3> { r.vertices().iter().map(|v| v + shift).collect() };
    for slack in [tolerance::SUPPORT_SLACK, tolerance::NEAR_SUPPORT] {
        let slack = slack * precision.size;
        let shift = direction * (depth + slack);
        let vertices = moved_by(shift);
        let moved = r.shifted(&vertices);
        let (mut on_r, mut on_s) = (FeatureSet::default(), FeatureSet::default());
        on_r.set_supporting(&moved, &-direction, slack);
        on_s.set_supporting(s, direction, slack);
        let closest = closest_features(&moved, &on_r, s, &on_s, false);
        let points = [closest.points[0] - shift, closest.points[1]];
        if (points[1] - points[0] - way).norm() <= precision.error {
            return points;
        }
    }
    let vertices = moved_by(way);
    let moved = r.shifted(&vertices);
    let scratch = &mut DistanceScratch::default();
    let closest = closest_polytopes(&moved, s, precision, DistanceLimits::EXACT, scratch);
    let closest = closest.expect("nothing is beyond infinity");
    [closest.points[0] - way, closest.points[1]]
}
