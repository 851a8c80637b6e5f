//! Spaces: ranges, steps and differences on their topology, sampling, wrapping, limits and the world box (§4.4).

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::robot::{Coordinate, JointKind, LinkDefinition, Robot};
use cstk::space::{Sampler, Space, WorldBox};

use helpers::random::Random;
use helpers::robots::{link, robot, space};

fn interval(lower: f64, upper: f64) -> Option<Coordinate> {
    Some(Coordinate::Interval { lower, upper })
}

fn of(kinds: &[JointKind]) -> Arc<Robot> {
    let links = kinds.iter().enumerate();
    let chain = links.map(|(i, kind)| link(i.checked_sub(1), kind.clone(), Vec3::z()));
    robot(3, chain.collect())
}

const EVERY: [JointKind; 6] = [
    JointKind::Revolute,
    JointKind::Prismatic,
    JointKind::Planar,
    JointKind::Spherical,
    JointKind::Free,
    JointKind::FreeEuler,
];

#[test]
fn the_joints_say_what_coordinates_are() {
    let space = space(vec![of(&EVERY)]);
    let (circle, line, part) = (Coordinate::Circle, Coordinate::LINE, Coordinate::Quaternion);
    let mut want = vec![circle, line, line, line, circle];
    want.extend([part; 4]);
    want.extend([line; 3]);
    want.extend([part; 4]);
    want.extend([line, line, line, circle, circle, circle]);
    assert_eq!(space.coordinates(), want);
    assert_eq!((space.nq(), space.nv()), (22, 20));
}

#[test]
fn ranges_that_do_not_fit_are_refused() {
    let world = WorldBox::unbounded();
    let mimic = |multiplier: f64| {
        let follower = LinkDefinition {
            coordinate: Some(0),
            multiplier,
            ..link(Some(0), JointKind::Revolute, Vec3::x())
        };
        robot(
            3,
            vec![link(None, JointKind::Revolute, Vec3::z()), follower],
        )
    };
    // A circle is one only if a whole turn brings every link back.
    for (multiplier, is_circle) in [(-2.0, true), (0.5, false), (1.7, false)] {
        let by_default = space(vec![mimic(multiplier)]).coordinates()[0];
        assert_eq!(by_default == Coordinate::Circle, is_circle);
        let asked = Space::new(vec![mimic(multiplier)], &[Some(Coordinate::Circle)], world);
        assert_eq!(asked.is_ok(), is_circle);
    }
    let quaternion = [Some(Coordinate::Quaternion), None, None, None];
    Space::new(vec![of(&[JointKind::Spherical])], &quaternion, world).unwrap();
    for (joint, ranges) in [
        (
            JointKind::Spherical,
            vec![None, interval(-1.0, 1.0), None, None],
        ),
        (JointKind::Revolute, vec![Some(Coordinate::Quaternion)]),
        (JointKind::Prismatic, vec![Some(Coordinate::Circle)]),
        (JointKind::Revolute, vec![interval(2.0, 1.0)]),
    ] {
        let error = Space::new(vec![of(&[joint])], &ranges, world).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(error.message.contains("range "), "{error}");
    }
    // Limits of the joint, unless the space says otherwise.
    let limited = LinkDefinition {
        limits: [-0.5, 0.25],
        ..link(None, JointKind::Revolute, Vec3::z())
    };
    let limited = robot(3, vec![limited]);
    assert_eq!(
        space(vec![limited.clone()]).coordinates()[0],
        interval(-0.5, 0.25).unwrap()
    );
    let wider = Space::new(vec![limited], &[Some(Coordinate::Circle)], world).unwrap();
    assert_eq!(wider.coordinates()[0], Coordinate::Circle);
}

#[test]
fn quaternions_off_their_norm_are_refused() {
    let space = space(vec![of(&[JointKind::Revolute, JointKind::Free])]);
    let mut q = space.neutral();
    space.check_configuration(&q).unwrap();
    q[7] = 1.0 + 9e-7;
    space.check_configuration(&q).unwrap();
    q[7] = 1.0 + 2e-6;
    let error = space.check_configuration(&q).unwrap_err();
    assert_eq!(error.kind, ErrorKind::NotARotation);
    assert!(error.message.contains("4 to 7"), "{error}");
}

fn largest_difference(a: &Pose, b: &Pose) -> f64 {
    (a.rotation - b.rotation)
        .amax()
        .max((a.translation - b.translation).amax())
}

