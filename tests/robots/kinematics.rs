//! Frames, Euler angles, forward kinematics and Jacobians (§4.1–4.3): the report's worked examples with its numbers, its
//! errata, and central differences for every joint.

use std::sync::Arc;

use cstk::error::{ErrorKind, Result};
use cstk::euler::{
    AngularFrame, basic_to_euler_jacobian, euler_rates, euler_rates_inverse,
    euler_to_basic_jacobian, euler_to_rotation, rotation_to_euler,
};
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::robot::{CustomJoint, JointKind, LinkDefinition, Robot, RobotState, Speeds, Twist};

use helpers::random::Random;
use helpers::robots::{Screw, link, robot, space};

/// Random angles with pitch away from the singularity.
fn angles(random: &mut Random) -> [f64; 3] {
    [
        random.within(-3.0, 3.0),
        random.within(-1.4, 1.4),
        random.within(-3.0, 3.0),
    ]
}

#[test]
fn euler_angles_multiply_out_equations_3_to_5() {
    let mut random = Random::new(1);
    for _ in 0..200 {
        let [yaw, pitch, roll] = angles(&mut random);
        // The report's matrices take inertial to turned components, so that (6) is their product transposed.
        let (s, c) = yaw.sin_cos();
        let m3 = Mat3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
        let (s, c) = pitch.sin_cos();
        let m4 = Mat3::new(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
        let (s, c) = roll.sin_cos();
        let m5 = Mat3::new(1.0, 0.0, 0.0, 0.0, c, s, 0.0, -s, c);
        let product = (m5 * m4 * m3).transpose();
        let rotation = euler_to_rotation([yaw, pitch, roll]);
        assert!((product - rotation).amax() < 1e-15);
        for (got, want) in rotation_to_euler(&rotation).iter().zip([yaw, pitch, roll]) {
            assert!((got - want).abs() < 1e-13);
        }
    }
}

/// E8: with one-argument arctangents (7) gives an angle of the wrong half circle wherever a cosine is negative.
#[test]
fn equation_7_needs_arctangents_of_two_arguments() {
    let angles = [2.5, 0.3, -2.8];
    let t = euler_to_rotation(angles);
    let printed = -(t[(2, 0)] / t[(0, 0)]).atan();
    assert!((printed - angles[0]).abs() > 3.0);
    assert!((rotation_to_euler(&t)[0] - angles[0]).abs() < 1e-15);
}

#[test]
fn at_the_singularity_the_angles_give_the_same_rotation() {
    for pitch in [std::f64::consts::FRAC_PI_2, -std::f64::consts::FRAC_PI_2] {
        let rotation = euler_to_rotation([0.4, pitch, 0.9]);
        let [yaw, found, roll] = rotation_to_euler(&rotation);
        assert_eq!(roll, 0.0);
        assert!((euler_to_rotation([yaw, found, roll]) - rotation).amax() < 1e-12);
        for frame in [AngularFrame::Body, AngularFrame::World] {
            let error = euler_rates_inverse([0.4, pitch, 0.9], frame).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Degenerate);
        }
    }
}

/// Equation (31) from the derivative of (6): R^T dR is the cross matrix of the angular velocity in the body's frame, dR R^T
/// of that in the inertial frame (E4).
#[test]
fn euler_rates_are_the_derivative_of_equation_6() {
    let mut random = Random::new(2);
    for _ in 0..200 {
        let at = angles(&mut random);
        let r = euler_to_rotation(at);
        for column in 0..3 {
            let h = 1e-6;
            let moved = |by: f64| {
                let mut at = at;
                at[column] += by;
                euler_to_rotation(at)
            };
            let derivative = (moved(h) - moved(-h)) / (2.0 * h);
            for (frame, cross) in [
                (AngularFrame::Body, r.transpose() * derivative),
                (AngularFrame::World, derivative * r.transpose()),
            ] {
                let want = Vec3::new(cross[(2, 1)], cross[(0, 2)], cross[(1, 0)]);
                let got = euler_rates(at, frame).column(column).into_owned();
                assert!((got - want).amax() < 1e-9, "{frame:?} {column}");
                let product = euler_rates(at, frame) * euler_rates_inverse(at, frame).unwrap();
                assert!((product - Mat3::identity()).amax() < 1e-13);
            }
        }
        // The printed matrix is that of the body's frame.
        let (st, ct) = at[1].sin_cos();
        let (sf, cf) = at[2].sin_cos();
        let printed = Mat3::new(st, 0.0, 1.0, cf * ct, sf, 0.0, -sf * ct, cf, 0.0);
        assert!((euler_rates(at, AngularFrame::Body) - printed).amax() < 1e-15);
    }
}

