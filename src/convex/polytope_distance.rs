//! The exact distance of the hulls of two primitives' vertices: GJK finds the candidate features, closed forms give their
//! distance, and a supporting direction certifies it; where none does, all features are compared.

use super::beyond::Beyond;
use super::closest::{Closest, closest_features, closest_segments};
use super::cuboid_distance::segment_to_cuboid;
use super::cuboids_closest::{CuboidsClosest, cuboids_closest};
use super::every_feature::{DistanceScratch, Known, closest_of_all};
use super::feature_pair::{FeatureTouch, across, feature_normal, foot_in};
use super::level_features::at_end;
use super::local_features::local_normals;
use super::placed::{PlacedPrimitive, Precision, gap_of_primitives, larger_gap};
use super::point_to_polygon::point_to_polygon;
use crate::gjk::{DistanceLimits, Gjk, Names, NearestCorners, gjk};
use crate::pose::Vec3;
use crate::primitive::{Cuboid, Feature, FeatureKind};
use crate::tolerance;

/// The closest points of the hulls of two primitives' vertices, unless these are proved to be farther apart than the cutoff.
#[inline(always)]
pub fn closest_polytopes(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
    scratch: &mut DistanceScratch,
) -> Result<Closest, Beyond> {
    let mut found = match closed_form(a, b, pair) {
        Some(found) => found,
        None => closest_by_features(a, b, pair, limits, scratch)?,
    };
    let [on_a, on_b] = &found.points;
    found.features = [
        snapped(a, found.features[0], on_a, pair.error),
        snapped(b, found.features[1], on_b, pair.error),
    ];
    Ok(found)
}

/// The same for primitives without a closed form.
#[inline(never)]
fn closest_by_features(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
    scratch: &mut DistanceScratch,
) -> Result<Closest, Beyond> {
    let needs_bounds = |placed: &PlacedPrimitive| placed.shape.is_solid() || is_large(placed);
    if pair.planar {
        return Ok(planar_closest(a, b, pair, scratch));
    }
    if let (Some(on_a), Some(on_b)) = (cuboid(a), cuboid(b)) {
        return match cuboids_closest([a, b], [on_a, on_b], pair.size, limits.cutoff) {
            CuboidsClosest::Beyond => Err(Beyond::SOMEHOW),
            CuboidsClosest::Found(found) => Ok(found),
            CuboidsClosest::Unknown {
                direction,
                features,
            } => match features.and_then(|features| touch_of([a, b], features, None, pair)) {
                Some(found) => Ok(found),
                None => bounded_closest(a, b, direction, pair, limits, scratch),
            },
        };
    }
    if needs_bounds(a) || needs_bounds(b) {
        // A start that depends on the two primitives alone, so that the answer does too.
        let start = a.middle() - b.middle();
        return bounded_closest(a, b, start, pair, limits, scratch);
    }
    if limits.cutoff < f64::INFINITY && plane_gap(a, b).max(plane_gap(b, a)) > limits.cutoff {
        return Err(Beyond::SOMEHOW);
    }
    scratch.a.set_all(a);
    scratch.b.set_all(b);
    Ok(closest_features(a, &scratch.a, b, &scratch.b, true))
}

/// The closest points in closed form, in space: of a point or segment with a point, segment or box, and of a point with a small
/// polygon.
#[inline(always)]
pub fn closed_form(a: &PlacedPrimitive, b: &PlacedPrimitive, pair: &Precision) -> Option<Closest> {
    if pair.planar {
        return None;
    }
    let is_small_polygon =
        |placed: &PlacedPrimitive| placed.shape.faces.len() == 1 && !is_large(placed);
    match (a.vertex_count(), b.vertex_count()) {
        (1 | 2, 1 | 2) => Some(closest_segments(a, b)),
        (1, _) if is_small_polygon(b) => Some(point_to_polygon(&a.vertex(0), b)),
        (_, 1) if is_small_polygon(a) => Some(point_to_polygon(&b.vertex(0), a).swapped()),
        (1 | 2, _) | (_, 1 | 2) => closest_to_cuboid(a, b, pair),
        _ => None,
    }
}

/// The closest points of a point or a segment and a box that are more than the error apart, or clearly in one another.
fn closest_to_cuboid(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
) -> Option<Closest> {
    let found = if let Some(cuboid) = cuboid(b)
        && a.vertex_count() <= 2
    {
        segment_to_cuboid(a, b, cuboid, pair.error)
    } else if let Some(cuboid) = cuboid(a)
        && b.vertex_count() <= 2
    {
        segment_to_cuboid(b, a, cuboid, pair.error).swapped()
    } else {
        return None;
    };
    let is_clear = found.distance > pair.error || found.depth > tolerance::JUST_INSIDE * pair.size;
    is_clear.then_some(found)
}

pub fn cuboid<'a>(placed: &PlacedPrimitive<'a>) -> Option<&'a Cuboid> {
    placed.form()?.cuboid()
}

/// The distance of a set from the plane of a flat polygon, on either side.
fn plane_gap(flat: &PlacedPrimitive, other: &PlacedPrimitive) -> f64 {
    if !flat.shape.is_flat() {
        return f64::NEG_INFINITY;
    }
    let normal = flat.normal(0);
    larger_gap(flat, other, &normal).0
}

