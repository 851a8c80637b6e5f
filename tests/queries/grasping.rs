//! S-objects attached to links and let go again, against all pairs of bodies asked one by one; pairs that may meet.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{AllowedPair, CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Addition, Attachment, Change, Environment};
use cstk::error::ErrorKind;
use cstk::motion::{SlideOptions, SlideOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext, SSide};
use cstk::robot::JointKind;
use cstk::space::Space;
use cstk::user_data::UserData;

use helpers::random::Random;
use helpers::robots::{environment, link, robot, space};
use helpers::shapes::cuboid;

/// Three links in a row, 1 long, turning about z, y and z.
fn arm() -> Arc<Space> {
    let axes = [Vec3::z(), Vec3::y(), Vec3::z()];
    let links = (0..3usize).map(|i| {
        let mut link = link(i.checked_sub(1), JointKind::Revolute, axes[i]);
        let along = if i > 0 { 1.2 } else { 0.0 };
        link.at = Pose::from_translation(Vec3::new(along, 0.0, 0.0));
        link.body = Some(cuboid([0.5, 0.2, 0.3]).body.clone());
        link
    });
    space(vec![robot(3, links.collect())])
}

fn all(space: &Arc<Space>, environment: &Arc<Environment>, allowed: &[AllowedPair]) -> CObject {
    let objects = SObjects::All(environment.clone());
    let options = InducedOptions::default();
    CObject::induced(
        space.clone(),
        &[],
        objects,
        LeftOut {
            allowed,
            unmoved: false,
        },
        options,
    )
    .unwrap()
}

struct Scene {
    space: Arc<Space>,
    environment: Arc<Environment>,
    ids: Vec<u64>,
    bodies: Vec<Arc<Body>>,
    poses: Vec<Pose>,
}

fn scene(random: &mut Random) -> Scene {
    let bodies: Vec<Arc<Body>> = [[0.3, 0.2, 0.2], [0.4, 0.1, 0.3], [0.6, 0.6, 0.1], [0.2; 3]]
        .map(|sides| cuboid(sides).body.clone())
        .into();
    let poses: Vec<Pose> = bodies.iter().map(|_| random.pose(2.5)).collect();
    let placed: Vec<(&Arc<Body>, Pose)> = bodies.iter().zip(poses.iter().copied()).collect();
    let (environment, ids) = environment(&placed);
    Scene {
        space: arm(),
        environment,
        ids,
        bodies,
        poses,
    }
}

/// The least distance over all pairs, each asked by itself: objects 0 and 1 held by links 2 and 1.
fn brute(scene: &Scene, q: &[f64], grasps: &[(usize, usize, Pose)]) -> f64 {
    let links = scene.space.link_poses(q).unwrap();
    let holder = |object: usize| grasps.iter().find(|(o, ..)| *o == object);
    let at = |object: usize| match holder(object) {
        Some((_, link, pose)) => links[*link].compose(pose),
        None => scene.poses[object],
    };
    let mut query = QueryContext::new();
    let mut least = f64::INFINITY;
    let mut ask = |a: (&Body, &Pose), b: (&Body, &Pose)| {
        least = least.min(query.pair_distance(a, b, f64::INFINITY).unwrap().distance);
    };
    for object in 0..4 {
        let holds = |link: usize| holder(object).is_some_and(|(_, l, _)| *l == link);
        for (link, pose) in links.iter().enumerate().filter(|(link, _)| !holds(*link)) {
            let body = scene.space.link(link).unwrap().body.as_ref().unwrap();
            ask((body, pose), (&scene.bodies[object], &at(object)));
        }
        for other in object + 1..4 {
            let one_is_held = holder(object).is_some() || holder(other).is_some();
            let same = |a: &(usize, usize, Pose), b: &(usize, usize, Pose)| a.1 == b.1;
            let both = holder(object).zip(holder(other));
            if one_is_held && !both.is_some_and(|(a, b)| same(a, b)) {
                ask(
                    (&scene.bodies[object], &at(object)),
                    (&scene.bodies[other], &at(other)),
                );
            }
        }
    }
    least
}

