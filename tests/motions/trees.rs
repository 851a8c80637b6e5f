//! Motions of robots that branch, of several robots, with joints that mimic others and custom ones, against themselves, each other and
//! what they hold of two environments: what is proved free is so at every sample, pair by pair.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, Class, InducedOptions};
use cstk::environment::{Attachment, Change, Environment};
use cstk::motion::{MotionAnswer, MotionOptions, MotionOutcome, RegionOptions, RegionOutcome};
use cstk::pose::Vec3;
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, LinkDefinition, Robot, bezier};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{Screw, against_with, environment, link, robot, space};
use helpers::shapes::{cuboid, hull};
use helpers::surfaces::{cube, solid_one};

use super::random_scenes::{at, built, class};

fn body(random: &mut Random) -> Arc<Body> {
    match random.below(5) {
        0 => hull(&random.points(8, 0.25)).body,
        1 => cuboid([0.6, 0.1, 0.1]).body,
        2 => built(|b| b.add_sphere(&random.point(0.3), 0.1, 0).unwrap()),
        3 => built(|b| {
            let [from, to] = [random.point(0.4), random.point(0.4)];
            b.add_capsule(&from, &to, 0.05, 0).unwrap();
        }),
        _ => solid_one(&cube(0.2)),
    }
}

/// A robot of up to 8 links, each on any earlier one or on the world.
fn tree(random: &mut Random) -> Arc<Robot> {
    let count = 1 + random.below(8);
    let has_custom = random.below(4) == 0;
    let mut shared = None;
    let links = (0..count).map(|i: usize| {
        let kind = match random.below(if has_custom { 9 } else { 8 }) {
            0..=2 => JointKind::Revolute,
            3 => JointKind::Prismatic,
            4 => JointKind::Planar,
            5 => JointKind::Free,
            6 => JointKind::Spherical,
            7 => JointKind::Fixed,
            _ => JointKind::Custom(Arc::new(Screw)),
        };
        let parent = if i == 0 || random.below(6) == 0 {
            None
        } else {
            Some(random.below(i))
        };
        let mut definition = LinkDefinition {
            at: random.pose(0.7),
            body: (random.below(5) > 0).then(|| body(random)),
            ..link(parent, kind, random.unit())
        };
        if definition.kind.has_axis() {
            definition.multiplier = random.within(-1.5, 1.5);
            definition.offset = random.within(-1.0, 1.0);
            // A coordinate that several joints share.
            match shared {
                Some(coordinate) if random.below(3) == 0 => {
                    definition.coordinate = Some(coordinate);
                }
                None if i == 0 => {
                    definition.coordinate = Some(0);
                    shared = Some(0);
                }
                _ => {}
            }
        }
        definition
    });
    let links: Vec<_> = links.collect();
    robot(3, links)
}

struct Scene {
    set: CObject,
    space: Arc<Space>,
}

fn scene(random: &mut Random) -> Scene {
    let robots = (0..1 + random.below(3)).map(|_| tree(random)).collect();
    let space: Arc<Space> = space(robots);
    let count = space.link_count();
    let with_body: Vec<usize> = (0..count)
        .filter(|&l| space.link(l).unwrap().body.is_some())
        .collect();
    let mut parts = Vec::new();
    // Two environments whose objects have the same ids, both holding some.
    for _ in 0..random.below(3) {
        let objects: Vec<_> = (0..3).map(|_| (body(random), random.pose(2.5))).collect();
        let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
        let (environment, ids): (Arc<Environment>, Vec<u64>) = environment(&objects);
        for &id in &ids[..random.below(3)] {
            let attachment = Attachment {
                space: space.serial(),
                link: random.below(count),
                touch_links: (0..random.below(2)).collect(),
            };
            let change = Change::Attach {
                id,
                pose: random.pose(0.5),
                attachment,
            };
            environment.apply(&[change]).unwrap();
        }
        let options = InducedOptions {
            margin: [0.0, 0.05][random.below(2)],
            ..InducedOptions::default()
        };
        if !with_body.is_empty() {
            parts.push(Arc::new(against_with(&space, &environment, options)));
        }
    }
    let mut pairs = Vec::new();
    if with_body.len() > 1 {
        for _ in 0..1 + random.below(12) {
            let pair = [(); 2].map(|()| with_body[random.below(with_body.len())]);
            if pair[0] != pair[1] {
                pairs.push(pair);
            }
        }
    }
    if !pairs.is_empty() {
        let options = InducedOptions {
            margin: [0.0, 0.03][random.below(2)],
            contact_epsilon: [0.0, 0.01][random.below(2)],
        };
        let itself = CObject::induced_links(space.clone(), &pairs, options).unwrap();
        parts.push(Arc::new(itself));
    }
    if parts.is_empty() {
        return scene(random);
    }
    let set = match random.below(4) {
        0 if parts.len() > 1 => {
            let rest = CObject::union(&parts[1..]).unwrap();
            CObject::difference(&parts[0], &Arc::new(rest)).unwrap()
        }
        1 if parts.len() > 1 => CObject::intersection(&parts).unwrap(),
        _ => CObject::union(&parts).unwrap(),
    };
    Scene { set, space }
}

