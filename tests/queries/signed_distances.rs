//! Signed distances and their derivatives: against central differences on both sides of contact, and where none is defined.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::CObject;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::query::{DepthOptions, GradientKind, QueryContext, SignedDistanceList};

use helpers::all_cases;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, space};
use helpers::shapes::{cuboid, hull, hulls, mesh};

fn signed(cobject: &CObject, q: &[f64]) -> SignedDistanceList {
    let mut query = QueryContext::new();
    let options = DepthOptions::default();
    query
        .signed_distances(cobject, q, 1.0, 9, &options)
        .unwrap()
}

fn built(add: impl FnOnce(&mut BodyBuilder)) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    add(&mut builder);
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    Arc::new(body.unwrap())
}

fn rounded(random: &mut Random) -> Arc<Body> {
    built(|builder| {
        builder
            .add_capsule(&random.point(0.5), &random.point(0.5), 0.3, 0)
            .unwrap();
    })
}

/// Compares the rows with central differences; returns how many were compared apart and in contact.
fn compare(cobject: &CObject, q: &[f64], tolerance: f64) -> [usize; 2] {
    const H: f64 = 1e-6;
    let list = signed(cobject, q);
    let [pair] = &list.pairs[..] else {
        return [0; 2];
    };
    assert!(pair.lower <= pair.distance && pair.distance <= pair.upper + 1e-12);
    if pair.gradient != GradientKind::Derivative || pair.distance.abs() < 1e-3 {
        return [0; 2];
    }
    for k in 0..q.len() {
        let near = [-H, H].map(|h| {
            let mut q = q.to_vec();
            q[k] += h;
            let list = signed(cobject, &q);
            list.pairs
                .first()
                .map(|pair| (pair.distance, pair.gradient))
        });
        // Beside a kink the differences are of both its sides.
        let [
            Some((low, GradientKind::Derivative)),
            Some((high, GradientKind::Derivative)),
        ] = near
        else {
            return [0; 2];
        };
        let slope = (high - low) / (2.0 * H);
        let off = (slope - list.gradients[k]).abs();
        assert!(
            off <= tolerance,
            "coordinate {k} of {q:?}: {slope}, but {}: {pair:?}",
            list.gradients[k]
        );
    }
    if pair.distance > 0.0 { [1, 0] } else { [0, 1] }
}

#[test]
fn derivatives_are_right_on_both_sides_of_contact() {
    let mut random = Random::new(5);
    let cases = if all_cases() { 3000 } else { 60 };
    let mut counts = [[0; 2]; 3];
    for case in 0..cases {
        let kind = case % 3;
        let body = match kind {
            0 => hull(&random.points(8, 0.5)).body,
            1 => hulls(&[random.points(6, 0.5), random.points(7, 0.5)]).body,
            _ => rounded(&mut random),
        };
        let wall = match kind {
            0 => hull(&random.points(9, 0.6)).body,
            _ => hulls(&[random.points(6, 0.6), random.points(7, 0.6)]).body,
        };
        let objects = environment(&[(&wall, random.pose(0.1))]);
        let cobject = against(&space(vec![free_body(&body)]), &objects.0);
        let q: Vec<f64> = (0..6).map(|_| random.within(-0.5, 0.5)).collect();
        let found = compare(&cobject, &q, 1e-4);
        counts[kind]
            .iter_mut()
            .zip(found)
            .for_each(|(sum, n)| *sum += n);
    }
    println!("compared apart and in contact: convex, unions, rounded {counts:?} of {cases}");
    for [apart, meeting] in counts {
        assert!(apart > 0 && meeting > 0, "{counts:?}");
    }
}

/// Bodies of one shape whose z axis is along x, y or z.
fn posed_shape(kind: usize, along: usize) -> Arc<Body> {
    let pose = Pose {
        rotation: match along {
            0 => rotation_about(&Vec3::y(), FRAC_PI_2),
            1 => rotation_about(&Vec3::x(), FRAC_PI_2),
            _ => Mat3::identity(),
        },
        translation: Vec3::zeros(),
    };
    built(|builder| {
        let [low, high] = [-0.3, 0.3].map(|z| pose.transform_point(&(Vec3::z() * z)));
        match kind {
            0 => builder.add_cylinder(&pose, 0.2, 0.3, 0),
            1 => builder.add_cone(&pose, 0.2, 0.6, 0),
            2 => builder.add_box(&pose, &Vec3::new(0.2, 0.25, 0.3), 0),
            3 => builder.add_capsule(&low, &high, 0.2, 0),
            _ => builder.add_ellipsoid(&pose, &Vec3::new(0.2, 0.25, 0.3), 0),
        }
        .unwrap();
    })
}

