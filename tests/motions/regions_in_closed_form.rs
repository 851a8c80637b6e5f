//! Boxes of C-space whose class is known: sliders, planar arms, pure sets, floors, joints that share a coordinate; and what is no box.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use cstk::cobject::{CObject, InducedOptions, PureShape};
use cstk::error::ErrorKind;
use cstk::motion::{RegionOptions, RegionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{Coordinate, JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{Screw, against, against_with, environment, link, robot, space};
use helpers::shapes::cuboid;

use crate::regions::{check, random_box};

fn outcome(cobject: &CObject, low: &[f64], high: &[f64]) -> RegionOutcome {
    let options = RegionOptions::default();
    let answer = QueryContext::new().classify_region(cobject, low, high, &options);
    answer.unwrap().outcome
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

/// A cube that meets a wall from -1 to 1: closed forms, and sides a hair's breadth away.
#[test]
fn a_slider_is_free_before_a_wall_and_inside_in_it() {
    let space = slider();
    let wall = cuboid([1.0; 3]).body;
    let set = against(&space, &environment(&[(&wall, Pose::identity())]).0);
    for (low, high, wanted) in [
        (-5.0, -1.0 - 1e-9, RegionOutcome::Free),
        (1.0 + 1e-9, 50.0, RegionOutcome::Free),
        (-5.0, -0.999, RegionOutcome::Mixed),
        (-0.9, 0.9, RegionOutcome::Inside),
        (-1.0 + 1e-6, 1.0 - 1e-6, RegionOutcome::Inside),
        (0.5, 1.001, RegionOutcome::Mixed),
        (-1e3, 1e3, RegionOutcome::Mixed),
        (0.0, 0.0, RegionOutcome::Inside),
        (2.0, 2.0, RegionOutcome::Free),
    ] {
        assert_eq!(outcome(&set, &[low], &[high]), wanted, "{low} to {high}");
    }
    let outside = CObject::complement(&Arc::new(set)).unwrap();
    assert_eq!(outcome(&outside, &[-0.9], &[0.9]), RegionOutcome::Free);
    assert_eq!(outcome(&outside, &[1.1], &[9.0]), RegionOutcome::Inside);
}

/// A configuration in contact is not inside, nor outside its complement.
#[test]
fn contact_is_neither_inside_nor_outside() {
    let space = slider();
    let wall = cuboid([1.0; 3]).body;
    let options = InducedOptions {
        contact_epsilon: 0.5,
        ..InducedOptions::default()
    };
    let set = against_with(
        &space,
        &environment(&[(&wall, Pose::identity())]).0,
        options,
    );
    assert_eq!(outcome(&set, &[1.1], &[1.4]), RegionOutcome::Free);
    assert_eq!(outcome(&set, &[-0.9], &[1.4]), RegionOutcome::Mixed);
    let outside = CObject::complement(&Arc::new(set)).unwrap();
    assert_eq!(outcome(&outside, &[1.1], &[1.4]), RegionOutcome::Free);
    assert_eq!(outcome(&outside, &[1.4], &[2.0]), RegionOutcome::Mixed);
    assert_eq!(outcome(&outside, &[1.6], &[2.0]), RegionOutcome::Inside);
}

/// Two rods of length 1 in the plane z = 0, and a wall from x = 1.5 on: the tip's x is cos a + cos (a + b).
#[test]
fn a_planar_arm_is_free_where_its_reach_is_short() {
    let rod = cuboid([1.0, 1e-6, 1e-6]).body;
    let links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        LinkDefinition {
            at: Pose::from_translation(Vec3::new(0.5, 0.0, 0.0)),
            body: Some(rod.clone()),
            ..link(Some(0), JointKind::Fixed, Vec3::z())
        },
        LinkDefinition {
            at: Pose::from_translation(Vec3::new(1.0, 0.0, 0.0)),
            ..link(Some(0), JointKind::Revolute, Vec3::z())
        },
        LinkDefinition {
            at: Pose::from_translation(Vec3::new(0.5, 0.0, 0.0)),
            body: Some(rod),
            ..link(Some(2), JointKind::Fixed, Vec3::z())
        },
    ];
    let space = space(vec![robot(3, links)]);
    let wall = cuboid([1.0, 10.0, 1.0]).body;
    let pose = Pose::from_translation(Vec3::new(2.0, 0.0, 0.0));
    let set = against(&space, &environment(&[(&wall, pose)]).0);
    // The largest x over the box [a - h, a + h] x [b - h, b + h].
    let mut random = Random::new(307);
    let mut outcomes = [0usize; 4];
    for _ in 0..300 {
        let [a, b] = [(); 2].map(|()| random.within(-PI, PI));
        let h = random.within(0.0, 0.4);
        let cosine = |from: f64, to: f64| {
            let has_top = (from / TAU).ceil() <= to / TAU;
            if has_top {
                1.0
            } else {
                from.cos().max(to.cos())
            }
        };
        // Of a sum of cosines a bound, exact where both angles grow together.
        let highest = cosine(a - h, a + h) + cosine(a + b - 2.0 * h, a + b + 2.0 * h);
        let found = outcome(&set, &[a - h, b - h], &[a + h, b + h]);
        outcomes[found as usize] += 1;
        if highest < 1.49 {
            assert_eq!(found, RegionOutcome::Free, "{a} {b} {h}");
        }
        let middle = a.cos() + (a + b).cos();
        if middle > 1.51 {
            assert_ne!(found, RegionOutcome::Free, "{a} {b} {h}");
        }
    }
    println!("free, inside, mixed, undecided: {outcomes:?}");
    assert!(outcomes[0] > 100 && outcomes[2] > 20, "{outcomes:?}");
}

/// Pure sets alone, where boxes have closed forms; on a circle a box runs upwards over the place where angles wrap.
#[test]
fn boxes_meet_pure_sets_when_they_should() {
    let space = slider();
    let ball = PureShape::Ball {
        center: vec![3.0],
        radius: 1.0,
    };
    let ball = pure(&space, ball, None);
    assert_eq!(outcome(&ball, &[0.0], &[1.99]), RegionOutcome::Free);
    assert_eq!(outcome(&ball, &[2.01], &[3.99]), RegionOutcome::Inside);
    assert_eq!(outcome(&ball, &[1.9], &[2.1]), RegionOutcome::Mixed);

    let turning = vec![link(None, JointKind::Revolute, Vec3::z())];
    let circle = helpers::robots::space(vec![robot(3, turning)]);
    assert_eq!(circle.coordinates(), [Coordinate::Circle]);
    let arc = PureShape::Box {
        low: vec![3.0],
        high: vec![3.5],
    };
    let arc = pure(&circle, arc, None);
    assert_eq!(
        outcome(&arc, &[3.1 - TAU], &[3.4 - TAU]),
        RegionOutcome::Inside
    );
    assert_eq!(outcome(&arc, &[3.6], &[2.9 + TAU]), RegionOutcome::Free);
    assert_eq!(outcome(&arc, &[-3.0], &[3.2]), RegionOutcome::Mixed);
}

#[test]
fn boxes_that_are_none_are_refused() {
    let context = &mut QueryContext::new();
    let space = slider();
    let set = pure(
        &space,
        PureShape::HalfSpace {
            normal: vec![1.0],
            offset: 0.0,
            is_open: false,
        },
        None,
    );
    let options = RegionOptions::default();
    let mut refused = |set: &CObject, low: &[f64], high: &[f64], kind: ErrorKind, culprit: &str| {
        let error = context
            .classify_region(set, low, high, &options)
            .unwrap_err();
        assert_eq!(error.kind, kind, "{error:?}");
        assert!(error.message.contains(culprit), "{error:?}");
    };
    refused(
        &set,
        &[1.0],
        &[0.0],
        ErrorKind::InvalidArgument,
        "coordinate 0",
    );
    refused(&set, &[f64::NAN], &[0.0], ErrorKind::NotFinite, "low");
    refused(&set, &[0.0], &[f64::INFINITY], ErrorKind::NotFinite, "high");
    refused(&set, &[0.0, 0.0], &[1.0], ErrorKind::WrongSize, "low");
    refused(&set, &[0.0], &[], ErrorKind::WrongSize, "high");
    let cube = cuboid([1.0; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Free, Vec3::x())
    }];
    let free = helpers::robots::space(vec![robot(3, links)]);
    let far = Pose::from_translation(Vec3::new(9.0, 0.0, 0.0));
    let among = against(&free, &environment(&[(&cube, far)]).0);
    let low = free.neutral();
    let turned = free.step(&low, &[0.0, 0.0, 0.0, 0.1, 0.0, 0.0]);
    refused(
        &among,
        &low,
        &turned,
        ErrorKind::Unsupported,
        "coordinate 3",
    );
    let shifted = free.step(&low, &[1.0; 6]);
    let mut high = low.clone();
    high[..3].copy_from_slice(&[1.0, 1.0, 1.0]);
    assert_ne!(shifted, high);
    assert_eq!(outcome(&among, &low, &high), RegionOutcome::Free);
    refused(
        &among,
        &high,
        &low,
        ErrorKind::InvalidArgument,
        "coordinate 0",
    );
}

/// A custom joint moves no faster than it says: its boxes are proved by that alone.
#[test]
fn boxes_of_custom_joints_rest_on_their_speeds() {
    let cube = cuboid([0.5; 3]).body;
    let links = vec![LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Custom(Arc::new(Screw)), Vec3::x())
    }];
    let space = space(vec![robot(3, links)]);
    let objects: Vec<Pose> = (0..4)
        .map(|i| Pose::from_translation(Vec3::new(1.2, 0.3 * f64::from(i), 0.5)))
        .collect();
    let objects: Vec<_> = objects.iter().map(|pose| (&cube, *pose)).collect();
    let set = against(&space, &environment(&objects).0);
    let mut random = Random::new(311);
    let context = &mut QueryContext::new();
    let mut free = 0;
    for _ in 0..200 {
        let [low, high] = &random_box(&mut random, &space);
        let options = RegionOptions { max_boxes: 400 };
        let answer = context.classify_region(&set, low, high, &options).unwrap();
        free += usize::from(answer.outcome == RegionOutcome::Free);
        check(&mut random, context, &set, [low, high], &answer, 100);
    }
    assert!(free > 20, "{free}");
}

