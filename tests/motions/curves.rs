//! Motions on Bezier curves and B-splines.

use std::sync::Arc;

use cstk::cobject::{CObject, Class};
use cstk::error::ErrorKind;
use cstk::motion::{MotionOptions, MotionOutcome, Spline};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, bezier};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::{cuboid, hull};

const KINDS: [JointKind; 4] = [
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Planar,
    JointKind::FreeEuler,
];

/// An arm of three links with joints that curves may move, among eight hulls.
pub fn arm_among_hulls(random: &mut Random) -> Arc<CObject> {
    let links = (0..3).map(|i: usize| LinkDefinition {
        at: random.pose(0.5),
        body: Some(hull(&random.points(10, 0.4)).body),
        ..link(
            i.checked_sub(1),
            KINDS[random.below(4)].clone(),
            random.unit(),
        )
    });
    let space = space(vec![robot(3, links.collect())]);
    let bodies: Vec<_> = (0..8)
        .map(|_| (hull(&random.points(10, 0.4)).body, random.pose(2.5)))
        .collect();
    let objects: Vec<_> = bodies.iter().map(|(body, pose)| (body, *pose)).collect();
    Arc::new(against(&space, &environment(&objects).0))
}

fn class(context: &mut QueryContext, set: &CObject, q: &[f64]) -> Class {
    context
        .classify(set, Configuration::Coordinates(q))
        .unwrap()
}

/// The configuration on a Bezier curve.
fn on_curve(points: &[f64], nq: usize, t: f64) -> Vec<f64> {
    let of = |c: usize| bezier(points.iter().skip(c).step_by(nq).copied(), t);
    (0..nq).map(of).collect()
}

/// A point of a B-spline by de Boor's recursion of basis functions, from their definition.
fn on_spline(spline: &Spline, nq: usize, u: f64) -> Vec<f64> {
    fn basis(knots: &[f64], i: usize, degree: usize, u: f64) -> f64 {
        if degree == 0 {
            let last = knots[knots.len() - 1];
            let closes = u == last && knots[i + 1] == last;
            let is_in = knots[i] <= u && u < knots[i + 1] || closes && knots[i] < knots[i + 1];
            return f64::from(u8::from(is_in));
        }
        let part = |numerator: f64, denominator: f64| {
            if denominator > 0.0 {
                numerator / denominator
            } else {
                0.0
            }
        };
        part(u - knots[i], knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, u)
            + part(
                knots[i + degree + 1] - u,
                knots[i + degree + 1] - knots[i + 1],
            ) * basis(knots, i + 1, degree - 1, u)
    }
    let count = spline.points.len() / nq;
    let weights: Vec<f64> = (0..count)
        .map(|i| basis(spline.knots, i, spline.degree, u))
        .collect();
    (0..nq)
        .map(|c| {
            (0..count)
                .map(|i| weights[i] * spline.points[i * nq + c])
                .sum()
        })
        .collect()
}

#[test]
fn free_curves_are_free_at_every_sample_and_hits_are_hits() {
    let mut random = Random::new(211);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 4];
    for _ in 0..150 {
        let set = arm_among_hulls(&mut random);
        let nq = set.space().nq();
        for _ in 0..6 {
            let size = [0.1, 0.5, 2.0][random.below(3)];
            let start: Vec<f64> = (0..nq).map(|_| random.within(-2.0, 2.0)).collect();
            let count = 1 + random.below(5);
            let points: Vec<f64> = (0..count)
                .flat_map(|_| {
                    start
                        .iter()
                        .map(|x| x + random.within(-size, size))
                        .collect::<Vec<_>>()
                })
                .collect();
            let options = MotionOptions::default();
            let answer = context.motion_on_curve(&set, &points, &options).unwrap();
            outcomes[answer.outcome as usize] += 1;
            for i in 0..150 {
                let t = f64::from(i) / 149.0;
                if answer.outcome == MotionOutcome::Free || t < answer.times[0] {
                    let found = class(context, &set, &on_curve(&points, nq, t));
                    assert_ne!(found, Class::Inside, "at {t} of {answer:?}");
                }
            }
            if answer.outcome == MotionOutcome::Hit {
                let q = on_curve(&points, nq, answer.times[1]);
                assert_eq!(class(context, &set, &q), Class::Inside);
                assert_eq!(q, answer.configuration);
            }
        }
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(outcomes[0] > 100 && outcomes[1] > 100, "{outcomes:?}");
    assert!(outcomes[2] < 20 && outcomes[3] == 0, "{outcomes:?}");
}

