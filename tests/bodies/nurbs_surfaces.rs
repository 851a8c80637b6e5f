//! NURBS surfaces as triangles: against dense samples by the definition of B-splines, and against spheres, cylinders and tori.

use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

use cstk::body::{BezierPatch, Body, BodyBuilder, NurbsSurface};
use cstk::pose::Vec3;
use cstk::query::QueryContext;

use super::sampled_surfaces::{ball, built, check_ball, check_samples};
use helpers::random::Random;

/// The B-splines of a knot vector by their recursive definition (Cox, de Boor), where 0 / 0 is 0. Where the last one ends, their limit
/// from below.
fn b_splines(degree: usize, knots: &[f64], t: f64) -> Vec<f64> {
    let end = knots[knots.len() - 1 - degree];
    let mut splines: Vec<f64> = knots
        .windows(2)
        .map(|two| {
            let is_within = two[0] <= t && t < two[1];
            let is_end = t == end && two[0] < t && t == two[1];
            f64::from(u8::from(if t == end { is_end } else { is_within }))
        })
        .collect();
    for p in 1..=degree {
        let share = |i: usize, t: f64| {
            let length = knots[i + p] - knots[i];
            if length == 0.0 { 0.0 } else { t / length }
        };
        splines = (0..splines.len() - 1)
            .map(|i| {
                let (rising, falling) = (t - knots[i], knots[i + p + 1] - t);
                share(i, rising) * splines[i] + share(i + 1, falling) * splines[i + 1]
            })
            .collect();
    }
    splines
}

/// The point of a surface at parameters from 0 to 1, which every span that is not empty takes an equal part of.
fn at(surface: &NurbsSurface, u: f64, v: f64) -> Vec3 {
    let [in_u, in_v] = [(0, u), (1, v)].map(|(along, part)| {
        let (degree, knots) = (surface.degrees[along], surface.knots[along]);
        let mut spans = knots[degree..knots.len() - degree].to_vec();
        spans.dedup();
        let place = part * (spans.len() - 1) as f64;
        let k = (place as usize).min(spans.len() - 2);
        let t = spans[k] + (spans[k + 1] - spans[k]) * (place - k as f64);
        b_splines(degree, knots, t.min(spans[spans.len() - 1]))
    });
    let (mut sum, mut weights) = (Vec3::zeros(), 0.0);
    for (i, a) in in_u.iter().enumerate() {
        for (j, b) in in_v.iter().enumerate() {
            let index = i * in_v.len() + j;
            let weight = a * b * surface.weights.map_or(1.0, |weights| weights[index]);
            sum += surface.points[index] * weight;
            weights += weight;
        }
    }
    sum / weights
}

/// Up to 4 spans, with knots of any multiplicity between them; at the ends clamped or not, and even with knots that no point of the
/// curve depends on.
fn drawn_knots(random: &mut Random, degree: usize) -> Vec<f64> {
    let copies = |random: &mut Random| match random.below(2) {
        0 => degree + 1,
        _ => 1 + random.below(degree + 1),
    };
    let before = |random: &mut Random, copies: usize| degree + 1 - copies + random.below(copies);
    let start = [0.0, 0.0, -3.0, 1e6][random.below(4)];
    let mut t = start;
    let many = copies(random);
    let mut knots = vec![t; many];
    for _ in 0..before(random, many) {
        t -= random.within(0.0, 1.0);
        knots.insert(0, t);
    }
    t = start;
    for inner in 0..random.below(4) {
        let is_tiny = inner == 0 && start == 0.0 && random.below(2) == 0;
        t += if is_tiny {
            1e-300
        } else {
            random.within(0.1, 2.0)
        };
        knots.extend(vec![t; 1 + random.below(degree)]);
    }
    t += random.within(0.1, 2.0);
    let many = copies(random);
    knots.extend(vec![t; many]);
    for _ in 0..before(random, many) {
        t += random.within(0.0, 1.0);
        knots.push(t);
    }
    knots
}

/// What a surface borrows.
struct Drawn {
    degrees: [usize; 2],
    knots: [Vec<f64>; 2],
    points: Vec<Vec3>,
    weights: Option<Vec<f64>>,
}