/// Angles of a thousand million radians are rounded to 1e-7: what is called free is so for the angles that queries compute.
#[test]
fn boxes_of_large_angles_are_proved_with_their_rounding() {
    let mut random = Random::new(313);
    let arm = cuboid([2.0, 0.1, 0.1]).body;
    let links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        LinkDefinition {
            at: Pose::from_translation(Vec3::new(1.0, 0.0, 0.0)),
            body: Some(arm),
            ..link(Some(0), JointKind::Fixed, Vec3::z())
        },
    ];
    let plate = cuboid([0.4, 0.001, 0.4]).body;
    let pose = Pose::from_translation(Vec3::new(1.9, 0.7, 0.0));
    let space = space(vec![robot(3, links)]);
    let set = against(&space, &environment(&[(&plate, pose)]).0);
    let context = &mut QueryContext::new();
    let mut free = 0;
    for _ in 0..200 {
        let low = [random.within(-1e9, 1e9).round() * TAU];
        let high = [low[0] + random.within(0.0, 0.5)];
        let options = RegionOptions::default();
        let answer = context
            .classify_region(&set, &low, &high, &options)
            .unwrap();
        free += usize::from(answer.outcome == RegionOutcome::Free);
        check(&mut random, context, &set, [&low, &high], &answer, 100);
    }
    assert!(free > 20, "{free}");
}

