//! Triangles that stand for a surface, against dense samples of it.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::random::Random;

/// Along each parameter. Surfaces of up to 6 parts have samples where these meet.
const SAMPLES: usize = 120;

/// Points of a surface, whose parameters go from 0 to 1 in so many steps each.
pub fn samples(at: impl Fn(f64, f64) -> Vec3, steps: usize) -> Vec<Vec3> {
    (0..=steps * steps + 2 * steps)
        .map(|k| {
            let (i, j) = (k / (steps + 1), k % (steps + 1));
            at(i as f64 / steps as f64, j as f64 / steps as f64)
        })
        .collect()
}

/// Balls and points beside a surface, whose parameters go from 0 to 1: the distance of the surface is that of its nearest sample, but
/// for how far samples are from each other.
pub fn check_samples(
    body: &Arc<Body>,
    tolerance: f64,
    at: impl Fn(f64, f64) -> Vec3,
    random: &mut Random,
) {
    let mut query = QueryContext::new();
    let stated = body.stated_deviation();
    assert!(0.0 < stated && stated <= tolerance);
    let samples = samples(&at, SAMPLES);
    // No point of the surface is farther from a sample than half the diagonal of a cell is long; cells are bent a little.
    let gap = (0..SAMPLES * SAMPLES)
        .map(|k| {
            let [i, j] = [k / SAMPLES, k % SAMPLES];
            let corner = |a: usize, b: usize| samples[(i + a) * (SAMPLES + 1) + j + b];
            let across = (corner(0, 0) - corner(1, 1)).norm();
            across.max((corner(0, 1) - corner(1, 0)).norm())
        })
        .fold(0.0, f64::max);
    let ball = ball(0.1);
    for k in 0..60 {
        let near = samples[random.below(samples.len())];
        let center = near + random.unit() * [0.1 + 2.0 * tolerance, 0.5, 2.0][k % 3];
        let pose = Pose::from_translation(center);
        let identity = Pose::identity();
        let distances = samples.iter().map(|sample| (sample - center).norm());
        let sampled = distances.fold(f64::INFINITY, f64::min) - 0.1;
        let found = query
            .pair_distance((body, &identity), (&ball, &pose), f64::INFINITY)
            .unwrap();
        assert!(found.lower <= sampled.max(0.0));
        assert!(found.upper >= sampled - gap, "{found:?} {sampled} {gap}");
        assert!(found.upper - found.lower <= 2.0 * stated + 1e-9);
    }
    // Every sample is within the deviation of the triangles.
    let point = self::ball(0.0);
    for _ in 0..300 {
        let sample = at(random.within(0.0, 1.0), random.within(0.0, 1.0));
        let pose = Pose::from_translation(sample);
        let identity = Pose::identity();
        let found = query
            .pair_distance((body, &identity), (&point, &pose), f64::INFINITY)
            .unwrap();
        assert_eq!(found.distance, 0.0, "{sample}");
    }
}

/// A ball beside a surface: the bounds of its distance take in that of its center in closed form, less its radius.
pub fn check_ball(
    query: &mut QueryContext,
    (body, pose): (&Arc<Body>, &Pose),
    (ball, radius): (&Arc<Body>, f64),
    center: &Vec3,
    distance: impl Fn(&Vec3) -> f64,
) {
    let truth = (distance(center) - radius).max(0.0);
    let at = Pose::from_translation(pose.transform_point(center));
    let found = query
        .pair_distance((body, pose), (ball, &at), f64::INFINITY)
        .unwrap();
    let stated = body.stated_deviation();
    assert!(found.lower <= truth + 1e-14 && truth <= found.upper + 1e-14);
    assert!(found.upper - found.lower <= 2.0 * stated + 1e-9);
}

pub fn built(builder: &BodyBuilder) -> Arc<Body> {
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

pub fn ball(radius: f64) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_sphere(&Vec3::zeros(), radius, 0).unwrap();
    built(&builder)
}
