//! Motions against intersections, differences and complements, of induced sets, solids and pure sets.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions, Predicate, PureOptions, PureShape};
use cstk::error::{ErrorKind, Result};
use cstk::motion::{MotionAnswer, MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::random::Random;
use helpers::robots::{against, against_with, environment, link, robot, space};
use helpers::shapes::{cuboid, hull};
use helpers::surfaces::{cube, solid_one};

/// A body of boxes and hulls, or a hollow cube whose inside counts.
fn body(random: &mut Random, size: f64) -> Arc<Body> {
    match random.below(3) {
        0 => hull(&random.points(10, 0.7 * size)).body,
        1 => cuboid([size, 0.7 * size, 0.5 * size]).body,
        _ => solid_one(&cube(size)),
    }
}

pub fn arm(random: &mut Random) -> Arc<Space> {
    let links = (0..3).map(|i: usize| LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.6, 0.0, 0.0)),
        body: Some(body(random, 0.4)),
        ..link(i.checked_sub(1), JointKind::Revolute, random.unit())
    });
    let range = Coordinate::Interval {
        lower: -9.0,
        upper: 9.0,
    };
    let robots = vec![robot(3, links.collect())];
    let ranges = [Some(range); 3];
    Arc::new(Space::new(robots, &ranges, WorldBox::unbounded()).unwrap())
}

fn leaf(random: &mut Random, space: &Arc<Space>) -> Arc<CObject> {
    let nq = space.nq();
    let options = PureOptions::default();
    let shape = match random.below(6) {
        0 => PureShape::Ball {
            center: (0..nq).map(|_| random.within(-2.0, 2.0)).collect(),
            radius: random.within(0.5, 2.0),
        },
        1 => {
            let low: Vec<f64> = (0..nq).map(|_| random.within(-3.0, 1.0)).collect();
            let high = low.iter().map(|x| x + random.within(0.5, 3.0)).collect();
            PureShape::Box { low, high }
        }
        2 => PureShape::HalfSpace {
            normal: (0..nq).map(|_| random.within(-1.0, 1.0)).collect(),
            offset: random.within(-1.0, 1.0),
            is_open: false,
        },
        _ => {
            let objects: Vec<_> = (0..1 + random.below(4))
                .map(|_| (body(random, 1.0), random.pose(1.2)))
                .collect();
            let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
            let options = InducedOptions {
                margin: [0.0, 0.05][random.below(2)],
                contact_epsilon: [0.0, 0.02][random.below(2)],
            };
            return Arc::new(against_with(space, &environment(&objects).0, options));
        }
    };
    Arc::new(CObject::pure(space.clone(), shape, options).unwrap())
}

pub fn compound(random: &mut Random, space: &Arc<Space>, depth: usize) -> Arc<CObject> {
    if depth == 0 || random.below(5) == 0 {
        return leaf(random, space);
    }
    let part = |random: &mut Random| compound(random, space, depth - 1);
    let set = match random.below(5) {
        0 => CObject::complement(&part(random)),
        1 => CObject::difference(&part(random), &part(random)),
        2 | 3 => CObject::intersection(&[part(random), part(random)]),
        _ => CObject::union(&[part(random), part(random)]),
    };
    Arc::new(set.unwrap())
}

fn class(context: &mut QueryContext, set: &CObject, q: &[f64]) -> Class {
    context
        .classify(set, Configuration::Coordinates(q))
        .unwrap()
}

/// Samples what a motion says: all that is free is not inside, and a hit is.
fn check(context: &mut QueryContext, set: &CObject, [q, v]: [&[f64]; 2], answer: &MotionAnswer) {
    let at = |t: f64| {
        let part: Vec<f64> = v.iter().map(|x| x * t).collect();
        set.space().step(q, &part)
    };
    for i in 0..200 {
        let t = f64::from(i) / 199.0;
        if answer.outcome == MotionOutcome::Free || t < answer.times[0] {
            assert_ne!(
                class(context, set, &at(t)),
                Class::Inside,
                "at {t} of {answer:?}"
            );
        }
    }
    if answer.outcome == MotionOutcome::Hit {
        let t = answer.times[1];
        assert_eq!(class(context, set, &at(t)), Class::Inside, "{answer:?}");
    }
}

#[test]
fn motions_of_compound_sets_are_what_samples_say() {
    let mut random = Random::new(201);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 4];
    for _ in 0..400 {
        let space = arm(&mut random);
        let set = compound(&mut random, &space, 3);
        for _ in 0..6 {
            let size = [0.1, 0.5, 2.0][random.below(3)];
            let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
                (0..space.nv())
                    .map(|_| random.within(-size, size))
                    .collect()
            };
            let (q, v) = (drawn(&mut random, 2.0), drawn(&mut random, size));
            let options = MotionOptions::default();
            let answer = context.motion_along(&set, &q, &v, &options).unwrap();
            outcomes[answer.outcome as usize] += 1;
            check(context, &set, [&q, &v], &answer);
        }
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(outcomes[0] > 400 && outcomes[1] > 400, "{outcomes:?}");
    // Near ends where complements end without a depth to tell them.
    assert!(outcomes[2] < 200 && outcomes[3] == 0, "{outcomes:?}");
}