/// Steps and differences undo each other, and the way between two configurations has constant speed: checked on the poses
/// of the links, since a quaternion and its negative are one rotation.
#[test]
fn steps_and_differences_undo_each_other() {
    let mut random = Random::new(3);
    let space = space(vec![of(&EVERY)]);
    for round in 0..2000 {
        let size = [1e-9, 1e-3, 1.0][round % 3];
        let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-2.0, 2.0)).collect();
        let q0 = space.step(&space.neutral(), &v);
        // Rotation vectors of up to sqrt(3) * 1.7 < pi.
        let w: Vec<f64> = (0..space.nv())
            .map(|_| random.within(-1.7, 1.7) * size)
            .collect();
        let q1 = space.step(&q0, &w);
        let back = space.difference(&q0, &q1);
        for (got, want) in back.iter().zip(&w) {
            assert!((got - want).abs() < 1e-14 * 20.0, "{got} {want}");
        }
        let reversed = space.difference(&q1, &q0);
        for (a, b) in reversed.iter().zip(&back) {
            assert!((a + b).abs() < 1e-13);
        }
        let length = space.distance(&q0, &q1, None);
        let straight = w.iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - straight).abs() < 1e-13);
        for t in [0.0, 0.3, 1.0] {
            let between = space.interpolate(&q0, &q1, t);
            assert!((space.distance(&q0, &between, None) - t * length).abs() < 1e-13);
            assert!((space.distance(&between, &q1, None) - (1.0 - t) * length).abs() < 1e-13);
        }
        let ends = [space.interpolate(&q0, &q1, 1.0), q1].map(|q| space.link_poses(&q).unwrap());
        for (a, b) in ends[0].iter().zip(&ends[1]) {
            assert!(largest_difference(a, b) < 1e-12);
        }
    }
}

/// A free joint's step at constant velocity in its own frame, against many small Euler steps of the pose.
#[test]
fn free_joints_follow_screws() {
    let space = space(vec![of(&[JointKind::Free])]);
    let mut random = Random::new(4);
    for _ in 0..20 {
        let v: Vec<f64> = (0..6).map(|_| random.within(-1.5, 1.5)).collect();
        let (linear, angular) = (Vec3::from_row_slice(&v[..3]), Vec3::from_row_slice(&v[3..]));
        let n = 20000;
        let mut pose = Pose::identity();
        let part = 1.0 / f64::from(n);
        for _ in 0..n {
            let half = pose.rotation + pose.rotation * angular.cross_matrix() * (0.5 * part);
            pose.translation += half * linear * part;
            let turn = nalgebra::Rotation3::from_scaled_axis(angular * part);
            pose.rotation *= turn.into_inner();
        }
        let reached = space.link_poses(&space.step(&space.neutral(), &v)).unwrap()[0];
        assert!(largest_difference(&reached, &pose) < 1e-7);
    }
}

#[test]
fn circles_go_the_shorter_way() {
    let space = space(vec![of(&[JointKind::Revolute])]);
    for (from, to, want) in [
        (0.1, TAU - 0.1, -0.2),
        (TAU - 0.1, 0.1, 0.2),
        (0.0, 3.0, 3.0),
        (0.0, PI, PI),
        (PI, 0.0, -PI),
        (-1.5 * PI, 1.5 * PI, PI),
        (1.0, 1.0 + 5.0 * TAU, 0.0),
        (-7.0, 7.0, 14.0 - 2.0 * TAU),
    ] {
        let way = space.difference(&[from], &[to])[0];
        assert!((way - want).abs() < 1e-14, "{from} to {to}: {way}");
        assert!((space.distance(&[from], &[to], Some(&[2.0])) - 2.0 * want.abs()).abs() < 1e-13);
        assert_eq!(space.displacement(&[from], &[to])[0], to - from);
    }
    assert!((space.interpolate(&[0.1], &[TAU - 0.1], 0.5)[0]).abs() < 1e-15);
}

/// A way that is proved one way is proved the other way too: quaternions and circles are turned back as they were turned, those half a turn
/// apart as well.
#[test]
fn the_way_back_is_the_same() {
    let mut random = Random::new(59);
    let circle = space(vec![of(&[JointKind::Revolute])]);
    for _ in 0..10_000 {
        let size = 10f64.powf(random.within(-3.0, 3.0));
        let from = random.within(-size, size);
        // Half turns, more and less by some ulps, and any angles.
        let to = match random.below(3) {
            0 => from + PI * (random.below(9) as f64 - 4.0),
            1 => (from + PI) * (1.0 + random.within(-1e-15, 1e-15)),
            _ => random.within(-size, size),
        };
        let [there, back] = [[from, to], [to, from]].map(|[a, b]| circle.difference(&[a], &[b])[0]);
        assert_eq!(there, -back, "{from} {to}");
        assert!(there.abs() <= PI);
    }
    let ball = space(vec![of(&[JointKind::Spherical])]);
    for _ in 0..10_000 {
        let axis = random.unit();
        let from = nalgebra::UnitQuaternion::from_matrix(&random.rotation());
        let turn = nalgebra::UnitQuaternion::from_scaled_axis(axis * PI);
        let [a, b] = [from, from * turn].map(|q| [q.w, q.i, q.j, q.k]);
        let [there, back] = [ball.difference(&a, &b), ball.difference(&b, &a)];
        let off = there.iter().zip(&back).map(|(x, y)| (x + y).abs());
        assert!(off.fold(0.0, f64::max) < 1e-7, "{there:?} {back:?}");
    }
}

