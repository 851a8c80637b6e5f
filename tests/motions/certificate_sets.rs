//! Which C-objects have certificates: known cases of each kind.

use std::collections::HashSet;
use std::sync::Arc;

use cstk::body::Body;
use cstk::certificate::Certificate;
use cstk::cobject::{CObject, InducedOptions, PureShape};
use cstk::environment::{Attachment, Change};
use cstk::error::{ErrorKind, Result};
use cstk::motion::{MotionAnswer, MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3, rotation_about};
use cstk::primitive::SupportFunction;
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, LinkDefinition, Robot};
use cstk::space::{Space, WorldBox};

use helpers::pure::pure;
use helpers::robots::{Screw, against, environment, link, robot, space};
use helpers::shapes::cuboid;
use helpers::surfaces::{cube, hollow_cube, solid, solid_one, surface_one, torus};

use super::random_scenes::built;

fn made(
    cobject: &CObject,
    q0: &[f64],
    q1: &[f64],
    threshold: f64,
) -> Result<(MotionAnswer, Option<Certificate>)> {
    let options = MotionOptions {
        threshold,
        ..MotionOptions::default()
    };
    QueryContext::new().motion_certificate(cobject, q0, q1, &options)
}

/// A certificate that is accepted; its number of entries.
fn certified(cobject: &CObject, q0: &[f64], q1: &[f64]) -> usize {
    let (answer, certificate) = made(cobject, q0, q1, 0.0).unwrap();
    let certificate = certificate.unwrap_or_else(|| panic!("{answer:?}"));
    certificate.verify(cobject, q0, q1, 0.0).unwrap();
    certificate.entries().len()
}

fn unsupported(cobject: &CObject, leaf: u64) {
    let q = vec![0.0; cobject.space().nq()];
    let error = made(cobject, &q, &q, 0.0).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    let name = format!("C-object {leaf} ");
    assert!(error.message.contains(&name), "{}", error.message);
}

/// A body that goes on screws.
fn flying(body: &Arc<Body>) -> Arc<Robot> {
    let flies = LinkDefinition {
        body: Some(body.clone()),
        ..link(None, JointKind::Free, Vec3::z())
    };
    robot(3, vec![flies])
}

/// A slider of a unit cube along x, with a range and a world.
fn slider(range: f64, world: f64) -> Arc<Space> {
    let links = vec![LinkDefinition {
        body: Some(cuboid([1.0; 3]).body),
        ..link(None, JointKind::Prismatic, Vec3::x())
    }];
    let range = Coordinate::Interval {
        lower: -range,
        upper: range,
    };
    let world = WorldBox {
        low: [-world, -1.0, -1.0],
        high: [world, 1.0, 1.0],
    };
    Arc::new(Space::new(vec![robot(3, links)], &[Some(range)], world).unwrap())
}

fn wall(space: &Arc<Space>, x: f64) -> Arc<CObject> {
    let body = cuboid([1.0; 3]).body;
    let pose = Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    Arc::new(against(space, &environment(&[(&body, pose)]).0))
}

#[test]
fn translations_take_one_entry() {
    let space = slider(9.0, 9.0);
    assert_eq!(certified(&wall(&space, 8.0), &[-9.0], &[6.999],), 1);
    let (answer, none) = made(&wall(&space, 8.0), &[-9.0], &[7.001], 0.0).unwrap();
    assert!(answer.outcome == MotionOutcome::Hit && none.is_none());
    let (answer, none) = made(&wall(&space, 8.0), &[-9.0], &[6.999], 0.002).unwrap();
    assert!(answer.outcome == MotionOutcome::Hit && none.is_none());
}

