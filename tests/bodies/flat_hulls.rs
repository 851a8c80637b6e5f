//! Hulls of points of which many lie on a line or in a plane, up to rounding: every point given belongs to the hull.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::error::Result;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::QueryContext;

use helpers::random::Random;

fn hull(points: &[Vec3]) -> Result<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polyhedron(points, 0)?;
    builder.build(&HierarchyOptions::default(), &mut |_| Ok(()))
}

fn point() -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_points(&[Vec3::zeros()], 0.0).unwrap();
    let built = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(built.unwrap())
}

/// Whether the hull is built, and holds all points.
fn holds_all(points: &[Vec3], probe: &Body, name: &str) -> bool {
    let Ok(body) = hull(points) else {
        return false;
    };
    let size = points.iter().map(Vec3::amax).fold(0.0, f64::max);
    for at in points {
        let pose = Pose::from_translation(*at);
        let here = Pose::identity();
        let found = QueryContext::new().pair_distance((&body, &here), (probe, &pose), 1.0);
        let lower = found.unwrap().lower;
        assert!(
            lower <= 1e-11 * size,
            "{name}: {at} is {lower:e} away of {points:?}"
        );
    }
    true
}

#[test]
fn corners_on_lines_of_points_are_kept() {
    let probe = point();
    let whole =
        |points: &[[f64; 3]]| -> Vec<Vec3> { points.iter().map(|p| Vec3::from(*p)).collect() };
    for points in [
        whole(&[
            [3.0, 3.0, 3.0],
            [3.0, 3.0, 2.0],
            [3.0, 3.0, 4.0],
            [1.0, 1.0, 3.0],
        ]),
        whole(&[
            [4.0, 6.0, -9.0],
            [-1.0, 6.0, -9.0],
            [-1.0, 5.0, -11.0],
            [5.0, 6.0, -9.0],
        ]),
        whole(&[
            [1.0, 0.0, 1.0],
            [1.0, 1.0, 1.0],
            [1.0, -1.0, 1.0],
            [-1.0, 0.0, 0.0],
        ]),
    ] {
        assert!(holds_all(&points, &probe, "flat"), "{points:?}");
    }
    let mut random = Random::new(41);
    let mut refused = 0;
    let cases = 3000;
    for case in 0..cases {
        // Grids of points, flat or solid, in any order, turned about an axis or freely, or inclined.
        let counts = [
            2 + random.below(3),
            2 + random.below(4),
            1 + random.below(2),
        ];
        let turn = match case % 4 {
            0 => Mat3::identity(),
            1 => rotation_about(&Vec3::y(), random.within(0.0, 6.3)),
            2 => random.rotation(),
            _ => Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.3, 0.0, 1.0),
        };
        let mut points: Vec<Vec3> = Vec::new();
        for i in 0..counts[0] * counts[1] * counts[2] {
            let [x, rest] = [i % counts[0], i / counts[0]];
            let [y, z] = [rest % counts[1], rest / counts[1]];
            points.push(turn * (0.1 * Vec3::new(x as f64, y as f64, 3.0 * z as f64)));
        }
        for i in (1..points.len()).rev() {
            points.swap(i, random.below(i + 1));
        }
        refused += usize::from(!holds_all(&points, &probe, "grid"));
    }
    println!("{refused} of {cases} refused");
    assert_eq!(refused, 0);
}

/// Few points with small whole coordinates, which are often in one plane or on one line.
#[test]
fn whole_points_have_hulls() {
    let probe = point();
    let mut random = Random::new(43);
    let (mut refused, cases) = (0, 5000);
    for case in 0..cases {
        let most = [2, 3, 8, 1000][case % 4];
        let mut whole = || random.below(2 * most + 1) as f64 - most as f64;
        let points: Vec<Vec3> = (0..4 + case % 9)
            .map(|_| Vec3::from([0; 3].map(|_| whole())))
            .collect();
        let is_spread = points.iter().any(|p| p != &points[0]);
        refused += usize::from(is_spread && !holds_all(&points, &probe, "whole"));
    }
    println!("{refused} of {cases} refused");
    assert_eq!(refused, 0);
}