/// Equations (8)–(11), with the sub- and superscripts the right way round (E7): the inverse of a pose undoes it.
#[test]
fn homogeneous_transforms_and_their_inverse() {
    let mut random = Random::new(3);
    for _ in 0..100 {
        let pose = random.pose(2.0);
        let x = random.point(3.0);
        let mut matrix = nalgebra::Matrix4::identity();
        matrix
            .fixed_view_mut::<3, 3>(0, 0)
            .copy_from(&pose.rotation);
        matrix
            .fixed_view_mut::<3, 1>(0, 3)
            .copy_from(&pose.translation);
        let homogeneous = matrix * x.push(1.0);
        assert!((homogeneous.xyz() - pose.transform_point(&x)).amax() < 1e-15);
        let back = matrix.try_inverse().unwrap() * homogeneous;
        assert!((back.xyz() - x).amax() < 1e-14);
        let again = pose.inverse().transform_point(&pose.transform_point(&x));
        assert!((again - x).amax() < 1e-14);
    }
}

/// The two-link arm of Figures 13 and 15: equations (15)–(18) and (34)–(37).
#[test]
fn the_reports_two_link_arm() {
    let (x0, x1) = (2.0, 1.5);
    let mut links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        link(Some(0), JointKind::Revolute, Vec3::z()),
    ];
    links[1].at = Pose::from_translation(Vec3::new(x0, 0.0, 0.0));
    let robot = robot(3, links);
    for q in [[0.4, -1.1], [0.0, 0.0], [3.0, 2.9]] {
        let poses = robot.link_poses(&q).unwrap();
        let (t0, t01) = (q[0], q[0] + q[1]);
        // (34)
        let turned = rotation_about(&Vec3::z(), t01);
        assert!((poses[1].rotation - turned).amax() < 1e-15);
        // (17); E6: the offset that (14) ends with is given in the last frame.
        let tip = poses[1].transform_point(&Vec3::new(x1, 0.0, 0.0));
        // (35), (36): from the frames' origins to the end, in inertial coordinates.
        let p0 = Vec3::new(
            x0 * t0.cos() + x1 * t01.cos(),
            x0 * t0.sin() + x1 * t01.sin(),
            0.0,
        );
        let p1 = Vec3::new(x1 * t01.cos(), x1 * t01.sin(), 0.0);
        assert!((tip - poses[0].translation - p0).amax() < 1e-15);
        assert!((tip - poses[1].translation - p1).amax() < 1e-15);
        // (37), its columns from joint 0 on (E5).
        let posture = RobotState {
            q: &q,
            poses: &poses,
        };
        let jacobian = robot.jacobian(posture, 1, &tip).unwrap();
        let expected = [
            [-(x0 * t0.sin() + x1 * t01.sin()), -x1 * t01.sin()],
            [x0 * t0.cos() + x1 * t01.cos(), x1 * t01.cos()],
            [0.0, 0.0],
            [0.0, 0.0],
            [0.0, 0.0],
            [1.0, 1.0],
        ];
        for (row, want) in expected.iter().enumerate() {
            for (column, want) in want.iter().enumerate() {
                assert!((jacobian[row * 2 + column] - want).abs() < 1e-15);
            }
        }
    }
}