impl Drawn {
    /// Control points over a bent sheet.
    fn new(random: &mut Random) -> Self {
        let degrees = [1 + random.below(4), 1 + random.below(4)];
        let knots = degrees.map(|degree| drawn_knots(random, degree));
        let [rows, columns] = [0, 1].map(|along| knots[along].len() - degrees[along] - 1);
        let points = (0..rows * columns).map(|k| {
            let (i, j) = (k / columns, k % columns);
            Vec3::new(i as f64, j as f64, 0.0) + random.point(0.6)
        });
        let points: Vec<Vec3> = points.collect();
        let weights = points.iter().map(|_| random.within(0.3, 3.0)).collect();
        Self {
            degrees,
            knots,
            points,
            weights: (random.below(2) == 0).then_some(weights),
        }
    }

    fn surface(&self) -> NurbsSurface<'_> {
        NurbsSurface {
            degrees: self.degrees,
            knots: [&self.knots[0], &self.knots[1]],
            points: &self.points,
            weights: self.weights.as_deref(),
        }
    }
}

#[test]
fn bounds_hold_for_densely_sampled_surfaces() {
    let mut random = Random::new(2301);
    let mut triangles = 0;
    for round in 0..60 {
        let drawn = Drawn::new(&mut random);
        let surface = drawn.surface();
        let tolerance = [0.3, 0.1, 0.03][round % 3];
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_nurbs_surface(&surface, tolerance, 7).unwrap();
        let body = built(&builder);
        triangles += body.primitives().len();
        assert_eq!(body.tag(0), 7);
        check_samples(&body, tolerance, |u, v| at(&surface, u, v), &mut random);
    }
    println!("{triangles} triangles");
}

/// A control point in the plane, and its weight.
type Weighted = ([f64; 2], f64);

/// Four quarters of the unit circle.
const CIRCLE: [Weighted; 9] = [
    ([1.0, 0.0], 1.0),
    ([1.0, 1.0], FRAC_1_SQRT_2),
    ([0.0, 1.0], 1.0),
    ([-1.0, 1.0], FRAC_1_SQRT_2),
    ([-1.0, 0.0], 1.0),
    ([-1.0, -1.0], FRAC_1_SQRT_2),
    ([0.0, -1.0], 1.0),
    ([1.0, -1.0], FRAC_1_SQRT_2),
    ([1.0, 0.0], 1.0),
];

const CIRCLE_KNOTS: [f64; 12] = [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];

/// A profile, given by distances from the axis, heights and weights, turned once around the z axis.
fn turned(profile: &[Weighted], degree: usize, knots: &[f64], tolerance: f64) -> Arc<Body> {
    let pairs = profile
        .iter()
        .flat_map(|around| CIRCLE.map(|turn| (around, turn)));
    let (points, weights): (Vec<Vec3>, Vec<f64>) = pairs
        .map(|(([out, height], a), ([x, y], b))| (Vec3::new(out * x, out * y, *height), a * b))
        .unzip();
    let surface = NurbsSurface {
        degrees: [degree, 2],
        knots: [knots, &CIRCLE_KNOTS],
        points: &points,
        weights: Some(&weights),
    };
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_nurbs_surface(&surface, tolerance, 0).unwrap();
    built(&builder)
}

/// Compares balls with a surface of revolution in closed form, at each tolerance. Ten times as near must take about ten times as many
/// triangles.
fn check_turned(
    seed: u64,
    (profile, degree, knots): (&[Weighted], usize, &[f64]),
    distance: impl Fn(&Vec3) -> f64,
) {
    let mut random = Random::new(seed);
    let mut query = QueryContext::new();
    let ball = ball(0.125);
    let mut counts = Vec::new();
    for tolerance in [0.1, 0.01, 0.001] {
        let body = turned(profile, degree, knots, tolerance);
        counts.push(body.primitives().len());
        for _ in 0..3000 {
            let pose = random.pose(0.5);
            let center = random.point(1.6);
            check_ball(
                &mut query,
                (&body, &pose),
                (&ball, 0.125),
                &center,
                &distance,
            );
        }
    }
    println!("{counts:?} triangles");
    assert!(counts[1] < 20 * counts[0] && counts[2] < 20 * counts[1]);
}

