//! GPM: a gear drops through a plate and onto a spindle.

use crate::gear::{SIDES, gear};
use crate::mesh::Mesh;
use crate::motion::{Pose, polyline};
use crate::motor::{TOP, motor};
use crate::plate::plate;
use crate::scene::{Changes, Scene};

/// The height of the gear's lower face at the end: the last 22.5 % of the way are below the end of the spindle.
const SEAT: f64 = TOP - 0.225;

/// The height of the plate's lower face.
const PLATE: f64 = 1.2;

/// GPM: the gear (3920 polygons) drops one unit straight through the hole in the plate (4054) and onto the spindle of
/// the motor (2252), in 200 poses, without touching.
///
/// Reconstructs figure 5 of §2.3.5. Gear, hole and spindle are coaxial polygons with parallel flats: between bore and
/// spindle there are exactly 0.00125 (but for rounding), and between tooth tips and hole as well, as "in both cases …
/// there are many pairs of polygons approximately the minimal distance (0.00125) apart". The teeth are in the hole
/// from pose 97 to pose 134 of 0 to 199, up to 686 pairs within 0.00128; the bore is over the flats of the spindle in
/// the last 21 % of the way, from pose 158, where 504 pairs are that near.
pub fn gear_plate_motor() -> Scene {
    scene("GPM".into(), Changes::none())
}

/// GPM with the plate at another height, the gear and the plate turned by some of their teeth and flats, and the world
/// turned about the axis of motion; clearances and the end of the motion are those of [`gear_plate_motor`].
pub fn gear_plate_motor_seeded(seed: u64) -> Scene {
    scene(format!("GPM {seed}"), Changes::seeded(seed))
}

fn scene(name: String, mut changes: Changes) -> Scene {
    let half_turn = std::f64::consts::PI;
    let world = changes.number(half_turn);
    let flats = |n: f64| world + 2.0 * half_turn * n.round() / SIDES as f64;
    let upright = |mesh: Mesh, angle: f64, z: f64| {
        let turn = Pose::rotation([0.0, 0.0, 1.0], angle);
        mesh.moved(&Pose::translation([0.0, 0.0, z]).compose(&turn))
    };
    let gear = upright(gear(), flats(changes.number(28.0)), 0.0);
    let plate = upright(
        plate(),
        flats(changes.number(28.0)),
        PLATE + changes.number(0.02),
    );
    let motor = upright(motor(), world, 0.0);
    Scene {
        name,
        moving: gear,
        obstacles: vec![plate, motor],
        poses: polyline(&[[0.0, 0.0, SEAT + 1.0], [0.0, 0.0, SEAT]], 200),
    }
}
