//! Bezier patches as triangles: against dense samples of the patches, and against the spheres that rational patches are.

use std::f64::consts::FRAC_1_SQRT_2;

use cstk::body::{BezierPatch, BodyBuilder};
use cstk::error::ErrorKind;
use cstk::pose::Vec3;
use cstk::query::QueryContext;

use super::sampled_surfaces::{ball, built, check_ball, check_samples};
use helpers::random::Random;

/// Bernstein's polynomials of a degree, by their definition.
fn bernstein(degree: usize, t: f64) -> Vec<f64> {
    let binomial = |k: usize| (0..k).fold(1.0, |all, i| all * (degree - i) as f64 / (i + 1) as f64);
    (0..=degree)
        .map(|k| binomial(k) * t.powi(k as i32) * (1.0 - t).powi((degree - k) as i32))
        .collect()
}

pub fn at(patch: &BezierPatch, u: f64, v: f64) -> Vec3 {
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

#[test]
fn bounds_hold_for_densely_sampled_patches() {
    let mut random = Random::new(2201);
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
        assert_eq!(body.tag(0), 7);
        check_samples(&body, tolerance, |u, v| at(&patch, u, v), &mut random);
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
        let ball = ball(0.25);
        for _ in 0..3000 {
            let pose = random.pose(0.5);
            let apart = [1.25, 0.75][random.below(2)];
            let apart = apart + random.within(-3.0, 3.0) * body.stated_deviation();
            let center = random.unit() * apart;
            let distance = |p: &Vec3| (p.norm() - 1.0).abs();
            check_ball(&mut query, (&body, &pose), (&ball, 0.25), &center, distance);
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