#[test]
fn sets_given_in_c_space_or_in_the_world_are_certified() {
    let space = slider(1.0, 2.0);
    let floor = PureShape::Floor {
        links: vec![0],
        normal: Vec3::z(),
        offset: -0.5 - 1e-9,
    };
    let ball = PureShape::Ball {
        center: vec![1.5],
        radius: 0.25,
    };
    let region = PureShape::Box {
        low: vec![1.5],
        high: vec![2.0],
    };
    let half = PureShape::HalfSpace {
        normal: vec![-1.0],
        offset: -1.1,
        is_open: false,
    };
    for (shape, end, most) in [
        // To the end of the range, which is open.
        (PureShape::BeyondLimits, 1.0, 1),
        (PureShape::BeyondWorld { links: vec![0] }, 1.99, 64),
        (floor, 5.0, 1),
        (ball, 1.2, 64),
        (region, 1.45, 64),
        (half, 1.09, 1),
    ] {
        let set = pure(&space, shape.clone(), Some(1.0));
        let count = certified(&set, &[-1.0], &[end]);
        assert!(count <= most, "{count} entries of {shape:?}");
    }
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    let (answer, none) = made(&limits, &[0.0], &[1.5], 0.0).unwrap();
    assert!(answer.outcome == MotionOutcome::Hit && none.is_none());
    assert!(made(&limits, &[0.0], &[0.5], 0.4).unwrap().1.is_some());
    assert!(made(&limits, &[0.0], &[0.5], 0.6).unwrap().1.is_none());
    // What rests on a side of the world, which is open, is inside of it.
    let base = LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.0, 0.0, -1.0)),
        ..link(None, JointKind::Fixed, Vec3::z())
    };
    let arm = LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.5, 0.0, 1.0)),
        ..link(Some(0), JointKind::Revolute, Vec3::z())
    };
    let tip = LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.4, 0.0, 0.0)),
        ..link(Some(1), JointKind::Fixed, Vec3::z())
    };
    let world = WorldBox {
        low: [-1.0; 3],
        high: [1.0; 3],
    };
    let robots = vec![robot(3, vec![base, arm, tip])];
    let turner = Arc::new(Space::new(robots, &[], world).unwrap());
    let beyond = pure(&turner, PureShape::beyond_world(&turner), None);
    assert!(certified(&beyond, &[-1.5], &[1.5]) > 15);
    // A free body's position is limited too, and moves on a screw.
    let body = flying(&cuboid([0.1; 3]).body);
    let range = Some(Coordinate::Interval {
        lower: -1.0,
        upper: 1.0,
    });
    let mut ranges = vec![range; 3];
    ranges.resize(7, None);
    let space = Arc::new(Space::new(vec![body], &ranges, WorldBox::unbounded()).unwrap());
    let limits = pure(&space, PureShape::BeyondLimits, Some(1.0));
    let q0 = [-0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let q1 = [0.5, 0.0, 0.0, 0.0, 0.0, 0.6, 0.8];
    assert!(certified(&limits, &q0, &q1) > 1);
}

#[test]
fn intersections_choose_the_part_that_is_free() {
    let space = slider(9.0, 9.0);
    let [first, second] = [0.0, 1.5].map(|x| wall(&space, x));
    let both = CObject::intersection(&[first.clone(), second.clone()]).unwrap();
    // From -3 to .49 the slider passes the first wall, and keeps out of the second.
    certified(&both, &[-3.0], &[0.49]);
    let apart = CObject::intersection(&[wall(&space, -4.0), wall(&space, 4.0)]).unwrap();
    // At no time in both, but in each at some time.
    assert!(certified(&apart, &[-8.0], &[8.0]) >= 2);
    let without = CObject::difference(&wall(&space, 8.0), &first).unwrap();
    certified(&without, &[-3.0], &[3.0]);
    // Inside the first wall only the complement of that is free.
    let without = CObject::difference(&first, &first.clone()).unwrap();
    unsupported(&without, first.serial());
    let complement = CObject::complement(&first).unwrap();
    unsupported(&complement, first.serial());
    let ball = PureShape::Ball {
        center: vec![0.0],
        radius: 1.0,
    };
    let ball = pure(&space, ball, Some(1.0));
    let complement = CObject::complement(&ball).unwrap();
    unsupported(&complement, ball.serial());
    // The complement of a union of complements is an intersection.
    let parts = [first, wall(&space, 8.0)].map(|set| Arc::new(CObject::complement(&set).unwrap()));
    let neither = CObject::complement(&Arc::new(CObject::union(&parts).unwrap())).unwrap();
    certified(&neither, &[-3.0], &[3.0]);
}

#[test]
fn solids_are_shown_to_be_outside() {
    let space = slider(9.0, 9.0);
    let room = |body| {
        let objects = environment(&[(&body, Pose::identity())]).0;
        against(&space, &objects)
    };
    // In the cavity of a solid, and past a closed cube of the same size.
    let hollow = room(solid(&hollow_cube()));
    let beside = room(solid_one(&cube(2.0)));
    certified(&beside, &[3.0], &[9.0]);
    let outcome = |set: &CObject, from: f64, to: f64| made(set, &[from], &[to], 0.0).unwrap();
    certified(&hollow, &[-0.09], &[0.09]);
    let (answer, certificate) = outcome(&beside, 0.0, 0.1);
    assert!(answer.outcome == MotionOutcome::Hit && certificate.is_none());
    // The faces alone do not fill the cube.
    let surface = room(surface_one(&cube(2.0)));
    let (_, certificate) = outcome(&surface, 0.0, 0.1);
    let certificate = certificate.unwrap();
    certificate.verify(&surface, &[0.0], &[0.1], 0.0).unwrap();
    let error = certificate
        .verify(&beside, &[0.0], &[0.1], 0.0)
        .unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotProved);
}