/// The feature of a point; instead of an edge, its end vertex where the point is within `slack` of it.
#[inline(always)]
pub(super) fn snapped(
    placed: &PlacedPrimitive,
    feature: Feature,
    point: &Vec3,
    slack: f64,
) -> Feature {
    if feature.kind != FeatureKind::Edge {
        return feature;
    }
    let ends = placed.shape.edges[feature.index as usize];
    let is_near = |&i: &u32| (placed.vertex(i) - point).norm() <= slack;
    ends.into_iter()
        .find(is_near)
        .map_or(feature, Feature::vertex)
}

/// Polygons with at most this many edges are compared edge by edge; GJK finds the features of larger ones. The time of the
/// first grows with the product of the edge counts.
const MAX_EDGES_ENUMERATED: usize = 32;

fn is_large(placed: &PlacedPrimitive) -> bool {
    placed.shape.edges.len() > MAX_EDGES_ENUMERATED
}

/// The closest points of polygons in one plane: compares the outlines, then tests containment.
fn planar_closest(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    scratch: &mut DistanceScratch,
) -> Closest {
    scratch.a.set_outline(a);
    scratch.b.set_outline(b);
    let found = closest_features(a, &scratch.a, b, &scratch.b, false);
    let holds = |outer: &PlacedPrimitive, inner: &PlacedPrimitive| {
        let point = inner.vertex(0);
        let inside = !outer.shape.faces.is_empty() && outer.over_face(0, &point).1;
        inside.then_some(point)
    };
    let (inner, outer) = (Feature::vertex(0), Feature::interior());
    if found.distance <= pair.error {
        found
    } else if let Some(point) = holds(b, a) {
        Closest::meeting_at(point, [inner, outer])
    } else if let Some(point) = holds(a, b) {
        Closest::meeting_at(point, [outer, inner])
    } else {
        found
    }
}

/// The closest points of solids, and of polygons too large to enumerate: compares the features near the supporting planes.
/// `start` is a guess of the direction from B to A.
fn bounded_closest(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    start: Vec3,
    pair: &Precision,
    limits: DistanceLimits,
    scratch: &mut DistanceScratch,
) -> Result<Closest, Beyond> {
    let size = pair.size;
    let bounds = gjk(a, b, start, limits);
    if bounds.lower > limits.cutoff {
        return Err(Beyond {
            direction: bounds.direction,
            gap: bounds.lower,
        });
    }
    // A separating direction is trusted over a tetrahedron around the origin.
    let may_meet = bounds.lower <= tolerance::SUPPORT_ERROR * size;
    let is_common = |nearest: &NearestCorners| nearest.difference.norm() <= pair.error;
    let common = bounds.nearest.filter(is_common);
    let common = bounds.near.or(common.map(|nearest| nearest.points));
    if may_meet && bounds.overlap > tolerance::TOUCH_DEPTH * size {
        let common_point = Closest::meeting_at(bounds.common, [Feature::interior(); 2]);
        // Deeper sets have no contact, and yes or no needs none.
        let is_just_inside = bounds.overlap <= tolerance::JUST_INSIDE * size;
        let touch = (is_just_inside && limits.enough < 0.0)
            .then(|| touch_at_end([a, b], &bounds, common, pair))
            .flatten();
        return Ok(Closest {
            depth: bounds.overlap,
            ..touch.unwrap_or(common_point)
        });
    }
    // Yes or no needs no more than a common point; else the features that touch are looked for.
    if let Some(points) = common
        && limits.enough >= 0.0
    {
        return Ok(Closest::between(points, [Feature::interior(); 2]));
    }
    let accepted = tolerance::CERTIFIED_GAP * size;
    if let Some(nearest) = &bounds.nearest
        && let Some(found) = between_corners(a, b, nearest)
    {
        let by_search = nearest.difference.norm() - bounds.lower <= accepted;
        let lower = match bounds.lower > 0.0 && by_search {
            true => Some(bounds.lower),
            // Nearly touching sets turn the search's direction, but not the normal of their features.
            false => gap_along_normal(a, b, &found).filter(|gap| found.distance - gap <= accepted),
        };
        if let Some(lower) = lower {
            let at_end = at_end([a, b], found, pair.error);
            return Ok(at_end
                .filter(|found| found.distance <= lower + accepted)
                .unwrap_or(found));
        }
    }
    if may_meet && let Some(found) = touch_at_end([a, b], &bounds, common, pair) {
        return Ok(found);
    }
    let mut attained = bounds.attained;
    if bounds.lower > 0.0 {
        let slack = tolerance::NEAR_SUPPORT * size;
        scratch.a.set_supporting(a, &-bounds.direction, slack);
        scratch.b.set_supporting(b, &bounds.direction, slack);
        let found = closest_features(a, &scratch.a, b, &scratch.b, false);
        if found.distance - bounds.lower <= accepted
            || found.distance - certificate(a, b, &found, bounds.direction) <= accepted
        {
            return Ok(found);
        }
        attained = attained.min(found.distance);
    }
    let direction = if bounds.lower > 0.0 {
        Some(bounds.direction)
    } else {
        // Of sets that touch, the triangle that the search ends with is mostly on the boundary of their difference.
        bounds.across.and_then(|across| {
            let (gap, direction) = larger_gap(a, b, &across.direction);
            (gap >= -tolerance::TOUCH_DEPTH * size).then_some(direction)
        })
    };
    let known = Known {
        attained,
        direction,
        common: common.map(|points| points[0]),
    };
    let mut found = closest_of_all([a, b], &known, pair, scratch);
    if found.distance > pair.error {
        found.doubt = doubt_of([a, b], &found, direction, pair);
    }
    Ok(found)
}

