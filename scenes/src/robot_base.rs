//! The base part of a robot.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::lathe::lathe;
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::prism::{cuboid, prism};
use crate::random::Random;
use crate::tube::bar;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// The base part of a robot, 276 polygons: a flanged round pedestal with a turret on top, four bolt bosses and four
/// ribs on the flange, a cable box with a connector at the side.
///
/// About 0.8 wide and 0.75 high, standing on z = 0. A union of closed parts that overlap. Reconstructs the model of
/// figure 6 (§3.3.2), of which the report gives the count.
pub fn robot_base() -> Mesh {
    let pedestal = lathe(
        &[
            [0.40, 0.0],
            [0.40, 0.05],
            [0.38, 0.07],
            [0.24, 0.09],
            [0.20, 0.45],
            [0.24, 0.50],
            [0.24, 0.62],
            [0.20, 0.66],
        ],
        20,
    );
    let turret = lathe(&[[0.14, 0.60], [0.14, 0.72], [0.11, 0.75]], 12);
    let boss = lathe(&[[0.045, 0.04], [0.045, 0.10], [0.03, 0.115]], 8)
        .moved(&Pose::translation([0.33, 0.0, 0.0]));
    let rib = prism(&[[0.19, 0.05], [0.36, 0.05], [0.19, 0.36]], -0.025, 0.025)
        .moved(&Pose::rotation([1.0, 0.0, 0.0], FRAC_PI_2));
    let cable_box = cuboid([-0.34, -0.09, 0.40], [-0.17, 0.09, 0.58]);
    let connector = bar([-0.33, 0.0, 0.49], [-0.40, 0.0, 0.49], 0.04, 8);

    let mut base = Mesh::union([pedestal, turret, cable_box, connector]);
    for quarter in 0..4 {
        let angle = FRAC_PI_2 * f64::from(quarter);
        base.append(&boss.moved(&Pose::rotation(UP, angle + PI / 4.0)));
        base.append(&rib.moved(&Pose::rotation(UP, angle)));
    }
    base
}

/// `count` robot bases: one in place, the others turned and moved at random, so that some overlap.
///
/// 44 of them have 12144 polygons: reconstructs the input of figure 9 (§3.3.2), "replicating and randomly moving the
/// robot base model 43 times".
pub fn robot_bases(count: usize, seed: u64) -> Mesh {
    scattered(&robot_base(), count, 0.9, seed)
}

/// `count` copies of `model`, the first in place, the others at random poses in a cube with `spacing` cubed of room
/// each.
pub(crate) fn scattered(model: &Mesh, count: usize, spacing: f64, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let half = spacing * (count as f64).cbrt() / 2.0;
    let mut copies = Mesh::default();
    for copy in 0..count {
        let pose = match copy {
            0 => Pose::identity(),
            _ => {
                let turn = random.rotation();
                Pose::translation(random.point(half)).compose(&turn)
            }
        };
        copies.append(&model.moved(&pose));
    }
    copies
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_the_report() {
        assert_eq!(robot_base().polygons(), 276);
        assert_eq!(robot_bases(44, 1).polygons(), 12144);
    }

    #[test]
    fn the_first_copy_stays_in_place() {
        let base = robot_base();
        let several = robot_bases(3, 5);
        assert_eq!(several.vertices[..base.vertices.len()], base.vertices);
    }
}