/// A body held by the slider is an s-object to the other links, and like a link to the other objects.
#[test]
fn attached_objects_are_certified_where_they_are_held() {
    let links = [0.0, 5.0].map(|z| LinkDefinition {
        at: Pose::from_translation(Vec3::new(0.0, 0.0, z)),
        body: Some(cuboid([1.0; 3]).body),
        ..link(None, JointKind::Prismatic, Vec3::x())
    });
    let space = space(vec![robot(3, links.to_vec())]);
    let rod = cuboid([0.1, 0.1, 7.0]).body;
    let pillar = cuboid([1.0, 1.0, 30.0]).body;
    let aside = Pose::from_translation(Vec3::new(6.0, 0.0, 0.0));
    let (objects, ids) = environment(&[(&rod, Pose::identity()), (&pillar, aside)]);
    let attach = Change::Attach {
        id: ids[0],
        pose: Pose::from_translation(Vec3::new(0.0, 2.0, 0.0)),
        attachment: Attachment::new(&space, 0, &[]).unwrap(),
    };
    objects.apply(&[attach]).unwrap();
    let cobject = against(&space, &objects);
    certified(&cobject, &[0.0, 0.0], &[4.0, -4.0]);
    let (_, certificate) = made(&cobject, &[0.0, 0.0], &[4.0, -4.0], 0.0).unwrap();
    let items = certificate
        .unwrap()
        .entries()
        .iter()
        .map(|entry| entry.item)
        .max();
    // Both links and the rod against the pillar, the other link against the rod.
    assert_eq!(items.map(|last| last + 1 >= 4), Some(true));
    let moved = Change::Move {
        id: ids[1],
        pose: Pose::from_translation(Vec3::new(6.0, 0.01, 0.0)),
    };
    let (_, certificate) = made(&cobject, &[0.0, 0.0], &[4.0, -4.0], 0.0).unwrap();
    objects.apply(&[moved]).unwrap();
    let found = certificate
        .unwrap()
        .verify(&cobject, &[0.0, 0.0], &[4.0, -4.0], 0.0);
    assert_eq!(found.unwrap_err().kind, ErrorKind::NotProved);
}

/// Joints of the caller's move by speeds that are stated; support functions have no certificates.
#[test]
fn custom_joints_are_certified_and_support_functions_refused() {
    let links = vec![LinkDefinition {
        body: Some(cuboid([0.5; 3]).body),
        ..link(None, JointKind::Custom(Arc::new(Screw)), Vec3::z())
    }];
    let space = space(vec![robot(3, links)]);
    let wall = cuboid([1.0; 3]).body;
    let pose = Pose::from_translation(Vec3::new(1.3, 0.0, 0.0));
    let cobject = against(&space, &environment(&[(&wall, pose)]).0);
    assert!(certified(&cobject, &[0.0, 0.0], &[1.0, 1.0]) > 1);

    struct Ball;
    impl SupportFunction for Ball {
        fn support(&self, direction: &Vec3) -> Result<Vec3> {
            Ok(*direction)
        }
    }
    let ball = built(|b| b.add_support(Arc::new(Ball), 0).unwrap());
    let slider = slider(1.0, 1.0);
    let cobject = against(&slider, &environment(&[(&ball, pose)]).0);
    unsupported(&cobject, cobject.serial());
}

#[test]
fn links_among_themselves_are_certified_by_the_joints_between_them() {
    let rod = built(|b| {
        let middle = Pose::from_translation(Vec3::new(0.5, 0.0, 0.0));
        b.add_box(&middle, &Vec3::new(0.4, 0.05, 0.05), 0).unwrap();
    });
    let links = (0..3).map(|i: usize| LinkDefinition {
        at: Pose::from_translation(Vec3::new(f64::from(i > 0), 0.0, 0.0)),
        body: Some(rod.clone()),
        ..link(i.checked_sub(1), JointKind::Revolute, Vec3::z())
    });
    let space = space(vec![robot(3, links.collect())]);
    let options = InducedOptions::default();
    let itself = CObject::induced_links(space, &[[0, 2]], options).unwrap();
    // The first joint turns both alike: with the others at rest one entry shows it.
    assert_eq!(certified(&itself, &[0.0, 1.0, 0.5], &[3.0, 1.0, 0.5]), 1);
    certified(&itself, &[0.0, 1.0, 1.0], &[3.0, -1.0, -1.0]);
}

#[test]
fn a_limit_of_work_ends_the_making() {
    let space = slider(9.0, 9.0);
    let context = &mut QueryContext::new();
    let set = wall(&space, 8.0);
    for limit in 0..20 {
        context.set_limit(Some(limit));
        let options = MotionOptions::default();
        let made = context.motion_certificate(&set, &[-9.0], &[6.0], &options);
        match made.unwrap() {
            (answer, Some(certificate)) => {
                assert_eq!(answer.outcome, MotionOutcome::Free);
                certificate.verify(&set, &[-9.0], &[6.0], 0.0).unwrap();
            }
            (answer, None) => assert_eq!(answer.outcome, MotionOutcome::Undecided),
        }
    }
}

