//! A desk lamp.

use std::f64::consts::FRAC_PI_2;

use crate::lathe::{directions, lathe, ring};
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::Point;
use crate::prism::prism;
use crate::robot_base::scattered;
use crate::tube::bar;

const SHOULDER: Point = [0.0, 0.0, 0.14];
const ELBOW: Point = [-0.40, 0.0, 0.75];
const HEAD: Point = [0.35, 0.0, 1.0];

/// A desk lamp, 626 polygons: a heavy round foot with a switch, two arms of two thin bars each, three joints, a
/// conical shade of sheet metal, open below, and a bulb in it.
///
/// About 1.06 long, 0.4 wide and 1.04 high, standing on z = 0. The sides of the arms are quads up to 0.8 long and
/// 0.008 wide, "the polygons that model the surface of the lamp arm" (§3.4). A union of closed parts that overlap.
/// Reconstructs the model of figures 3 and 7 (§2.3.5, §3.3.2), of which the report gives the count.
pub fn lamp() -> Mesh {
    let foot = lathe(
        &[
            [0.20, 0.0],
            [0.20, 0.02],
            [0.19, 0.03],
            [0.12, 0.045],
            [0.06, 0.05],
            [0.05, 0.07],
            [0.045, 0.09],
            [0.04, 0.11],
            [0.03, 0.12],
        ],
        32,
    );
    let knob: Vec<[f64; 2]> = directions(6)
        .iter()
        .map(|[c, s]| [0.13 + 0.02 * c, 0.02 * s])
        .collect();
    let switch = prism(&knob, 0.035, 0.055);

    let mut lamp = Mesh::union([foot, switch, head()]);
    for side in [-1.0, 1.0] {
        lamp.append(&arm(SHOULDER, ELBOW, 0.034 * side));
        lamp.append(&arm(ELBOW, HEAD, 0.012 * side));
    }
    for centre in [SHOULDER, ELBOW, HEAD] {
        lamp.append(&joint(centre));
    }
    lamp
}

/// `count` lamps: one in place, the others turned and moved at random, so that some overlap a little.
///
/// 5 of them have 3130 polygons: reconstructs the input of figure 8 (§3.3.2), "replicating and randomly moving the
/// lamp model four times".
pub fn lamps(count: usize, seed: u64) -> Mesh {
    scattered(&lamp(), count, 0.9, seed)
}

/// One bar of an arm, `aside` from the plane of the lamp.
fn arm(from: Point, to: Point, aside: f64) -> Mesh {
    let shift = |[x, y, z]: Point| [x, y + aside, z];
    bar(shift(from), shift(to), 0.01, 8)
}

/// A bevelled cylinder across the arms.
fn joint(centre: Point) -> Mesh {
    let profile = [
        [0.028, -0.05],
        [0.036, -0.042],
        [0.036, 0.042],
        [0.028, 0.05],
    ];
    let across = Pose::rotation([1.0, 0.0, 0.0], FRAC_PI_2);
    lathe(&profile, 12).moved(&Pose::translation(centre).compose(&across))
}

/// Shade and bulb, hanging from the upper arm and tilted forward.
fn head() -> Mesh {
    let shade = ring(
        &[
            [0.18, -0.25],
            [0.06, -0.02],
            [0.045, 0.0],
            [0.035, 0.0],
            [0.05, -0.03],
            [0.17, -0.25],
        ],
        24,
    );
    let bulb = lathe(
        &[
            [0.015, -0.17],
            [0.035, -0.15],
            [0.042, -0.12],
            [0.03, -0.08],
            [0.025, -0.05],
            [0.038, -0.04],
            [0.038, 0.03],
        ],
        10,
    );
    let tilt = Pose::rotation([0.0, 1.0, 0.0], -0.35);
    let below = Pose::translation([0.0, 0.0, -0.045]);
    let pose = Pose::translation(HEAD).compose(&tilt).compose(&below);
    Mesh::union([shade, bulb]).moved(&pose)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_the_report() {
        assert_eq!(lamp().polygons(), 626);
        assert_eq!(lamps(5, 1).polygons(), 3130);
    }
}
