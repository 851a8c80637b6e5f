//! Two bodies on screws: closed forms, and samples.

use cstk::error::ErrorKind;
use cstk::motion::{MotionOptions, MotionOutcome, PairMotion};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::query::QueryContext;

use helpers::random::Random;
use helpers::shapes::{cuboid, hull};
use helpers::surfaces::{cube, solid_one};

fn shift(x: f64, y: f64, z: f64) -> Pose {
    Pose::from_translation(Vec3::new(x, y, z))
}

/// Both meet in the middle: cubes of 1 that come from -4 and 4 with the same speed touch at |x| = .5.
#[test]
fn two_cubes_that_meet_in_the_middle_do_so_in_time() {
    let body = cuboid([1.0; 3]).body;
    let (left, right) = (shift(-4.0, 0.0, 0.0), shift(4.0, 0.2, 0.1));
    let [end_left, end_right] = [shift(4.0, 0.0, 0.0), shift(-4.0, 0.2, 0.1)];
    let context = &mut QueryContext::new();
    let a = PairMotion {
        body: &body,
        poses: [&left, &end_left],
    };
    let b = PairMotion {
        body: &body,
        poses: [&right, &end_right],
    };
    let options = MotionOptions::default();
    let answer = context.pair_motion(&a, &b, &options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Hit);
    assert!((answer.times[1] - 3.5 / 8.0).abs() < 2e-6, "{answer:?}");
    assert_eq!(answer.distance.unwrap().distance, 0.0);
    // A straight pass at a distance of 1e-6 takes no more than one look at the primitives.
    let high = [shift(4.0, 1.000001, 0.0), shift(-4.0, 1.000001, 0.0)];
    let above = PairMotion {
        body: &body,
        poses: [&high[0], &high[1]],
    };
    context.reset_statistics();
    let answer = context.pair_motion(&a, &above, &options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Free);
    assert!(context.statistics().primitive_distances <= 2);
    // The same with a threshold of more than the gap.
    let options = MotionOptions {
        threshold: 2e-6,
        ..options
    };
    let answer = context.pair_motion(&a, &above, &options).unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Hit);
}

#[test]
fn free_screws_are_free_at_every_sample_and_hits_are_hits() {
    let mut random = Random::new(221);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 4];
    for _ in 0..1500 {
        let bodies = [(); 2].map(|()| match random.below(3) {
            0 => hull(&random.points(12, 0.5)).body,
            1 => cuboid([1.5, 0.6, 1e-3]).body,
            _ => solid_one(&cube(0.4)),
        });
        let poses = [(); 4].map(|()| random.pose(1.5));
        let [a, b] = [0, 1].map(|i| PairMotion {
            body: &bodies[i],
            poses: [&poses[2 * i], &poses[2 * i + 1]],
        });
        let options = MotionOptions::default();
        let answer = context.pair_motion(&a, &b, &options).unwrap();
        outcomes[answer.outcome as usize] += 1;
        for i in 0..60 {
            let t = f64::from(i) / 59.0;
            let now = [a, b].map(|moving| at(&moving, t));
            if answer.outcome == MotionOutcome::Free || t < answer.times[0] {
                let meets = context.pair_within((&bodies[0], &now[0]), (&bodies[1], &now[1]), 0.0);
                assert!(!meets.unwrap(), "at {t} of {answer:?}");
            }
        }
        if answer.outcome == MotionOutcome::Hit {
            let [p, q] = &answer.configuration;
            assert!(
                context
                    .pair_within((&bodies[0], p), (&bodies[1], q), 0.0)
                    .unwrap()
            );
            let truth = at(&a, answer.times[1]);
            assert!((truth.translation - p.translation).amax() < 1e-9);
        }
    }
    assert!(outcomes[0] > 200 && outcomes[1] > 200, "{outcomes:?}");
    assert!(outcomes[2] < 10 && outcomes[3] == 0, "{outcomes:?}");
}