/// By how much no direction proves the distance of points that were found by comparing features. Of faces that are nearly coplanar rounding
/// may leave none over which a corner is, so that others are taken to be nearest.
fn doubt_of(
    [a, b]: [&PlacedPrimitive; 2],
    found: &Closest,
    direction: Option<Vec3>,
    pair: &Precision,
) -> f64 {
    let proved_at_least = found.distance - tolerance::CERTIFIED_GAP * pair.size;
    let between = (found.points[0] - found.points[1]) / found.distance;
    let mut proved = certificate(a, b, found, direction.unwrap_or(between));
    if proved < proved_at_least {
        let normals = local_normals([a, b], &found.points, pair).into_iter();
        let gaps = normals.map(|normal| larger_gap(a, b, &normal).0);
        proved = gaps.fold(proved, f64::max);
    }
    (proved_at_least - proved.max(0.0)).max(0.0)
}

/// The closest points of sets that touch at the features that a search has come to, or at an end of what these have in common where they
/// are parallel. `common` are those found of sets that meet, if they are known.
fn touch_at_end(
    sides: [&PlacedPrimitive; 2],
    bounds: &Gjk,
    common: Option<[Vec3; 2]>,
    pair: &Precision,
) -> Option<Closest> {
    let [on_a, on_b] = features_of(sides, &bounds.across.as_ref()?.names);
    let features = [on_a?, on_b?];
    let points = bounds.nearest.map(|nearest| nearest.points).or(common);
    let at_end =
        points.and_then(|points| at_end(sides, Closest::between(points, features), pair.error));
    let features = at_end.map_or(features, |found| found.features);
    touch_of(sides, features, common.map(|[point, _]| point), pair)
}

/// The closest points of sets that touch at two features, if their own normal proves it. `common` is a point of both sets, or none.
fn touch_of(
    sides: [&PlacedPrimitive; 2],
    features: [Feature; 2],
    common: Option<Vec3>,
    pair: &Precision,
) -> Option<Closest> {
    let touch = FeatureTouch::at(sides[0], sides[1], features, pair)?;
    touch.closest(sides, features, common, pair)
}

/// The features that corners of each side span, where they span one.
fn features_of(sides: [&PlacedPrimitive; 2], names: &[Names; 2]) -> [Option<Feature>; 2] {
    [0, 1].map(|side| sides[side].feature_of(names[side].as_slice()))
}

/// The nearest points between the corners that GJK ended with, if the corners of each side span a feature.
fn between_corners(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    nearest: &NearestCorners,
) -> Option<Closest> {
    let [on_a, on_b] = features_of([a, b], &nearest.names);
    let features = [on_a?, on_b?];
    let found = Closest::between(nearest.points, features);
    // The foot of a vertex in a face is more accurate than a combination of corners.
    let [on_a, on_b] = found.points;
    Some(match (features[0].kind, features[1].kind) {
        (FeatureKind::Vertex, FeatureKind::Face) => Closest {
            points: [on_a, foot_in(b, features[1], &on_a).unwrap_or(on_b)],
            ..found
        },
        (FeatureKind::Face, FeatureKind::Vertex) => Closest {
            points: [foot_in(a, features[0], &on_b).unwrap_or(on_a), on_b],
            ..found
        },
        _ => found,
    })
}

/// The largest gap proved by one of these directions: the given one, the one between the points, and the normal of their
/// features.
fn certificate(a: &PlacedPrimitive, b: &PlacedPrimitive, found: &Closest, direction: Vec3) -> f64 {
    let mut best = gap_of_primitives(a, b, &direction);
    let mut offer = |n: Vec3| {
        if let Some(n) = n.try_normalize(0.0) {
            let n = if n.dot(&direction) < 0.0 { -n } else { n };
            best = best.max(gap_of_primitives(a, b, &n));
        }
    };
    let [on_a, on_b] = found.features;
    let between = found.points[0] - found.points[1];
    offer(between);
    // What it has along edges is rounding.
    offer(across(b, on_b, across(a, on_a, between)));
    if let Some(normal) = feature_normal(a, b, found.features) {
        offer(normal);
    }
    best
}

/// The gap along the normal of the closest features, on the side where it is larger; negative where the sets overlap.
fn gap_along_normal(a: &PlacedPrimitive, b: &PlacedPrimitive, found: &Closest) -> Option<f64> {
    let normal = feature_normal(a, b, found.features)?;
    Some(larger_gap(a, b, &normal).0)
}
