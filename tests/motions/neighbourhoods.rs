//! Free neighbourhoods change no answer, and are dropped where what they are of changes.

use std::sync::Arc;

use cstk::cobject::{AllowedPair, CObject, Class, InducedOptions, SObjects};
use cstk::environment::{Attachment, Change, Environment};
use cstk::motion::MotionOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use super::random_scenes::{at, scene};
use helpers::random::Random;
use helpers::robots::{Screw, against, against_with, environment, link, robot, space};
use helpers::shapes::{cube_surface, cuboid};

/// A context that remembers and one that does not.
struct Both {
    with: QueryContext,
    without: QueryContext,
}

impl Both {
    fn new() -> Self {
        let mut without = QueryContext::new();
        without.set_neighbourhoods(false);
        let mut with = QueryContext::new();
        with.set_neighbourhoods(true);
        Self { with, without }
    }

    fn class(&mut self, cobject: &CObject, q: &[f64]) -> Class {
        let q = Configuration::Coordinates(q);
        let [a, b] = [&mut self.with, &mut self.without].map(|c| c.classify(cobject, q).unwrap());
        assert_eq!(a, b, "{q:?}");
        a
    }

    fn within(&mut self, cobject: &CObject, q: &[f64], threshold: f64) -> bool {
        let q = Configuration::Coordinates(q);
        let both = [&mut self.with, &mut self.without];
        let [a, b] = both.map(|c| c.within(cobject, q, threshold).unwrap());
        assert_eq!(a, b, "{q:?} within {threshold}");
        a
    }

    fn motion(&mut self, cobject: &CObject, q: &[f64], v: &[f64], options: &MotionOptions) {
        let both = [&mut self.with, &mut self.without];
        let [a, b] = both.map(|c| c.motion_along(cobject, q, v, options).unwrap());
        assert_eq!(a.outcome, b.outcome, "{q:?} {v:?}");
        assert_eq!(a.configuration, b.configuration);
        if !options.any_contact {
            assert_eq!(a.times, b.times, "{q:?} {v:?}");
            let text = |found: &cstk::motion::MotionAnswer| format!("{:?}", found.distance);
            assert_eq!(text(&a), text(&b));
        }
    }
}

/// Near one of a few configurations: there the memory fills.
fn near(random: &mut Random, space: &Space, anchors: &[Vec<f64>]) -> Vec<f64> {
    let anchor = &anchors[random.below(anchors.len())];
    let size = 10f64.powf(random.within(-4.0, 0.0));
    at(space, anchor, &velocity(random, space, size), 1.0)
}

fn velocity(random: &mut Random, space: &Space, size: f64) -> Vec<f64> {
    (0..space.nv())
        .map(|_| random.within(-size, size))
        .collect()
}

fn anchors(random: &mut Random, space: &Space, count: usize) -> Vec<Vec<f64>> {
    let start = space.neutral();
    let anywhere = |_| at(space, &start, &velocity(random, space, 3.0), 1.0);
    (0..count).map(anywhere).collect()
}

/// Moves, deletes, attaches or adds an object.
fn change(random: &mut Random, space: &Space, environment: &Environment) {
    let snapshot = environment.snapshot();
    let objects: Vec<_> = snapshot.objects().cloned().collect();
    let Some(object) = objects.get(random.below(objects.len().max(1))) else {
        return;
    };
    let id = object.id;
    let change = match random.below(6) {
        0 if objects.len() > 3 => Change::Delete { id },
        1 => Change::Add {
            body: object.body.clone(),
            pose: random.pose(3.0),
            data: None,
        },
        2 => Change::Attach {
            id,
            pose: random.pose(0.5),
            attachment: Attachment::new(space, random.below(space.link_count()), &[]).unwrap(),
        },
        _ => Change::Move {
            id,
            pose: random.pose(3.0),
        },
    };
    environment.apply(&[change]).unwrap();
}

/// The same links against the same objects with other options: each C-object of a context has its own memory.
fn sibling(random: &mut Random, cobject: &CObject) -> CObject {
    let (space, environment) = (cobject.space(), &cobject.environments()[0]);
    let allowed: Vec<AllowedPair> = environment
        .snapshot()
        .objects()
        .take(2)
        .map(|object| {
            let link = random.below(space.link_count());
            AllowedPair {
                link,
                attached: 0,
                object: object.id,
            }
        })
        .collect();
    let options = InducedOptions {
        contact_epsilon: [0.0, 0.1][random.below(2)],
        margin: [0.0, 0.02][random.below(2)],
    };
    let objects = SObjects::All(environment.clone());
    CObject::induced(space.clone(), &[], objects, &allowed, options).unwrap()
}

