//! Motion bounds: no point of a link moves farther than they say, whatever joints carry it.

mod common;

use std::sync::Arc;

use cstk::body::Body;
use cstk::pose::Vec3;
use cstk::robot::{JointKind, LinkDefinition};

use common::random::Random;
use common::robots::{Screw, link, robot, space};
use common::shapes::hull;

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
