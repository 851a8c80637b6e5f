//! Paths of several segments: as their segments one by one, in one state of the world.

use cstk::cobject::{CObject, Class};
use cstk::environment::Change;
use cstk::error::{Error, ErrorKind, Result};
use cstk::motion::{MotionOptions, MotionOutcome, PathAnswer};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};

use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

use super::motions::gantry;
use super::random_scenes::{class, scene};

fn silent(_: f64) -> Result<()> {
    Ok(())
}

fn path(cobject: &CObject, points: &[f64], options: &MotionOptions) -> PathAnswer {
    let mut context = QueryContext::new();
    let answer = context.motion_path(cobject, points, options, &mut silent);
    answer.unwrap()
}

#[test]
fn paths_answer_as_their_segments() {
    let mut random = Random::new(223);
    let mut outcomes = [[0usize; 4]; 2];
    let context = &mut QueryContext::new();
    for round in 0..300 {
        let cobject = scene(&mut random);
        let space = cobject.space().clone();
        let count = 1 + random.below(6);
        let mut points = space.neutral();
        let mut size = 2.0;
        let mut last = points.clone();
        points.clear();
        for _ in 0..count {
            let step: Vec<f64> = (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect();
            last = space.step(&last, &step);
            points.extend(&last);
            size = 0.3;
        }
        let points_of = |segment: usize| {
            let nq = space.nq();
            let end = (segment + 1).min(count - 1);
            [segment, end].map(|i| &points[i * nq..(i + 1) * nq])
        };
        let first = MotionOptions {
            tolerance: 1e-4,
            threshold: [0.0, 0.02][random.below(2)],
            ..MotionOptions::default()
        };
        let answer = path(&cobject, &points, &first);
        outcomes[0][answer.motion.outcome as usize] += 1;
        let mut segment = 0;
        let expected = loop {
            let [q0, q1] = points_of(segment);
            let motion = context.motion(&cobject, q0, q1, &first).unwrap();
            if motion.outcome != MotionOutcome::Free || segment + 2 >= count {
                break motion;
            }
            segment += 1;
        };
        assert_eq!(answer.segment, segment, "round {round}");
        assert_eq!(answer.motion.outcome, expected.outcome, "round {round}");
        assert_eq!(answer.motion.times, expected.times);
        assert_eq!(answer.motion.configuration, expected.configuration);
        let distances =
            [&answer.motion, &expected].map(|m| m.distance.as_ref().map(|d| d.distance));
        assert_eq!(distances[0], distances[1]);

        let any = MotionOptions {
            any_contact: true,
            ..first
        };
        let answer = path(&cobject, &points, &any);
        outcomes[1][answer.motion.outcome as usize] += 1;
        if expected.outcome != MotionOutcome::Near {
            assert_eq!(answer.motion.outcome, expected.outcome, "round {round}");
        }
        if answer.motion.outcome == MotionOutcome::Hit {
            let [q0, q1] = points_of(answer.segment);
            let v = space.difference(q0, q1);
            let part: Vec<f64> = v.iter().map(|x| x * answer.motion.times[1]).collect();
            assert_eq!(space.step(q0, &part), answer.motion.configuration);
            assert!(answer.motion.distance.is_none());
            if first.threshold == 0.0 {
                let there = class(context, &cobject, &answer.motion.configuration);
                assert_eq!(there, Class::Inside, "round {round}");
            } else {
                let q = Configuration::Coordinates(&answer.motion.configuration);
                let found = context.distance(&cobject, q, f64::INFINITY).unwrap();
                assert!(found.lower <= first.threshold, "round {round}: {found:?}");
            }
        }
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(
        outcomes
            .iter()
            .all(|[free, hit, ..]| *free > 50 && *hit > 50)
    );
}

/// A slider before a wall at 2.
fn slider() -> CObject {
    let cube = cuboid([1.0; 3]).body;
    gantry(
        &cube,
        &cube,
        Pose::from_translation(Vec3::new(3.0, 0.0, 0.0)),
    )
}

#[test]
fn the_first_segment_that_meets_is_named() {
    let cell = slider();
    let options = MotionOptions::default();
    let answer = path(&cell, &[0.0, 1.0, 0.5, 2.5, 0.0, 3.0], &options);
    assert_eq!(
        (answer.segment, answer.motion.outcome),
        (2, MotionOutcome::Hit)
    );
    assert!((answer.motion.times[1] - 0.75).abs() < 2e-6, "{answer:?}");
    let free = path(&cell, &[0.0, 1.0, 0.5, 1.9], &options);
    assert_eq!(
        (free.segment, free.motion.outcome),
        (2, MotionOutcome::Free)
    );
    assert_eq!(free.motion.configuration, [1.9]);
    // Single points.
    assert_eq!(
        path(&cell, &[1.9], &options).motion.outcome,
        MotionOutcome::Free
    );
    for any_contact in [false, true] {
        let options = MotionOptions {
            any_contact,
            ..options
        };
        let inside = path(&cell, &[2.5], &options);
        assert_eq!(
            (inside.segment, inside.motion.outcome),
            (0, MotionOutcome::Hit)
        );
        assert_eq!(inside.motion.times[1], 0.0);
    }
    let within = MotionOptions {
        threshold: 0.2,
        ..options
    };
    assert_eq!(
        path(&cell, &[1.9], &within).motion.outcome,
        MotionOutcome::Hit
    );
}

/// A contact that is wanted soon is found at the last point before any segment is proved.
#[test]
fn any_contact_is_looked_for_at_the_points_first() {
    let cell = slider();
    let mut points: Vec<f64> = (0..200).map(|i| 1.9 - f64::from(i % 7) * 0.01).collect();
    points.push(2.5);
    let work = |any_contact: bool| {
        let options = MotionOptions {
            any_contact,
            ..MotionOptions::default()
        };
        let mut calls = 0;
        let mut context = QueryContext::new();
        let answer = context.motion_path(&cell, &points, &options, &mut |_| {
            calls += 1;
            Ok(())
        });
        let answer = answer.unwrap();
        assert_eq!(
            (answer.segment, answer.motion.outcome),
            (199, MotionOutcome::Hit)
        );
        calls
    };
    assert_eq!(work(false), 201);
    // The last of 401 samples is a multiple of 16: one in sixteen is looked at before.
    assert!(work(true) < 30, "{}", work(true));
}

#[test]
fn progress_rises_and_may_end_the_work() {
    let cell = slider();
    let points = [0.0, 1.0, 0.5, 1.9, 0.0];
    for any_contact in [false, true] {
        let options = MotionOptions {
            any_contact,
            ..MotionOptions::default()
        };
        let mut told = Vec::new();
        let context = &mut QueryContext::new();
        let mut listen = |fraction: f64| {
            told.push(fraction);
            Ok(())
        };
        context
            .motion_path(&cell, &points, &options, &mut listen)
            .unwrap();
        assert!(told.is_sorted() && told[0] == 0.0 && told[told.len() - 1] == 1.0);
        assert_eq!(told.len(), if any_contact { 14 } else { 5 });
        for stop in 0..told.len() {
            let mut calls = 0;
            let mut end = |_| {
                calls += 1;
                if calls > stop {
                    return Err(Error::new(ErrorKind::Cancelled, "enough"));
                }
                Ok(())
            };
            let ended = context.motion_path(&cell, &points, &options, &mut end);
            assert_eq!(ended.unwrap_err().kind, ErrorKind::Cancelled);
        }
    }
}

/// What is put in the way meanwhile is not seen.
#[test]
fn a_path_sees_one_state_of_the_world() {
    let cube = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let far = Pose::from_translation(Vec3::new(0.0, 5.0, 0.0));
    let (objects, ids) = environment(&[(&cube, far)]);
    let cell = against(&space(vec![robot(3, links)]), &objects);
    let options = MotionOptions::default();
    let context = &mut QueryContext::new();
    let mut move_in = |_| {
        let change = Change::Move {
            id: ids[0],
            pose: Pose::from_translation(Vec3::new(3.0, 0.0, 0.0)),
        };
        objects.apply(&[change]).map(|_| ())
    };
    let points = [0.0, 1.0, 4.0];
    let answer = context.motion_path(&cell, &points, &options, &mut move_in);
    assert_eq!(answer.unwrap().motion.outcome, MotionOutcome::Free);
    let after = context.motion_path(&cell, &points, &options, &mut silent);
    assert_eq!(after.unwrap().motion.outcome, MotionOutcome::Hit);
}

/// The limit is one for the whole path, and never an error: what was proved before it counts.
#[test]
fn a_limit_leaves_what_was_proved() {
    let cell = slider();
    let points: Vec<f64> = (0..20).map(|i| 0.5 + f64::from(i % 2)).collect();
    let options = MotionOptions::default();
    let mut last = 0;
    let mut is_free = false;
    for limit in (0..2000).step_by(10) {
        let context = &mut QueryContext::new();
        context.set_limit(Some(limit));
        let answer = context.motion_path(&cell, &points, &options, &mut silent);
        let answer = answer.unwrap();
        is_free = answer.motion.outcome == MotionOutcome::Free;
        assert!(is_free || answer.motion.outcome == MotionOutcome::Undecided);
        assert!(answer.segment >= last, "{limit}: {answer:?}");
        last = answer.segment;
    }
    assert!(is_free && last == 18, "{last}");
}

#[test]
fn bad_paths_are_refused() {
    let cell = slider();
    let refused = |points: &[f64], options: MotionOptions| {
        let mut context = QueryContext::new();
        let answer = context.motion_path(&cell, points, &options, &mut silent);
        answer.unwrap_err()
    };
    let options = MotionOptions::default();
    assert_eq!(refused(&[], options).kind, ErrorKind::WrongSize);
    let error = refused(&[0.0, 1.0, f64::NAN], options);
    assert_eq!(error.kind, ErrorKind::NotFinite);
    assert!(error.message.contains("point 2"), "{error}");
    let options = MotionOptions {
        tolerance: 0.0,
        ..options
    };
    assert_eq!(refused(&[0.0], options).kind, ErrorKind::InvalidArgument);
    let complement = CObject::complement(&std::sync::Arc::new(slider())).unwrap();
    for any_contact in [false, true] {
        let options = MotionOptions {
            any_contact,
            ..MotionOptions::default()
        };
        let mut context = QueryContext::new();
        let answer = context.motion_path(&complement, &[0.0, 1.0], &options, &mut silent);
        // The start is free of the set, so it is in the complement.
        assert_eq!(answer.unwrap().motion.times, [0.0, 0.0]);
    }
}
