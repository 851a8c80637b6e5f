//! Curved surfaces refined within queries: spheres made of rational patches, in closed form.

use std::sync::Arc;

use cstk::body::{BezierPatch, Body, BodyBuilder};
use cstk::cobject::Class;
use cstk::error::ErrorKind;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext};

use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};

use super::bezier_patches::{add_sphere, at};
use super::sampled_surfaces::{ball, built, samples};

const GAP: f64 = 1e-6;

/// The surface of a unit sphere that is not finer than the tolerance asks for.
fn sphere(tolerance: f64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add_sphere(&mut builder, tolerance);
    built(&builder)
}

fn refining() -> QueryContext {
    let mut query = QueryContext::new();
    query.set_refinement(Some(GAP)).unwrap();
    query
}

/// The distance of a unit sphere's surface from a ball whose centre is `apart` from its own.
fn from_ball(apart: f64, radius: f64) -> f64 {
    ((apart - 1.0).abs() - radius).max(0.0)
}

/// The distance of two unit spheres' surfaces.
fn from_sphere(apart: f64) -> f64 {
    (apart - 2.0).max(0.0)
}

/// Distances are known to the gap, and thresholds decided up to it, though the body was built with a far larger tolerance.
#[test]
fn spheres_and_balls_are_as_near_as_in_closed_form() {
    let mut random = Random::new(2301);
    let (mut query, mut plain) = (refining(), QueryContext::new());
    let bodies = [0.3, 0.05].map(sphere);
    let radii = [0.0, 0.25, 3.0];
    let balls = radii.map(ball);
    let mut narrowed = 0.0f64;
    for k in 0..1200 {
        let (body, b) = (&bodies[k % 2], k % radii.len());
        let apart = match radii[b] {
            // Around the sphere, or beside it.
            3.0 => random.within(4.0, 4.5),
            radius => [1.0 + radius, 1.0 - radius][random.below(2)] + random.within(-0.2, 0.4),
        };
        let pose = random.pose(5.0);
        let at = Pose::from_translation(pose.translation + random.unit() * apart);
        let truth = from_ball(apart, radii[b]);
        let mut sides = [(&**body, &pose), (&*balls[b], &at)];
        if random.below(2) == 0 {
            sides.swap(0, 1);
        }
        let [r, s] = sides;
        let found = query.pair_distance(r, s, f64::INFINITY).unwrap();
        assert!(found.lower <= truth + 1e-13, "{found:?} {truth}");
        assert!(truth <= found.upper + 1e-13, "{found:?} {truth}");
        assert!(found.upper - found.lower <= GAP, "{found:?}");
        assert!(found.lower - 1e-12 <= found.distance && found.distance <= found.upper);
        if truth > GAP {
            let [on_r, on_s] = found.points;
            let between = (on_r - on_s).norm();
            assert!((between - truth).abs() < 2.0 * GAP, "{found:?} {truth}");
            let contact = found.contact.unwrap();
            assert!((contact.normal - (on_r - on_s) / between).amax() < 1e-6);
        }
        let before = plain.pair_distance(r, s, f64::INFINITY).unwrap();
        narrowed = narrowed.max(before.upper - before.lower);
        for (by, is_within) in [(2.0 * GAP, true), (-2.0 * GAP, false)] {
            if truth + by >= 0.0 {
                let found = query.pair_within(r, s, truth + by).unwrap();
                assert_eq!(found, is_within, "{truth} {by}");
            }
        }
        let most = query.pair_distance(r, s, 0.9 * truth).unwrap();
        if truth > 1e-3 {
            assert_eq!(most.kind, DistanceKind::BeyondMax);
            assert!(0.9 * truth <= most.lower && most.lower <= truth);
        }
    }
    assert!(narrowed > 0.1, "{narrowed}");
}

#[test]
fn two_curved_surfaces_are_as_near_as_in_closed_form() {
    let mut random = Random::new(2302);
    let mut query = refining();
    let bodies = [0.3, 0.05].map(sphere);
    for k in 0..200 {
        let poses = [random.pose(2.0), random.pose(2.0)];
        let apart = random.within(1.8, 3.0);
        let b = Pose {
            translation: poses[0].translation + random.unit() * apart,
            ..poses[1]
        };
        let truth = from_sphere(apart);
        let (r, s) = ((&*bodies[k % 2], &poses[0]), (&*bodies[k / 2 % 2], &b));
        let found = query.pair_distance(r, s, f64::INFINITY).unwrap();
        assert!(found.lower <= truth + 1e-13 && truth <= found.upper + 1e-13);
        assert!(
            found.upper - found.lower <= GAP,
            "{k} {apart} {}",
            found.upper - found.lower
        );
        assert!(query.pair_within(r, s, truth + 2.0 * GAP).unwrap());
        if truth > 2.0 * GAP {
            assert!(!query.pair_within(r, s, truth - 2.0 * GAP).unwrap());
        }
    }
}

