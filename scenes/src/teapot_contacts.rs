//! FP: a teapot in contact at the beginning, in the middle and at the end.

use crate::curve::straight_on;
use crate::lathe::{lathe, sphere, torus};
use crate::mesh::Mesh;
use crate::motion::{Pose, stop_and_go};
use crate::point::{Point, plus};
use crate::robot_base::robot_base;
use crate::scene::{Changes, Scene};
use crate::teapot::teapot;

/// How deep the teapot is in what it touches.
const DEPTH: f64 = 0.002;

/// From the teapot's origin to the pole of the ball that it touches with its lid, and on to the ball's centre.
const BALL: Point = [0.0, 0.0, 0.79 - DEPTH + 0.4];

/// FP: the teapot (1920 polygons) travels from a pedestal, past a robot base, to a ball that hangs over it, past a
/// ring and down into a basin, in 200 poses; the five obstacles have 3020 polygons.
///
/// Reconstructs figure 4 of §2.3.5, "an example in which both contact and large distances occur … mostly obscured in
/// the last frame". At the beginning, in the middle (poses 99 and 100 of 0 to 199) and at the end the surfaces
/// intersect by 0.002, and the motion comes to rest there; between them the distance grows to more than 0.5.
pub fn teapot_contacts() -> Scene {
    scene("FP".into(), Changes::none())
}

/// FP with the ball and the basin, and the places where they are touched, moved by up to 0.2, the other waypoints and
/// obstacles by up to 0.1 along each axis; the contacts are those of [`teapot_contacts`].
pub fn teapot_contacts_seeded(seed: u64) -> Scene {
    scene(format!("FP {seed}"), Changes::seeded(seed))
}

fn scene(name: String, mut changes: Changes) -> Scene {
    let up = changes.point([1.8, 0.0, 0.9], 0.1);
    let ball = changes.point([3.0, 0.0, 2.0], 0.2);
    let basin_place = changes.point([6.0, 0.0, 0.0], 0.2);
    let over = plus(basin_place, changes.point([-0.2, 0.0, 1.7], 0.1));
    let waypoints = [
        [0.0, 0.0, -DEPTH],
        up,
        ball,
        over,
        plus(basin_place, [0.0, 0.0, -DEPTH]),
    ];
    let placed = |mesh: Mesh, at: Point| mesh.moved(&Pose::translation(at));
    Scene {
        name,
        moving: teapot(),
        obstacles: vec![
            pedestal(),
            placed(robot_base(), changes.point([1.5, 1.3, 0.0], 0.1)),
            placed(sphere(0.4, 40, 22), plus(ball, BALL)),
            placed(
                torus(0.6, 0.15, 36, 17),
                changes.point([4.4, -1.6, 1.6], 0.1),
            ),
            placed(basin(), basin_place),
        ],
        poses: stop_and_go(&waypoints, 200),
    }
}

/// A stand with its top at z = 0, 290 polygons.
fn pedestal() -> Mesh {
    let mut profile = vec![[0.45, -0.8]];
    straight_on(&mut profile, [0.45, -0.75], 1);
    straight_on(&mut profile, [0.2, -0.7], 2);
    straight_on(&mut profile, [0.2, -0.1], 3);
    straight_on(&mut profile, [0.4, -0.05], 2);
    straight_on(&mut profile, [0.4, 0.0], 1);
    lathe(&profile, 32)
}

/// A bowl 0.7 deep with its floor at z = 0, 962 polygons.
fn basin() -> Mesh {
    let mut profile = vec![[0.75, -0.1]];
    straight_on(&mut profile, [1.22, 0.7], 10);
    straight_on(&mut profile, [1.15, 0.7], 1);
    straight_on(&mut profile, [0.7, 0.0], 10);
    straight_on(&mut profile, [0.3, 0.0], 3);
    lathe(&profile, 40)
}
