//! C-objects whose class the caller knows within boxes, balls and polytopes: what is true changes no answer and saves geometry, and
//! what is said is taken exactly where it is said.

use std::sync::Arc;

use cstk::cobject::{CObject, Class, PureShape};
use cstk::error::ErrorKind;
use cstk::motion::{GrowthOptions, MotionOptions, MotionOutcome, RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind};
use cstk::space::Space;

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, link, robot, space};
use helpers::shapes::cuboid;

use crate::compound::arm;

fn class(context: &mut QueryContext, cobject: &CObject, q: &[f64]) -> Class {
    let at = Configuration::Coordinates(q);
    context.classify(cobject, at).unwrap()
}

/// A configuration with angles and positions up to `size` from the neutral one.
fn configuration(random: &mut Random, space: &Space, size: f64) -> Vec<f64> {
    let v: Vec<f64> = (0..space.nv())
        .map(|_| random.within(-size, size))
        .collect();
    space.step(&space.neutral(), &v)
}

/// Everything, or nothing.
fn all_or_none(space: &Arc<Space>, is_all: bool) -> Arc<CObject> {
    let center = space.neutral();
    let all = pure(
        space,
        PureShape::Ball {
            center,
            radius: 1e6,
        },
        None,
    );
    match is_all {
        true => all,
        false => Arc::new(CObject::complement(&all).unwrap()),
    }
}

/// A box, a ball or a half-space; quaternions are free, and so may other coordinates be.
fn convex(random: &mut Random, space: &Arc<Space>, positions: &[usize]) -> Arc<CObject> {
    let mut low = vec![f64::NEG_INFINITY; space.nq()];
    let mut high = vec![f64::INFINITY; space.nq()];
    let mut normal = vec![0.0; space.nq()];
    for &c in positions {
        low[c] = random.within(-2.0, 0.0);
        high[c] = low[c] + random.within(0.5, 3.0);
        if matches!(space.coordinates()[c], Coordinate::Interval { .. }) {
            normal[c] = random.within(-1.0, 1.0);
        }
    }
    let has_planes = normal.iter().any(|x| *x != 0.0);
    let shape = match random.below(if has_planes { 3 } else { 2 }) {
        0 => PureShape::Box { low, high },
        1 => PureShape::Ball {
            center: configuration(random, space, 0.6),
            radius: random.within(0.7, 2.5),
        },
        _ => PureShape::HalfSpace {
            normal,
            offset: random.within(-0.2, 1.0),
            is_open: false,
        },
    };
    pure(space, shape, None)
}

/// A union of up to three sets, some of which are intersections.
fn sets(random: &mut Random, space: &Arc<Space>, positions: &[usize]) -> Arc<CObject> {
    let parts: Vec<Arc<CObject>> = (0..1 + random.below(3))
        .map(|_| {
            let faces: Vec<_> = (0..1 + random.below(3))
                .map(|_| convex(random, space, positions))
                .collect();
            Arc::new(CObject::intersection(&faces).unwrap())
        })
        .collect();
    Arc::new(CObject::union(&parts).unwrap())
}

fn spaces(random: &mut Random) -> Vec<(Arc<Space>, Vec<usize>)> {
    let sliders =
        (0..3).map(|i: usize| link(i.checked_sub(1), JointKind::Prismatic, random.unit()));
    let sliders = space(vec![robot(3, sliders.collect())]);
    let turns = (0..2).map(|i: usize| link(i.checked_sub(1), JointKind::Revolute, random.unit()));
    let turns = space(vec![robot(3, turns.collect())]);
    let free = space(vec![free_body(&cuboid([0.1; 3]).body)]);
    vec![
        (sliders, vec![0, 1, 2]),
        (turns, vec![0, 1]),
        (free, vec![0, 1, 2]),
        (arm(random), vec![0, 1, 2]),
    ]
}

