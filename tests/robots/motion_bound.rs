//! Motion bounds: no point of a link moves farther than they say, whatever joints carry it.

use std::sync::Arc;

use cstk::body::Body;
use cstk::pose::Vec3;
use cstk::robot::{JointKind, LinkDefinition, RobotState, Velocity};

use helpers::random::Random;
use helpers::robots::{Screw, link, robot, space};
use helpers::shapes::hull;

const KINDS: [fn() -> JointKind; 8] = [
    || JointKind::Fixed,
    || JointKind::Revolute,
    || JointKind::Prismatic,
    || JointKind::Planar,
    || JointKind::Spherical,
    || JointKind::Free,
    || JointKind::FreeEuler,
    || JointKind::Custom(Arc::new(Screw)),
];

#[test]
fn no_point_moves_farther_than_the_bound() {
    let mut random = Random::new(31);
    // How much of the bound is used at most: 1 would be tight.
    let mut used = 0.0f64;
    for round in 0..600 {
        let length = 1 + random.below(4);
        let mut shapes = Vec::new();
        let links = (0..length).map(|i| {
            let kind = KINDS[random.below(KINDS.len())]();
            let shape = hull(&random.points(6, 0.5));
            let mut definition = LinkDefinition {
                at: random.pose(1.0),
                body: Some(shape.body.clone()),
                ..link(i.checked_sub(1), kind, random.point(1.0))
            };
            if definition.kind.has_axis() {
                definition.multiplier = random.within(-2.0, 2.0);
                definition.offset = random.within(-1.0, 1.0);
            }
            shapes.push(shape);
            definition
        });
        let links: Vec<LinkDefinition> = links.collect();
        let space = space(vec![robot(3, links)]);
        let size = [0.01, 0.3, 2.0][round % 3];
        let start: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.5, 1.5)).collect();
        let q = space.step(&space.neutral(), &start);
        let v: Vec<f64> = (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect();
        let before = space.link_poses(&q).unwrap();
        for (i, shape) in shapes.iter().enumerate() {
            let bound = space.motion_bound(i, &q, &v);
            let body: &Body = &shape.body;
            assert!(body.radius() > 0.0);
            for k in 1..=20 {
                let part: Vec<f64> = v.iter().map(|x| x * f64::from(k) / 20.0).collect();
                let after = space.link_poses(&space.step(&q, &part)).unwrap();
                for p in &shape.parts[0] {
                    let way = after[i].transform_point(p) - before[i].transform_point(p);
                    let share = f64::from(k) / 20.0;
                    assert!(
                        way.norm() <= bound * share + 1e-12,
                        "{} > {bound}",
                        way.norm()
                    );
                    if bound > 0.0 {
                        used = used.max(way.norm() / (bound * share));
                    }
                }
            }
        }
    }
    println!("at most {used:.3} of a bound was used");
    assert!(used > 0.5);
}

/// Of things fixed to two links, wherever the links hang, and to links of two robots.
#[test]
fn no_distance_changes_by_more_than_the_relative_bound() {
    let mut random = Random::new(32);
    let mut used = 0.0f64;
    for round in 0..400 {
        let robots = (0..2).map(|_| {
            let links = (0..4).map(|i| {
                let kind = KINDS[random.below(KINDS.len())]();
                let parent = (i > 0).then(|| random.below(i));
                LinkDefinition {
                    at: random.pose(1.0),
                    ..link(parent, kind, random.point(1.0))
                }
            });
            robot(3, links.collect())
        });
        let space = space(robots.collect());
        let size = [0.01, 0.3, 2.0][round % 3];
        let start: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.5, 1.5)).collect();
        let q = space.step(&space.neutral(), &start);
        let v: Vec<f64> = (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect();
        for _ in 0..20 {
            let links = [0, 1].map(|_| random.below(space.link_count()));
            let points = [0, 1].map(|_| random.point(0.5));
            let sides = [0, 1].map(|i| (links[i], points[i].norm()));
            let bound = space.relative_motion_bound(sides, &q, &v);
            let distance = |share: f64| {
                let part: Vec<f64> = v.iter().map(|x| x * share).collect();
                let poses = space.link_poses(&space.step(&q, &part)).unwrap();
                let [a, b] = [0, 1].map(|i| poses[links[i]].transform_point(&points[i]));
                (a - b).norm()
            };
            let before = distance(0.0);
            for k in 1..=10 {
                let share = f64::from(k) / 10.0;
                let change = (distance(share) - before).abs();
                assert!(change <= bound * share + 1e-12, "{change} > {bound}");
                if bound > 0.0 {
                    used = used.max(change / (bound * share));
                }
            }
            if links[0] == links[1] {
                assert_eq!(bound, 0.0);
            }
        }
    }
    assert!(used > 0.5, "at most {used:.3} of a bound was used");
}