/// 100,000 queries of 200 random robots among objects: all kinds of joints and bodies, held objects, link pairs, margins, contact
/// epsilons, allowed pairs, pure sets beside; the environments change now and then.
#[test]
fn answers_are_the_same_with_and_without_neighbourhoods() {
    let mut random = Random::new(19);
    let (mut answers, mut links, mut dropped) = (0, 0, 0);
    for _ in 0..200 {
        let first = scene(&mut random);
        let second = sibling(&mut random, &first);
        let space = first.space();
        let environment = &first.environments()[0];
        let anchors = anchors(&mut random, space, 5);
        let mut both = Both::new();
        for i in 0..500 {
            if i % 125 == 124 {
                change(&mut random, space, environment);
            }
            let cobject = if i % 3 == 0 { &second } else { &first };
            let q = near(&mut random, space, &anchors);
            match i % 10 {
                0..7 => drop(both.class(cobject, &q)),
                7 | 8 => {
                    let threshold = [0.0, 0.1, 0.3][random.below(3)];
                    both.within(cobject, &q, threshold);
                }
                _ => {
                    let v = velocity(&mut random, space, 0.02);
                    let options = MotionOptions {
                        any_contact: random.below(2) == 0,
                        ..MotionOptions::default()
                    };
                    both.motion(cobject, &q, &v, &options);
                }
            }
        }
        let counts = both.with.neighbourhood_counts();
        answers += counts.answers;
        links += counts.left_out;
        dropped += counts.dropped;
    }
    // The test means something: neighbourhoods did answer.
    println!("{answers} answers, {links} links left out, {dropped} dropped");
    assert!(answers > 10_000 && links > 5_000 && dropped > 5_000);
}

/// A gantry along x whose cube is `gap` from a wall: the neighbourhood of 0 must end before the wall, for each contact epsilon,
/// margin and threshold.
#[test]
fn neighbourhoods_end_where_contact_begins() {
    let cube = cube_surface(1.0).body;
    let mut slider = link(None, JointKind::Prismatic, Vec3::x());
    slider.body = Some(cube.clone());
    let space = space(vec![robot(3, vec![slider])]);
    let wall = cuboid([1.0, 4.0, 4.0]).body;
    let wall_at = Vec3::new(2.5, 0.0, 0.0) - wall.center();
    let (world, _) = environment(&[(&wall, Pose::from_translation(wall_at))]);
    for (contact_epsilon, margin, threshold) in [
        (0.0, 0.0, 0.0),
        (0.1, 0.0, 0.0),
        (0.0, 0.2, 0.0),
        (0.1, 0.2, 0.0),
        (0.1, 0.2, 0.3),
    ] {
        let options = InducedOptions {
            contact_epsilon,
            margin,
        };
        let all = against_with(&space, &world, options);
        let mut both = Both::new();
        for i in 0..6000 {
            let q = [-2.0 + 0.001 * f64::from(i)];
            both.class(&all, &q);
            both.within(&all, &q, threshold);
        }
        let counts = both.with.neighbourhood_counts();
        assert!(counts.answers > 2000, "{counts:?}");
    }
}

/// A joint of the caller's may do anything, so that what it moves is always looked at.
#[test]
fn custom_joints_are_never_remembered() {
    let cube = cuboid([0.2; 3]).body;
    let links = vec![
        LinkDefinition {
            body: Some(cube.clone()),
            ..link(None, JointKind::Revolute, Vec3::z())
        },
        LinkDefinition {
            body: Some(cube.clone()),
            ..link(Some(0), JointKind::Custom(Arc::new(Screw)), Vec3::z())
        },
    ];
    let space = space(vec![robot(3, links)]);
    let far = Pose::from_translation(Vec3::new(9.0, 0.0, 0.0));
    let (world, _) = environment(&[(&cube, far)]);
    let all = against(&space, &world);
    let mut both = Both::new();
    for i in 0..100 {
        let small = f64::from(i) * 1e-4;
        both.class(&all, &[small, small, small]);
    }
    let counts = both.with.neighbourhood_counts();
    assert_eq!(counts.answers, 0);
    assert!(counts.made > 0, "{counts:?}");
}

/// What was known of one state of an environment is forgotten in the next.
#[test]
fn neighbourhoods_are_dropped_where_the_environment_changes() {
    let cube = cuboid([0.2; 3]).body;
    let mut slider = link(None, JointKind::Prismatic, Vec3::x());
    slider.body = Some(cube.clone());
    let space = space(vec![robot(3, vec![slider])]);
    let far = Pose::from_translation(Vec3::new(5.0, 0.0, 0.0));
    let (world, ids) = environment(&[(&cube, far)]);
    let all = against(&space, &world);
    let mut both = Both::new();
    for _ in 0..3 {
        assert_eq!(both.class(&all, &[0.0]), Class::Outside);
    }
    assert_eq!(both.with.neighbourhood_counts().answers, 2);
    let here = Change::Move {
        id: ids[0],
        pose: Pose::identity(),
    };
    world.apply(&[here]).unwrap();
    assert_eq!(both.class(&all, &[0.0]), Class::Inside);
    let back = Change::Move {
        id: ids[0],
        pose: far,
    };
    world.apply(&[back]).unwrap();
    for _ in 0..2 {
        assert_eq!(both.class(&all, &[0.0]), Class::Outside);
    }
    let counts = both.with.neighbourhood_counts();
    assert_eq!(counts.answers, 3);
    assert!(counts.dropped >= 1, "{counts:?}");
}
