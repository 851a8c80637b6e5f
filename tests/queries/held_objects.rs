//! S-objects held by links of all kinds: frames without a body, two at once, in several states, above links that rest.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{AllowedPair, CObject, Class, InducedOptions, LeftOut, SObjects};
use cstk::environment::{Attachment, Change, Environment};
use cstk::error::ErrorKind;
use cstk::motion::{SlideOptions, SlideOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, DistanceKind, QueryContext};
use cstk::robot::JointKind;
use cstk::space::Space;

use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::cuboid;

fn box_of(sides: [f64; 3]) -> Arc<Body> {
    cuboid(sides).body
}

/// A pose at which a box from `cuboid` has its middle at a point.
fn middle_at(body: &Body, at: [f64; 3]) -> Pose {
    Pose::from_translation(Vec3::from(at) - body.center())
}

fn attach(space: &Space, id: u64, link: usize, pose: Pose) -> Change {
    Change::Attach {
        id,
        pose,
        attachment: Attachment::new(space, link, &[]).unwrap(),
    }
}

fn class(cobject: &CObject, q: &[f64]) -> Class {
    let at = Configuration::Coordinates(q);
    QueryContext::new().classify(cobject, at).unwrap()
}

fn distance(cobject: &CObject, q: &[f64]) -> f64 {
    let at = Configuration::Coordinates(q);
    let found = QueryContext::new().distance(cobject, at, f64::INFINITY);
    found.unwrap().distance
}

/// Links that slide along x, y apart, with bodies or without.
fn sliders(bodies: &[Option<Arc<Body>>]) -> Arc<Space> {
    let links = bodies.iter().map(|body| {
        let mut link = link(None, JointKind::Prismatic, Vec3::x());
        link.body = body.clone();
        link
    });
    space(vec![robot(3, links.collect())])
}

/// A tool frame has no body: what it holds is part of the robot all the same.
#[test]
fn a_frame_without_a_body_holds() {
    let (small, cube) = (box_of([0.2; 3]), box_of([1.0; 3]));
    let mut links = vec![
        link(None, JointKind::Prismatic, Vec3::x()),
        link(Some(0), JointKind::Fixed, Vec3::x()),
    ];
    links[0].body = Some(small.clone());
    links[1].at = Pose::from_translation(Vec3::new(2.0, 0.0, 0.0));
    let space = space(vec![robot(3, links)]);
    let wall = box_of([0.5, 4.0, 4.0]);
    let (world, ids) = environment(&[
        (&cube, Pose::from_translation(Vec3::new(0.0, 30.0, 0.0))),
        (&wall, middle_at(&wall, [3.75, 0.0, 0.0])),
    ]);
    let hold = attach(&space, ids[0], 1, middle_at(&cube, [0.0; 3]));
    world.apply(&[hold]).unwrap();
    let all = against(&space, &world);
    // The wall's face is at 3.5, the cube's front at 2.5.
    assert!((distance(&all, &[0.0]) - 1.0).abs() < 1e-14);
    assert_eq!(class(&all, &[1.5]), Class::Inside);
    let chosen = |links: &[usize]| {
        let objects = SObjects::All(world.clone());
        CObject::induced(
            space.clone(),
            links,
            objects,
            LeftOut::default(),
            InducedOptions::default(),
        )
        .unwrap()
    };
    assert!((distance(&chosen(&[1]), &[0.25]) - 0.75).abs() < 1e-14);
    let empty_hand = Environment::default();
    let objects = SObjects::All(Arc::new(empty_hand));
    let none = CObject::induced(
        space,
        &[1],
        objects,
        LeftOut::default(),
        InducedOptions::default(),
    )
    .unwrap();
    let at = Configuration::Coordinates(&[0.0]);
    let found = QueryContext::new().distance(&none, at, f64::INFINITY);
    assert_eq!(found.unwrap().kind, DistanceKind::Empty);
}

/// An environment and its snapshot, in which one object is held differently: both count, in either order.
#[test]
fn an_object_may_be_held_in_two_states() {
    let cube = box_of([1.0; 3]);
    let space = sliders(&[Some(box_of([0.1; 3]))]);
    let wall = box_of([4.0, 1.0, 4.0]);
    let (world, ids) = environment(&[
        (&cube, Pose::identity()),
        (&wall, middle_at(&wall, [0.0, 10.0, 0.0])),
    ]);
    let hold = |y: f64| attach(&space, ids[0], 0, middle_at(&cube, [0.0, y, 0.0]));
    world.apply(&[hold(8.95)]).unwrap();
    let then = Arc::new(world.freeze());
    world.apply(&[hold(9.05)]).unwrap();
    let (then, now) = (against(&space, &then), against(&space, &world));
    let (then, now) = (Arc::new(then), Arc::new(now));
    for order in [[&then, &now], [&now, &then]] {
        let union = CObject::union(&order.map(Arc::clone)).unwrap();
        assert_eq!(class(&union, &[0.0]), Class::Inside);
        assert_eq!(distance(&union, &[0.0]), 0.0);
    }
    assert!((distance(&then, &[0.0]) - 0.05).abs() < 1e-13);
}

