//! The closest points of two cores of which at least one is smooth: known only by its support function.

use super::beside_cylinder::{beside_cylinder, is_cylinder};
use super::beyond::Beyond;
use super::closest::Closest;
use super::core::{Core, inside};
use super::likely_parts::{ByParts, LikelyParts, holds};
use super::nearest_parts::NearestParts;
use super::placed::{PlacedPrimitive, Precision};
use super::point_to_smooth::point_to_smooth;
use super::polytope_distance::cuboid;
use super::segment::{Segment, closest_parameters};
use super::touching_parts::{TouchingParts, touch_between};
use crate::gjk::{DistanceLimits, Names, Nearby, Refined, RefinedBounds, refined, walked};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Vec3;
use crate::primitive::Feature;
use crate::tolerance;

/// The closest points of two such cores, and the unit direction from B to A that certifies their distance; zero if there is
/// none; unless the cores are proved to be farther apart than the cutoff.
pub fn smooth_closest(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    pair: &Precision,
    limits: DistanceLimits,
) -> Result<(Closest, Vec3), Beyond> {
    let (core_a, core_b) = (Core::of(a), Core::of(b));
    if let Some(found) = from_point(a, &core_b, pair).or_else(|| {
        let found = from_point(b, &core_a, pair)?;
        Some(found.swapped())
    }) {
        // Not divided by the distance, which is rounded otherwise: this has to be of length 1.
        let direction = (found.points[0] - found.points[1]).normalize();
        return Ok((found, direction));
    }
    if let Some(found) = between_parallel([a, b], [&core_a, &core_b], pair) {
        return Ok(found);
    }
    let cores = [&core_a, &core_b];
    // A start that depends on the two primitives alone, so that the answer does too.
    let start = a.middle() - b.middle();
    let search = || refined_cores(cores, start, pair, limits);
    let close = tolerance::MIN_SMOOTH_NORMAL_DISTANCE * pair.size;
    let found = match likely(cores, pair, limits) {
        Some(ByParts::Beyond { direction, gap }) => return Err(Beyond { direction, gap }),
        Some(ByParts::Within(points)) => return Ok(near_enough(points, Vec3::zeros())),
        Some(ByParts::Meet { point, depth }) => {
            let closest = Closest {
                depth,
                ..Closest::meeting_at(point, [a, b].map(inside))
            };
            return Ok((closest, Vec3::zeros()));
        }
        Some(ByParts::Near(near)) => RefinedBounds::of_nearby(near),
        Some(ByParts::Close { points, direction }) => {
            // Of most cores that overlap by more, or are apart, a walk proves it. Whether two primitives meet was asked of one before.
            let walked =
                (limits.enough != 0.0).then(|| walked(&core_a, &core_b, start, pair.size, limits));
            match walked {
                Some(walked) if walked.depth > 0.0 => walked,
                Some(walked) if walked.lower > close => search(),
                _ => touching(cores, points, direction, pair).unwrap_or_else(search),
            }
        }
        None => match refined_pair(cores, start, pair, limits, close) {
            Refined::Bounds(found) => found,
            Refined::Touch(near) => of_touch(cores, &near, pair, limits).unwrap_or_else(search),
        },
    };
    if found.lower > limits.cutoff {
        return Err(Beyond {
            direction: found.direction,
            gap: found.lower,
        });
    }
    if found.upper <= limits.enough {
        return Ok(near_enough(found.points, found.direction));
    }
    let deep = tolerance::JUST_INSIDE * pair.size;
    let slack = tolerance::ON_FEATURE * pair.size;
    let closest = Closest {
        distance: found.upper,
        points: found.points,
        features: [(a, 0), (b, 1)].map(|(placed, side)| {
            if placed.shape.smooth().is_some() || found.depth > deep {
                inside(placed)
            } else {
                let names = found.names.map(|names| names[side]);
                holding_feature(placed, names, &found.points[side], slack)
            }
        }),
        doubt: doubt(&found),
        depth: found.depth,
    };
    Ok((closest, found.direction))
}