/// Of everything but what is known to be outside, motions and boxes are free exactly where they stay in the sets; of nothing but what is
/// known to be inside, exactly where they stay out. Samples of the sets themselves are the oracle.
#[test]
fn what_is_known_holds_exactly_within_its_sets() {
    let random = &mut Random::new(411);
    let context = &mut QueryContext::new();
    let options = &MotionOptions::default();
    let mut outcomes = [[0; 2]; 2];
    let mut unknown = 0;
    for (space, positions) in &spaces(random) {
        for case in 0..300 {
            let within = sets(random, space, positions);
            let is_taken = case % 2 == 0;
            let known = if is_taken {
                Class::Outside
            } else {
                Class::Inside
            };
            let of = all_or_none(space, is_taken);
            let set = CObject::with_known(&of, &within, known).unwrap();
            let complement = CObject::complement(&Arc::new(set)).unwrap();
            let set = CObject::with_known(&of, &within, known).unwrap();
            let q0 = configuration(random, space, 1.0);
            let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-0.7, 0.7)).collect();
            let q1 = space.step(&q0, &v);
            let is_in =
                |context: &mut QueryContext, q: &[f64]| class(context, &within, q) == Class::Inside;
            for t in 0..=20 {
                let q = space.interpolate(&q0, &q1, f64::from(t) / 20.0);
                let expected = match is_in(context, &q) {
                    true => known,
                    false => class(context, &of, &q),
                };
                assert_eq!(class(context, &set, &q), expected);
                assert_eq!(class(context, &complement, &q), expected.reversed());
                let at = Configuration::Coordinates(&q);
                assert_eq!(
                    context.within(&set, at, 0.0).unwrap(),
                    expected == Class::Inside
                );
            }
            let answer = context.motion(&set, &q0, &q1, options).unwrap();
            match answer.outcome {
                MotionOutcome::Free => {
                    for t in 0..=100 {
                        let q = space.interpolate(&q0, &q1, f64::from(t) / 100.0);
                        assert_eq!(is_in(context, &q), is_taken, "{case}: {q:?}");
                    }
                }
                MotionOutcome::Hit => {
                    assert_eq!(is_in(context, &answer.configuration), !is_taken, "{case}");
                }
                // It touches the boundary of a set, or a rotation comes near it.
                MotionOutcome::Near | MotionOutcome::Undecided => unknown += 1,
            }
            let is_free = answer.outcome == MotionOutcome::Free;
            outcomes[usize::from(is_taken)][usize::from(is_free)] += 1;
        }
    }
    assert!(
        outcomes.iter().flatten().all(|count| *count > 50) && unknown < 60,
        "{outcomes:?} {unknown}"
    );
}

/// Boxes that were proved free change no class, motion or box, and save most of the geometry.
#[test]
fn proved_boxes_change_no_answer_and_save_geometry() {
    let random = &mut Random::new(412);
    let (mut with, mut without) = (QueryContext::new(), QueryContext::new());
    let mut frees = 0;
    for _ in 0..12 {
        let space = arm(random);
        let obstacles: Vec<_> = (0..4)
            .map(|_| (cuboid([0.2; 3]).body, random.pose(1.5)))
            .collect();
        let obstacles: Vec<_> = obstacles.iter().map(|(body, pose)| (body, *pose)).collect();
        let of = Arc::new(against(&space, &environment(&obstacles).0));
        let mut boxes = Vec::new();
        for _ in 0..8 {
            let q = configuration(random, &space, 1.5);
            if class(&mut without, &of, &q) == Class::Inside {
                continue;
            }
            let grown = without
                .grow_region(&of, &q, None, &GrowthOptions::default())
                .unwrap();
            let (low, high) = (grown.low, grown.high);
            boxes.push((low, high));
        }
        let shapes = boxes.iter().map(|(low, high)| {
            let (low, high) = (low.clone(), high.clone());
            pure(&space, PureShape::Box { low, high }, None)
        });
        let shapes: Vec<_> = shapes.collect();
        if shapes.is_empty() {
            continue;
        }
        let within = CObject::union(&shapes).unwrap();
        let known = CObject::with_known(&of, &within, Class::Outside).unwrap();
        let inside = |random: &mut Random, number: usize| -> Vec<f64> {
            let (low, high) = &boxes[number];
            let ends = low.iter().zip(high);
            ends.map(|(l, h)| l + (h - l) * random.within(0.01, 0.99))
                .collect()
        };
        for _ in 0..40 {
            let q = configuration(random, &space, 2.0);
            assert_eq!(class(&mut with, &known, &q), class(&mut without, &of, &q));
            let other = configuration(random, &space, 2.0);
            let options = &MotionOptions::default();
            let answers = [(&mut with, &known), (&mut without, &*of)]
                .map(|(context, set)| context.motion(set, &q, &other, options).unwrap().outcome);
            if !answers.contains(&MotionOutcome::Near) {
                assert_eq!(answers[0], answers[1]);
            }
            frees += u32::from(answers[0] == MotionOutcome::Free);

            // Within one box no geometry is asked.
            let number = random.below(boxes.len());
            let [a, b] = [inside(random, number), inside(random, number)];
            with.reset_statistics();
            assert_eq!(class(&mut with, &known, &a), Class::Outside);
            let answer = with.motion(&known, &a, &b, options).unwrap();
            assert_eq!(answer.outcome, MotionOutcome::Free);
            let low: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a.min(*b)).collect();
            let high: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a.max(*b)).collect();
            let boxed = with.classify_region(&known, &low, &high, &RegionOptions::default());
            assert_eq!(boxed.unwrap().outcome, RegionOutcome::Free);
            let done = with.statistics();
            assert_eq!((done.node_pairs, done.primitive_pairs), (0, 0));

            // Distances and clearances do not take the word.
            let at = Configuration::Coordinates(&a);
            let [near, far] = [(&mut with, &known), (&mut without, &*of)]
                .map(|(context, set)| context.distance(set, at, f64::INFINITY).unwrap().distance);
            assert!((near - far).abs() < 1e-12, "{near} {far}");
        }
    }
    assert!(frees > 20, "{frees}");
}

