//! Depths and signed distances of convex pairs, beside closed forms and brute force.

use std::sync::Arc;

use cstk::body::Body;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::all_cases;
use helpers::oracle::hull_distance;
use helpers::random::Random;
use helpers::shapes::{box_corners, cuboid, hull, widest_gap};

use crate::depths::{at, built, depth, depth_to};

/// The bounds of a signed distance: of the distance of bodies that are apart, else of minus their depth.
fn signed(a: (&Body, &Pose), b: (&Body, &Pose)) -> [f64; 2] {
    let apart = QueryContext::new()
        .pair_distance(a, b, f64::INFINITY)
        .unwrap();
    match apart.lower > 0.0 {
        true => [apart.lower, apart.upper],
        false => {
            let found = depth(a, b);
            [-found.upper, -found.lower]
        }
    }
}

/// The signed distance of a point from a box around the origin.
fn from_box(point: &Vec3, half: &Vec3) -> f64 {
    let beyond = point.abs() - half;
    beyond.sup(&Vec3::zeros()).norm() + beyond.max().min(0.0)
}

fn from_segment(point: &Vec3, [from, to]: &[Vec3; 2]) -> f64 {
    let along = to - from;
    let part = along.dot(&(point - from)) / along.norm_squared();
    (point - from - along * part.clamp(0.0, 1.0)).norm()
}

/// The same of two hulls, by brute force.
fn between_hulls(a: &[Vec3], b: &[Vec3]) -> f64 {
    let found = hull_distance(a, b);
    if found.gap < 0.0 {
        return found.gap;
    }
    assert!(found.upper - found.gap < 1e-11);
    found.upper
}

#[test]
fn convex_pairs_have_the_signed_distances_of_closed_forms() {
    let mut random = Random::new(9);
    let cases = if all_cases() { 100_000 } else { 1600 };
    let mut counts = [[0; 2]; 4];
    for case in 0..cases {
        let poses = [random.pose(0.9), random.pose(0.9)];
        let placed = |points: &[Vec3], i: usize| -> Vec<Vec3> {
            points.iter().map(|p| poses[i].transform_point(p)).collect()
        };
        let mut sides = || [0, 1, 2].map(|_| random.within(0.3, 2.0));
        let sides = [sides(), sides()];
        let radius = random.within(0.1, 1.0);
        let ball = built(|b| b.add_sphere(&Vec3::zeros(), radius, 0).unwrap());
        let ball = Arc::new(ball);
        let center = poses[1].translation;
        let kind = case % 4;
        let (a, b, exact) = match kind {
            0 => {
                let gap = widest_gap(sides, [&poses[0], &poses[1]]);
                let corners = [0, 1].map(|i| placed(&box_corners(sides[i]), i));
                let exact = match gap < 0.0 {
                    true => gap,
                    false => between_hulls(&corners[0], &corners[1]),
                };
                let [a, b] = sides.map(|sides| cuboid(sides).body);
                (a, b, exact)
            }
            1 => {
                let mut points = || {
                    let count = 4 + random.below(3);
                    random.points(count, 1.0)
                };
                let points = [points(), points()];
                let exact = between_hulls(&placed(&points[0], 0), &placed(&points[1], 1));
                let [a, b] = points.map(|points| hull(&points).body);
                (a, b, exact)
            }
            2 => {
                let local = poses[0].rotation.tr_mul(&(center - poses[0].translation));
                let half = Vec3::from(sides[0]) * 0.5;
                (
                    cuboid(sides[0]).body,
                    ball,
                    from_box(&local, &half) - radius,
                )
            }
            _ => {
                let ends = [random.point(0.7), random.point(0.7)];
                let thickness = random.within(0.1, 0.5);
                let capsule = built(|b| b.add_capsule(&ends[0], &ends[1], thickness, 0).unwrap());
                let capsule = Arc::new(capsule);
                let axis = ends.map(|end| poses[0].transform_point(&end));
                (
                    capsule,
                    ball,
                    from_segment(&center, &axis) - thickness - radius,
                )
            }
        };
        let [lower, upper] = signed((&a, &poses[0]), (&b, &poses[1]));
        assert!(
            lower <= exact + 1e-11 && exact - 1e-11 <= upper && upper - lower < 1e-9,
            "case {case}: {exact} in {lower} .. {upper}"
        );
        counts[kind][usize::from(exact < 0.0)] += 1;
    }
    println!(
        "{cases} pairs, apart and meeting: boxes, hulls, box and ball, capsule and ball {counts:?}"
    );
    assert!(
        counts.iter().flatten().all(|count| 40 * count > cases),
        "{counts:?}"
    );
}

#[test]
fn balls_and_capsules_have_closed_forms() {
    let ball = |radius: f64| built(|b| b.add_sphere(&Vec3::zeros(), radius, 0).unwrap());
    let found = depth(
        (&ball(1.0), &at(0.6, 0.8, 0.3)),
        (&ball(0.5), &at(0.0, 0.0, 0.0)),
    );
    let exact = 1.5 - Vec3::new(0.6, 0.8, 0.3).norm();
    assert!(
        (found.lower - exact).abs() < 1e-11 && (found.upper - exact).abs() < 1e-11,
        "{found:?}"
    );
    // Concentric: every direction is as good.
    let found = depth(
        (&ball(1.0), &at(0.0, 0.0, 0.0)),
        (&ball(0.5), &at(0.0, 0.0, 0.0)),
    );
    assert!(
        (found.upper - 1.5).abs() < 1e-10 && (found.lower - 1.5).abs() < 1e-10,
        "{found:?}"
    );
    // Two balls side by side, and one between them that must move across, not along.
    let pair = built(|b| {
        b.add_sphere(&Vec3::new(-0.4, 0.0, 0.0), 0.5, 0).unwrap();
        b.add_sphere(&Vec3::new(0.4, 0.0, 0.0), 0.5, 1).unwrap();
    });
    let found = depth_to(
        (&ball(0.5), &at(0.0, 0.1, 0.0)),
        (&pair, &at(0.0, 0.0, 0.0)),
        1e-4,
        5000,
    );
    // The way out ends where both balls touch: at height sqrt(1 - .16).
    let exact = 0.84f64.sqrt() - 0.1;
    assert!(
        found.lower <= exact && found.upper >= exact - 1e-12,
        "{found:?}"
    );
    assert!(found.upper - exact < 1e-9, "{exact} {found:?}");
}

#[test]
fn cylinders_have_bounds_too() {
    let cylinder = built(|b| b.add_cylinder(&Pose::identity(), 0.5, 1.0, 0).unwrap());
    let block = cuboid([4.0, 4.0, 1.0]).body;
    for (pose, exact) in [(at(0.1, 0.2, 1.2), 0.3), (at(2.2, 0.1, 0.0), 0.3)] {
        let found = depth_to((&cylinder, &pose), (&block, &at(0.0, 0.0, 0.0)), 1e-3, 4000);
        assert!(
            found.lower <= exact + 1e-9 && found.upper >= exact - 1e-9,
            "{found:?}"
        );
        assert!(found.upper - exact < 1e-8, "{exact} {found:?}");
        assert!(found.is_tight && found.lower > exact - 1e-3, "{found:?}");
    }
}
