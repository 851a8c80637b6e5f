//! Gradients (§4.4) against central differences of the distance at random configurations.

use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::{CObject, InducedOptions};
use cstk::pose::{Pose, Vec3};
use cstk::query::{QueryContext, SSide};
use cstk::robot::{JointKind, LinkDefinition, Robot};

use helpers::differences::{agrees, agrees_at_many, distance, rows};
use helpers::random::Random;
use helpers::robots::{
    against, against_one, environment, free_body, free_planar_body, link, robot, space,
};
use helpers::shapes::{Shape, dented_ball, hull, hulls, planar};

/// Obstacles around a robot: hulls and a dented triangle surface.
fn obstacles(random: &mut Random) -> Vec<(Shape, Pose)> {
    let mut found = Vec::new();
    for i in 0..6 {
        let away = random.unit() * random.within(2.5, 4.0);
        let pose = Pose {
            rotation: random.rotation(),
            translation: away,
        };
        let shape = match i % 3 {
            0 => hull(&random.points(10, 0.7)),
            1 => hulls(&[random.points(6, 0.5), random.points(9, 0.5)]),
            _ => dented_ball(|| random.within(0.5, 0.8)),
        };
        found.push((shape, pose));
    }
    found
}

fn against_obstacles(robot: Arc<Robot>, obstacles: &[(Shape, Pose)]) -> CObject {
    let placed: Vec<(&Arc<Body>, Pose)> = obstacles.iter().map(|(s, p)| (&s.body, *p)).collect();
    against(&space(vec![robot]), &environment(&placed).0)
}

/// Every joint type about or along arbitrary axes at arbitrary frames, a fixed link between moving ones, and a
/// coordinate that moves two joints. The links' bodies differ.
fn mixed_arm(random: &mut Random) -> Arc<Robot> {
    let kinds = [
        (JointKind::Revolute, Some(0)),
        (JointKind::Prismatic, Some(1)),
        (JointKind::Fixed, None),
        (JointKind::Revolute, Some(2)),
        (JointKind::Revolute, Some(0)),
        (JointKind::Prismatic, Some(3)),
        (JointKind::Prismatic, Some(2)),
    ];
    let links = kinds
        .iter()
        .enumerate()
        .map(|(i, (kind, coordinate))| LinkDefinition {
            at: random.pose(0.4),
            coordinate: *coordinate,
            body: [
                None,
                Some(hull(&random.points(8, 0.3)).body),
                Some(dented_ball(|| random.within(0.2, 0.3)).body),
            ][i % 3]
                .clone(),
            ..link(i.checked_sub(1), kind.clone(), random.point(2.0))
        });
    let links = links.collect();
    robot(3, links)
}

#[test]
fn a_free_body_among_obstacles() {
    let mut random = Random::new(1);
    for seed in 0..4 {
        let obstacles = obstacles(&mut random);
        let body = match seed % 2 {
            0 => hull(&random.points(8, 0.6)).body,
            _ => dented_ball(|| random.within(0.4, 0.6)).body,
        };
        let cobject = against_obstacles(free_body(&body), &obstacles);
        agrees_at_many(&cobject, &[1.5, 1.5, 1.5, 3.0, 1.5, 3.0], 60, seed);
    }
}

#[test]
fn arms_of_every_joint_type_among_obstacles() {
    let mut random = Random::new(2);
    for seed in 0..6 {
        let obstacles = obstacles(&mut random);
        let cobject = against_obstacles(mixed_arm(&mut random), &obstacles);
        agrees_at_many(&cobject, &[3.0, 0.7, 3.0, 0.7], 50, seed);
    }
}

/// Two links of one robot: joints that move both must cancel.
#[test]
fn link_against_link_of_one_robot() {
    let mut random = Random::new(3);
    for seed in 0..6 {
        let mut arm = |parent, kind, coordinate, body: Option<Arc<Body>>| LinkDefinition {
            at: random.pose(0.8),
            coordinate,
            body,
            ..link(parent, kind, random.point(1.0))
        };
        let mut shapes = Random::new(seed + 100);
        let one = hull(&shapes.points(8, 0.5)).body;
        let other = dented_ball(|| shapes.within(0.4, 0.6)).body;
        let links = vec![
            arm(None, JointKind::Revolute, Some(0), None),
            arm(Some(0), JointKind::Prismatic, Some(1), None),
            arm(Some(1), JointKind::Revolute, Some(2), Some(one)),
            arm(Some(0), JointKind::Revolute, Some(3), None),
            arm(Some(3), JointKind::Prismatic, Some(2), Some(other)),
        ];
        let space = space(vec![robot(3, links)]);
        let options = InducedOptions::default();
        let cobject = CObject::induced_links(space.clone(), &[[2, 4]], options).unwrap();
        let ranges = [3.0, 1.5, 3.0, 3.0];
        agrees_at_many(&cobject, &ranges, 50, seed);
        let swapped = CObject::induced_links(space, &[[4, 2]], options).unwrap();
        let q = [0.3, 1.4, -0.2, 2.0];
        let both = [&cobject, &swapped].map(|c| {
            QueryContext::new()
                .gradients(c, &q, f64::INFINITY, 1)
                .unwrap()
        });
        if both.iter().all(|list| !list.contacts.is_empty()) {
            // Joint 0 carries both links.
            assert!(both.iter().all(|list| list.gradients[0].abs() <= 1e-12));
            assert!((both[0].contacts[0].normal + both[1].contacts[0].normal).amax() <= 1e-9);
        }
    }
}

