//! Whole motions: what is proved free is free at every sample, what hits does so where it is said, and known cases.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::cobject::{CObject, Class, InducedOptions, PureShape};
use cstk::error::ErrorKind;
use cstk::motion::{MotionAnswer, MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::{Space, WorldBox};

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, environment, free_planar_body, link, robot, space};
use helpers::shapes::{box_corners, cuboid, planar};

use super::random_scenes::{at, built, class, rough_ball, scene};

/// `CSTK_MOTIONS=200000 cargo test --release --test motions free_motions -- --nocapture` runs a campaign with 10,000 samples each.
#[test]
fn free_motions_are_free_at_every_sample_and_hits_are_hits() {
    let campaign: Option<usize> = std::env::var("CSTK_MOTIONS")
        .ok()
        .map(|n| n.parse().unwrap());
    let (count, samples) = campaign.map_or((1500, 100), |count| (count, 10_000));
    let mut random = Random::new(191);
    let mut outcomes = [0usize; 4];
    let context = &mut QueryContext::new();
    let mut cobject = scene(&mut random);
    for round in 0..count {
        if round % 10 == 0 {
            cobject = scene(&mut random);
        }
        let space = cobject.space().clone();
        let drawn = |random: &mut Random, size: f64| -> Vec<f64> {
            (0..space.nv())
                .map(|_| random.within(-size, size))
                .collect()
        };
        let q = space.step(&space.neutral(), &drawn(&mut random, 2.0));
        let size = [0.05, 0.3, 1.0, 3.0][random.below(4)];
        let v = drawn(&mut random, size);
        let options = MotionOptions {
            any_contact: random.below(4) == 0,
            tolerance: [1e-3, 1e-6][random.below(2)],
            ..MotionOptions::default()
        };
        let answer = context.motion_along(&cobject, &q, &v, &options).unwrap();
        let [free, end] = answer.times;
        let free_until = match answer.outcome {
            MotionOutcome::Free => 1.0,
            MotionOutcome::Hit if options.any_contact => 0.0,
            _ => free,
        };
        outcomes[answer.outcome as usize] += 1;
        for i in 0..samples {
            // Half of them come ever nearer to the end of what is free.
            let part = random.within(0.0, 1.0);
            let near_end = 1.0 - 10f64.powf(-6.0 * part);
            let t = free_until * if i % 2 == 0 { part } else { near_end };
            let t = if i == 0 { free_until } else { t };
            let is_start = t == 0.0 && free_until == 0.0;
            if (answer.outcome == MotionOutcome::Free || t < free_until) && !is_start {
                let q = at(&space, &q, &v, t);
                let found = class(context, &cobject, &q);
                assert_ne!(found, Class::Inside, "round {round}: at {t} of {answer:?}");
            }
        }
        if answer.outcome == MotionOutcome::Hit {
            let q = at(&space, &q, &v, end);
            assert_eq!(class(context, &cobject, &q), Class::Inside, "round {round}");
            assert_eq!(q, answer.configuration);
            assert!(options.any_contact || end - free <= options.tolerance);
            let told = answer.distance.map(|distance| distance.lower);
            assert_eq!(told, (!options.any_contact).then_some(0.0));
        }
    }
    println!("free, hit, near, undecided: {outcomes:?}");
    assert!(
        outcomes[0] > count / 10 && outcomes[1] > count / 10,
        "{outcomes:?}"
    );
    assert!(
        outcomes[2] <= count / 50 && outcomes[3] == 0,
        "{outcomes:?}"
    );
}