/// What the parts that probably hold the closest points prove.
fn likely(cores: [&Core; 2], pair: &Precision, limits: DistanceLimits) -> Option<ByParts> {
    let least = tolerance::SUPPORT_ERROR * pair.size;
    let threshold = limits.by_more_than(tolerance::SMOOTH_ERROR * pair.size);
    let limits = threshold.unwrap_or(DistanceLimits {
        enough: f64::NEG_INFINITY,
        cutoff: limits.cutoff.max(least),
    });
    with_widest(LikelyParts {
        cores,
        accepted: tolerance::CERTIFIED_GAP * pair.size,
        least,
        deep: tolerance::JUST_INSIDE * pair.size,
        close: tolerance::MIN_SMOOTH_NORMAL_DISTANCE * pair.size,
        limits,
    })
}

/// The bounds of cores that touch or are next to each other at two points; `None` where they are not found, or the cores overlap by more than
/// [`tolerance::JUST_INSIDE`] L. The direction of cores that touch is the contact's normal.
#[inline(never)]
fn touching(
    cores: [&Core; 2],
    points: [Vec3; 2],
    direction: Vec3,
    pair: &Precision,
) -> Option<RefinedBounds> {
    let parts = TouchingParts::new(cores, points, pair.size);
    touch_bounds(cores, &parts.touch(direction).1?, pair)
}

/// The same of cores that a search ended with a signed gap of, `lower`. Of cores that overlap another direction may have a larger one; yes or
/// no needs no more than a common point.
fn of_touch(
    cores: [&Core; 2],
    near: &Nearby,
    pair: &Precision,
    limits: DistanceLimits,
) -> Option<RefinedBounds> {
    if near.lower >= -tolerance::SUPPORT_ERROR * pair.size || limits.enough >= 0.0 {
        return touch_bounds(cores, near, pair);
    }
    touching(cores, near.points, near.direction, pair)
}

/// The bounds of cores with a signed gap, `lower`; `None` likewise.
fn touch_bounds(cores: [&Core; 2], near: &Nearby, pair: &Precision) -> Option<RefinedBounds> {
    let bounds = RefinedBounds::of_nearby(*near);
    let rounding = tolerance::SUPPORT_ERROR * pair.size;
    if near.lower > rounding {
        return Some(bounds);
    }
    if near.lower < -tolerance::JUST_INSIDE * pair.size {
        return None;
    }
    let touch = RefinedBounds {
        lower: 0.0,
        ..bounds
    };
    if near.lower >= -rounding {
        return Some(touch);
    }
    // Where surfaces have crossed, what is between them is in both, and at an edge, a rim or an apex that itself.
    let [p, q] = near.points;
    let is_common = |point: &Vec3| cores.iter().all(|core| holds(core, point, rounding));
    let common = [0.5 * (p + q), p, q].into_iter().find(is_common)?;
    Some(RefinedBounds {
        upper: 0.0,
        points: [common; 2],
        ..touch
    })
}

/// Two points that decide a threshold: not the closest ones, so that no features hold them.
fn near_enough(points: [Vec3; 2], direction: Vec3) -> (Closest, Vec3) {
    (
        Closest::between(points, [Feature::interior(); 2]),
        direction,
    )
}

/// The closest points of a single point and a smooth core in closed form, if they are far enough apart to define a direction.
fn from_point(point: &PlacedPrimitive, core: &Core, pair: &Precision) -> Option<Closest> {
    let is_point = point.vertex_count() == 1 && point.shape.smooth().is_none();
    if !is_point {
        return None;
    }
    let least = tolerance::MIN_SMOOTH_NORMAL_DISTANCE * pair.size;
    point_to_smooth(&point.vertex(0), core, least)
}

/// The closest points of a cylinder and of what has an axis parallel to its own, in closed form.
fn between_parallel(
    [a, b]: [&PlacedPrimitive; 2],
    [core_a, core_b]: [&Core; 2],
    pair: &Precision,
) -> Option<(Closest, Vec3)> {
    if is_cylinder(core_a) {
        return beside_cylinder([core_a, core_b], b, pair.size);
    }
    let (found, direction) = beside_cylinder([core_b, core_a], a, pair.size)?;
    Some((found.swapped(), -direction))
}