#[test]
fn no_point_moves_farther_along_a_direction_than_the_directed_bound() {
    let mut random = Random::new(33);
    let mut used = 0.0f64;
    for round in 0..600 {
        let length = 1 + random.below(4);
        let links = (0..length).map(|i| {
            let kind = KINDS[random.below(KINDS.len())]();
            // Axes along z are common, and keep what is along z.
            let axis = match random.below(2) {
                0 => Vec3::z(),
                _ => random.point(1.0),
            };
            let at = match random.below(2) {
                0 => cstk::pose::Pose::from_translation(random.point(1.0)),
                _ => random.pose(1.0),
            };
            LinkDefinition {
                at,
                ..link(i.checked_sub(1), kind, axis)
            }
        });
        let space = space(vec![robot(3, links.collect())]);
        let size = [0.01, 0.3, 2.0][round % 3];
        let start: Vec<f64> = (0..space.nv()).map(|_| random.within(-1.5, 1.5)).collect();
        let q = space.step(&space.neutral(), &start);
        let v: Vec<f64> = (0..space.nv())
            .map(|_| random.within(-size, size))
            .collect();
        let poses = &space.link_poses(&q).unwrap();
        let posture = RobotState { q: &q, poses };
        for direction in [Vec3::z(), random.unit()] {
            let point = random.point(0.5);
            let link = length - 1;
            let bound = space.directed_motion_bound(
                link,
                point.norm(),
                &direction,
                posture,
                Velocity::Constant(&v),
            );
            let whole = space.motion_bound_of_radius(link, point.norm(), &q, &v);
            assert!(bound <= whole * (1.0 + 1e-12), "{bound} > {whole}");
            for k in 1..=20 {
                let share = f64::from(k) / 20.0;
                let part: Vec<f64> = v.iter().map(|x| x * share).collect();
                let after = space.link_poses(&space.step(&q, &part)).unwrap();
                let way = after[link].transform_point(&point) - poses[link].transform_point(&point);
                let along = way.dot(&direction).abs();
                assert!(along <= bound * share + 1e-12, "{along} > {bound}");
                if bound > 1e-9 {
                    used = used.max(along / (bound * share));
                }
            }
        }
    }
    assert!(used > 0.5, "at most {used:.3} of a bound was used");
}

/// Joints whose speeds change on the way, and their signs too.
#[test]
fn velocities_of_any_sign_move_along_a_direction_no_farther_than_their_bound() {
    let mut random = Random::new(41);
    let kinds = [
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Planar,
        JointKind::FreeEuler,
    ];
    let mut used = 0.0f64;
    for round in 0..1000 {
        let length = 1 + random.below(4);
        let links = (0..length).map(|i: usize| LinkDefinition {
            at: random.pose(0.5),
            ..link(
                i.checked_sub(1),
                kinds[random.below(4)].clone(),
                random.unit(),
            )
        });
        let space = space(vec![robot(3, links.collect())]);
        let size = [0.01, 0.3, 2.0][round % 3];
        let q: Vec<f64> = (0..space.nq()).map(|_| random.within(-1.0, 1.0)).collect();
        let most: Vec<f64> = (0..space.nv()).map(|_| random.within(0.0, size)).collect();
        let poses = &space.link_poses(&q).unwrap();
        let posture = RobotState { q: &q, poses };
        let (direction, point) = (random.unit(), random.point(0.5));
        let link = length - 1;
        let velocity = Velocity::AtMost(&most);
        let bound = space.directed_motion_bound(link, point.norm(), &direction, posture, velocity);
        let mut at = q.clone();
        for _ in 0..4 {
            let part: Vec<f64> = most
                .iter()
                .map(|x| 0.25 * x * random.within(-1.0, 1.0).signum())
                .collect();
            at = at.iter().zip(&part).map(|(x, y)| x + y).collect();
            let after = space.link_poses(&at).unwrap();
            let way = after[link].transform_point(&point) - poses[link].transform_point(&point);
            let along = way.dot(&direction).abs();
            assert!(along <= bound + 1e-12, "{along} > {bound}");
            used = used.max(along / bound);
        }
    }
    assert!(used > 0.5, "at most {used:.3} of a bound was used");
}

/// A base that shifts and turns over a floor, and an arm of joints upright on it, keep their heights.
#[test]
fn what_moves_level_has_no_motion_upwards() {
    let links = vec![
        link(None, JointKind::Planar, Vec3::z()),
        link(Some(0), JointKind::Revolute, Vec3::z()),
        link(Some(1), JointKind::Revolute, -Vec3::z()),
    ];
    let space = space(vec![robot(3, links)]);
    let q = [0.3, -2.0, 1.0, 0.4, 0.7];
    let v = [0.5, 0.2, 2.0, -1.0, 3.0];
    let poses = &space.link_poses(&q).unwrap();
    let posture = RobotState { q: &q, poses };
    for link in 0..3 {
        let bound =
            space.directed_motion_bound(link, 1.0, &Vec3::z(), posture, Velocity::Constant(&v));
        assert!(bound < 1e-14, "{bound}");
    }
}

/// What does not move has a bound of 0, and what states no speeds has none, unless it rests.
#[test]
fn resting_joints_and_unknown_speeds() {
    struct Unknown;
    impl cstk::robot::CustomJoint for Unknown {
        fn coordinates(&self) -> usize {
            1
        }
        fn pose(&self, q: &[f64]) -> cstk::error::Result<cstk::pose::Pose> {
            Ok(cstk::pose::Pose::from_translation(Vec3::x() * q[0]))
        }
        fn jacobian(
            &self,
            _: &[f64],
            columns: &mut Vec<cstk::robot::Twist>,
        ) -> cstk::error::Result<()> {
            columns.push(cstk::robot::Twist {
                linear: Vec3::x(),
                angular: Vec3::zeros(),
            });
            Ok(())
        }
        fn speeds(&self) -> Option<cstk::robot::Speeds> {
            None
        }
    }
    let body = hull(&Random::new(1).points(6, 0.5)).body;
    let tip = LinkDefinition {
        body: Some(body),
        ..link(Some(0), JointKind::Revolute, Vec3::z())
    };
    let base = link(None, JointKind::Custom(Arc::new(Unknown)), Vec3::z());
    let space = space(vec![robot(3, vec![base, tip])]);
    assert_eq!(space.motion_bound(1, &[0.3, 0.1], &[0.0, 0.0]), 0.0);
    assert!(space.motion_bound(1, &[0.3, 0.1], &[0.0, 0.2]).is_finite());
    assert!(
        space
            .motion_bound(1, &[0.3, 0.1], &[0.1, 0.0])
            .is_infinite()
    );
}
