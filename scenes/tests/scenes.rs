//! What the documentation says of the scenes, by brute force.

mod support;

use std::f64::consts::PI;

use cstk_scenes::*;
use support::{distance, distances_within};

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