#[test]
fn a_turned_circle_is_a_torus() {
    let profile = CIRCLE.map(|([x, z], weight)| ([1.0 + 0.375 * x, 0.375 * z], weight));
    check_turned(2302, (&profile, 2, &CIRCLE_KNOTS), |p| {
        ((p.x.hypot(p.y) - 1.0).hypot(p.z) - 0.375).abs()
    });
}

#[test]
fn a_turned_half_circle_is_a_sphere() {
    let profile: Vec<Weighted> = CIRCLE[..5]
        .iter()
        .map(|([z, x], weight)| ([*x, *z], *weight))
        .collect();
    let knots = [5.0, 5.0, 5.0, 6.0, 6.0, 7.0, 7.0, 7.0];
    check_turned(2303, (&profile, 2, &knots), |p| (p.norm() - 1.0).abs());
}

#[test]
fn a_turned_line_is_a_cylinder() {
    let profile = [-1.0, 0.25, 1.0].map(|height| ([0.75, height], 1.0));
    let knots = [0.0, 0.0, 1e-3, 1.0, 1.0];
    check_turned(2304, (&profile, 1, &knots), |p| {
        let beyond = (p.z.abs() - 1.0).max(0.0);
        (p.x.hypot(p.y) - 0.75).hypot(beyond)
    });
}

#[test]
fn one_clamped_span_is_a_bezier_patch() {
    let mut random = Random::new(2305);
    for _ in 0..30 {
        let degrees = [1 + random.below(5), 1 + random.below(5)];
        let ends = [[0.0, 1.0], [-7.0, 1e6], [3.0, 3.0 + 1e-12]];
        let knots = degrees.map(|degree| {
            let ends = ends[random.below(3)];
            ends.map(|end| vec![end; degree + 1]).concat()
        });
        let count = (degrees[0] + 1) * (degrees[1] + 1);
        let points = random.points(count, 1.0);
        let weights: Vec<f64> = points.iter().map(|_| random.within(0.3, 3.0)).collect();
        let weights = (random.below(2) == 0).then_some(&weights[..]);
        let [mut one, mut other] = [3, 3].map(|dimension| BodyBuilder::new(dimension).unwrap());
        let patch = BezierPatch {
            degrees,
            points: &points,
            weights,
        };
        one.add_bezier_patch(&patch, 0.05, 1).unwrap();
        let surface = NurbsSurface {
            degrees,
            knots: [&knots[0], &knots[1]],
            points: &points,
            weights,
        };
        other.add_nurbs_surface(&surface, 0.05, 1).unwrap();
        let [one, other] = [built(&one), built(&other)];
        assert!(one.vertices().eq(other.vertices()));
        let difference = (one.stated_deviation() - other.stated_deviation()).abs();
        assert!(difference < 1e-11);
    }
}

/// Those of degree 1 are the squares between their control points.
#[test]
fn patches_follow_the_second_parameter_first() {
    let points: Vec<Vec3> = (0..12)
        .map(|k| Vec3::new(f64::from(k / 4), f64::from(k % 4), 0.0))
        .collect();
    let surface = NurbsSurface {
        degrees: [1, 1],
        knots: [
            &[0.0, 1.0, 2.0, 5.0, 5.0],
            &[0.0, 0.0, 1e-300, 2.0, 3.0, 3.0],
        ],
        points: &points,
        weights: None,
    };
    for dimension in [2, 3] {
        let mut builder = BodyBuilder::new(dimension).unwrap();
        builder.add_nurbs_surface(&surface, 1e-9, 0).unwrap();
        let body = built(&builder);
        let corners: Vec<Vec3> = body.vertices().collect();
        assert_eq!(corners.len(), 36);
        for (k, six) in corners.chunks(6).enumerate() {
            let (i, j) = ((k / 3) as f64, (k % 3) as f64);
            let middle = six.iter().sum::<Vec3>() / 6.0;
            assert!((middle - Vec3::new(i + 0.5, j + 0.5, 0.0)).norm() < 1e-12);
        }
    }
}