/// Appendix A's ensemble. E11: the last list has seven numbers in print, of which the first six count; and the "rotated 90
/// degrees" of the second is a roll, which takes its Y to the arm's Z.
#[test]
fn the_ensemble_of_appendix_a() {
    let half = std::f64::consts::FRAC_PI_2;
    let placements = [
        [0.0; 6],
        [0.0, 2.875, 0.0, 0.0, 0.0, half],
        [6.5, 0.0, -2.125, 0.0, 0.0, 0.0],
    ];
    let links = placements
        .iter()
        .enumerate()
        .map(|(i, placement)| LinkDefinition {
            at: Pose::from_euler(placement),
            ..link(i.checked_sub(1), JointKind::Revolute, Vec3::z())
        });
    let robot = robot(3, links.collect());
    let poses = robot.link_poses(&[0.0; 3]).unwrap();
    assert!((poses[1].rotation * Vec3::y() - Vec3::z()).amax() < 1e-15);
    assert!((poses[2].translation - Vec3::new(6.5, 2.875 + 2.125, 0.0)).amax() < 1e-14);
}

/// Every kind of joint, in one tree, at random frames; one mimics another.
fn every_joint(random: &mut Random) -> Arc<Robot> {
    let kinds = [
        JointKind::Free,
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Planar,
        JointKind::Spherical,
        JointKind::Fixed,
        JointKind::FreeEuler,
        JointKind::Custom(Arc::new(Screw)),
        JointKind::Revolute,
    ];
    let parents = [
        None,
        Some(0),
        Some(1),
        Some(1),
        Some(3),
        Some(4),
        Some(2),
        Some(5),
        Some(7),
    ];
    let links = kinds
        .into_iter()
        .zip(parents)
        .enumerate()
        .map(|(i, (kind, parent))| {
            let mut definition = LinkDefinition {
                at: random.pose(1.0),
                ..link(parent, kind, random.point(1.0))
            };
            if i == 8 {
                // Follows the first revolute joint, whose coordinate comes after the seven of the free joint.
                definition.coordinate = Some(7);
                definition.multiplier = -1.7;
                definition.offset = 0.3;
            }
            definition
        });
    robot(3, links.collect())
}

#[test]
fn jacobians_agree_with_differences_for_every_joint() {
    let mut random = Random::new(5);
    let mut worst = 0.0f64;
    for _ in 0..60 {
        let robot = every_joint(&mut random);
        let space = space(vec![robot.clone()]);
        assert_eq!(
            (space.nq(), space.nv()),
            (7 + 1 + 1 + 3 + 4 + 6 + 2, 6 + 1 + 1 + 3 + 3 + 6 + 2)
        );
        let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.0, 1.0)).collect();
        let q = space.step(&space.neutral(), &v);
        space.check_configuration(&q).unwrap();
        let poses = space.link_poses(&q).unwrap();
        let posture = RobotState {
            q: &q,
            poses: &poses,
        };
        for (link, pose) in poses.iter().enumerate() {
            let local = random.point(1.0);
            let point = pose.transform_point(&local);
            let jacobian = space.jacobian(posture, link, &point).unwrap();
            let h = 1e-5;
            for k in 0..space.nv() {
                let moved = |by: f64| {
                    let mut step = vec![0.0; space.nv()];
                    step[k] = by;
                    space.link_poses(&space.step(&q, &step)).unwrap()[link]
                };
                let (back, forth) = (moved(-h), moved(h));
                let linear =
                    (forth.transform_point(&local) - back.transform_point(&local)) / (2.0 * h);
                let cross =
                    (forth.rotation - back.rotation) / (2.0 * h) * pose.rotation.transpose();
                let angular = Vec3::new(cross[(2, 1)], cross[(0, 2)], cross[(1, 0)]);
                for row in 0..3 {
                    let at = |row: usize| jacobian[row * space.nv() + k];
                    worst = worst.max((at(row) - linear[row]).abs());
                    worst = worst.max((at(row + 3) - angular[row]).abs());
                }
            }
        }
    }
    println!("largest difference of a Jacobian's entry: {worst:.1e}");
    assert!(worst < 1e-8, "{worst}");
}

