//! Bezier patches as triangles: against dense samples of the patches, and against the spheres that rational patches are.

use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

use cstk::body::{BezierPatch, Body, BodyBuilder};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::random::Random;

pub fn built(builder: &BodyBuilder) -> Arc<Body> {
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

/// Bernstein's polynomials of a degree, by their definition.
fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let binomial = |k: usize| (0..k).fold(1.0, |all, i| all * (degree - i) as f64 / (i + 1) as f64);
    (0..=degree)
        .map(|k| binomial(k) * t.powi(k as i32) * (1.0 - t).powi((degree - k) as i32))
        .collect()
}

fn at(patch: &BezierPatch, u: f64, v: f64) -> Vec3 {
    let [in_u, in_v] = [(patch.degrees[0], u), (patch.degrees[1], v)].map(|(n, t)| bernstein(n, t));
    let (mut sum, mut weights) = (Vec3::zeros(), 0.0);
    for (i, a) in in_u.iter().enumerate() {
        for (j, b) in in_v.iter().enumerate() {
            let index = i * in_v.len() + j;
            let weight = a * b * patch.weights.map_or(1.0, |weights| weights[index]);
            sum += patch.points[index] * weight;
            weights += weight;
        }
    }
    sum / weights
}

/// A grid of points of a patch, `count` steps either way.
pub fn samples(patch: &BezierPatch, count: usize) -> Vec<Vec3> {
    (0..=count * count + 2 * count)
        .map(|k| {
            let (i, j) = (k / (count + 1), k % (count + 1));
            at(patch, i as f64 / count as f64, j as f64 / count as f64)
        })
        .collect()
}

/// Control points over a bent sheet, some of them moved onto others so that edges are points.
fn drawn(random: &mut Random) -> ([usize; 2], Vec<Vec3>, Option<Vec<f64>>) {
    let degrees = [1 + random.below(4), 1 + random.below(4)];
    let count = (degrees[0] + 1) * (degrees[1] + 1);
    let mut points: Vec<Vec3> = (0..count)
        .map(|k| {
            let (i, j) = (k / (degrees[1] + 1), k % (degrees[1] + 1));
            Vec3::new(i as f64, j as f64, 0.0) + random.point(0.6)
        })
        .collect();
    if random.below(4) == 0 {
        let pole = points[0];
        points[..=degrees[1]].fill(pole);
    }
    let weights =
        (random.below(2) == 0).then(|| (0..count).map(|_| random.within(0.3, 3.0)).collect());
    (degrees, points, weights)
}

