//! Pairs at poses as callers give them, which C asks about: to the last bit what the same poses answer once they are read.

use cstk::body::{Body, BodyBuilder};
use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, GivenPair, QueryContext};
use helpers::models::built;
use helpers::random::Random;

/// A body of each kind that is answered for by itself, and a few that are searched; spatial, but the last.
fn bodies(random: &mut Random) -> Vec<Body> {
    let off = [0.0, 1.0, 1e3].map(|far| random.point(far));
    let (up, at) = (Vec3::new(0.0, 0.0, 0.7), |v: Vec3| {
        Pose::from_translation(v)
    });
    let corners: Vec<Vec3> = (0..12).map(|_| random.point(0.5)).collect();
    let each = |dimension: u32, add: &dyn Fn(&mut BodyBuilder)| {
        let mut builder = BodyBuilder::new(dimension).unwrap();
        add(&mut builder);
        built(&builder, &Default::default())
    };
    let mut bodies = Vec::new();
    for o in off {
        bodies.extend([
            each(3, &|b| b.add_sphere(&o, 0.4, 1).unwrap()),
            each(3, &|b| b.add_capsule(&o, &(o + up), 0.2, 2).unwrap()),
            each(3, &|b| {
                b.add_box(&at(o), &Vec3::new(0.5, 0.4, 0.3), 3).unwrap()
            }),
            each(3, &|b| b.add_cylinder(&at(o), 0.4, 0.5, 4).unwrap()),
        ]);
    }
    bodies.extend([
        each(3, &|b| b.add_polyhedron(&corners, 5).unwrap()),
        each(3, &|b| b.add_polygon(&corners[..3], 6).unwrap()),
        each(3, &|b| {
            b.add_sphere(&off[1], 0.3, 7).unwrap();
            b.add_sphere(&off[0], 0.3, 8).unwrap();
        }),
        each(2, &|b| {
            let flat = corners[..3].iter().map(|p| Vec3::new(p.x, p.y, 0.0));
            b.add_polygon(&flat.collect::<Vec<_>>(), 9).unwrap();
        }),
    ]);
    bodies
}

fn given_distance(
    context: &mut QueryContext,
    pair: &GivenPair,
    most: f64,
) -> cstk::error::Result<Distance> {
    context.take_given_distance(pair, most, |distance| distance)
}

/// Poses about as far apart as the bodies are long; some far from the origin, some off a rotation by less than is refused.
fn rows(random: &mut Random, bodies: [&Body; 2]) -> [[f64; 12]; 2] {
    let spread = [0.5, 2.0, 1e3][random.below(3)];
    let off = [0.0, 1e-14, 1e-8][random.below(3)];
    bodies.map(|body| {
        let turn = random.pose(0.0);
        let pose = Pose {
            translation: random.point(spread) - turn.rotation * body.center(),
            ..turn
        };
        let mut rows = pose.to_row_major();
        for entry in rows.iter_mut() {
            *entry += off * random.within(-1.0, 1.0);
        }
        rows
    })
}

#[test]
fn poses_as_given_answer_what_they_answer_once_read() {
    let mut random = Random::new(173);
    let bodies = bodies(&mut random);
    let mut context = QueryContext::new();
    let (mut met, mut apart) = (0, 0);
    for case in 0..20_000 {
        let two = [
            random.below(bodies.len() - 1),
            random.below(bodies.len() - 1),
        ];
        let pair = two.map(|i| &bodies[i]);
        let rows = rows(&mut random, pair);
        let given = GivenPair {
            bodies: pair,
            poses: [&rows[0], &rows[1]],
        };
        let poses = rows
            .each_ref()
            .map(|rows| Pose::from_row_major(rows).unwrap());
        let (a, b) = ((pair[0], &poses[0]), (pair[1], &poses[1]));
        let most = [f64::INFINITY, 0.3][random.below(2)];
        let found = given_distance(&mut context, &given, most).unwrap();
        let expected = context.pair_distance(a, b, most).unwrap();
        assert_eq!(
            format!("{found:?}"),
            format!("{expected:?}"),
            "{case} {two:?}"
        );
        let near = found.distance * [0.999, 1.0, 1.001][random.below(3)];
        let threshold = if near.is_finite() { near } else { 0.0 };
        let within = context.given_within(&given, threshold).unwrap();
        let as_expected = context.pair_within(a, b, threshold).unwrap();
        assert_eq!(within, as_expected, "{case} {two:?} {threshold}");
        met += usize::from(found.distance == 0.0);
        apart += usize::from(found.distance > 0.0);
    }
    assert!(met > 1000 && apart > 1000, "{met} {apart}");
}

#[test]
fn poses_that_are_none_are_refused_by_name() {
    let bodies = bodies(&mut Random::new(5));
    let (ball, flat) = (&bodies[0], bodies.last().unwrap());
    let here = Pose::identity().to_row_major();
    let mut context = QueryContext::new();
    let mut refused = |bodies: [&Body; 2], poses: [&[f64; 12]; 2], limit: f64| {
        let pair = GivenPair { bodies, poses };
        let distance = given_distance(&mut context, &pair, limit).unwrap_err();
        let within = context.given_within(&pair, limit).unwrap_err();
        assert_eq!(distance.kind, within.kind);
        (distance.kind, within.message)
    };
    for (entry, value, kind) in [
        (0, -1.0, ErrorKind::NotARotation),
        (1, 1e-3, ErrorKind::NotARotation),
        (3, f64::NAN, ErrorKind::NotFinite),
        (5, f64::NAN, ErrorKind::NotFinite),
        (11, f64::INFINITY, ErrorKind::NotFinite),
    ] {
        let mut spoilt = here;
        spoilt[entry] = value;
        for (side, name) in ["pose_a", "pose_b"].into_iter().enumerate() {
            let poses = [[&spoilt, &here], [&here, &spoilt]][side];
            let (found, message) = refused([ball; 2], poses, 1.0);
            assert_eq!(found, kind, "{entry}: {message}");
            assert!(message.starts_with(name), "{message}");
        }
    }
    assert_eq!(
        refused([ball; 2], [&here; 2], -1.0).0,
        ErrorKind::InvalidArgument
    );
    assert_eq!(
        refused([ball; 2], [&here; 2], f64::NAN).0,
        ErrorKind::NotFinite
    );
    assert_eq!(
        refused([ball, flat], [&here; 2], 1.0).0,
        ErrorKind::InvalidArgument
    );
    let mut tilted = here;
    (tilted[5], tilted[6], tilted[9], tilted[10]) = (0.6, -0.8, 0.8, 0.6);
    assert_eq!(
        refused([flat; 2], [&tilted, &here], 1.0).0,
        ErrorKind::InvalidArgument
    );
}