/// Equation (22)–(23): the Jacobian of x, y, z, yaw, pitch, roll, from the basic one and back (E4).
#[test]
fn the_euler_jacobian_is_the_derivative_of_the_placement() {
    let mut random = Random::new(6);
    let mut compared = 0;
    for _ in 0..60 {
        let robot = every_joint(&mut random);
        let space = space(vec![robot]);
        let v: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.0, 1.0)).collect();
        let q = space.step(&space.neutral(), &v);
        let poses = space.link_poses(&q).unwrap();
        let link = 8;
        let at = poses[link].to_euler();
        if at[4].abs() > 1.2 || at[3].abs() > 3.1 || at[5].abs() > 3.1 {
            continue;
        }
        compared += 1;
        let basic = space
            .jacobian(
                RobotState {
                    q: &q,
                    poses: &poses,
                },
                link,
                &poses[link].translation,
            )
            .unwrap();
        let angles = [at[3], at[4], at[5]];
        let mut rates = basic.clone();
        basic_to_euler_jacobian(&mut rates, angles).unwrap();
        let h = 1e-5;
        for k in 0..space.nv() {
            let moved = |by: f64| {
                let mut step = vec![0.0; space.nv()];
                step[k] = by;
                space.link_poses(&space.step(&q, &step)).unwrap()[link].to_euler()
            };
            let (back, forth) = (moved(-h), moved(h));
            for row in 0..6 {
                let quotient = (forth[row] - back[row]) / (2.0 * h);
                let got = rates[row * space.nv() + k];
                assert!((got - quotient).abs() < 1e-7 * got.abs().max(1.0));
            }
        }
        euler_to_basic_jacobian(&mut rates, angles);
        for (again, first) in rates.iter().zip(&basic) {
            assert!((again - first).abs() < 1e-13 * first.abs().max(1.0));
        }
    }
    assert!(compared > 20);
}

#[test]
fn faulty_maps_are_named() {
    struct Faulty(usize);
    impl CustomJoint for Faulty {
        fn coordinates(&self) -> usize {
            1
        }
        fn pose(&self, _: &[f64]) -> Result<Pose> {
            let mut pose = Pose::identity();
            match self.0 {
                0 => pose.translation.x = f64::NAN,
                1 => pose.rotation[(0, 0)] = 2.0,
                _ => {}
            }
            Ok(pose)
        }
        fn jacobian(&self, _: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
            let mut twist = Twist {
                linear: Vec3::zeros(),
                angular: Vec3::zeros(),
            };
            twist.linear.x = f64::INFINITY;
            columns.extend(std::iter::repeat_n(twist, if self.0 == 2 { 3 } else { 1 }));
            Ok(())
        }
        fn speeds(&self) -> Option<Speeds> {
            None
        }
    }
    for (fault, kind) in [
        (0, ErrorKind::NotFinite),
        (1, ErrorKind::NotARotation),
        (2, ErrorKind::WrongSize),
        (3, ErrorKind::NotFinite),
    ] {
        let definition = LinkDefinition {
            name: "wheel".into(),
            ..link(None, JointKind::Custom(Arc::new(Faulty(fault))), Vec3::z())
        };
        let robot = robot(3, vec![definition]);
        let error = match robot.link_poses(&[0.0]) {
            Err(error) => error,
            Ok(poses) => robot
                .jacobian(
                    RobotState {
                        q: &[0.0],
                        poses: &poses,
                    },
                    0,
                    &Vec3::zeros(),
                )
                .unwrap_err(),
        };
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.message.contains("wheel"), "{error}");
    }
}