/// Balls beside random patches: the distance of a patch is that of its nearest sample, but for how far samples are from each other.
#[test]
fn bounds_hold_for_densely_sampled_patches() {
    const SAMPLES: usize = 120;
    let mut random = Random::new(2201);
    let mut query = QueryContext::new();
    let mut triangles = 0;
    for round in 0..45 {
        let (degrees, points, weights) = drawn(&mut random);
        let patch = BezierPatch {
            degrees,
            points: &points,
            weights: weights.as_deref(),
        };
        let tolerance = [0.3, 0.1, 0.02][round % 3];
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_bezier_patch(&patch, tolerance, 7).unwrap();
        let body = built(&builder);
        triangles += body.primitives().len();
        let stated = body.stated_deviation();
        assert!(0.0 < stated && stated <= tolerance);
        assert_eq!(body.tag(0), 7);
        let samples = samples(&patch, SAMPLES);
        // No point of the patch is farther from a sample than half the diagonal of a cell is long; cells are bent a little.
        let gap = (0..SAMPLES * SAMPLES)
            .map(|k| {
                let [i, j] = [k / SAMPLES, k % SAMPLES];
                let corner = |a: usize, b: usize| samples[(i + a) * (SAMPLES + 1) + j + b];
                let across = (corner(0, 0) - corner(1, 1)).norm();
                across.max((corner(0, 1) - corner(1, 0)).norm())
            })
            .fold(0.0, f64::max);
        let mut ball = BodyBuilder::new(3).unwrap();
        ball.add_sphere(&Vec3::zeros(), 0.1, 0).unwrap();
        let ball = built(&ball);
        for k in 0..60 {
            let near = samples[random.below(samples.len())];
            let center = near + random.unit() * [0.1 + 2.0 * tolerance, 0.5, 2.0][k % 3];
            let pose = Pose::from_translation(center);
            let identity = Pose::identity();
            let distances = samples.iter().map(|sample| (sample - center).norm());
            let sampled = distances.fold(f64::INFINITY, f64::min) - 0.1;
            let found = query
                .pair_distance((&body, &identity), (&ball, &pose), f64::INFINITY)
                .unwrap();
            assert!(found.lower <= sampled.max(0.0));
            assert!(found.upper >= sampled - gap, "{found:?} {sampled} {gap}");
            assert!(found.upper - found.lower <= 2.0 * stated + 1e-9);
        }
        // Every sample is within the deviation of the triangles.
        let mut point = BodyBuilder::new(3).unwrap();
        point.add_sphere(&Vec3::zeros(), 0.0, 0).unwrap();
        let point = built(&point);
        for _ in 0..300 {
            let sample = at(&patch, random.within(0.0, 1.0), random.within(0.0, 1.0));
            let pose = Pose::from_translation(sample);
            let identity = Pose::identity();
            let found = query
                .pair_distance((&body, &identity), (&point, &pose), f64::INFINITY)
                .unwrap();
            assert_eq!(found.distance, 0.0, "{sample}");
        }
    }
    println!("{triangles} triangles");
}

/// An eighth of the unit sphere, one edge of which is a point.
const OCTANT: [([f64; 3], f64); 9] = [
    ([1.0, 0.0, 0.0], 1.0),
    ([1.0, 1.0, 0.0], FRAC_1_SQRT_2),
    ([0.0, 1.0, 0.0], 1.0),
    ([1.0, 0.0, 1.0], FRAC_1_SQRT_2),
    ([1.0, 1.0, 1.0], 0.5),
    ([0.0, 1.0, 1.0], FRAC_1_SQRT_2),
    ([0.0, 0.0, 1.0], 1.0),
    ([0.0, 0.0, 1.0], FRAC_1_SQRT_2),
    ([0.0, 0.0, 1.0], 1.0),
];

/// Adds the surface of the unit sphere, as eight patches tagged with their octants.
pub fn add_sphere(builder: &mut BodyBuilder, tolerance: f64) {
    for octant in 0..8 {
        let sign = Vec3::from_fn(|k, _| if octant >> k & 1 == 0 { 1.0 } else { -1.0 });
        let points = OCTANT.map(|(p, _)| Vec3::from(p).component_mul(&sign));
        let weights = OCTANT.map(|(_, weight)| 5.0 * weight);
        let patch = BezierPatch {
            degrees: [2, 2],
            points: &points,
            weights: Some(&weights),
        };
        builder.add_bezier_patch(&patch, tolerance, octant).unwrap();
    }
}

#[test]
fn eight_rational_patches_are_a_sphere() {
    let mut random = Random::new(2202);
    let mut query = QueryContext::new();
    let mut counts = Vec::new();
    for tolerance in [0.1, 0.01, 0.001] {
        let mut builder = BodyBuilder::new(3).unwrap();
        add_sphere(&mut builder, tolerance);
        let body = built(&builder);
        counts.push(body.primitives().len());
        let stated = body.stated_deviation();
        let mut ball = BodyBuilder::new(3).unwrap();
        ball.add_sphere(&Vec3::zeros(), 0.25, 0).unwrap();
        let ball = built(&ball);
        for _ in 0..3000 {
            let pose = random.pose(0.5);
            let apart = [1.25, 0.75][random.below(2)] + random.within(-3.0, 3.0) * stated;
            let at = Pose::from_translation(pose.translation + random.unit() * apart);
            let truth = (apart - 1.25).max(0.75 - apart).max(0.0);
            let found = query
                .pair_distance((&body, &pose), (&ball, &at), f64::INFINITY)
                .unwrap();
            assert!(found.lower <= truth + 1e-14 && truth <= found.upper + 1e-14);
            assert!(found.upper - found.lower <= 2.0 * stated + 1e-9);
        }
    }
    println!("{counts:?} triangles");
    // Ten times as near takes about ten times as many triangles.
    assert!(counts[1] < 20 * counts[0] && counts[2] < 20 * counts[1]);
}