/// A slider of a unit cube along x.
pub fn slider() -> Arc<Space> {
    space(vec![robot(
        3,
        vec![LinkDefinition {
            body: Some(cuboid([1.0; 3]).body),
            ..link(None, JointKind::Prismatic, Vec3::x())
        }],
    )])
}

fn wall(space: &Arc<Space>, x: f64) -> Arc<CObject> {
    let body = cuboid([1.0; 3]).body;
    let pose = Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    Arc::new(against(space, &environment(&[(&body, pose)]).0))
}

fn outcome(set: &CObject, from: f64, to: f64) -> (MotionOutcome, f64) {
    let options = MotionOptions::default();
    let answer = QueryContext::new()
        .motion(set, &[from], &[to], &options)
        .unwrap();
    (answer.outcome, from + (to - from) * answer.times[1])
}

/// Closed forms: a cube meets the wall at 0 from -1 to 1, and that at 1.5 from .5 to 2.5.
#[test]
fn a_slider_meets_both_either_and_neither_of_two_walls() {
    let space = slider();
    let [first, second] = [0.0, 1.5].map(|x| wall(&space, x));
    let both = CObject::intersection(&[first.clone(), second.clone()]).unwrap();
    let only_first = CObject::difference(&first, &second).unwrap();
    let only_second = CObject::difference(&second, &first).unwrap();
    let neither = CObject::complement(&Arc::new(
        CObject::union(&[first.clone(), second.clone()]).unwrap(),
    ))
    .unwrap();
    let near = |(outcome, x): (MotionOutcome, f64), at: f64| {
        assert_eq!(outcome, MotionOutcome::Hit, "{x}");
        assert!((x - at).abs() < 1e-5, "{x} for {at}");
    };
    near(outcome(&both, -3.0, 3.0), 0.5);
    near(outcome(&only_first, -3.0, 3.0), -1.0);
    near(outcome(&only_first, 0.6, -3.0), 0.5);
    near(outcome(&only_second, -3.0, 3.0), 1.0);
    near(outcome(&neither, -0.9, 3.0), 2.5);
    assert_eq!(outcome(&both, -3.0, 0.49).0, MotionOutcome::Free);
    assert_eq!(outcome(&both, 3.0, 1.01).0, MotionOutcome::Free);
    assert_eq!(outcome(&neither, -0.99, 2.49).0, MotionOutcome::Free);
    assert_eq!(outcome(&only_second, -3.0, 0.99).0, MotionOutcome::Free);
    assert_eq!(outcome(&only_first, 0.51, 3.0).0, MotionOutcome::Free);
}

/// What is inside a solid is so without touching its surface.
#[test]
fn inside_a_hollow_solid_its_complement_is_free() {
    let space = slider();
    let room = solid_one(&cube(10.0));
    let inside = Arc::new(against(
        &space,
        &environment(&[(&room, Pose::identity())]).0,
    ));
    let outside = CObject::complement(&inside).unwrap();
    let [(_, low), (_, high)] = [outcome(&inside, -30.0, 0.0), outcome(&inside, 30.0, 0.0)];
    assert_eq!(
        outcome(&outside, 0.9 * low, 0.9 * high).0,
        MotionOutcome::Free
    );
    // Where it begins to touch the wall from inside, neither containment nor overlap is certain for a moment.
    assert_ne!(outcome(&outside, 0.0, 2.0 * high).0, MotionOutcome::Free);
    let never = CObject::intersection(&[inside, wall(&space, 20.0)]).unwrap();
    assert_eq!(outcome(&never, 0.0, 10.0).0, MotionOutcome::Free);
}

/// Where |x| is at least 2; measures, or not.
struct Far {
    measures: bool,
}

impl Predicate for Far {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        Ok(if q[0].abs() >= 2.0 {
            Class::Inside
        } else {
            Class::Outside
        })
    }

    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        Ok(self.measures.then_some(2.0 - q[0].abs()))
    }

    fn measures(&self) -> bool {
        self.measures
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn knows_depth(&self) -> bool {
        true
    }
}

#[test]
fn predicates_that_measure_are_followed_and_others_refused_by_number() {
    let space = slider();
    let predicate = |measures| {
        let shape = PureShape::Predicate(Arc::new(Far { measures }));
        CObject::pure(space.clone(), shape, PureOptions::default()).unwrap()
    };
    let far = predicate(true);
    let (found, x) = outcome(&far, -1.0, 5.0);
    assert!(
        found == MotionOutcome::Hit && (x - 2.0).abs() < 1e-5,
        "{found:?} {x}"
    );
    assert_eq!(outcome(&far, -1.9, 1.9).0, MotionOutcome::Free);
    let near = CObject::complement(&Arc::new(far)).unwrap();
    let (found, x) = outcome(&near, 5.0, -5.0);
    assert!(
        found == MotionOutcome::Hit && (x - 2.0).abs() < 1e-5,
        "{found:?} {x}"
    );
    let blind = predicate(false);
    let options = MotionOptions::default();
    let refused = QueryContext::new().motion(&blind, &[0.0], &[1.0], &options);
    let error = refused.unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    assert!(
        error.message.contains(&blind.serial().to_string()),
        "{}",
        error.message
    );
}