#[test]
fn link_against_link_of_two_robots() {
    let mut random = Random::new(4);
    for seed in 0..3 {
        let one = free_body(&hull(&random.points(7, 0.7)).body);
        let other = mixed_arm(&mut random);
        let space = space(vec![one, other]);
        let options = InducedOptions::default();
        let cobject = CObject::induced_links(space, &[[5, 7], [11, 5]], options).unwrap();
        let ranges = [2.0, 2.0, 2.0, 3.0, 1.5, 3.0, 3.0, 0.7, 3.0, 0.7];
        agrees_at_many(&cobject, &ranges, 50, seed);
    }
}

#[test]
fn planar_bodies_and_arms() {
    let mut random = Random::new(5);
    for seed in 0..6 {
        let scene: Vec<(Shape, Pose)> = (0..4)
            .map(|i| {
                let angle = 1.6 * f64::from(i) + random.within(0.0, 0.5);
                let mut pose = random.planar_pose(0.0);
                pose.translation = Vec3::new(angle.cos(), angle.sin(), 0.0) * 2.5;
                (
                    planar(&[random.polygon(5, 0.8), random.polygon(3, 0.8)]),
                    pose,
                )
            })
            .collect();
        let body = planar(&[random.polygon(6, 0.7)]).body;
        let cobject = against_obstacles(free_planar_body(&body), &scene);
        agrees_at_many(&cobject, &[1.2, 1.2, 3.0], 60, seed);

        let arm = (0..3)
            .map(|i: usize| LinkDefinition {
                body: Some(planar(&[random.polygon(4, 0.3)]).body),
                at: random.planar_pose(0.5),
                ..if i == 1 {
                    link(Some(0), JointKind::Prismatic, Vec3::new(1.0, -2.0, 0.0))
                } else {
                    link(i.checked_sub(1), JointKind::Revolute, Vec3::z() * -3.0)
                }
            })
            .collect();
        let cobject = against_obstacles(robot(2, arm), &scene);
        agrees_at_many(&cobject, &[3.0, 0.5, 3.0], 60, seed);
    }
}

/// Not only the nearest contact: each object's row is the gradient of the distance from that object alone.
#[test]
fn every_witness_has_its_own_gradient() {
    let mut random = Random::new(6);
    let shapes: Vec<(Shape, Pose)> = (0..5)
        .map(|_| (hull(&random.points(8, 0.8)), random.pose(4.0)))
        .collect();
    let placed: Vec<(&Arc<Body>, Pose)> = shapes.iter().map(|(s, p)| (&s.body, *p)).collect();
    let (environment, ids) = environment(&placed);
    let space = space(vec![free_body(&hull(&random.points(8, 0.8)).body)]);
    let all = against(&space, &environment);
    let mut compared = 0;
    for _ in 0..40 {
        let q: Vec<f64> = [2.0, 2.0, 2.0, 3.0, 1.5, 3.0]
            .map(|r| random.within(-r, r))
            .into();
        let list = QueryContext::new()
            .gradients(&all, &q, f64::INFINITY, 100)
            .unwrap();
        assert_eq!(list.witnesses.len(), ids.len());
        for &id in &ids {
            let one = against_one(&space, &environment, id);
            if distance(&one, &q) < 0.02 || !agrees(&one, &q) {
                continue;
            }
            compared += 1;
            let alone = QueryContext::new()
                .gradients(&one, &q, f64::INFINITY, 1)
                .unwrap();
            let witness = list
                .witnesses
                .iter()
                .find(|w| w.s_side == SSide::Object(id))
                .unwrap();
            assert_eq!(rows(&list)[witness.first_contact], rows(&alone)[0]);
        }
    }
    assert!(compared > 100, "{compared}");
}
