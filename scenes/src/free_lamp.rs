//! FL: a lamp flies freely.

use std::f64::consts::FRAC_PI_2;

use crate::curve::bezier;
use crate::lamp::lamp;
use crate::lathe::{sphere, torus};
use crate::mesh::Mesh;
use crate::motion::{Pose, polyline};
use crate::point::Point;
use crate::robot_base::robot_base;
use crate::scene::{Changes, Scene};
use crate::tube::tube;

/// FL: the lamp (626 polygons) flies 4.9 units along x past a robot base and a ball, through a hoop, past another
/// robot base and under an arch, in 200 poses, without touching; the five obstacles have 1526 polygons.
///
/// Reconstructs figure 3 of §2.3.5, "an example typical of gross-motion problems or free-flight". The distance is
/// between 0.17 and 0.65, above the threshold of 0.1 that the report used there.
pub fn free_lamp() -> Scene {
    scene("FL".into(), Changes::none())
}

/// FL with every obstacle and waypoint moved by up to 0.02 along each axis and the robot bases turned; still without
/// touching.
pub fn free_lamp_seeded(seed: u64) -> Scene {
    scene(format!("FL {seed}"), Changes::seeded(seed))
}

fn scene(name: String, mut changes: Changes) -> Scene {
    let waypoints = [
        [0.0, 0.0, 0.0],
        [1.2, 0.2, 0.3],
        [2.4, -0.2, 0.1],
        [3.6, 0.1, 0.4],
        [4.8, 0.0, 0.0],
    ]
    .map(|p| changes.point(p, 0.02));
    let mut base = || {
        let angle = changes.number(FRAC_PI_2);
        robot_base().moved(&Pose::rotation([0.0, 0.0, 1.0], angle))
    };
    let bases = [base(), base()];
    let mut placed = |mesh: &Mesh, at: Point| {
        let at = changes.point(at, 0.02);
        mesh.moved(&Pose::translation(at))
    };
    Scene {
        name,
        moving: lamp(),
        obstacles: vec![
            placed(&bases[0], [1.1, -0.75, 0.0]),
            placed(&sphere(0.4, 30, 13), [0.9, 0.95, 0.8]),
            placed(&hoop(), [2.4, -0.2, 0.65]),
            placed(&bases[1], [3.6, 0.95, 0.0]),
            placed(&arch(), [4.2, 0.0, -0.22]),
        ],
        poses: polyline(&waypoints, 200),
    }
}

/// A ring to fly through along x, 384 polygons.
fn hoop() -> Mesh {
    torus(0.85, 0.08, 24, 16).moved(&Pose::rotation([0.0, 1.0, 0.0], FRAC_PI_2))
}

/// A bent pipe to fly under along x, 200 polygons.
fn arch() -> Mesh {
    let path: [Point; 4] = [
        [0.0, -0.9, 0.0],
        [0.0, -0.9, 2.5],
        [0.0, 0.9, 2.5],
        [0.0, 0.9, 0.0],
    ];
    tube(&bezier(path, 18), &[0.07; 19], 11)
}