/// How far the upper bound may exceed the distance, beyond the pair's error. Where no direction proves the sets apart it is the
/// whole upper bound, so that callers get a lower bound of 0. That error holds the rounding of the lower bound too: in EPSILON L, 16
/// of the poses (see [`tolerance::DISTANCE_ERROR`]), 10 of each smooth support point, which is found in the core's own frame, turned and
/// shifted, and 4 of the product: 40 of 48.
fn doubt(found: &RefinedBounds) -> f64 {
    if found.lower == 0.0 {
        return found.upper;
    }
    (found.upper - found.lower).max(0.0)
}

/// The distance of the cores after A's has moved by `shift`.
pub fn shifted_cores(
    a: &PlacedPrimitive,
    b: &PlacedPrimitive,
    start: Vec3,
    shift: Vec3,
    pair: &Precision,
) -> RefinedBounds {
    let (a, b) = (Core::shifted(a, shift), Core::of(b));
    refined_cores([&a, &b], start, pair, DistanceLimits::EXACT)
}

fn refined_cores(
    cores: [&Core; 2],
    start: Vec3,
    pair: &Precision,
    limits: DistanceLimits,
) -> RefinedBounds {
    refined_pair(cores, start, pair, limits, f64::NEG_INFINITY).bounds()
}

/// The same by a search that also ends at a touch, where two points are no more than `close` apart.
fn refined_pair(
    cores: [&Core; 2],
    start: Vec3,
    pair: &Precision,
    limits: DistanceLimits,
    close: f64,
) -> Refined {
    let accepted = tolerance::CERTIFIED_GAP * pair.size;
    let [a, b] = cores;
    let finish = |names: &[Names; 2], direction: &Vec3, at_touch: bool| match at_touch {
        true => touch_between(cores, *names, direction, pair.size),
        false => with_widest(Finish {
            cores,
            names: *names,
            accepted,
            direction,
        }),
    };
    refined(a, b, start, pair.size, limits, close, finish)
}

/// The end of a search, by Newton's method.
struct Finish<'a> {
    cores: [&'a Core<'a>; 2],
    names: [Names; 2],
    accepted: f64,
    direction: &'a Vec3,
}

impl Work for Finish<'_> {
    type Output = Option<Nearby>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<Nearby> {
        NearestParts::new(self.cores, self.names, self.accepted)?.solve(self.direction)
    }
}

/// The feature of a polytope that holds a point of it: one of those between the corners of these names, if they are known.
pub fn holding_feature(
    placed: &PlacedPrimitive,
    names: Option<Names>,
    point: &Vec3,
    slack: f64,
) -> Feature {
    if let Some(names) = &names {
        let names = names.as_slice();
        let near = |&&i: &&u32| (placed.vertex(i) - point).norm() <= slack;
        let vertex = names.iter().find(near).copied();
        let known = vertex
            .map(Feature::vertex)
            .or_else(|| placed.feature_of(names));
        if let Some(known) = known {
            return known;
        }
    }
    feature_at(placed, point, slack)
}