/// Surfaces of many triangles on one side or on both, so that trees of either are opened, and samples that come ever nearer to the first contact:
/// what meets a little before it, and is apart there, is the contact that was to be found.
#[test]
fn no_contact_of_surfaces_comes_before_the_first() {
    let mut random = Random::new(194);
    let context = &mut QueryContext::new();
    let (mut hits, mut looked) = (0, 0);
    for _ in 0..600 {
        let links = (0..3).map(|i: usize| LinkDefinition {
            at: random.pose(0.5),
            body: Some(rough_ball(&mut random)),
            ..link(i.checked_sub(1), JointKind::Revolute, random.unit())
        });
        let space = space(vec![robot(3, links.collect())]);
        let objects: Vec<_> = (0..6)
            .map(|i| {
                let cylinder = |b: &mut BodyBuilder| {
                    let radius = random.within(0.01, 0.1);
                    let added = b.add_cylinder(&Pose::identity(), radius, 0.3, 0);
                    added.unwrap();
                };
                let body = if i < 4 {
                    built(cylinder)
                } else {
                    rough_ball(&mut random)
                };
                (body, random.pose(2.0))
            })
            .collect();
        let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
        let cobject = against(&space, &environment(&objects).0);
        for _ in 0..30 {
            let q: Vec<f64> = (0..3).map(|_| random.within(-3.0, 3.0)).collect();
            let v: Vec<f64> = (0..3).map(|_| random.within(-1.5, 1.5)).collect();
            let options = MotionOptions::default();
            let answer = context.motion_along(&cobject, &q, &v, &options).unwrap();
            if answer.outcome != MotionOutcome::Hit || answer.times[0] == 0.0 {
                continue;
            }
            hits += 1;
            for _ in 0..200 {
                let t = answer.times[0] * (1.0 - 10f64.powf(-random.within(0.0, 6.0)));
                let found = class(context, &cobject, &at(&space, &q, &v, t));
                assert_ne!(found, Class::Inside, "at {t} of {answer:?}");
                looked += 1;
            }
        }
    }
    println!("{hits} first contacts, {looked} samples before them");
    assert!(hits > 100);
}

/// The same in the plane, where polygons are solid.
#[test]
fn motions_of_the_plane_are_proved_too() {
    let mut random = Random::new(193);
    let mut outcomes = [0usize; 4];
    let context = &mut QueryContext::new();
    for _ in 0..60 {
        let polygon = |random: &mut Random| planar(&[random.polygon(5, 0.5)]).body;
        let space = space(vec![free_planar_body(&polygon(&mut random))]);
        let objects: Vec<_> = (0..6)
            .map(|_| (polygon(&mut random), random.planar_pose(3.0)))
            .collect();
        let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
        let cobject = against(&space, &environment(&objects).0);
        for _ in 0..20 {
            let drawn = |random: &mut Random| [(); 3].map(|_| random.within(-3.0, 3.0));
            let (q0, q1) = (drawn(&mut random), drawn(&mut random));
            let options = MotionOptions::default();
            let answer = context.motion(&cobject, &q0, &q1, &options).unwrap();
            outcomes[answer.outcome as usize] += 1;
            let v = space.difference(&q0, &q1);
            for i in 0..200 {
                let t = f64::from(i) / 200.0;
                if answer.outcome == MotionOutcome::Free || t < answer.times[0] {
                    let found = class(context, &cobject, &at(&space, &q0, &v, t));
                    assert_ne!(found, Class::Inside, "at {t} of {answer:?}");
                }
            }
            if answer.outcome == MotionOutcome::Hit {
                let found = class(context, &cobject, &answer.configuration);
                assert_eq!(found, Class::Inside);
            }
        }
    }
    assert!(
        outcomes[0] > 200 && outcomes[1] > 200 && outcomes[3] == 0,
        "{outcomes:?}"
    );
}