fn meets(context: &mut QueryContext, set: &CObject, q: &[f64], threshold: f64) -> bool {
    if threshold == 0.0 {
        return class(context, set, q) == Class::Inside;
    }
    let at = cstk::query::Configuration::Coordinates(q);
    context.within(set, at, threshold).unwrap()
}

fn check(
    random: &mut Random,
    Scene { set, space }: &Scene,
    [q, v]: [&[f64]; 2],
    options: &MotionOptions,
    answer: &MotionAnswer,
) {
    let oracle = &mut QueryContext::new();
    let free_until = match answer.outcome {
        MotionOutcome::Free => 1.0,
        MotionOutcome::Hit if options.any_contact => 0.0,
        _ => answer.times[0],
    };
    for i in 0..80 {
        let part = random.within(0.0, 1.0);
        let t = match i {
            0 => 0.0,
            _ if i % 2 == 0 => part,
            _ => 1.0 - 10f64.powf(-6.0 * part),
        } * free_until;
        if answer.outcome == MotionOutcome::Free || t < free_until {
            let inside = meets(oracle, set, &at(space, q, v, t), options.threshold);
            assert!(!inside, "at {t} of {answer:?} {options:?}");
        }
    }
    if answer.outcome == MotionOutcome::Hit {
        let q = at(space, q, v, answer.times[1]);
        assert!(
            meets(oracle, set, &q, options.threshold),
            "{answer:?} {options:?}"
        );
    }
    // What begins in contact says so, unless any contact will do.
    if meets(oracle, set, q, options.threshold) {
        let is_told = answer.outcome == MotionOutcome::Hit
            && (options.any_contact || answer.times == [0.0, 0.0]);
        assert!(is_told, "{answer:?} {options:?}");
    }
}

#[test]
fn motions_of_trees_are_what_samples_say() {
    let count: usize = std::env::var("CSTK_TREES").map_or(700, |n| n.parse().unwrap());
    let seed: u64 = std::env::var("CSTK_SEED").map_or(921, |n| n.parse().unwrap());
    let mut random = Random::new(seed);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 5];
    for _ in 0..count {
        let scene = scene(&mut random);
        let Scene { set, space } = &scene;
        for _ in 0..6 {
            let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
                (0..space.nv())
                    .map(|_| random.within(-size, size) * f64::from(u8::from(random.below(4) > 0)))
                    .collect()
            };
            let q = space.step(&space.neutral(), &drawn(&mut random, 2.0));
            let size = [1e-6, 0.02, 0.3, 1.0, 4.0, 20.0][random.below(6)];
            let v = drawn(&mut random, size);
            let options = MotionOptions {
                any_contact: random.below(4) == 0,
                tolerance: [1.0, 0.3, 1e-3, 1e-6][random.below(4)],
                threshold: [0.0, 0.0, 0.02][random.below(3)],
            };
            match context.motion_along(set, &q, &v, &options) {
                Ok(answer) => {
                    outcomes[answer.outcome as usize] += 1;
                    check(&mut random, &scene, [&q, &v], &options, &answer);
                }
                Err(_) => outcomes[4] += 1,
            }
        }
    }
    println!("free, hit, near, undecided, refused: {outcomes:?}");
    assert!(
        outcomes[0] > count / 2 && outcomes[1] > count / 2,
        "{outcomes:?}"
    );
}