#[test]
fn what_is_held_is_part_of_the_robot() {
    let mut random = Random::new(31);
    let mut query = QueryContext::new();
    let mut held_on_r = 0;
    for _ in 0..30 {
        let scene = scene(&mut random);
        let cobject = all(&scene.space, &scene.environment, &[]);
        let grasps: Vec<(usize, usize, Pose)> = [(0, 2), (1, 1)]
            .map(|(o, l)| (o, l, random.pose(0.6)))
            .into();
        let changes = grasps.iter().map(|(object, link, pose)| Change::Attach {
            id: scene.ids[*object],
            pose: *pose,
            attachment: Attachment::new(&scene.space, *link, &[]).unwrap(),
        });
        let (_, version) = scene
            .environment
            .apply(&changes.collect::<Vec<_>>())
            .unwrap();
        for _ in 0..20 {
            let q: Vec<f64> = (0..3).map(|_| random.within(-3.0, 3.0)).collect();
            let at = Configuration::Coordinates(&q);
            let found = query.distance(&cobject, at, f64::INFINITY).unwrap();
            let expected = brute(&scene, &q, &grasps);
            assert!((found.distance - expected).abs() < 1e-13);
            assert_eq!(found.version, version);
            let inside = query.classify(&cobject, at).unwrap() == Class::Inside;
            assert_eq!(inside, expected == 0.0);
            assert!(query.within(&cobject, at, expected + 1e-12).unwrap());
            let witness = found.witness.unwrap();
            held_on_r += usize::from(witness.r_object != 0);
            if expected < 1e-3 {
                continue;
            }
            // The nearest pair's gradient: of all that moves with links, on both sides.
            let list = query.gradients(&cobject, &q, expected + 1e-9, 10).unwrap();
            if list.witnesses.len() > 1 || list.contacts.len() > 1 {
                continue;
            }
            for (k, slope) in list.gradients.iter().enumerate() {
                let there = |h: f64| {
                    let mut q = q.clone();
                    q[k] += h;
                    brute(&scene, &q, &grasps)
                };
                let difference = (there(1e-6) - there(-1e-6)) / 2e-6;
                let curved = (there(1e-6) + there(-1e-6) - 2.0 * expected).abs() > 1e-9;
                assert!(
                    curved || (difference - slope).abs() < 1e-6,
                    "{difference} {slope}"
                );
            }
        }
        // Let go where the arm stands still: from then on it is an obstacle like others.
        let back: Vec<Change> = grasps
            .iter()
            .map(|(object, ..)| Change::Move {
                id: scene.ids[*object],
                pose: scene.poses[*object],
            })
            .collect();
        scene.environment.apply(&back).unwrap();
        let q: Vec<f64> = (0..3).map(|_| random.within(-3.0, 3.0)).collect();
        let at = Configuration::Coordinates(&q);
        let found = query.distance(&cobject, at, f64::INFINITY).unwrap();
        assert!((found.distance - brute(&scene, &q, &[])).abs() < 1e-13);
    }
    assert!(held_on_r > 50, "{held_on_r}");
}

/// Fingers may touch what they hold; pairs named in the set may meet; snapshots keep the grasp that they saw.
#[test]
fn pairs_that_may_meet_are_left_out() {
    let mut random = Random::new(5);
    let scene = scene(&mut random);
    let (a, b) = (scene.ids[0], scene.ids[3]);
    let at_origin = Pose::identity();
    let attach = |touch: &[usize]| Change::Attach {
        id: a,
        pose: at_origin,
        attachment: Attachment::new(&scene.space, 2, touch).unwrap(),
    };
    let mut query = QueryContext::new();
    let q = [0.0, 0.0, 0.0];
    let at = Configuration::Coordinates(&q);
    // The object fills the hand, and reaches into the link before it when that is as long.
    scene.environment.apply(&[attach(&[])]).unwrap();
    let one = |id: u64, allowed: &[AllowedPair]| {
        let objects = SObjects::Some(scene.environment.clone(), vec![id]);
        let options = InducedOptions::default();
        CObject::induced(
            scene.space.clone(),
            &[],
            objects,
            LeftOut {
                allowed,
                unmoved: false,
            },
            options,
        )
        .unwrap()
    };
    let own = one(a, &[]);
    let list = query.witnesses(&own, at, f64::INFINITY, 100).unwrap();
    let mut links: Vec<usize> = list.witnesses.iter().map(|w| w.r_link).collect();
    links.sort_unstable();
    assert_eq!(links, [0, 1]);
    assert!(list.witnesses.iter().all(|w| w.s_carrier == Some(2)));
    scene.environment.apply(&[attach(&[1])]).unwrap();
    let list = query.witnesses(&own, at, f64::INFINITY, 100).unwrap();
    assert_eq!(
        list.witnesses.iter().map(|w| w.r_link).collect::<Vec<_>>(),
        [0]
    );
    let allowed = [AllowedPair {
        link: 0,
        attached: 0,
        object: a,
    }];
    let nothing = query
        .distance(&one(a, &allowed), at, f64::INFINITY)
        .unwrap();
    assert_eq!(nothing.kind, DistanceKind::Empty);
    // What is held may lie on what it was taken from.
    let r_sides = |allowed: &[AllowedPair], query: &mut QueryContext| {
        let list = query
            .witnesses(&one(b, allowed), at, f64::INFINITY, 100)
            .unwrap();
        let mut sides: Vec<_> = list
            .witnesses
            .iter()
            .map(|w| (w.r_link, w.r_object))
            .collect();
        sides.sort_unstable();
        sides
    };
    assert_eq!(r_sides(&[], &mut query), [(0, 0), (1, 0), (2, 0), (2, a)]);
    let allowed = [AllowedPair {
        link: 2,
        attached: a,
        object: b,
    }];
    assert_eq!(r_sides(&allowed, &mut query), [(0, 0), (1, 0), (2, 0)]);
    let then = Arc::new(scene.environment.freeze());
    scene
        .environment
        .apply(&[Change::Delete { id: a }])
        .unwrap();
    assert_eq!(r_sides(&[], &mut query), [(0, 0), (1, 0), (2, 0)]);
    let before = query.witnesses(&all(&scene.space, &then, &[]), at, f64::INFINITY, 100);
    assert!(before.unwrap().witnesses.iter().any(|w| w.r_object == a));
}