/// A body that shifts along x among one object.
pub fn gantry(body: &Arc<Body>, object: &Arc<Body>, pose: Pose) -> CObject {
    let links = vec![LinkDefinition {
        body: Some(body.clone()),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let (environment, _) = environment(&[(object, pose)]);
    against(&space(vec![robot(3, links)]), &environment)
}

fn first_contact(cobject: &CObject, from: f64, to: f64) -> MotionAnswer {
    let options = MotionOptions::default();
    let answer = QueryContext::new().motion(cobject, &[from], &[to], &options);
    answer.unwrap()
}

/// Case A28 of docs/cases.md (BerkeleyAutomation/python-fcl#38): the box meets the cone's rim at .425.
#[test]
fn a_box_meets_the_rim_of_a_cone() {
    let cone = built(|b| b.add_cone(&Pose::identity(), 1.0, 3.0, 0).unwrap());
    let cell = gantry(&cuboid([1.0, 2.0, 3.0]).body, &cone, Pose::identity());
    let answer = first_contact(&cell, -10.0, 10.0);
    assert_eq!(answer.outcome, MotionOutcome::Hit);
    assert!((answer.times[1] - 0.425).abs() < 2e-6, "{:?}", answer.times);
}

/// A ball past a plate that steps of 0.05 jump over.
#[test]
fn a_thin_plate_is_not_jumped_over() {
    let ball = built(|b| b.add_sphere(&Vec3::zeros(), 0.005, 0).unwrap());
    let plate = cuboid([0.001, 1.0, 1.0]).body;
    let cell = gantry(
        &ball,
        &plate,
        Pose::from_translation(Vec3::new(0.0255, 0.0, 0.0)),
    );
    let answer = first_contact(&cell, -0.5, 0.5);
    assert_eq!(answer.outcome, MotionOutcome::Hit);
    assert!((answer.times[1] - 0.52).abs() < 2e-6, "{:?}", answer.times);
}

/// Angles of a thousand million radians are rounded to 1e-7: what is called free is so for the angles that queries compute.
#[test]
fn large_angles_are_proved_with_their_rounding() {
    let mut random = Random::new(197);
    let arm = built(|b| {
        let middle = Pose::from_translation(Vec3::new(1.0, 0.0, 0.0));
        b.add_box(&middle, &Vec3::new(1.0, 0.05, 0.05), 0).unwrap();
    });
    let links = vec![LinkDefinition {
        body: Some(arm),
        ..link(None, JointKind::Revolute, Vec3::z())
    }];
    let plate = cuboid([0.4, 0.001, 0.4]).body;
    let pose = Pose::from_translation(Vec3::new(1.9, 0.7, 0.0));
    let space = space(vec![robot(3, links)]);
    let cobject = against(&space, &environment(&[(&plate, pose)]).0);
    let context = &mut QueryContext::new();
    let mut free = 0;
    for _ in 0..300 {
        let q = [random.within(-1e9, 1e9).round() * std::f64::consts::TAU];
        let v = [random.within(-0.5, 0.5)];
        let options = MotionOptions::default();
        let answer = context.motion_along(&cobject, &q, &v, &options).unwrap();
        let until = answer.times[0];
        free += usize::from(answer.outcome == MotionOutcome::Free);
        for i in 0..100 {
            let t = f64::from(i) / 100.0;
            if answer.outcome == MotionOutcome::Free || t < until {
                let found = class(context, &cobject, &at(&space, &q, &v, t));
                assert_ne!(found, Class::Inside, "at {t} of {answer:?}");
            }
        }
    }
    assert!(free > 50, "{free}");
}

/// Closed forms: a slider from 0 on, with a range to 1, a world to 2, and sets around 3.
#[test]
fn motions_meet_pure_sets_when_they_should() {
    let cube = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let range = Coordinate::Interval {
        lower: -1.0,
        upper: 1.0,
    };
    let world = WorldBox {
        low: [-2.0; 3],
        high: [2.0; 3],
    };
    let robots = vec![robot(3, links)];
    let space = Arc::new(Space::new(robots, &[Some(range)], world).unwrap());
    let floor = PureShape::Floor {
        links: vec![0],
        normal: -Vec3::x(),
        offset: -3.0,
    };
    // The time at which a motion from 0 to 4 meets each.
    let cases = [
        (PureShape::BeyondLimits, 1.0 / 4.0),
        (PureShape::BeyondWorld { links: vec![0] }, 2.0 / 4.0),
        (floor, 2.5 / 4.0),
        (
            PureShape::Box {
                low: vec![2.5],
                high: vec![2.75],
            },
            2.5 / 4.0,
        ),
        (
            PureShape::HalfSpace {
                normal: vec![-1.0],
                offset: -3.0,
                is_open: false,
            },
            3.0 / 4.0,
        ),
        (
            PureShape::Ball {
                center: vec![3.0],
                radius: 1e-3,
            },
            2.999 / 4.0,
        ),
    ];
    for (shape, time) in cases {
        let set = pure(&space, shape, Some(1.0));
        let name = format!("{:?}", set.set());
        let answer = first_contact(&set, 0.0, 4.0);
        assert_eq!(answer.outcome, MotionOutcome::Hit, "{name}");
        assert!(
            (answer.times[1] - time).abs() < 2e-6,
            "{name}: {:?}",
            answer.times
        );
        let before = first_contact(&set, 0.0, 4.0 * time - 1e-3);
        assert_eq!(before.outcome, MotionOutcome::Free, "{name}");
    }
    // To the end of the range, which is open.
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    assert_eq!(
        first_contact(&limits, -1.0, 1.0).outcome,
        MotionOutcome::Free
    );
}

/// Two walls 3 mm apart and a plate of 2.9 mm between them.
#[test]
fn a_narrow_slot_is_passed() {
    let walls = built(|b| {
        for (y, tag) in [(-0.5015, 0), (0.5015, 1)] {
            let corners = box_corners([2.0, 1.0, 2.0]);
            let moved: Vec<Vec3> = corners.iter().map(|p| p + Vec3::new(0.0, y, 0.0)).collect();
            b.add_polyhedron(&moved, tag).unwrap();
        }
    });
    let plate = cuboid([0.1, 0.0029, 0.1]).body;
    let cell = gantry(&plate, &walls, Pose::identity());
    let context = &mut QueryContext::new();
    let answer = context.motion(&cell, &[-3.0], &[3.0], &MotionOptions::default());
    assert_eq!(answer.unwrap().outcome, MotionOutcome::Free);
    let work = context.statistics();
    assert!(work.primitive_distances <= 8, "{work:?}");
    // With a threshold of less and of more than the play of .05 mm.
    for (threshold, outcome) in [(4.9e-5, MotionOutcome::Free), (5.1e-5, MotionOutcome::Hit)] {
        let options = MotionOptions {
            threshold,
            ..MotionOptions::default()
        };
        let answer = context.motion(&cell, &[-3.0], &[3.0], &options).unwrap();
        assert_eq!(answer.outcome, outcome, "{threshold}");
    }
}

/// Case A33 of docs/cases.md: two links pass the same place, one after the other.
#[test]
fn links_that_pass_the_same_place_at_different_times_are_free() {
    let cube = cuboid([0.4; 3]).body;
    let slider = |axis: Vec3, start: Vec3| LinkDefinition {
        body: Some(cube.clone()),
        at: Pose::from_translation(start),
        ..link(None, JointKind::Prismatic, axis)
    };
    let links = vec![
        slider(Vec3::x(), Vec3::new(-1.0, 0.0, 0.0)),
        slider(Vec3::y(), Vec3::new(0.0, -3.0, 0.0)),
    ];
    let space = space(vec![robot(3, links)]);
    let itself = CObject::induced_links(space, &[[0, 1]], InducedOptions::default()).unwrap();
    let context = &mut QueryContext::new();
    let options = MotionOptions::default();
    let passes = context
        .motion(&itself, &[0.0; 2], &[4.0; 2], &options)
        .unwrap();
    assert_eq!(passes.outcome, MotionOutcome::Free);
    // The second starts a unit ahead: now they are in the middle together from 0.65 to 0.75 or so.
    let meets = context
        .motion(&itself, &[0.0, 1.8], &[4.0, 5.8], &options)
        .unwrap();
    assert_eq!(meets.outcome, MotionOutcome::Hit);
}

#[test]
fn bad_input_is_refused_and_what_starts_inside_says_so() {
    let cube = cuboid([1.0; 3]).body;
    let cell = gantry(&cube, &cube, Pose::identity());
    let context = &mut QueryContext::new();
    let options = MotionOptions::default();
    let starts_inside = context.motion(&cell, &[0.2], &[5.0], &options).unwrap();
    assert_eq!(starts_inside.outcome, MotionOutcome::Hit);
    assert_eq!(starts_inside.times, [0.0, 0.0]);
    let rests = context.motion(&cell, &[5.0], &[5.0], &options).unwrap();
    assert_eq!(rests.outcome, MotionOutcome::Free);
    let kind = |q0: &[f64], q1: &[f64], options: MotionOptions| {
        let refused = QueryContext::new().motion(&cell, q0, q1, &options);
        refused.unwrap_err().kind
    };
    assert_eq!(kind(&[f64::NAN], &[1.0], options), ErrorKind::NotFinite);
    assert_eq!(kind(&[0.0, 1.0], &[1.0], options), ErrorKind::WrongSize);
    for tolerance in [0.0, -1.0, f64::NAN, 2.0] {
        let options = MotionOptions {
            tolerance,
            ..options
        };
        assert_eq!(kind(&[4.0], &[5.0], options), ErrorKind::InvalidArgument);
    }
    context.set_limit(Some(0));
    let limited = context.motion(&cell, &[-2.0], &[2.0], &options);
    match limited {
        Ok(answer) => assert_eq!(answer.outcome, MotionOutcome::Undecided),
        Err(error) => assert_eq!(error.kind, ErrorKind::Limit),
    }
}

/// What moves farther than single precision holds is not free of what lies on its way, of one object or of several, nor is a link of
/// the link before it.
#[test]
fn no_way_is_too_long_for_links() {
    let cube = cuboid([2.0; 3]).body;
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()] {
        let base = LinkDefinition {
            body: Some(cube.clone()),
            ..link(None, JointKind::Prismatic, axis)
        };
        let finger = LinkDefinition {
            at: Pose::from_translation(axis * 5.0),
            body: Some(cube.clone()),
            ..link(Some(0), JointKind::Prismatic, axis)
        };
        let space = space(vec![robot(3, vec![base, finger])]);
        let places = [5.0, 9.0, 13.0, -7.0].map(|x| Pose::from_translation(axis * x));
        let itself =
            CObject::induced_links(space.clone(), &[[0, 1]], InducedOptions::default()).unwrap();
        let mut sets = vec![itself];
        for count in [1, 2, 4] {
            let objects: Vec<_> = places[..count].iter().map(|at| (&cube, *at)).collect();
            let (environment, _) = environment(&objects);
            sets.push(against(&space, &environment));
        }
        let context = &mut QueryContext::new();
        for exponent in 36..=48 {
            let far = 10f64.powi(exponent);
            for set in &sets {
                for any_contact in [false, true] {
                    let options = MotionOptions {
                        any_contact,
                        ..MotionOptions::default()
                    };
                    let found = context.motion(set, &[0.0, -far], &[0.0, far], &options);
                    let outcome = found.unwrap().outcome;
                    assert_ne!(outcome, MotionOutcome::Free, "{axis:?} {far:e}");
                }
            }
        }
    }
}

/// A body that hardly turns on its way, by any small angle, is not free of what lies on it; nor is an arm on it that reaches into itself.
#[test]
fn turns_of_any_smallness_hide_nothing() {
    let cube = cuboid([0.2; 3]).body;
    let base = LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Free, Vec3::z())
    };
    let arm = LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.0, 1.0, 0.0)),
        body: Some(cube.clone()),
        ..link(Some(0), JointKind::Prismatic, Vec3::y())
    };
    let space = space(vec![robot(3, vec![base, arm])]);
    let (environment, _) =
        environment(&[(&cube, Pose::from_translation(Vec3::new(1.5, 0.0, 0.0)))]);
    let wall = against(&space, &environment);
    let itself =
        CObject::induced_links(space.clone(), &[[0, 1]], InducedOptions::default()).unwrap();
    let context = &mut QueryContext::new();
    let q = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    for exponent in (0..330).step_by(3) {
        for linear in [2.0, -2.0] {
            let turn = 10f64.powi(-exponent).min(0.01);
            let outcome = |set: &CObject, context: &mut QueryContext, v: &[f64]| {
                let options = MotionOptions::default();
                context.motion_along(set, &q, v, &options).unwrap().outcome
            };
            let v = [linear, 0.0, 0.0, 0.0, turn, 0.0, 0.0];
            let found = outcome(&wall, context, &v);
            let right = [MotionOutcome::Free, MotionOutcome::Hit][usize::from(linear > 0.0)];
            assert_eq!(found, right, "{turn:e}");
            let v = [linear, 0.0, 0.0, 0.0, turn, 0.0, -0.9];
            let found = outcome(&itself, context, &v);
            assert_eq!(found, MotionOutcome::Hit, "{turn:e}");
        }
    }
}
