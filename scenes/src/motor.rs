//! The motor of the gear, plate and motor.

use std::f64::consts::TAU;

use crate::curve::{rounded_on, straight_on};
use crate::gear::{BORE, CLEARANCE, SIDES, corner_radius};
use crate::lathe::{directions, lathe};
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::prism::{cuboid, prism};

/// The height of the spindle's end.
pub(crate) const TOP: f64 = 0.9;

/// How much lower the flats of the spindle end.
pub(crate) const CHAMFER: f64 = 0.01;

/// An electric motor, 2252 polygons, with its axis on z, from z = 0 to 0.9: a round housing with fins, feet, a
/// terminal box and a bolted flange, and a spindle of 56 flats 0.09875 from the axis from z = 0.65 up.
///
/// A union of closed parts that overlap; housing and spindle are one. Reconstructs the motor of figure 5 (§2.3.5), of
/// which the report gives the count.
pub fn motor() -> Mesh {
    let terminals = [
        cuboid([0.28, -0.09, 0.18], [0.46, 0.09, 0.38]),
        cuboid([0.455, -0.10, 0.17], [0.475, 0.10, 0.39]),
        cuboid([0.38, 0.08, 0.22], [0.45, 0.10, 0.34]),
    ];
    let fin = cuboid([0.30, -0.01, 0.10], [0.37, 0.01, 0.46]);
    let foot = cuboid([0.25, -0.04, 0.015], [0.38, 0.04, 0.065]);
    let head: Vec<[f64; 2]> = directions(6)
        .iter()
        .map(|[c, s]| [0.29 + 0.025 * c, 0.025 * s])
        .collect();
    let bolt = prism(&head, 0.57, 0.61);

    let mut motor = housing();
    terminals.iter().for_each(|part| motor.append(part));
    // The fins leave room for the terminal box.
    around(
        &mut motor,
        &fin,
        (0..24).map(|k| (30.0 + 300.0 * f64::from(k) / 23.0) / 360.0),
    );
    around(
        &mut motor,
        &foot,
        (0..4).map(|k| 0.125 + 0.25 * f64::from(k)),
    );
    around(&mut motor, &bolt, (0..6).map(|k| f64::from(k) / 6.0));
    motor
}

/// Adds `part` at each of these fractions of a turn about the axis.
fn around(motor: &mut Mesh, part: &Mesh, turns: impl Iterator<Item = f64>) {
    for turn in turns {
        motor.append(&part.moved(&Pose::rotation([0.0, 0.0, 1.0], TAU * turn)));
    }
}

fn housing() -> Mesh {
    let spindle = corner_radius(BORE - CLEARANCE);
    let mut profile = vec![[0.26, 0.0]];
    rounded_on(&mut profile, [0.32, 0.0], [0.32, 0.06], 6);
    straight_on(&mut profile, [0.32, 0.50], 8);
    straight_on(&mut profile, [0.36, 0.50], 1);
    straight_on(&mut profile, [0.36, 0.56], 2);
    rounded_on(&mut profile, [0.36, 0.58], [0.34, 0.58], 3);
    straight_on(&mut profile, [0.20, 0.58], 5);
    rounded_on(&mut profile, [0.17, 0.58], [0.17, 0.61], 4);
    straight_on(&mut profile, [0.17, 0.64], 1);
    rounded_on(&mut profile, [0.17, 0.65], [0.16, 0.65], 2);
    straight_on(&mut profile, [spindle, 0.65], 2);
    straight_on(&mut profile, [spindle, TOP - CHAMFER], 1);
    straight_on(&mut profile, [spindle - CHAMFER, TOP], 1);
    lathe(&profile, SIDES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn count_of_the_report() {
        assert_eq!(motor().polygons(), 2252);
    }
}