/// Objects that other spaces' links hold are nowhere to be found.
#[test]
fn an_object_held_elsewhere_is_refused() {
    let scene = scene(&mut Random::new(6));
    let other = arm();
    let attach = Change::Attach {
        id: scene.ids[0],
        pose: Pose::identity(),
        attachment: Attachment::new(&other, 0, &[]).unwrap(),
    };
    scene.environment.apply(&[attach]).unwrap();
    let cobject = all(&scene.space, &scene.environment, &[]);
    let refused = QueryContext::new().classify(&cobject, Configuration::Coordinates(&[0.0; 3]));
    assert_eq!(refused.unwrap_err().kind, ErrorKind::Unsupported);
    assert_eq!(
        Attachment::new(&other, 3, &[]).unwrap_err().kind,
        ErrorKind::NotFound
    );
    assert_eq!(
        Attachment::new(&other, 0, &[9]).unwrap_err().kind,
        ErrorKind::NotFound
    );
}

/// A held rod sweeps farther than the hand does: its way is proved free by its own reach.
#[test]
fn slides_carry_what_is_held() {
    let mut links = vec![link(None, JointKind::Revolute, Vec3::z())];
    links[0].body = Some(cuboid([0.1; 3]).body.clone());
    let space = space(vec![robot(3, links)]);
    let rod = cuboid([4.0, 0.01, 0.01]).body.clone();
    let post = cuboid([0.01, 0.01, 1.0]).body.clone();
    let beyond = Pose::from_translation(Vec3::new(0.0, 3.0, 0.0));
    let (environment, ids) = environment(&[(&rod, beyond), (&post, beyond)]);
    let attach = Change::Attach {
        id: ids[0],
        pose: Pose::from_translation(Vec3::new(2.0, 0.0, 0.0)),
        attachment: Attachment::new(&space, 0, &[]).unwrap(),
    };
    environment.apply(&[attach]).unwrap();
    let cobject = all(&space, &environment, &[]);
    let options = SlideOptions::with_shell(0.1);
    let mut query = QueryContext::new();
    // Across the post at a quarter turn, in one step: no.
    let step = query.slide(&cobject, &[1.2], &[0.8], &options).unwrap();
    assert!(step.configuration[0] < std::f64::consts::FRAC_PI_2);
    let beside = query.slide(&cobject, &[1.2], &[-0.8], &options).unwrap();
    assert_eq!(
        (beside.outcome, beside.configuration[0]),
        (SlideOutcome::Moved, 1.2 - 0.8)
    );
}

/// Data of objects come back with their witnesses, and go with the last state that holds them.
#[test]
fn data_of_objects_come_back() {
    let kept = Arc::new(());
    let space = arm();
    let environment = Arc::new(Environment::default());
    let body = cuboid([0.2; 3]).body.clone();
    let pose = Pose::from_translation(Vec3::new(0.0, 0.0, 2.0));
    let add = Change::Add(Addition {
        data: Some(UserData::new(7, Some(kept.clone()))),
        ..Addition::new(body, pose)
    });
    let (ids, _) = environment.apply(std::slice::from_ref(&add)).unwrap();
    drop(add);
    let cobject = all(&space, &environment, &[]);
    let found = QueryContext::new().distance(&cobject, Configuration::Coordinates(&[0.0; 3]), 9.0);
    let witness = found.unwrap().witness.unwrap();
    assert_eq!(
        (witness.s_side, witness.data[1]),
        (SSide::Object(ids[0]), 7)
    );
    let then = environment.freeze();
    environment.apply(&[Change::Delete { id: ids[0] }]).unwrap();
    assert_eq!(Arc::strong_count(&kept), 2);
    drop(then);
    assert_eq!(Arc::strong_count(&kept), 1);
}