/// Surfaces one inside the other, equally near everywhere: the search ends, and says what it knows.
#[test]
fn surfaces_that_are_near_everywhere_end_with_bounds() {
    let mut query = refining();
    let outer = sphere(0.05);
    let inner = {
        let mut builder = BodyBuilder::new(3).unwrap();
        let pose = Pose::identity();
        builder.add_body(&outer, &pose, 0).unwrap();
        built(&builder)
    };
    let here = Pose::identity();
    let found = query.pair_distance((&outer, &here), (&inner, &here), f64::INFINITY);
    let found = found.unwrap();
    assert_eq!(found.lower, 0.0);
    assert!(found.upper <= 0.2);
    let beside = ball(0.5);
    let found = query.pair_distance((&outer, &here), (&beside, &here), f64::INFINITY);
    let found = found.unwrap();
    assert!(found.lower <= 0.5 && 0.5 <= found.upper);
    query.set_limit(Some(100));
    let stopped = query.pair_distance((&outer, &here), (&beside, &here), f64::INFINITY);
    assert_eq!(stopped.unwrap_err().kind, ErrorKind::Limit);
}

/// A robot among objects, some of them curved and some put together of curved parts: the least of closed forms.
#[test]
fn scenes_are_classified_and_measured_as_in_closed_form() {
    let mut random = Random::new(2303);
    let mut query = refining();
    let curved = sphere(0.2);
    let pair = {
        let mut builder = BodyBuilder::new(3).unwrap();
        let at = |x: f64| Pose::from_translation(Vec3::new(x, 0.0, 0.0));
        builder
            .add_sphere(&Vec3::new(0.0, 4.0, 0.0), 0.5, 9)
            .unwrap();
        builder.add_body(&curved, &at(-2.0), 0).unwrap();
        builder.add_body(&curved, &at(2.0), 1).unwrap();
        built(&builder)
    };
    assert!(pair.stated_deviation() > 0.05);
    let mut kinds = [0; 3];
    for _ in 0..60 {
        let objects = [random.pose(4.0), random.pose(4.0), random.pose(4.0)];
        let flat = ball(0.7);
        let (world, _) = environment(&[
            (&curved, objects[0]),
            (&pair, objects[1]),
            (&flat, objects[2]),
        ]);
        let radius = 0.5;
        let space = space(vec![free_body(&ball(radius))]);
        let cobject = against(&space, &world);
        for _ in 0..10 {
            let center = random.point(5.0);
            let q = [center.x, center.y, center.z, 0.0, 0.0, 0.0];
            let from = |point: Vec3| (point - center).norm();
            let within = |x: f64, y: f64| objects[1].transform_point(&Vec3::new(x, y, 0.0));
            let distances = [
                from_ball(from(objects[0].translation), radius),
                from_ball(from(within(-2.0, 0.0)), radius),
                from_ball(from(within(2.0, 0.0)), radius),
                (from(within(0.0, 4.0)) - 0.5 - radius).max(0.0),
                (from(objects[2].translation) - 0.7 - radius).max(0.0),
            ];
            let truth = distances.into_iter().fold(f64::INFINITY, f64::min);
            let nearest = distances.iter().position(|d| *d == truth).unwrap();
            kinds[if truth == 0.0 {
                0
            } else {
                1 + usize::from(nearest > 2)
            }] += 1;
            let at = Configuration::Coordinates(&q);
            let found = query.distance(&cobject, at, f64::INFINITY).unwrap();
            assert!(found.lower <= truth + 1e-12, "{found:?} {truth}");
            assert!(truth <= found.upper + 1e-12, "{found:?} {truth}");
            assert!(found.upper - found.lower <= GAP);
            let class = query.classify(&cobject, at).unwrap();
            if truth > 2.0 * GAP {
                assert_eq!(class, Class::Outside, "{truth}");
                assert!(!query.within(&cobject, at, truth - 2.0 * GAP).unwrap());
                assert!(query.within(&cobject, at, truth + 2.0 * GAP).unwrap());
            } else if truth == 0.0 {
                assert_eq!(class, Class::Inside);
            }
        }
    }
    println!("meeting, curved, flat: {kinds:?}");
    assert!(kinds.iter().all(|count| *count > 20));
}