/// Two held objects that may meet: named from either side.
#[test]
fn two_held_objects_may_be_allowed() {
    let cube = box_of([1.0; 3]);
    let tiny = box_of([0.01; 3]);
    let space = sliders(&[Some(tiny.clone()), Some(tiny)]);
    let (world, ids) = environment(&[(&cube, Pose::identity()), (&cube, Pose::identity())]);
    let hold = |i: usize, y: f64| attach(&space, ids[i], i, middle_at(&cube, [0.0, y, 0.0]));
    world.apply(&[hold(0, 2.0), hold(1, 2.5)]).unwrap();
    let with = |allowed: &[AllowedPair]| {
        let objects = SObjects::All(world.clone());
        let options = InducedOptions::default();
        let set = CObject::induced(
            space.clone(),
            &[],
            objects,
            LeftOut {
                allowed,
                unmoved: false,
            },
            options,
        )
        .unwrap();
        class(&set, &[0.0, 0.0])
    };
    let pair = |link: usize| AllowedPair {
        link,
        attached: ids[link],
        object: ids[1 - link],
    };
    assert_eq!(with(&[]), Class::Inside);
    assert_eq!(with(&[pair(0)]), Class::Outside);
    assert_eq!(with(&[pair(1)]), Class::Outside);
    // Links that one of them may touch are so by their own bodies alone.
    let touching = |i: usize, y: f64| Change::Attach {
        id: ids[i],
        pose: middle_at(&cube, [0.0, y, 0.0]),
        attachment: Attachment::new(&space, i, &[1 - i]).unwrap(),
    };
    world.apply(&[touching(0, 2.0), touching(1, 2.5)]).unwrap();
    assert_eq!(with(&[]), Class::Inside);
}

/// A base that rests on the floor stops nobody, whether the hand is empty or not; what the hand holds meets the base.
#[test]
fn resting_links_do_not_stop_slides() {
    let base = box_of([1.0, 1.0, 1.0]);
    let mut links = vec![
        link(None, JointKind::Fixed, Vec3::z()),
        link(None, JointKind::Prismatic, Vec3::z()),
    ];
    links[0].body = Some(base.clone());
    links[0].at = middle_at(&base, [0.0, 0.0, 0.5]);
    links[1].body = Some(box_of([0.1; 3]));
    let space = space(vec![robot(3, links)]);
    let floor = box_of([9.0, 9.0, 1.0]);
    let small = box_of([0.2; 3]);
    let (world, ids) = environment(&[
        (&floor, middle_at(&floor, [0.0, 0.0, -0.5])),
        (&small, Pose::from_translation(Vec3::new(30.0, 0.0, 0.0))),
    ]);
    let all = against(&space, &world);
    let options = SlideOptions::with_shell(0.1);
    let mut query = QueryContext::new();
    let mut slide = |q: f64, v: f64| query.slide(&all, &[q], &[v], &options).unwrap();
    let empty = slide(5.0, 0.5);
    assert_eq!(
        (empty.outcome, empty.configuration[0]),
        (SlideOutcome::Moved, 5.5)
    );
    let hold = attach(&space, ids[1], 1, middle_at(&small, [0.0, 0.0, -0.2]));
    world.apply(&[hold]).unwrap();
    let full = slide(5.0, 0.5);
    assert_eq!(
        (full.outcome, full.configuration[0]),
        (SlideOutcome::Moved, 5.5)
    );
    // Down on the base, which is 1 high: what is held reaches 0.3 below the hand's frame.
    let mut q = 2.0;
    for _ in 0..30 {
        q = slide(q, -0.1).configuration[0];
    }
    assert!(q > 1.3 && q < 1.33, "{q}");
}

/// Sets that the object elsewhere is not of are answered; that it is refused does not depend on what was asked before.
#[test]
fn objects_held_elsewhere_concern_their_sets_only() {
    let cube = box_of([1.0; 3]);
    let space = sliders(&[Some(cube.clone())]);
    let other = sliders(&[Some(cube.clone())]);
    let (world, ids) = environment(&[(&cube, Pose::identity()), (&cube, Pose::identity())]);
    let set = |objects: SObjects| {
        CObject::induced(
            space.clone(),
            &[],
            objects,
            LeftOut::default(),
            InducedOptions::default(),
        )
        .unwrap()
    };
    let first = set(SObjects::Some(world.clone(), vec![ids[0]]));
    let all = set(SObjects::All(world.clone()));
    let mut query = QueryContext::new();
    let at = Configuration::Coordinates(&[0.0]);
    assert_eq!(query.classify(&all, at).unwrap(), Class::Inside);
    world
        .apply(&[attach(&other, ids[1], 0, Pose::identity())])
        .unwrap();
    assert_eq!(query.classify(&first, at).unwrap(), Class::Inside);
    assert_eq!(query.version_seen(&world), Some(2));
    for _ in 0..2 {
        let refused = query.classify(&all, at).unwrap_err();
        assert_eq!(refused.kind, ErrorKind::Unsupported);
        let refused = query.within(&all, at, 1.0).unwrap_err();
        assert_eq!(refused.kind, ErrorKind::Unsupported);
    }
}

/// Of terms that hold one pair the one with the largest margin decides, and is named.
#[test]
fn the_widest_margin_is_named() {
    let cube = box_of([1.0; 3]);
    let space = sliders(&[Some(cube.clone())]);
    let apart = Pose::from_translation(Vec3::new(0.0, 1.2, 0.0));
    let (world, _) = environment(&[(&cube, apart)]);
    let with = |margin: f64| {
        let options = InducedOptions {
            margin,
            contact_epsilon: 0.0,
        };
        let objects = SObjects::All(world.clone());
        Arc::new(
            CObject::induced(space.clone(), &[], objects, LeftOut::default(), options).unwrap(),
        )
    };
    let (thin, wide) = (with(0.0), with(0.5));
    for order in [[&thin, &wide], [&wide, &thin]] {
        let union = CObject::union(&order.map(Arc::clone)).unwrap();
        let at = Configuration::Coordinates(&[0.0]);
        let found = QueryContext::new().distance(&union, at, 9.0).unwrap();
        assert_eq!(found.distance, 0.0);
        assert_eq!(found.witness.unwrap().leaf.serial, wide.serial());
    }
}
