//! Certificates are about content: they hold in worlds that came about in another order.

use std::sync::Arc;

use cstk::cobject::CObject;
use cstk::environment::{Attachment, Change, Environment};
use cstk::motion::{MotionOptions, MotionOutcome};
use cstk::octree::Octree;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk::robot::{JointKind, LinkDefinition};
use cstk::space::Space;

use helpers::random::Random;
use helpers::robots::{against, link, robot, space};
use helpers::shapes::cuboid;

/// A cube that slides along x, and a second one on it.
fn sliders() -> Arc<Space> {
    let moving = |parent, axis| LinkDefinition {
        body: Some(cuboid([0.2; 3]).body),
        ..link(parent, JointKind::Prismatic, axis)
    };
    space(vec![robot(
        3,
        vec![moving(None, Vec3::x()), moving(Some(0), Vec3::y())],
    )])
}

/// Whether the certificate of a free motion in one world holds in another.
fn holds_in(one: &CObject, other: &CObject) -> bool {
    let (q0, q1) = ([-2.0, 0.0], [2.0, 0.3]);
    let context = &mut QueryContext::new();
    let found = context.motion_certificate(one, &q0, &q1, &MotionOptions::default());
    let (answer, certificate) = found.unwrap();
    assert_eq!(answer.outcome, MotionOutcome::Free);
    let certificate = certificate.unwrap();
    certificate.verify(one, &q0, &q1, 0.0).unwrap();
    certificate.verify(other, &q0, &q1, 0.0).is_ok()
}

/// Cells set in any order, and others set and cleared again.
#[test]
fn octrees_of_the_same_cells_are_one() {
    let space = sliders();
    let resolution = 0.1;
    let cells: Vec<Vec3> = (-9..=9)
        .map(|i| Vec3::new(0.31 * f64::from(i), 3.05, 0.05))
        .collect();
    let placed = |changes: &[(&[Vec3], bool)]| {
        let world = Arc::new(Environment::default());
        let mut octree = Octree::new(resolution).unwrap();
        octree.place(&world, &Pose::identity(), None).unwrap();
        for (cells, occupied) in changes {
            octree.set(cells, *occupied).unwrap();
        }
        against(&space, &world)
    };
    let one = placed(&[(&cells, true)]);
    let mut backwards: Vec<(&[Vec3], bool)> = cells.chunks(1).map(|cell| (cell, true)).collect();
    backwards.reverse();
    let neighbour = [Vec3::new(1.05, 3.15, 0.05)];
    let others = [
        placed(&backwards),
        placed(&[(&cells, true), (&neighbour, true), (&neighbour, false)]),
    ];
    for other in &others {
        assert!(holds_in(&one, other) && holds_in(other, &one));
    }
    let more = placed(&[(&cells, true), (&neighbour, true)]);
    assert!(!holds_in(&one, &more) && !holds_in(&more, &one));
}

/// Objects added in any order, some of them twice and deleted again.
#[test]
fn environments_of_the_same_objects_are_one() {
    let mut random = Random::new(12);
    let space = sliders();
    let bodies = [[0.1, 0.2, 0.3], [0.4, 0.1, 0.1]].map(|sides| cuboid(sides).body);
    for _ in 0..20 {
        let mut objects: Vec<(usize, Pose)> = (0..6)
            .map(|_| {
                let mut pose = random.pose(1.5);
                pose.translation.y += 3.0;
                (random.below(2), pose)
            })
            .collect();
        let mut built = || {
            let world = Arc::new(Environment::default());
            let mut ids = Vec::new();
            for k in 0..objects.len() {
                objects.swap(k, random.below(k + 1));
            }
            for (body, pose) in objects.iter().chain(&objects) {
                let add = Change::add(bodies[*body].clone(), *pose);
                ids.extend(world.apply(&[add]).unwrap().0);
            }
            for id in ids.into_iter().take(objects.len()) {
                world.apply(&[Change::Delete { id }]).unwrap();
            }
            against(&space, &world)
        };
        let (one, other) = (built(), built());
        assert!(holds_in(&one, &other));
    }
}

/// Objects that links hold, one each, whichever came first; and zeros of either sign.
#[test]
fn attached_objects_are_in_no_order() {
    let space = sliders();
    let bodies = [[0.1; 3], [0.3, 0.1, 0.1]].map(|sides| cuboid(sides).body);
    let built = |order: [usize; 2], zero: f64| {
        let world = Arc::new(Environment::default());
        for k in order {
            let at = Vec3::new(zero, -2.0 - k as f64, 1.0);
            let pose = Pose::from_translation(at);
            let id = world.apply(&[Change::add(bodies[k].clone(), pose)]);
            let attachment = Attachment::new(&space, k, &[0, 1]).unwrap();
            let attach = Change::Attach {
                id: id.unwrap().0[0],
                pose,
                attachment,
            };
            world.apply(&[attach]).unwrap();
        }
        for zero in [zero, -zero] {
            let pose = Pose::from_translation(Vec3::new(zero, 3.0, zero));
            world
                .apply(&[Change::add(bodies[0].clone(), pose)])
                .unwrap();
        }
        against(&space, &world)
    };
    let one = built([0, 1], 0.0);
    for other in [built([1, 0], 0.0), built([0, 1], -0.0), built([1, 0], -0.0)] {
        assert!(holds_in(&one, &other) && holds_in(&other, &one));
    }
}
