//! The acceptance cases about gradients: A35 and A36.

use cstk::cobject::Class;
use cstk::convex::ContactMode;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, RobotState};

use helpers::differences::{distance, moved};
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, link, robot, space};
use helpers::shapes::{box_corners, hull, mesh, planar};

/// A box about (center, 0): a link that reaches along x.
fn bar(length: f64, half: f64) -> Vec<Vec3> {
    [(0.0, -half), (length, -half), (length, half), (0.0, half)]
        .map(|(x, y)| Vec3::new(x, y, 0.0))
        .to_vec()
}

/// A planar arm of two links against a disc of many sides. Points, Jacobian and gradient are of one configuration.
/// Case A36 of docs/cases.md.
#[test]
fn points_and_gradients_belong_to_the_configuration_asked_about() {
    let mut links = vec![
        link(None, JointKind::Revolute, Vec3::z()),
        link(Some(0), JointKind::Revolute, Vec3::z()),
    ];
    let bars = [bar(1.0, 0.05), bar(0.8, 0.04)];
    links[1].at = Pose::from_translation(Vec3::x());
    for (link, corners) in links.iter_mut().zip(&bars) {
        *link = LinkDefinition {
            body: Some(planar(std::slice::from_ref(corners)).body),
            ..link.clone()
        };
    }
    let disc: Vec<Vec3> = (0..180)
        .map(|i| {
            let (s, c) = (f64::from(i) * std::f64::consts::TAU / 180.0).sin_cos();
            Vec3::new(0.3 * c, 0.3 * s, 0.0)
        })
        .collect();
    let disc = planar(&[disc]);
    let space = space(vec![robot(2, links)]);
    let at = Pose::from_translation(Vec3::new(1.1, 0.9, 0.0));
    let cobject = against(&space, &environment(&[(&disc.body, at)]).0);
    let mut random = Random::new(36);
    let (mut compared, mut worst) = (0, 0.0f64);
    while compared < 2000 {
        let q = [random.within(-3.0, 3.0), random.within(-3.0, 3.0)];
        let here = distance(&cobject, &q);
        if here < 1e-3 {
            continue;
        }
        let list = QueryContext::new()
            .gradients(&cobject, &q, here + 1e-6, 8)
            .unwrap();
        let contact = &list.contacts[0];
        let row = &list.gradients[..2];
        // The point is one of the link's at this very configuration, and n^T J there is the gradient.
        let poses = space.link_poses(&q).unwrap();
        let r_link = list.witnesses[0].r_link;
        let own = poses[r_link].inverse().transform_point(&contact.points[0]);
        let (length, half) = [(1.0, 0.05), (0.8, 0.04)][r_link];
        assert!((-1e-12..=length + 1e-12).contains(&own.x) && own.y.abs() <= half + 1e-12);
        let posture = RobotState {
            q: &q,
            poses: &poses,
        };
        let jacobian = space.jacobian(posture, r_link, &contact.points[0]).unwrap();
        for k in 0..2 {
            let along: f64 = (0..3)
                .map(|i| contact.normal[i] * jacobian[2 * i + k])
                .sum();
            assert!((along - row[k]).abs() < 1e-14);
        }
        if list.contacts.len() > 1 || contact.mode == ContactMode::EdgeEdge {
            continue;
        }
        let step = 1e-6;
        let differences: Vec<f64> = (0..2)
            .map(|k| {
                let at = |by: f64| distance(&cobject, &moved(&q, k, by));
                (at(step) - at(-step)) / (2.0 * step)
            })
            .collect();
        compared += 1;
        for (got, want) in row.iter().zip(&differences) {
            worst = worst.max((got - want).abs());
        }
    }
    println!("A36: {compared} configurations, largest error {worst:.1e}");
    assert!(worst < 1e-6, "{worst:e}");
}

/// Every witness has a gradient, at contact too, of solids and of surfaces alike; never a NaN, and at ties one of the
/// one-sided set.
/// Case A35 of docs/cases.md.
#[test]
fn touching_pairs_have_gradients() {
    let mut random = Random::new(35);
    let floor = hull(&box_corners([4.0, 4.0, 1.0]));
    let corners = box_corners([1.0, 1.0, 1.0]);
    let faces = [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ];
    for body in [hull(&corners), mesh(&corners, &faces)] {
        let cobject = against(
            &space(vec![free_body(&body.body)]),
            &environment(&[(&floor.body, Pose::identity())]).0,
        );
        for _ in 0..200 {
            // On a corner, an edge or a face of the cube, just on the floor.
            let mut q = [
                random.within(-0.5, 0.5),
                random.within(-0.5, 0.5),
                0.0,
                random.within(-3.0, 3.0),
                0.0,
                0.0,
            ];
            match random.below(3) {
                0 => q[5] = random.within(-1.0, 1.0),
                1 => (q[4], q[5]) = (random.within(-0.5, 0.5), random.within(-1.0, 1.0)),
                _ => {}
            }
            let pose = cobject.space().link_poses(&q).unwrap()[5];
            let lowest = body
                .parts
                .iter()
                .flatten()
                .map(|p| pose.transform_point(p).z);
            q[2] = 0.5 - lowest.fold(f64::INFINITY, f64::min);
            let at = Configuration::Coordinates(&q);
            let mut query = QueryContext::new();
            assert_eq!(query.classify(&cobject, at).unwrap(), Class::Inside);
            let list = query.gradients(&cobject, &q, 0.0, 100).unwrap();
            assert!(!list.contacts.is_empty());
            assert!(list.witnesses.iter().all(|w| !w.overlapping));
            assert!(list.gradients.iter().all(|x| x.is_finite()));
            // Faces of a surface touch one by one; only of solids does one pair say how the distance grows: by the least that
            // its contacts say, or more.
            if body.parts.len() > 1 {
                continue;
            }
            let step = 1e-7;
            for k in 0..list.nv {
                for sign in [-1.0, 1.0] {
                    let growth = distance(&cobject, &moved(&q, k, sign * step)) / step;
                    let rows = list.gradients.chunks_exact(list.nv);
                    let promised = rows.map(|row| sign * row[k]).fold(f64::INFINITY, f64::min);
                    assert!(growth >= promised - 1e-6, "{growth} {promised}");
                }
            }
        }
    }
}