/// What the builder was told of the body, and vertices that moved, leave nothing to refine.
#[test]
fn only_patches_are_refined() {
    let mut query = refining();
    let mut builder = BodyBuilder::new(3).unwrap();
    add_sphere(&mut builder, 0.1);
    builder.set_deviation(0.2).unwrap();
    let told = built(&builder);
    let here = Pose::identity();
    let at = Pose::from_translation(Vec3::new(3.0, 0.0, 0.0));
    let point = ball(0.0);
    let found = query.pair_distance((&told, &here), (&point, &at), f64::INFINITY);
    let found = found.unwrap();
    assert!(found.upper - found.lower >= 0.4);
    for gap in [0.0, -1.0] {
        let error = query.set_refinement(Some(gap)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
    }
    let error = query.set_refinement(Some(f64::NAN)).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotFinite);
    assert_eq!(query.refinement(), Some(GAP));
    query.set_refinement(None).unwrap();
    let plain = sphere(0.1);
    let found = query.pair_distance((&plain, &here), (&point, &at), f64::INFINITY);
    assert!(found.unwrap().excess > 0.0);
}

/// The same of dense samples of patches of many degrees, and of flat patches of the plane.
#[test]
fn bent_sheets_are_as_near_as_their_samples() {
    let mut random = Random::new(2304);
    let mut query = refining();
    for _ in 0..12 {
        let degrees = [1 + random.below(4), 1 + random.below(4)];
        let columns = degrees[1] + 1;
        let points: Vec<Vec3> = (0..(degrees[0] + 1) * columns)
            .map(|k| Vec3::new((k / columns) as f64, (k % columns) as f64, 0.0) + random.point(0.6))
            .collect();
        let patch = BezierPatch {
            degrees,
            points: &points,
            weights: None,
        };
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_bezier_patch(&patch, 0.2, 0).unwrap();
        let body = built(&builder);
        let samples = samples(|u, v| at(&patch, u, v), 300);
        let point = ball(0.0);
        for _ in 0..6 {
            let beside = Pose::from_translation(random.point(3.0));
            let apart = |sample: &Vec3| (sample - beside.translation).norm();
            let truth = samples.iter().map(apart).fold(f64::INFINITY, f64::min);
            let here = Pose::identity();
            let found = query.pair_distance((&body, &here), (&point, &beside), f64::INFINITY);
            let found = found.unwrap();
            assert!(found.lower <= truth);
            // The square of how far samples are apart, over the distance.
            assert!(found.upper >= truth - 0.01, "{found:?} {truth}");
            assert!(found.upper - found.lower <= GAP);
        }
    }
}

/// The control points of a dome over the unit square, a quarter high at its middle.
fn dome(shift: f64) -> Vec<Vec3> {
    let point = |k: usize| {
        let (i, j) = (k / 3, k % 3);
        let z = if (i, j) == (1, 1) { 1.0 } else { 0.0 };
        Vec3::new(0.5 * i as f64 + shift, 0.5 * j as f64, z)
    };
    (0..9).map(point).collect()
}

/// Far more triangles are near, by the deviation of a coarse part far away, than a refinement begins with: touching bodies are never
/// said to be apart, nor their distance to be known.
#[test]
fn pairs_that_are_left_out_leave_a_doubt() {
    let mut builder = BodyBuilder::new(3).unwrap();
    let add = |builder: &mut BodyBuilder, points: &[Vec3], tolerance: f64| {
        let patch = BezierPatch {
            degrees: [2, 2],
            points,
            weights: None,
        };
        builder.add_bezier_patch(&patch, tolerance, 1).unwrap();
    };
    add(&mut builder, &dome(0.0), 6.25e-4);
    let fine = built(&builder);
    add(&mut builder, &dome(50.0), 0.2);
    let with_coarse = built(&builder);
    // Upside down, top on top.
    let half_turn = Mat3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);
    let mut query = QueryContext::new();
    query.set_refinement(Some(1e-4)).unwrap();
    for lift in [0.0, 1e-3, 0.05] {
        let over = Pose {
            rotation: half_turn,
            translation: Vec3::new(0.0, 1.0, 0.5 + lift),
        };
        let sides = ((&*with_coarse, &Pose::identity()), (&*fine, &over));
        for most in [1e-4, 2e-3, f64::INFINITY] {
            let found = query.pair_distance(sides.0, sides.1, most).unwrap();
            assert!(
                found.lower <= lift + 1e-12 && lift <= found.upper + 1e-12,
                "{lift} {most} {found:?}"
            );
            match found.kind {
                DistanceKind::BeyondMax => assert!(most < lift, "{lift} {most} {found:?}"),
                DistanceKind::LowerBound => assert_eq!(found.distance, found.lower),
                _ => assert!(
                    (found.distance - lift).abs() <= 1e-4,
                    "{lift} {most} {found:?}"
                ),
            }
            assert!(query.pair_within(sides.0, sides.1, lift + 1e-3).unwrap());
        }
    }
}
