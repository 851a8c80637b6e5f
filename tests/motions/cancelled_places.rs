//! Places that are small sums of large terms: of bodies modelled far from the origin of their frame, and of arms folded onto each other.
//! What is rounded there has nothing to do with the size of the sum.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{Class, PureShape};
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};

use helpers::oracle::moved_exactly;
use helpers::pure::pure;
use helpers::random::Random;
use helpers::robots::{against, environment, link, robot, space};
use helpers::shapes::{cuboid, hull};

use super::random_scenes::{built, class};

/// A small box modelled `far` from the origin, and the pose that puts it with its face at x from the origin on, in the middle of the
/// others; where the face then really is, at least.
fn far_box(random: &mut Random, far: f64, x: f64) -> (Arc<Body>, Pose, f64) {
    let rotation = random.rotation();
    let center = random.unit() * far;
    let corner = |i: usize| {
        let side = |k: usize| if i >> k & 1 == 0 { -0.1 } else { 0.1 };
        center + rotation.tr_mul(&Vec3::new(side(0), side(1), side(2)))
    };
    let corners: Vec<Vec3> = (0..8).map(corner).collect();
    let pose = Pose {
        rotation,
        translation: Vec3::new(x + 0.1, 0.0, 0.0) - rotation * center,
    };
    let placed = corners
        .iter()
        .map(|v| moved_exactly(v, &pose, &Vec3::zeros()).x);
    let face = placed.fold(f64::INFINITY, f64::min);
    (hull(&corners).body, pose, face)
}

/// A cube of side 1 that slides along y.
fn slider() -> Vec<LinkDefinition> {
    vec![LinkDefinition {
        body: Some(cuboid([1.0; 3]).body),
        ..link(None, JointKind::Prismatic, Vec3::y())
    }]
}

#[test]
fn certificates_claim_no_larger_gap_than_there_is() {
    let mut random = Random::new(7001);
    let mut context = QueryContext::new();
    let (mut certified, ends) = (0, ([-0.01], [0.01]));
    for _ in 0..300 {
        let far = 10f64.powf(random.within(0.0, 9.5));
        let (body, pose, face) = far_box(&mut random, far, 0.6);
        let set = against(
            &space(vec![robot(3, slider())]),
            &environment(&[(&body, pose)]).0,
        );
        let (q0, q1) = (&ends.0, &ends.1);
        let found = context.motion_certificate(&set, q0, q1, &MotionOptions::default());
        let (answer, certificate) = found.unwrap();
        assert_eq!(answer.outcome, MotionOutcome::Free, "{far:e}");
        let certificate = certificate.unwrap();
        for entry in certificate.entries() {
            assert!(
                entry.gap <= face - 0.5,
                "{far:e}: {} > {}",
                entry.gap,
                face - 0.5
            );
        }
        certificate.verify(&set, q0, q1, 0.0).unwrap();
        certified += 1;
    }
    assert_eq!(certified, 300);
}

/// A ball at the end of two long arms, folded onto each other, that turns about the normal of a floor: no height changes but by rounding.
#[test]
fn folded_arms_over_a_floor_are_rounded_by_their_lengths() {
    let mut random = Random::new(7003);
    let mut context = QueryContext::new();
    let ball = built(|b| b.add_sphere(&Vec3::zeros(), 0.25, 0).unwrap());
    let mut free = 0;
    for case in 0..200 {
        let (normal, away) = (random.unit(), random.unit() * 1e6);
        let links = vec![
            LinkDefinition {
                at: Pose::from_translation(away),
                ..link(None, JointKind::Revolute, normal)
            },
            LinkDefinition {
                at: Pose::from_translation(-away),
                body: Some(ball.clone()),
                ..link(Some(0), JointKind::Revolute, normal)
            },
        ];
        let space = space(vec![robot(3, links)]);
        let (q0, q1) = ([0.0, 0.0], [1e-3, 0.0]);
        for rounding in [0.0, 1e-11, 1e-10, 5e-10, 1e-9, 1e-8, 1e-6] {
            let floor = PureShape::Floor {
                links: vec![1],
                normal,
                offset: -0.25 - rounding,
            };
            let set = pure(&space, floor, Some(1.0));
            let found = context.motion(&set, &q0, &q1, &MotionOptions::default());
            if found.unwrap().outcome != MotionOutcome::Free {
                continue;
            }
            free += 1;
            for i in 0..=400 {
                let q = [1e-3 * f64::from(i) / 400.0, 0.0];
                let class = class(&mut context, &set, &q);
                assert_ne!(class, Class::Inside, "case {case} {rounding:e} at {}", q[0]);
            }
        }
    }
    assert!(free >= 200, "{free}");
}
