//! Environments under change, what they ought to hold, and where to ask them.

use std::collections::BTreeMap;
use std::sync::Arc;

use cstk::body::Body;
use cstk::cobject::InducedOptions;
use cstk::environment::{Change, Environment};
use cstk::pose::{Pose, Vec3};

use super::random::Random;
use super::robots::environment;
use super::shapes::{box_corners, cuboid, hull, hulls};

/// Objects by their ids, as they ought to be.
pub type Model = BTreeMap<u64, (Arc<Body>, Pose)>;

pub fn spatial_bodies(random: &mut Random) -> Vec<Arc<Body>> {
    let parts: Vec<Vec<Vec3>> = (0..3)
        .map(|_| {
            let aside = random.point(0.3);
            let corners = box_corners([0.2, 0.1, 0.3]);
            corners.iter().map(|corner| corner + aside).collect()
        })
        .collect();
    let far_off: Vec<Vec3> = box_corners([0.2; 3])
        .iter()
        .map(|corner| corner + Vec3::new(1e3, -2e3, 5e2))
        .collect();
    let bodies = [
        cuboid([0.3, 0.2, 0.1]),
        cuboid([0.02, 0.02, 1.0]),
        cuboid([4.0, 3.0, 0.05]),
        hulls(&parts),
        hull(&far_off),
        hull(&[Vec3::zeros(), Vec3::new(0.4, 0.1, 0.0)]),
    ];
    bodies.map(|shape| shape.body).into()
}

/// Poses near the robot, far from it, and very far.
pub fn any_pose(random: &mut Random, body: &Body) -> Pose {
    let half = match random.below(40) {
        0 => 1e6,
        1 | 2 => 50.0,
        _ => 2.0,
    };
    let mut pose = random.pose(half);
    // Where it stands is what counts, not where its origin is.
    pose.translation -= pose.rotation * body.center();
    pose
}

fn moved(random: &mut Random, body: &Body, from: &Pose) -> Pose {
    let step = match random.below(4) {
        0 => return any_pose(random, body),
        1 => 1e-3,
        2 => 0.05,
        _ => 0.5,
    };
    Pose {
        translation: from.translation + random.point(step),
        ..*from
    }
}

/// Some changes of an environment and its model, of which the number of objects is led to a given one.
pub fn change(
    environment: &Environment,
    model: &mut Model,
    bodies: &[Arc<Body>],
    random: &mut Random,
    wanted: usize,
) {
    let most = [1, 1, 4, 60][random.below(4)];
    // Of ten changes so many are additions, and so many moves.
    let [additions, moves] = if model.len() < wanted { [5, 4] } else { [1, 5] };
    let mut changes = Vec::new();
    let mut added = Vec::new();
    for _ in 0..1 + random.below(most) {
        let ids: Vec<u64> = model.keys().copied().collect();
        let kind = if ids.is_empty() { 0 } else { random.below(10) };
        if kind < additions {
            let body = bodies[random.below(bodies.len())].clone();
            let pose = any_pose(random, &body);
            added.push((changes.len(), body.clone(), pose));
            changes.push(Change::add(body, pose));
        } else if kind < additions + moves {
            let id = ids[random.below(ids.len())];
            let (body, pose) = &model[&id];
            let pose = moved(random, body, pose);
            changes.push(Change::Move { id, pose });
            model.get_mut(&id).unwrap().1 = pose;
        } else {
            let id = ids[random.below(ids.len())];
            changes.push(Change::Delete { id });
            model.remove(&id);
        }
    }
    let before = environment.snapshot().version;
    let (ids, version) = environment.apply(&changes).unwrap();
    assert_eq!(version, before + 1);
    for (at, body, pose) in added {
        assert!(model.keys().all(|&id| id < ids[at]));
        model.insert(ids[at], (body, pose));
    }
}

pub fn configurations(random: &mut Random, count: usize) -> Vec<[f64; 6]> {
    (0..count)
        .map(|_| {
            let at = random.point(2.0);
            let turn = random.point(3.0);
            [at.x, at.y, at.z, turn.x, turn.y, turn.z]
        })
        .collect()
}

/// Where the robot is close to one of the objects, wherever that is.
pub fn beside_one(random: &mut Random, model: &Model) -> [f64; 6] {
    let mut q = configurations(random, 1)[0];
    if let Some((body, pose)) = model.values().nth(random.below(model.len().max(1))) {
        let at = pose.transform_point(body.center()) + random.point(0.6);
        q[..3].copy_from_slice(at.as_slice());
    }
    q
}

pub fn options() -> InducedOptions {
    InducedOptions {
        contact_epsilon: 0.02,
        margin: 0.01,
    }
}

/// The objects of a model in an environment of their own, in another order, and where each went.
pub fn made_anew(model: &Model, random: &mut Random) -> (Arc<Environment>, Vec<u64>) {
    let mut order: Vec<usize> = (0..model.len()).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
    let objects: Vec<&(Arc<Body>, Pose)> = model.values().collect();
    let given: Vec<_> = order
        .iter()
        .map(|&i| (&objects[i].0, objects[i].1))
        .collect();
    let (made, ids) = environment(&given);
    let mut by_place = vec![0; ids.len()];
    for (&i, id) in order.iter().zip(ids) {
        by_place[i] = id;
    }
    (made, by_place)
}