#[test]
fn wrapping_and_clamping() {
    let robot = of(&[
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Spherical,
    ]);
    let ranges = [None, interval(-1.0, 2.0), None, None, None, None];
    let space = Space::new(vec![robot], &ranges, WorldBox::unbounded()).unwrap();
    let half = 0.5f64.sqrt();
    let q = [-0.25, 2.5, half, 0.0, 0.0, -half];
    let wrapped = space.wrap(&q);
    assert!((wrapped[0] - (TAU - 0.25)).abs() < 1e-15);
    assert_eq!(wrapped[1], 2.5);
    assert!((wrapped[2] + half).abs() < 1e-15 && (wrapped[5] - half).abs() < 1e-15);
    for angle in [-1e-20, TAU, -TAU, 1e300, 0.0] {
        let round = space.wrap(&[angle, 0.0, 0.0, 0.0, 0.0, 1.0])[0];
        assert!((0.0..TAU).contains(&round), "{angle}: {round}");
    }
    let clamped = space.clamp(&q);
    assert_eq!(clamped[..2], [-0.25, 2.0]);
    assert_eq!(space.beyond_limits(&q), Some(1));
    assert_eq!(space.beyond_limits(&clamped), None);
}

/// Of no box or an absurd one nothing could be shown.
#[test]
fn world_boxes_without_a_point_are_refused() {
    let infinite = f64::INFINITY;
    for (low, high) in [
        (infinite, infinite),
        (-infinite, -infinite),
        (1.0, 0.0),
        (-1e200, infinite),
        (0.0, 1e200),
        (f64::NAN, 1.0),
    ] {
        let world = WorldBox {
            low: [0.0, low, 0.0],
            high: [1.0, high, 1.0],
        };
        let error = Space::new(vec![of(&[JointKind::Prismatic])], &[], world).unwrap_err();
        assert!(error.message.contains("world box"), "{}", error.message);
    }
}

/// The world of §4.4's planar example, and what leaves it first.
#[test]
fn the_world_box_holds_the_links_origins() {
    let mut links: Vec<LinkDefinition> = (0..3usize)
        .map(|i| link(i.checked_sub(1), JointKind::Revolute, Vec3::z()))
        .collect();
    for (i, x) in [(1, 1.0), (2, 0.8)] {
        links[i].at = Pose::from_translation(Vec3::new(x, 0.0, 0.0));
    }
    let world = WorldBox {
        low: [0.0, 0.0, 0.0],
        high: [2.4, 2.4, 0.0],
    };
    let space = Space::new(vec![robot(2, links)], &[], world).unwrap();
    assert_eq!(space.dimension(), 2);
    assert!(space.contains(&[0.3, 0.4, 2.0]).unwrap());
    assert_eq!(space.beyond_world(&[-0.1, 0.0, 0.0]).unwrap(), Some(1));
    assert_eq!(space.beyond_world(&[0.1, -0.5, 0.0]).unwrap(), Some(2));
    assert!(!space.contains(&[1.0, 2.0, 0.0]).unwrap());
}

#[test]
fn samples_are_uniform_and_reproducible() {
    let robot = of(&[
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Spherical,
    ]);
    let ranges = [None, interval(-1.0, 3.0), None, None, None, None];
    let space = Space::new(vec![robot.clone()], &ranges, WorldBox::unbounded()).unwrap();
    let mut sampler = Sampler(42);
    let first = space.sample(&mut sampler).unwrap();
    assert_eq!(first, space.sample(&mut Sampler(42)).unwrap());
    let n = 20000;
    let (mut means, mut turned) = ([0.0; 2], nalgebra::Matrix3::zeros());
    let mut traces = 0.0;
    for _ in 0..n {
        let q = space.sample(&mut sampler).unwrap();
        space.check_configuration(&q).unwrap();
        assert!(space.contains(&q).unwrap() && (0.0..TAU).contains(&q[0]));
        means[0] += q[0] / f64::from(n);
        means[1] += q[1] / f64::from(n);
        let rotation = space.link_poses(&q).unwrap()[2].rotation
            * cstk::pose::rotation_about(&Vec3::z(), q[0]).transpose();
        turned += rotation / f64::from(n);
        traces += rotation.trace().powi(2) / f64::from(n);
    }
    assert!(
        (means[0] - PI).abs() < 0.05 && (means[1] - 1.0).abs() < 0.05,
        "{means:?}"
    );
    // Over all rotations the mean of every entry is 0, and that of the squared trace 1.
    assert!(turned.amax() < 0.02, "{turned}");
    assert!((traces - 1.0).abs() < 0.05, "{traces}");
    let unbounded = Space::new(vec![robot], &[], WorldBox::unbounded()).unwrap();
    let error = unbounded.sample(&mut sampler).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Unsupported);
    assert!(error.message.contains("coordinate 1"), "{error}");
}