/// A base that drives a hair's breadth above a floor is free in one look, wherever it drives; one that may tip is not.
#[test]
fn a_base_over_a_floor_is_proved_by_its_motion_along_the_normal() {
    let cube = cuboid([1.0; 3]).body;
    let floor = |space: &Arc<Space>| {
        let floor = PureShape::Floor {
            links: vec![space.link_count() - 1],
            normal: Vec3::z(),
            offset: -0.5 - 1e-6,
        };
        pure(space, floor, None)
    };
    let base = LinkDefinition {
        body: Some(cube.clone()),
        ..link(None, JointKind::Planar, Vec3::z())
    };
    let base = floor(&space(vec![robot(3, vec![base])]));
    let options = RegionOptions { max_boxes: 1 };
    let look = |set: &CObject, low: &[f64], high: &[f64]| {
        let answer = QueryContext::new().classify_region(set, low, high, &options);
        answer.unwrap().outcome
    };
    let found = look(&base, &[-50.0, -30.0, -2.0], &[70.0, 90.0, 2.0]);
    assert_eq!(found, RegionOutcome::Free);
    let tipping = vec![LinkDefinition {
        body: Some(cube),
        ..link(None, JointKind::Revolute, Vec3::x())
    }];
    let tipping = floor(&space(vec![robot(3, tipping)]));
    assert_eq!(look(&tipping, &[-1e-7], &[1e-7]), RegionOutcome::Free);
    assert_eq!(look(&tipping, &[-1e-5], &[1e-5]), RegionOutcome::Mixed);
}