/// A certificate proves what the caller only says: a wrong word has none.
#[test]
fn certificates_take_nobodys_word() {
    let random = &mut Random::new(413);
    let space = arm(random);
    let block = cuboid([5.0; 3]).body;
    let of = Arc::new(against(
        &space,
        &environment(&[(&block, random.pose(0.1))]).0,
    ));
    let ball = PureShape::Ball {
        center: vec![0.0; 3],
        radius: 1.0,
    };
    let within = pure(&space, ball, None);
    let wrong = CObject::with_known(&of, &within, Class::Outside).unwrap();
    let context = &mut QueryContext::new();
    let options = &MotionOptions::default();
    let ends = [&[0.0; 3], &[0.1; 3]];
    let said = context.motion(&wrong, ends[0], ends[1], options).unwrap();
    assert_eq!(said.outcome, MotionOutcome::Free);
    let (answer, certificate) = context
        .motion_certificate(&wrong, ends[0], ends[1], options)
        .unwrap();
    assert!(answer.outcome == MotionOutcome::Hit && certificate.is_none());
}

/// Certificates are made and checked of the set without what is said of its parts, wherever those are in it.
#[test]
fn certificates_of_sets_with_known_parts_are_accepted() {
    let random = &mut Random::new(417);
    let space = arm(random);
    let block = cuboid([5.0; 3]).body;
    let away = Pose::from_translation(Vec3::new(100.0, 0.0, 0.0));
    let of = Arc::new(against(&space, &environment(&[(&block, away)]).0));
    let ball = PureShape::Ball {
        center: vec![0.0; 3],
        radius: 1.0,
    };
    let within = pure(&space, ball, None);
    let known = Arc::new(CObject::with_known(&of, &within, Class::Outside).unwrap());
    let limits = pure(&space, PureShape::BeyondLimits, None);
    let sets = [
        CObject::union(&[known.clone(), limits.clone()]).unwrap(),
        CObject::union(&[limits.clone(), known.clone()]).unwrap(),
        CObject::intersection(&[known.clone(), limits]).unwrap(),
    ];
    let options = &MotionOptions::default();
    let [q0, q1] = [&[0.0; 3], &[0.1; 3]];
    for set in sets {
        let made = QueryContext::new().motion_certificate(&set, q0, q1, options);
        let (_, certificate) = made.unwrap();
        certificate.unwrap().verify(&set, q0, q1, 0.0).unwrap();
    }
}

#[test]
fn other_sets_and_classes_are_refused() {
    let random = &mut Random::new(414);
    let space = arm(random);
    let of = all_or_none(&space, true);
    let refused =
        |within: &CObject, class: Class| CObject::with_known(&of, within, class).unwrap_err().kind;
    let limits = pure(&space, PureShape::BeyondLimits, None);
    assert_eq!(refused(&limits, Class::Outside), ErrorKind::Unsupported);
    let complement = CObject::complement(&of).unwrap();
    assert_eq!(refused(&complement, Class::Outside), ErrorKind::Unsupported);
    assert_eq!(refused(&of, Class::Contact), ErrorKind::InvalidArgument);
    let elsewhere = all_or_none(&arm(random), true);
    assert_eq!(
        refused(&elsewhere, Class::Outside),
        ErrorKind::InvalidArgument
    );
    let mut nested = of.clone();
    for _ in 0..255 {
        nested = Arc::new(CObject::with_known(&nested, &of, Class::Outside).unwrap());
    }
    let deeper = CObject::with_known(&nested, &of, Class::Outside);
    assert_eq!(deeper.unwrap_err().kind, ErrorKind::Unsupported);
}