#[test]
fn pieces_of_a_spline_follow_its_basis_functions() {
    let mut random = Random::new(212);
    for _ in 0..300 {
        let degree = 1 + random.below(5);
        let count = degree + 1 + random.below(6);
        let nq = 1 + random.below(3);
        let mut knots = vec![0.0];
        for _ in 0..count + degree {
            // Some knots stand more than once, but none so often that the curve may jump.
            let last = knots[knots.len() - 1];
            let is_full = knots.iter().filter(|knot| **knot == last).count() == degree;
            let step =
                [0.0, random.within(0.1, 1.0)][random.below(4).min(1).max(usize::from(is_full))];
            knots.push(last + step);
        }
        let points: Vec<f64> = (0..count * nq).map(|_| random.within(-1.0, 1.0)).collect();
        let spline = Spline {
            degree,
            knots: &knots,
            points: &points,
        };
        let pieces = spline.pieces(nq).unwrap();
        for piece in &pieces {
            let [from, to] = piece.knots;
            for share in [0.0, 0.3, 0.999] {
                let found = on_curve(&piece.points, nq, share);
                let truth = on_spline(&spline, nq, from + share * (to - from));
                for (x, y) in found.iter().zip(&truth) {
                    assert!((x - y).abs() < 1e-9, "{x} for {y}");
                }
            }
        }
        let covered = pieces.first().zip(pieces.last());
        let ends = [knots[degree], knots[count]];
        assert!(covered.is_none_or(|(a, b)| [a.knots[0], b.knots[1]] == ends));
    }
}