/// A pose on the screw, by the axis and the angle of the rotation, which is found by nothing that the library uses.
fn at(moving: &PairMotion, t: f64) -> Pose {
    let [from, to] = moving.poses;
    let between = from.rotation.transpose() * to.rotation;
    let angle = ((between.trace() - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
    let twice = between - between.transpose();
    let axis = Vec3::new(twice[(2, 1)], twice[(0, 2)], twice[(1, 0)]).normalize();
    let shift = from.rotation.transpose() * (to.translation - from.translation);
    // The screw's axis: (1 - R) c is the part of the shift across the axis.
    let along = axis * axis.dot(&shift);
    let across = shift - along;
    let center = 0.5 * across + axis.cross(&across) * (0.5 / (angle / 2.0).tan());
    let turned = rotation_about(&axis, t * angle);
    let place = center - turned * center + along * t;
    Pose {
        rotation: from.rotation * turned,
        translation: from.translation + from.rotation * place,
    }
}

#[test]
fn a_limit_of_work_leaves_it_undecided() {
    let [small, room] = [solid_one(&cube(0.4)), solid_one(&cube(5.0))];
    let [from, to, at_rest] = [
        shift(20.0, 0.0, 0.0),
        shift(0.0, 1.0, 0.0),
        Pose::identity(),
    ];
    let ask = |context: &mut QueryContext| {
        let moves = PairMotion {
            body: &small,
            poses: [&from, &to],
        };
        let rests = PairMotion {
            body: &room,
            poses: [&at_rest, &at_rest],
        };
        let options = MotionOptions::default();
        context.pair_motion(&moves, &rests, &options).unwrap()
    };
    let whole = ask(&mut QueryContext::new());
    assert_eq!(whole.outcome, MotionOutcome::Hit);
    let mut undecided = 0;
    for limit in 0..100_000 {
        let context = &mut QueryContext::new();
        context.set_limit(Some(limit));
        let found = ask(context);
        if found.outcome != MotionOutcome::Undecided {
            assert_eq!((found.outcome, found.times), (whole.outcome, whole.times));
            break;
        }
        undecided += 1;
        assert!(found.times[0] <= whole.times[0] && found.distance.is_none());
    }
    assert!((3..100_000).contains(&undecided), "{undecided}");
}

#[test]
fn what_rests_or_starts_inside_is_told_at_once() {
    let [small, room] = [cuboid([1.0; 3]).body, solid_one(&cube(5.0))];
    let origin = Pose::identity();
    let rests = |body| PairMotion {
        body,
        poses: [&origin, &origin],
    };
    let options = MotionOptions::default();
    let context = &mut QueryContext::new();
    for (a, b, outcome) in [
        (&small, &small, MotionOutcome::Hit),
        (&small, &room, MotionOutcome::Hit),
    ] {
        let answer = context.pair_motion(&rests(a), &rests(b), &options).unwrap();
        assert_eq!((answer.outcome, answer.times), (outcome, [0.0, 0.0]));
    }
    let far = [shift(20.0, 0.0, 0.0), shift(20.0, 1.0, 0.0)];
    let passes = PairMotion {
        body: &small,
        poses: [&far[0], &far[1]],
    };
    let answer = context
        .pair_motion(&passes, &rests(&room), &options)
        .unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Free);
    let options = MotionOptions {
        threshold: f64::NAN,
        ..options
    };
    let refused = context.pair_motion(&passes, &rests(&room), &options);
    assert_eq!(refused.unwrap_err().kind, ErrorKind::NotFinite);
}

/// Displacements beyond single precision hide nothing: what passes through a body is not free of it, however far it goes.
#[test]
fn no_way_is_too_long_to_meet_something() {
    let body = cuboid([2.0; 3]).body;
    let context = &mut QueryContext::new();
    for exponent in 36..=48 {
        let far = 10f64.powi(exponent);
        for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
            let ends = [-far, far].map(|x| Pose::from_translation(axis * x));
            let at = Pose::from_translation(axis * 5.0);
            let moving = PairMotion {
                body: &body,
                poses: [&ends[0], &ends[1]],
            };
            let resting = PairMotion {
                body: &body,
                poses: [&at, &at],
            };
            for any_contact in [false, true] {
                let options = MotionOptions {
                    any_contact,
                    ..MotionOptions::default()
                };
                let found = context.pair_motion(&moving, &resting, &options).unwrap();
                assert_ne!(found.outcome, MotionOutcome::Free, "{axis:?} {far:e}");
            }
        }
    }
}
