//! What the documentation says of the scenes, by brute force.

mod support;

use std::f64::consts::PI;

use cstk_scenes::*;
use support::{along, distance, distances_within, norm};

const CLEARANCE: f64 = 0.00125;

fn obstacle_polygons(scene: &Scene) -> Vec<usize> {
    scene.obstacles.iter().map(Mesh::polygons).collect()
}

#[test]
fn counts_of_the_report() {
    for seed in [None, Some(1), Some(2)] {
        let lamp = seed.map_or_else(free_lamp, free_lamp_seeded);
        assert_eq!(lamp.moving.polygons(), 626);
        assert_eq!(lamp.obstacles.len(), 5);
        assert_eq!(obstacle_polygons(&lamp).iter().sum::<usize>(), 1526);

        let pot = seed.map_or_else(teapot_contacts, teapot_contacts_seeded);
        assert_eq!(pot.moving.polygons(), 1920);
        assert_eq!(pot.obstacles.len(), 5);
        assert_eq!(obstacle_polygons(&pot).iter().sum::<usize>(), 3020);

        let gear = seed.map_or_else(gear_plate_motor, gear_plate_motor_seeded);
        assert_eq!(gear.moving.polygons(), 3920);
        assert_eq!(obstacle_polygons(&gear), [4054, 2252]);

        for scene in [lamp, pot, gear] {
            assert_eq!(scene.poses.len(), 200);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_scene_and_another_another() {
    for make in [
        free_lamp_seeded,
        teapot_contacts_seeded,
        gear_plate_motor_seeded,
    ] {
        assert!(make(3) == make(3) && make(3) != make(4));
        assert!(make(3).turned(1) == make(3).turned(1));
    }
}

#[test]
fn the_lamp_flies_freely() {
    let scene = free_lamp();
    let distances: Vec<f64> = scene.poses.iter().map(|p| distance(&scene, p)).collect();
    let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
    let most = distances.iter().copied().fold(0.0, f64::max);
    assert!((0.17..0.18).contains(&least), "{least}");
    assert!((0.64..0.65).contains(&most), "{most}");
}

#[test]
fn seeded_lamps_fly_freely() {
    for seed in 1..=5 {
        let scene = free_lamp_seeded(seed);
        for pose in scene.poses.iter().step_by(6) {
            let distance = distance(&scene, pose);
            assert!(distance > 0.08, "seed {seed}: {distance}");
        }
    }
}

#[test]
fn the_teapot_touches_three_times() {
    let mut scenes = vec![teapot_contacts()];
    scenes.extend((1..=5).map(teapot_contacts_seeded));
    for scene in scenes {
        let at = |index: usize| distance(&scene, &scene.poses[index]);
        for index in [0, 99, 100, 199] {
            assert_eq!(at(index), 0.0, "{} {index}", scene.name);
        }
        for index in [20, 50, 80, 120, 150, 180] {
            assert!(at(index) > 0.15, "{} {index}: {}", scene.name, at(index));
        }
        assert!(at(50) > 0.5 && at(150) > 0.5, "{}", scene.name);
    }
}

#[test]
fn the_gear_keeps_its_clearance_on_the_spindle() {
    let mut scenes = vec![gear_plate_motor()];
    scenes.extend((1..=3).map(gear_plate_motor_seeded));
    for scene in scenes {
        for index in [160, 180, 199] {
            let found = distances_within(&scene, &scene.poses[index], 0.00128);
            let least = found.iter().copied().fold(f64::INFINITY, f64::min);
            assert!((least - CLEARANCE).abs() < 1e-15, "{least}");
            assert_eq!(found.len(), 504, "{} {index}", scene.name);
        }
    }
}

#[test]
fn the_gear_keeps_its_clearance_in_the_hole_and_nowhere_else() {
    let scene = gear_plate_motor();
    let near = |index: usize| distances_within(&scene, &scene.poses[index], 0.00128);
    for index in [97, 115, 134] {
        let found = near(index);
        let least = found.iter().copied().fold(f64::INFINITY, f64::min);
        assert!((least - CLEARANCE).abs() < 1e-15, "{least}");
        assert!(found.len() > 100);
    }
    for index in [0, 50, 95, 136, 150, 156] {
        assert!(near(index).is_empty(), "{index}");
    }
}

#[test]
fn bore_and_spindle_have_the_clearance_in_closed_form() {
    let radius = |mesh: &Mesh, low: f64, nearest: bool| {
        let radii = mesh.vertices.iter().filter(|p| p[2] > low);
        let radii = radii.map(|p| p[0].hypot(p[1]));
        match nearest {
            true => radii.fold(f64::INFINITY, f64::min),
            false => radii.fold(0.0, f64::max),
        }
    };
    let bore = radius(&gear(), -1.0, true);
    // Above the flange and the boss there is only the spindle.
    let spindle = radius(&motor(), 0.66, false);
    let gap = (bore - spindle) * (PI / 56.0).cos();
    assert!((gap - CLEARANCE).abs() < 1e-15);
}

#[test]
fn the_gear_moves_one_unit_down() {
    let scene = gear_plate_motor();
    let (first, last) = (scene.poses[0].0, scene.poses[199].0);
    assert!((first[11] - last[11] - 1.0).abs() < 1e-15);
    assert_eq!((first[3], first[7]), (0.0, 0.0));
}

#[test]
fn turning_keeps_distances() {
    let cases = [
        (free_lamp(), [0, 90, 199]),
        (teapot_contacts(), [30, 60, 150]),
        (gear_plate_motor(), [96, 150, 170]),
    ];
    for (scene, indices) in cases {
        let turned = scene.turned(7);
        for index in indices {
            let before = distance(&scene, &scene.poses[index]);
            let after = distance(&turned, &turned.poses[index]);
            assert!((before - after).abs() < 1e-14, "{} {index}", scene.name);
        }
    }
}

#[test]
fn turning_leaves_no_face_aligned() {
    for seed in 0..4 {
        let scene = free_lamp().turned(seed);
        for mesh in scene.obstacles.iter().chain([&scene.moving]) {
            for polygon in support::polygons(mesh) {
                let normal = support::area_vector(&polygon);
                let length = support::norm(normal);
                assert!(normal.iter().all(|n| n.abs() < 0.99999 * length));
            }
        }
    }
}

/// `pose` with the moving body shifted by `step` away from the origin.
fn outward(pose: &Pose, step: f64) -> Pose {
    let offset = [pose.0[3], pose.0[7], pose.0[11]];
    Pose::translation(along([0.0; 3], offset, step / norm(offset))).compose(pose)
}

#[test]
fn bumpy_pairs_are_as_far_apart_as_they_say() {
    let made = bumpy_pair(1000, 6);
    let scene = &made.scene;
    for (pose, placement) in scene.poses.iter().zip(made.placements).step_by(3) {
        let at = |step: f64| distance(scene, &outward(pose, step));
        let found = at(0.0);
        match placement {
            Placement::Far => assert!((0.5..2.00001).contains(&found), "{found}"),
            Placement::Near => assert!((0.001..0.10001).contains(&found), "{found}"),
            Placement::Touching => {
                assert!(found <= 1e-4, "{found}");
                assert!(at(1e-4) > 0.0 && at(-1.1e-4) == 0.0);
            }
            Placement::Overlapping => {
                assert_eq!(found, 0.0);
                assert!(at(0.029) == 0.0 && at(0.501) > 0.0);
            }
        }
    }
}

#[test]
fn coherent_bumpy_pairs_keep_their_gap() {
    for (polygons, gap) in [(1000, 0.01), (1000, 1.0), (3000, 0.01)] {
        let scene = bumpy_pair_coherent(polygons, gap, 8);
        assert_eq!(scene.poses.len(), 200);
        for pose in scene.poses.iter().step_by(40) {
            let more = distance(&scene, pose) - gap;
            assert!(
                (-1e-12..1.001e-6).contains(&more),
                "{polygons} {gap}: {more:e}"
            );
        }
    }
}

#[test]
fn the_same_bumpy_pair_again_and_others_for_other_seeds() {
    assert!(bumpy_pair(200, 1) == bumpy_pair(200, 1));
    assert!(bumpy_pair(200, 1) != bumpy_pair(200, 2));
    let coherent = |seed| bumpy_pair_coherent(200, 0.1, seed);
    assert!(coherent(1) == coherent(1) && coherent(1) != coherent(2));
    assert!(scattered(50, 1) == scattered(50, 1) && scattered(50, 1) != scattered(50, 2));
    for make in [puma_random, puma_coherent] {
        assert!(make(1) == make(1) && make(1) != make(2));
    }
}

#[test]
fn the_way_through_scattered_obstacles_is_narrow_and_wide_by_turns() {
    let scene = scattered(500, 2);
    let at = |index: usize| distance(&scene, &scene.poses[index]);
    for (index, most) in [(40, 0.2), (80, 0.2), (120, 0.2), (160, 0.2)] {
        let found = at(index);
        assert!(found > 0.0 && found < most, "{index}: {found}");
    }
    for index in [20, 60, 100, 140, 180] {
        let found = at(index);
        assert!((0.9..1.5).contains(&found), "{index}: {found}");
    }
    let beside_first = scene.poses[192..].iter().chain(&scene.poses[..8]);
    let least = beside_first.map(|pose| distance(&scene, pose));
    assert_eq!(least.fold(f64::INFINITY, f64::min), 0.0);
}
