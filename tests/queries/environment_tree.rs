//! The tree over an environment's objects, which follows their changes, finds what is near as well as one made anew.

use std::sync::Arc;

use cstk::body::Body;
use cstk::body_bounds::{Bounds, BoundsByEight};
use cstk::environment::{Change, Environment, NearScratch};
use cstk::index_set::IndexSet;
use cstk::lanes::Plain;
use cstk::pose::{Pose, Vec3};

use helpers::random::Random;
use helpers::robots::environment;
use helpers::shapes::{box_corners, cuboid, hull};

/// How many objects a query has to look at, of those the tree finds near.
fn looked_at(environment: &Environment, body: &Body, at: &[Pose], limit: f64) -> usize {
    let snapshot = environment.snapshot();
    let mut scratch = NearScratch::default();
    let mut count = 0;
    for pose in at {
        let mut bounds = BoundsByEight::default();
        bounds.push(&Bounds::of(Plain, body, pose));
        let mut first = IndexSet::new(1);
        first.insert(0);
        let tree = snapshot.tree();
        tree.visit_near(&bounds, &first, limit, &mut scratch, |_, _, _| {
            count += 1;
            limit
        });
    }
    count
}

#[test]
fn one_object_far_away_does_not_blur_the_others() {
    let mut random = Random::new(44);
    let small = cuboid([0.05; 3]).body;
    let objects: Vec<(&Arc<Body>, Pose)> = (0..1000).map(|_| (&small, random.pose(1.0))).collect();
    let at: Vec<Pose> = (0..200).map(|_| random.pose(1.0)).collect();
    let looked_at = |environment: &Environment| looked_at(environment, &small, &at, 0.01);
    let (live, ids) = environment(&objects);
    let before = looked_at(&live);
    assert!(before < 10 * at.len());
    // Far away, huge, or known but to a thousandth: whether it is there from the beginning, comes, or goes.
    let huge = cuboid([1e8; 3]).body;
    let from_afar = hull(
        &box_corners([0.1; 3])
            .iter()
            .map(|c| c + Vec3::x() * 1e12)
            .collect::<Vec<_>>(),
    );
    let odd = [
        (&small, Pose::from_translation(Vec3::new(1e7, 0.0, 0.0))),
        (&huge, Pose::from_translation(Vec3::new(1e8, 0.0, 0.0))),
        (
            &from_afar.body,
            Pose::from_translation(Vec3::x() * (1.0 - 1e12)),
        ),
    ];
    for (body, pose) in odd {
        let more = before + at.len();
        let mut with_it = objects.clone();
        with_it.push((body, pose));
        let (other, _) = environment(&with_it);
        assert!(looked_at(&other) <= more);
        let add = Change::add(body.clone(), pose);
        let (new, _) = live.apply(&[add]).unwrap();
        assert!(looked_at(&live) <= more);
        // And back again.
        for (_, near) in &objects[..3] {
            live.apply(&[Change::Move {
                id: new[0],
                pose: *near,
            }])
            .unwrap();
            live.apply(&[Change::Move { id: new[0], pose }]).unwrap();
        }
        assert!(looked_at(&live) <= more);
        live.apply(&[Change::Delete { id: new[0] }]).unwrap();
        assert_eq!(looked_at(&live), before);
    }
    // All of them go there.
    let away = Vec3::new(1e7, 2e7, 0.0);
    for (id, (_, pose)) in ids.iter().zip(&objects) {
        let pose = Pose {
            translation: pose.translation + away,
            ..*pose
        };
        live.apply(&[Change::Move { id: *id, pose }]).unwrap();
    }
    let there: Vec<Pose> = at
        .iter()
        .map(|pose| Pose {
            translation: pose.translation + away,
            ..*pose
        })
        .collect();
    let after = self::looked_at(&live, &small, &there, 0.01);
    assert!(after <= before + before / 10 + 1, "{after} {before}");
}

/// The tree's nodes stay as small as those of a tree made anew, and so does what a descent opens.
#[test]
fn changes_do_not_wear_the_tree_out() {
    let mut random = Random::new(45);
    let body = cuboid([0.3, 0.2, 0.1]).body;
    for (name, step) in [("anywhere", 0.0), ("near", 0.05), ("together", 0.1)] {
        let mut poses: Vec<Pose> = (0..3000).map(|_| random.pose(7.0)).collect();
        let objects: Vec<_> = poses.iter().map(|pose| (&body, *pose)).collect();
        let (live, mut ids) = environment(&objects);
        let mut worst: f64 = 0.0;
        for round in 0..12_000 {
            let i = random.below(poses.len());
            poses[i] = match name {
                "anywhere" => random.pose(7.0),
                "near" => Pose {
                    translation: poses[i].translation + random.point(step),
                    ..poses[i]
                },
                _ => Pose {
                    translation: poses[i].translation * (1.0 - step) + random.point(step),
                    ..poses[i]
                },
            };
            if round % 5 == 0 {
                let add = Change::add(body.clone(), poses[i]);
                let delete = Change::Delete { id: ids[i] };
                ids[i] = live.apply(&[delete, add]).unwrap().0[1];
            } else {
                let (id, pose) = (ids[i], poses[i]);
                live.apply(&[Change::Move { id, pose }]).unwrap();
            }
            if round % 500 == 0 {
                let objects: Vec<_> = poses.iter().map(|pose| (&body, *pose)).collect();
                let (anew, _) = environment(&objects);
                let surface = |e: &Environment| e.snapshot().tree().surface();
                worst = worst.max(surface(&live) / surface(&anew));
                let at: Vec<Pose> = poses.iter().step_by(30).copied().collect();
                let looked_at = |e: &Arc<Environment>| looked_at(e, &body, &at, 0.1);
                let [looked_at, wanted] = [&live, &anew].map(looked_at);
                assert!(looked_at.abs_diff(wanted) <= 2 + wanted / 50, "{name}");
            }
        }
        println!("{name}: {worst}");
        assert!(worst <= 1.6, "{name}: {worst}");
    }
}