/// Parts of an intersection are proved free within the making: that work is limited too, and its end is no error.
#[test]
fn a_limit_of_work_ends_the_making_for_intersections() {
    let space = slider(9.0, 9.0);
    let both = CObject::intersection(&[wall(&space, -4.0), wall(&space, 4.0)]).unwrap();
    let options = MotionOptions::default();
    let context = &mut QueryContext::new();
    let [mut undecided, mut made] = [0; 2];
    for limit in 0..400 {
        context.set_limit(Some(limit));
        let is_free = context
            .motion(&both, &[-8.0], &[8.0], &options)
            .is_ok_and(|answer| answer.outcome == MotionOutcome::Free);
        if !is_free {
            continue;
        }
        let (_, certificate) = context
            .motion_certificate(&both, &[-8.0], &[8.0], &options)
            .unwrap();
        undecided += usize::from(certificate.is_none());
        made += usize::from(certificate.is_some());
    }
    assert!(undecided > 0 && made > 0, "{undecided} and {made}");
}

/// A ball that sinks past a floor from beside a wall: where it is as near the floor as rounding, the wall is a length away.
#[test]
fn the_part_of_an_intersection_that_is_farther_is_shown() {
    let ball = built(|b| b.add_sphere(&Vec3::zeros(), 1.0, 0).unwrap());
    let sinking = LinkDefinition {
        body: Some(ball),
        ..link(None, JointKind::Prismatic, Vec3::z())
    };
    let space = space(vec![robot(3, vec![sinking])]);
    let floor = PureShape::Floor {
        links: vec![0],
        normal: Vec3::z(),
        offset: 1.0,
    };
    let floor = pure(&space, floor, None);
    let block = cuboid([40.0; 3]).body;
    let at = |z: f64| Pose::from_translation(Vec3::new(0.0, 0.0, z));
    let above = Arc::new(against(&space, &environment(&[(&block, at(24.0))]).0));
    let both = CObject::intersection(&[floor.clone(), above]).unwrap();
    for i in 0..40 {
        let high = 0.5f64.powi(30 + i);
        certified(&both, &[3.5 + high], &[0.5 + high]);
    }
    // Where only a complement keeps the motion out, that is said.
    let around = Arc::new(against(&space, &environment(&[(&block, at(0.0))]).0));
    let without = CObject::difference(&floor, &around).unwrap();
    for i in 0..100 {
        let error = made(&without, &[2.1 + 0.037 * f64::from(i)], &[0.5], 0.0).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
    }
}

/// The same input is refused as of motions.
#[test]
fn motions_too_long_to_prove_are_refused() {
    let space = slider(1e50, 9.0);
    let set = wall(&space, 8.0);
    let error = made(&set, &[-0.9e50], &[0.9e50], 0.0).unwrap_err();
    let options = MotionOptions::default();
    let of_motion = QueryContext::new().motion(&set, &[-0.9e50], &[0.9e50], &options);
    assert_eq!(error.kind, of_motion.unwrap_err().kind);
}

/// Two links of a chain: their hulls overlap all the time, so groups of faces are parted.
#[test]
fn linked_rings_are_certified_face_by_face() {
    let ring = torus(1.0, 0.25, 12, 24);
    let upright = Pose {
        rotation: rotation_about(&Vec3::x(), std::f64::consts::FRAC_PI_2),
        translation: Vec3::new(1.0, 0.0, 0.0),
    };
    for make in [surface_one, solid_one] {
        let (fixed, moving) = (make(&ring), make(&ring));
        let space = space(vec![flying(&moving)]);
        let cobject = against(&space, &environment(&[(&fixed, upright)]).0);
        let q0 = [-0.2, 0.1, 0.0, 0.0, 0.0, 0.0, 1.0];
        let q1 = [0.2, -0.1, 0.1, 0.0, 0.28, 0.0, 0.96];
        let count = certified(&cobject, &q0, &q1);
        assert!((10..5000).contains(&count), "{count}");
        let (_, certificate) = made(&cobject, &q0, &q1, 0.05).unwrap();
        let certificate = certificate.unwrap();
        certificate.verify(&cobject, &q0, &q1, 0.05).unwrap();
        // All faces are in the entries of both sides.
        let all = moving.primitives().len();
        for side in 0..2 {
            let entries = certificate.entries().iter();
            let named = entries.flat_map(|entry| certificate.primitives(entry, side));
            assert_eq!(named.collect::<HashSet<_>>().len(), all);
        }
    }
}