/// Shapes that stand and lie on one another, upright, leaning with a ruling on a face, or turned about the vertical: what is called a
/// derivative has differences that agree on both its sides, and where these do not agree it is one of several. The differences are the oracle.
#[test]
fn caps_and_rulings_on_faces_have_no_derivative() {
    const H: f64 = 1e-6;
    let slant = 0.2f64.atan2(0.6);
    let (mut several, mut smooth) = (0, 0);
    for case in 0..5 * 3 * 5 * 3 * 2 {
        let [kind, along, other, other_along, is_near] = [
            case % 5,
            case / 5 % 3,
            case / 15 % 5,
            case / 75 % 3,
            case / 225,
        ];
        if kind > 1 && other > 1 {
            continue;
        }
        let body = posed_shape(kind, along);
        let wall = posed_shape(other, other_along);
        let objects = environment(&[(&wall, Pose::identity())]);
        let cobject = against(&space(vec![free_body(&body)]), &objects.0);
        let height = [0.5, 0.9][is_near];
        for turn in [
            [0.0; 3],
            [0.3, 0.0, 0.0],
            [0.0, slant, 0.0],
            [0.0, 0.0, slant],
        ] {
            let q = [0.01, 0.02, height, turn[0], turn[1], turn[2]];
            let list = signed(&cobject, &q);
            let [pair] = &list.pairs[..] else {
                continue;
            };
            let differences: Vec<[f64; 2]> = (0..6)
                .map(|k| {
                    [-H, H].map(|h| {
                        let mut q = q;
                        q[k] += h;
                        (signed(&cobject, &q).pairs[0].distance - pair.distance) / h
                    })
                })
                .collect();
            let has_kink = differences.iter().any(|[a, b]| (a - b).abs() > 1e-3);
            let is_plain = differences.iter().all(|[a, b]| (a - b).abs() < 1e-5);
            let place = format!("{kind} along {along} over {other} along {other_along} at {q:?}");
            if has_kink {
                assert_ne!(
                    pair.gradient,
                    GradientKind::Derivative,
                    "{place}: {differences:?}"
                );
                several += 1;
            } else if is_plain && pair.distance > 0.0 {
                assert_eq!(pair.gradient, GradientKind::Derivative, "{place}");
                smooth += 1;
            }
        }
    }
    println!("with a kink {several}, without {smooth}");
    assert!(several > 100 && smooth > 100);
}

#[test]
fn what_has_no_derivative_says_so() {
    let cube = cuboid([2.0, 2.0, 2.0]).body;
    let objects = environment(&[(&cube, Pose::identity())]);
    let cobject = against(&space(vec![free_body(&cube)]), &objects.0);
    // Six ways out of the same length.
    let list = signed(&cobject, &[0.0; 6]);
    assert_eq!(list.pairs[0].gradient, GradientKind::OneOfSeveral);
    assert!((list.pairs[0].distance + 2.0).abs() < 1e-12);
    // Faces on faces: turned, they meet at one corner or another.
    let list = signed(&cobject, &[1.5, 0.2, 0.1, 0.0, 0.0, 0.0]);
    assert_eq!(list.pairs[0].gradient, GradientKind::OneOfSeveral);
    assert!((list.pairs[0].distance + 0.5).abs() < 1e-12);
    assert!((list.gradients[0] - 1.0).abs() < 1e-9);
    // Beyond the range.
    assert!(
        signed(&cobject, &[3.5, 0.0, 0.0, 0.0, 0.0, 0.0])
            .pairs
            .is_empty()
    );
}

#[test]
fn surfaces_in_each_other_have_no_depth() {
    let corners = [Vec3::zeros(), Vec3::x(), Vec3::y()];
    let triangle = mesh(&corners, &[[0, 1, 2]]).body;
    let turned =
        Pose::from_row_major(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.2, 0.0, 1.0, 0.0, -0.2]);
    let objects = environment(&[(&triangle, turned.unwrap())]);
    let cobject = against(&space(vec![free_body(&triangle)]), &objects.0);
    let list = signed(&cobject, &[0.0; 6]);
    assert_eq!(list.pairs[0].gradient, GradientKind::Undefined);
    assert_eq!(list.pairs[0].lower, f64::NEG_INFINITY);
    assert!(list.gradients.iter().all(|x| *x == 0.0));
}

/// A short list is the beginning of the whole one, though what is farther is cut while it is made.
#[test]
fn short_lists_begin_the_whole_one() {
    let mut random = Random::new(91);
    let bodies: Vec<_> = (0..200)
        .map(|_| (hull(&random.points(8, 0.3)).body, random.pose(1.5)))
        .collect();
    let objects: Vec<_> = bodies.iter().map(|(body, pose)| (body, *pose)).collect();
    let objects = environment(&objects);
    let body = hull(&random.points(8, 0.4)).body;
    let cobject = against(&space(vec![free_body(&body)]), &objects.0);
    let options = DepthOptions::default();
    for _ in 0..10 {
        let q: Vec<f64> = (0..6).map(|_| random.within(-0.5, 0.5)).collect();
        let list = |count: usize| {
            let mut query = QueryContext::new();
            query
                .signed_distances(&cobject, &q, 5.0, count, &options)
                .unwrap()
        };
        let whole = list(1000);
        assert!(whole.pairs.len() == 200 && !whole.truncated);
        for count in [0, 1, 5, 40, 199, 200] {
            let short = list(count);
            assert_eq!(short.truncated, count < 200);
            assert_eq!(short.pairs.len(), count);
            for (a, b) in short.pairs.iter().zip(&whole.pairs) {
                assert_eq!(
                    (a.distance, a.lower, a.upper),
                    (b.distance, b.lower, b.upper)
                );
            }
            assert_eq!(short.gradients, whole.gradients[..6 * count]);
        }
    }
}