/// The first feature of a polytope near a point of it: vertices first, then edges, then faces.
fn feature_at(placed: &PlacedPrimitive, point: &Vec3, slack: f64) -> Feature {
    if let Some(cuboid) = cuboid(placed) {
        return cuboid.feature_at(&cuboid.seen(&placed.seen(point)), slack);
    }
    let near = |v: &Vec3| (v - point).norm() <= slack;
    if let Some(i) = placed.vertices().iter().position(near) {
        return Feature::vertex(i as u32);
    }
    let here = Segment::point(*point);
    let on_edge = placed.shape.edges.iter().position(|&ends| {
        let segment = Segment::new(placed.edge_ends(ends));
        near(&segment.at(closest_parameters(&here, &segment).1))
    });
    if let Some(i) = on_edge {
        return Feature::edge(i as u32);
    }
    let mut faces = 0..placed.shape.faces.len();
    let face = faces.find(|&f| placed.height_over(f, point).abs() <= slack);
    face.map_or(Feature::interior(), |f| Feature::face(f as u32))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use cstk_scenes::Random;

    use super::*;
    use crate::gjk::Support;
    use crate::pose::{Pose, rotation_about};
    use crate::primitive::{Convex, Form, block, cone, convex_polyhedron, cylinder, ellipsoid};

    fn vector(random: &mut Random) -> Vec3 {
        Vec3::from(random.point(1.0))
    }

    fn pose(random: &mut Random, distance: f64) -> Pose {
        let axis = vector(random).normalize();
        Pose {
            rotation: rotation_about(&axis, random.within(0.0, 6.0)),
            translation: vector(random) * distance,
        }
    }

    fn shape(random: &mut Random, kind: usize, spread: f64) -> Convex {
        let mut size = || 10f64.powf(random.within(-spread, 0.0));
        let (a, b, c) = (size(), size(), size());
        let at = Pose::identity();
        match kind {
            0 => cylinder(&at, a, b).unwrap(),
            1 => cone(&at, a, b).unwrap(),
            2 => ellipsoid(&at, &Vec3::new(a, b, c)).unwrap(),
            3 => convex_polyhedron(&[vector(random)]).unwrap(),
            4 => convex_polyhedron(&[vector(random), vector(random)]).unwrap(),
            5 => convex_polyhedron(&[vector(random), vector(random), vector(random)]).unwrap(),
            _ => convex_polyhedron(&(0..10).map(|_| vector(random)).collect::<Vec<_>>()).unwrap(),
        }
    }

    /// The bounds of A as it is and B at a pose, which come together.
    fn closest(a: &Convex, b: &Convex, pose: &Pose) -> RefinedBounds {
        let mut buffer = crate::convex::PlacedBuffer::default();
        let (a, b) = (
            PlacedPrimitive::at_home(a, None),
            buffer.place(b, None, pose),
        );
        let pair = Precision {
            size: 1.0 + pose.translation.norm(),
            error: 0.0,
            planar: false,
        };
        let start = a.middle() - b.middle();
        let found = shifted_cores(&a, &b, start, Vec3::zeros(), &pair);
        let gap = (found.upper - found.lower) / pair.size;
        assert!((-1e-14..=5e-12).contains(&gap), "{gap:e} {found:?}");
        found
    }

    /// The bounds check each other: the upper one comes from two points of the sets, the lower one from a direction. 20 000
    /// pairs of each kind gave the numbers at [`tolerance::SMOOTH_ERROR`].
    #[test]
    fn bounds_come_together() {
        let mut overlaps = 0;
        for (spread, kinds) in [1e-4, 1.0, 4.0]
            .iter()
            .flat_map(|s| (0..21).map(move |k| (*s, k)))
        {
            let random = &mut Random::new(kinds as u64 + 1);
            for _ in 0..400 {
                let a = shape(random, kinds % 3, spread);
                let b = shape(random, kinds / 3, spread);
                let reach = random.within(0.3, 3.0);
                let found = closest(&a, &b, &pose(random, reach));
                overlaps += usize::from(found.upper == 0.0);
            }
        }
        assert!(overlaps > 1000, "{overlaps}");
    }
    /// What is guessed agrees with the search, and is right for most pairs: 9 of 10 that are apart or meet deeply, 7 of 10 of thin ones.
    #[test]
    fn likely_parts_are_those_of_the_search() {
        let exact = DistanceLimits::EXACT;
        for (spread, share) in [(0.3, 0.9), (1.0, 0.7), (4.0, 0.0)] {
            let random = &mut Random::new(11);
            let (mut guessed, mut asked) = (0, 0);
            for round in 0..12_000 {
                let kinds = [round % 3, round / 3 % 7];
                let shapes = kinds.map(|kind| match kind {
                    6 => {
                        let half = Vec3::from_fn(|_, _| 10f64.powf(random.within(-spread, 0.0)));
                        block(&Pose::identity(), &half).unwrap()
                    }
                    kind => shape(random, kind, spread),
                });
                let forms = [0, 1].map(|side| Form::of(&shapes[side]));
                let mut buffer = crate::convex::PlacedBuffer::default();
                let far = random.within(0.3, 3.0);
                let pose = pose(random, far);
                let a = PlacedPrimitive::at_home(&shapes[0], forms[0].as_ref());
                let b = buffer.place(&shapes[1], forms[1].as_ref(), &pose);
                let pair = Precision {
                    size: 1.0 + pose.translation.norm(),
                    error: 0.0,
                    planar: false,
                };
                let cores = [Core::of(&a), Core::of(&b)];
                let start = a.middle() - b.middle();
                let found = refined_cores([&cores[0], &cores[1]], start, &pair, exact);
                let is_clear = found.lower > 1e-6 || found.depth > 1e-2;
                asked += usize::from(is_clear && kinds[1] != 5);
                let Some(proved) = likely([&cores[0], &cores[1]], &pair, exact) else {
                    continue;
                };
                guessed += usize::from(is_clear && kinds[1] != 5);
                match proved {
                    ByParts::Near(near) => {
                        let distance = (near.points[0] - near.points[1]).norm();
                        let off = (distance - found.upper).abs().max(distance - near.lower);
                        assert!(off <= 1e-13 * pair.size, "{distance} {found:?}");
                    }
                    ByParts::Meet { point, depth } => {
                        assert!(found.upper <= 1e-14 * pair.size, "{depth} {found:?}");
                        for core in &cores {
                            let away = Vec3::from(random.point(1.0)).normalize();
                            let over = away.dot(&(core.support(&away) - point));
                            assert!(over > -1e-14 * pair.size, "{over}");
                        }
                    }
                    ByParts::Close { .. } => guessed -= usize::from(is_clear && kinds[1] != 5),
                    ByParts::Beyond { .. } | ByParts::Within(_) => panic!("nothing is asked"),
                }
            }
            let part = guessed as f64 / asked as f64;
            assert!(part > share, "{part} of {asked} at {spread}");
        }
    }

    /// The same of what stands upright or is turned by quarters: surfaces are level, and lines parallel. Two steps are enough in the mean.
    #[test]
    fn bounds_of_level_shapes_come_together_soon() {
        let random = &mut Random::new(4);
        let (mut steps, mut apart) = (0, 0);
        for round in 0..8000 {
            let (kind, other) = ([0, 1][round % 2], round / 2 % 4);
            let a = shape(random, kind, 1.0);
            let b = match other {
                0 | 1 => shape(random, other, 1.0),
                2 => {
                    let end = Vec3::z() * random.within(0.1, 1.0);
                    convex_polyhedron(&[end, -end]).unwrap()
                }
                _ => {
                    let (radius, half) = (random.within(0.1, 1.0), random.within(0.1, 1.0));
                    let corners = (0..12).map(|k| {
                        let (y, x) = f64::sin_cos(f64::from(k / 2) * TAU / 6.0);
                        let height = if k % 2 == 0 { half } else { -half };
                        Vec3::new(radius * x, radius * y, height)
                    });
                    convex_polyhedron(&corners.collect::<Vec<_>>()).unwrap()
                }
            };
            let over = random.within(0.0, 4.0).floor() * TAU / 4.0;
            let pose = Pose {
                rotation: rotation_about(&Vec3::z(), random.within(0.0, TAU))
                    * rotation_about(&Vec3::x(), if round % 3 == 0 { over } else { 0.0 }),
                translation: vector(random) * 2.0,
            };
            let found = closest(&a, &b, &pose);
            if found.lower > 1e-3 {
                apart += 1;
                steps += found.iterations;
            }
        }
        assert!(apart > 4000 && steps < 2 * apart, "{steps} of {apart}");
    }
}