/// A slider on a parabola up to 1 and back meets a wall at .75 after a quarter of the time.
#[test]
fn a_slider_on_a_parabola_meets_a_wall_when_it_should() {
    let links = vec![LinkDefinition {
        body: Some(cuboid([0.2; 3]).body),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let wall = cuboid([0.2, 1.0, 1.0]).body;
    let at = |x: f64| Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    let space = space(vec![robot(3, links)]);
    let cell = against(&space, &environment(&[(&wall, at(0.95))]).0);
    let context = &mut QueryContext::new();
    let options = MotionOptions::default();
    // 4 t (1 - t), which is .75 at t = .25.
    let curve = context.motion_on_curve(&cell, &[0.0, 2.0, 0.0], &options);
    let curve = curve.unwrap();
    assert_eq!(curve.outcome, MotionOutcome::Hit);
    assert!((curve.times[1] - 0.25).abs() < 2e-6, "{:?}", curve.times);
    // The same from a rest of a third of the time on: two pieces.
    let spline = Spline {
        degree: 2,
        knots: &[0.0, 0.0, 0.0, 1.0, 1.0, 3.0, 3.0, 3.0],
        points: &[0.0, 0.0, 0.0, 2.0, 0.0],
    };
    let answer = context.motion_on_spline(&cell, &spline, &options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Hit);
    assert!((answer.times[1] - 0.5).abs() < 3e-6, "{:?}", answer.times);
    assert!(answer.times[1] - answer.times[0] <= 1e-6);
    // One that stays below, though its control points do not.
    let low = context.motion_on_curve(&cell, &[0.0, 1.49, 0.0], &options);
    assert_eq!(low.unwrap().outcome, MotionOutcome::Free);
    let kind = |points: &[f64]| {
        let mut context = QueryContext::new();
        let refused = context.motion_on_curve(&cell, points, &options);
        refused.unwrap_err().kind
    };
    assert_eq!(kind(&[]), ErrorKind::WrongSize);
    assert_eq!(kind(&[0.0, f64::NAN]), ErrorKind::NotFinite);
    assert_eq!(kind(&[0.0; 18]), ErrorKind::InvalidArgument);
}

/// The end of the work within a spline is an answer: what was proved is told.
#[test]
fn a_limit_of_work_leaves_the_pieces_that_are_proved() {
    let mut random = Random::new(223);
    let context = &mut QueryContext::new();
    let mut ended = 0;
    for _ in 0..20 {
        let set = arm_among_hulls(&mut random);
        let nq = set.space().nq();
        let points: Vec<f64> = (0..12 * nq).map(|_| random.within(-0.5, 0.5)).collect();
        let knots: Vec<f64> = (0..16).map(f64::from).collect();
        let spline = Spline {
            degree: 3,
            points: &points,
            knots: &knots,
        };
        let mut proved = 0.0;
        for limit in (0..400).chain((400..20_000).step_by(200)) {
            context.set_limit(Some(limit));
            let options = &MotionOptions::default();
            match context.motion_on_spline(&set, &spline, options) {
                Ok(answer) if answer.outcome == MotionOutcome::Undecided => {
                    proved = answer.times[0].max(proved);
                    ended += usize::from(answer.times[0] > 0.0);
                }
                Ok(_) => break,
                Err(error) => {
                    assert_eq!((error.kind, proved), (ErrorKind::Limit, 0.0));
                }
            }
        }
    }
    assert!(ended > 20, "{ended}");
}

#[test]
fn bad_splines_are_refused_and_quaternions_do_not_move_on_curves() {
    let body = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(body.clone()),
        ..link(None, JointKind::Free, Vec3::z())
    }];
    let space: Arc<Space> = space(vec![robot(3, links)]);
    let cell = against(&space, &environment(&[(&body, Pose::identity())]).0);
    let context = &mut QueryContext::new();
    let options = MotionOptions::default();
    let mut points = [space.neutral(), space.neutral()].concat();
    points[0] = 5.0;
    let moved = context.motion_on_curve(&cell, &points, &options);
    assert_eq!(moved.unwrap_err().kind, ErrorKind::Unsupported);
    points[7] = 5.0;
    let rests = context.motion_on_curve(&cell, &points, &options).unwrap();
    assert_eq!(rests.outcome, MotionOutcome::Free);
    for (degree, knots, kind) in [
        (0, &[0.0, 1.0, 2.0][..], ErrorKind::InvalidArgument),
        (1, &[0.0, 0.0, 1.0], ErrorKind::WrongSize),
        (1, &[0.0, 1.0, 0.5, 1.0], ErrorKind::InvalidArgument),
        (1, &[0.0, f64::NAN, 1.0, 1.0], ErrorKind::NotFinite),
        (1, &[0.0, 1.0, 1.0, 1.0], ErrorKind::InvalidArgument),
        (2, &[0.0, 0.0, 0.0, 1.0, 1.0], ErrorKind::WrongSize),
    ] {
        let spline = Spline {
            degree,
            knots,
            points: &points,
        };
        let refused = context.motion_on_spline(&cell, &spline, &options);
        assert_eq!(refused.unwrap_err().kind, kind, "{knots:?}");
    }
}

/// A space without coordinates has one configuration, and every curve rests there.
#[test]
fn curves_rest_where_there_are_no_coordinates() {
    let cube = cuboid([1.0; 3]).body;
    let resting = LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Fixed, Vec3::x())
    };
    let space = space(vec![robot(3, vec![resting])]);
    assert_eq!(space.nq(), 0);
    let options = MotionOptions::default();
    for (x, outcome) in [(2.0, MotionOutcome::Free), (0.5, MotionOutcome::Hit)] {
        let at = Pose::from_translation(Vec3::new(x, 0.0, 0.0));
        let cobject = against(&space, &environment(&[(&cube, at)]).0);
        let mut context = QueryContext::new();
        let spline = Spline {
            degree: 1,
            knots: &[0.0, 0.0, 1.0, 1.0],
            points: &[],
        };
        let answers = [
            context.motion(&cobject, &[], &[], &options),
            context.motion_on_curve(&cobject, &[], &options),
            context.motion_on_spline(&cobject, &spline, &options),
        ];
        for answer in answers {
            assert_eq!(answer.unwrap().outcome, outcome);
        }
    }
}