/// Joints that follow another joint's coordinate move with it: fingers that open together, and a link that turns back.
#[test]
fn joints_that_share_a_coordinate_move_together() {
    let mut random = Random::new(331);
    let context = &mut QueryContext::new();
    let mut outcomes = [0usize; 4];
    for _ in 0..60 {
        let mut bar = |parent: Option<usize>, coordinate, multiplier| LinkDefinition {
            at: random.pose(0.5),
            body: Some(cuboid([0.6, 0.2, 0.1]).body),
            coordinate,
            multiplier,
            ..link(parent, JointKind::Revolute, random.unit())
        };
        let links = vec![
            bar(None, None, 1.0),
            bar(Some(0), None, 0.5),
            bar(Some(0), Some(1), -1.5),
            bar(Some(2), Some(0), -1.0),
        ];
        let space = space(vec![robot(3, links)]);
        assert_eq!(space.nq(), 2);
        let objects: Vec<_> = (0..5)
            .map(|_| (cuboid([0.4; 3]).body, random.pose(1.5)))
            .collect();
        let objects: Vec<_> = objects.iter().map(|(body, pose)| (body, *pose)).collect();
        let among = against(&space, &environment(&objects).0);
        let itself = CObject::induced_links(
            space.clone(),
            &[[0, 3], [1, 2], [1, 3]],
            InducedOptions::default(),
        );
        let set = CObject::union(&[Arc::new(among), Arc::new(itself.unwrap())]).unwrap();
        for _ in 0..10 {
            let [low, high] = &random_box(&mut random, &space);
            let options = RegionOptions { max_boxes: 400 };
            let answer = context.classify_region(&set, low, high, &options).unwrap();
            outcomes[answer.outcome as usize] += 1;
            check(&mut random, context, &set, [low, high], &answer, 100);
        }
    }
    println!("free, inside, mixed, undecided: {outcomes:?}");
    assert!(outcomes[0] > 60, "{outcomes:?}");
}

/// A box wider than single precision holds is not free of what it contains.
#[test]
fn no_box_is_too_wide_to_meet_something() {
    let space = slider();
    let wall = cuboid([1.0; 3]).body;
    let places = [5.0, 9.0, -7.0].map(|x| Pose::from_translation(Vec3::new(x, 0.0, 0.0)));
    for count in 1..=places.len() {
        let objects: Vec<_> = places[..count].iter().map(|at| (&wall, *at)).collect();
        let set = against(&space, &environment(&objects).0);
        for exponent in 36..=48 {
            let far = 10f64.powi(exponent);
            let found = outcome(&set, &[-far], &[far]);
            assert_ne!(found, RegionOutcome::Free, "{count} {far:e}");
        }
    }
}