#[test]
fn flat_patches_are_two_triangles() {
    let points: Vec<Vec3> = (0..16)
        .map(|k| Vec3::new(f64::from(k / 4), f64::from(k % 4), 0.0))
        .collect();
    let patch = BezierPatch {
        degrees: [3, 3],
        points: &points,
        weights: None,
    };
    for dimension in [2, 3] {
        let mut builder = BodyBuilder::new(dimension).unwrap();
        builder.add_bezier_patch(&patch, 1e-9, 0).unwrap();
        let body = built(&builder);
        assert_eq!(body.primitives().len(), 2);
        assert!(body.stated_deviation() < 1e-12);
    }
}

#[test]
fn what_is_no_patch_is_refused_and_adds_nothing() {
    let points: Vec<Vec3> = (0..4)
        .map(|k| Vec3::new(f64::from(k / 2), f64::from(k % 2), f64::from(k)))
        .collect();
    let good = BezierPatch {
        degrees: [1, 1],
        points: &points,
        weights: None,
    };
    let mut builder = BodyBuilder::new(3).unwrap();
    let mut refused = |patch: BezierPatch, tolerance: f64, kind: ErrorKind, culprit: &str| {
        let error = builder.add_bezier_patch(&patch, tolerance, 0).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.message.contains(culprit), "{error}");
        assert!(builder.is_empty());
    };
    let (invalid, size) = (ErrorKind::InvalidArgument, ErrorKind::WrongSize);
    for degrees in [[0, 1], [33, 1], [usize::MAX, 1]] {
        refused(BezierPatch { degrees, ..good }, 0.1, invalid, "degree_u");
    }
    let degrees = [1, 2];
    refused(
        BezierPatch { degrees, ..good },
        0.1,
        size,
        "6 control points",
    );
    for tolerance in [0.0, -1.0] {
        refused(good, tolerance, invalid, "tolerance");
    }
    refused(good, f64::NAN, ErrorKind::NotFinite, "tolerance");
    for (weight, kind) in [
        (0.0, invalid),
        (-1.0, invalid),
        (1e-7, invalid),
        (f64::NAN, ErrorKind::NotFinite),
    ] {
        let weights = Some(&[1.0, 1.0, weight, 1.0][..]);
        refused(BezierPatch { weights, ..good }, 0.1, kind, "weight 2");
    }
    let weights = Some(&[1.0; 3][..]);
    refused(BezierPatch { weights, ..good }, 0.1, size, "weights");
    let twisted = [
        Vec3::zeros(),
        Vec3::x(),
        Vec3::y(),
        Vec3::new(1.0, 1.0, 5.0),
    ];
    let twisted = BezierPatch {
        points: &twisted,
        ..good
    };
    for tolerance in [1e-9, 1e-300] {
        refused(twisted, tolerance, ErrorKind::Limit, "tolerance");
    }
    let far = [Vec3::x() * f64::INFINITY; 4];
    let far = BezierPatch {
        points: &far,
        ..good
    };
    refused(far, 0.1, ErrorKind::NotFinite, "control point 0");
    // The coordinates may be as large as any.
    let huge: Vec<Vec3> = points.iter().map(|p| p * 3e49).collect();
    let huge = BezierPatch {
        points: &huge,
        ..good
    };
    builder.add_bezier_patch(&huge, 1e48, 0).unwrap();
    // All of it may be one point.
    let point = [Vec3::x(); 4];
    let point = BezierPatch {
        points: &point,
        ..good
    };
    builder.add_bezier_patch(&point, 1e-3, 0).unwrap();
    built(&builder);
}