/// The same of all configurations of boxes, and of Bezier curves: neither speeds nor the middle mean there what they do on a line.
#[test]
fn boxes_and_curves_of_trees_are_what_samples_say() {
    let mut random = Random::new(923);
    let context = &mut QueryContext::new();
    let (mut regions, mut curves) = ([0usize; 5], [0usize; 5]);
    for _ in 0..500 {
        let scene = scene(&mut random);
        let Scene { set, space } = &scene;
        let rests = |coordinate: &Coordinate| matches!(coordinate, Coordinate::Quaternion);
        for _ in 0..3 {
            let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-2.0, 2.0)).collect();
            let q = space.step(&space.neutral(), &v);
            let size = [1e-3, 0.05, 0.3, 1.0][random.below(4)];
            let half: Vec<f64> = (space.coordinates().iter())
                .map(|coordinate| {
                    if rests(coordinate) || random.below(4) == 0 {
                        0.0
                    } else {
                        random.within(0.0, size)
                    }
                })
                .collect();
            let [low, high] = [-1.0, 1.0].map(|sign| {
                q.iter()
                    .zip(&half)
                    .map(|(q, h)| q + sign * h)
                    .collect::<Vec<_>>()
            });
            let options = RegionOptions { max_boxes: 60 };
            match context.classify_region(set, &low, &high, &options) {
                Err(_) => regions[4] += 1,
                Ok(answer) => {
                    regions[answer.outcome as usize] += 1;
                    let claimed = match answer.outcome {
                        RegionOutcome::Free => Some(false),
                        RegionOutcome::Inside => Some(true),
                        _ => None,
                    };
                    for _ in 0..100 {
                        let ends = low.iter().zip(&high);
                        let q: Vec<f64> = ends
                            .map(|(&low, &high)| match random.below(3) {
                                0 => low,
                                1 => high,
                                _ => random.within(0.0, 1.0) * (high - low) + low,
                            })
                            .collect();
                        if let Some(claimed) = claimed {
                            assert_eq!(
                                class(context, set, &q) == Class::Inside,
                                claimed,
                                "{answer:?}"
                            );
                        }
                    }
                }
            }
            let degree = 1 + random.below(4);
            let mut controls = q.clone();
            for _ in 0..degree {
                let point = q.iter().zip(space.coordinates()).map(|(x, coordinate)| {
                    if rests(coordinate) || random.below(4) == 0 {
                        *x
                    } else {
                        x + random.within(-size, size)
                    }
                });
                controls.extend(point.collect::<Vec<_>>());
            }
            let options = MotionOptions {
                threshold: [0.0, 0.02][random.below(2)],
                ..MotionOptions::default()
            };
            match context.motion_on_curve(set, &controls, &options) {
                Err(_) => curves[4] += 1,
                Ok(answer) => {
                    curves[answer.outcome as usize] += 1;
                    let nq = q.len();
                    for i in 0..100 {
                        let t = answer.times[0] * f64::from(i) / 100.0;
                        let of = |c: usize| bezier(controls.iter().skip(c).step_by(nq).copied(), t);
                        let q: Vec<f64> = (0..nq).map(of).collect();
                        if t < answer.times[0] {
                            assert!(
                                !meets(context, set, &q, options.threshold),
                                "{t} {answer:?}"
                            );
                        }
                    }
                }
            }
        }
    }
    println!("boxes: free, inside, mixed, undecided, refused: {regions:?}; curves: {curves:?}");
    assert!(regions[0] > 100 && curves[0] > 100 && curves[1] > 40);
}

/// A motion that leaves what it touches, or the threshold, at its start begins in contact, however fast.
#[test]
fn what_is_left_at_once_is_told_at_the_start() {
    let slider = |kind: JointKind| LinkDefinition {
        body: Some(cuboid([1.0; 3]).body),
        ..link(None, kind, Vec3::x())
    };
    let space = space(vec![
        robot(3, vec![slider(JointKind::Prismatic)]),
        robot(3, vec![slider(JointKind::Fixed)]),
    ]);
    let itself = |pairs: &[[usize; 2]], margin: f64| {
        let options = InducedOptions {
            margin,
            ..InducedOptions::default()
        };
        CObject::induced_links(space.clone(), pairs, options).unwrap()
    };
    let context = &mut QueryContext::new();
    for pairs in [[[0, 1]], [[1, 0]]] {
        for margin in [0.0, 0.25] {
            let set = itself(&pairs, margin);
            for threshold in [0.0, 0.5] {
                for speed in [1e-9, 1e-3, 1.0, 1e3, 1e9] {
                    for (within, expected) in [(1e-9, true), (0.0, true), (-1e-9, false)] {
                        let options = MotionOptions {
                            threshold,
                            ..MotionOptions::default()
                        };
                        let start = 1.0 + margin + threshold - within;
                        let answer = context
                            .motion_along(&set, &[start], &[speed], &options)
                            .unwrap();
                        let is_hit = answer.outcome == MotionOutcome::Hit;
                        // At 0 a class needs more than a touch; within 0 rounding may decide.
                        if within != 0.0 {
                            assert_eq!(is_hit, expected, "{answer:?} {start} {speed} {options:?}");
                        }
                        if is_hit {
                            assert_eq!(answer.times, [0.0, 0.0]);
                        }
                    }
                }
            }
        }
    }
}
