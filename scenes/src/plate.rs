//! The plate of the gear, plate and motor.

use crate::gear::{CLEARANCE, SIDES, TIP, corner_radius};
use crate::lathe::{directions, lathe};
use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::motion::Pose;
use crate::point::{Point, between};

/// The thickness of the plate.
pub(crate) const THICKNESS: f64 = 0.05;

/// Half the side of the plate.
const HALF: f64 = 0.6;

/// Faces between the hole and the edge.
const STEPS: usize = 32;

/// A flat square plate, 4054 polygons, 1.2 wide, from z = 0 to 0.05, with a round hole of 56 flats 0.30125 from the z
/// axis and six rivets in two rows on top.
///
/// Seven closed parts; the rivets overlap the plate. Reconstructs the plate of figure 5 (§2.3.5), of which the report
/// gives the count.
pub fn plate() -> Mesh {
    let mut plate = slab();
    for x in [-0.5, 0.5] {
        for y in [-0.5, 0.0, 0.5] {
            plate.append(&rivet().moved(&Pose::translation([x, y, THICKNESS])));
        }
    }
    plate
}

fn slab() -> Mesh {
    let top = (0..=STEPS).rev().map(|k| outline(k, THICKNESS));
    let bottom = (0..=STEPS).map(|k| outline(k, 0.0));
    let edge = [1.0, 2.0].map(|k| outline(STEPS, THICKNESS * k / 3.0));
    let rings: Vec<Vec<Point>> = top.chain(bottom).chain(edge).collect();
    loft(&rings, Ends::Joined)
}

/// The ring at height `z` that is `step` of the way from the hole to the edge.
fn outline(step: usize, z: f64) -> Vec<Point> {
    let hole = corner_radius(TIP + CLEARANCE);
    directions(SIDES)
        .iter()
        .map(|&[c, s]| {
            let square = HALF / c.abs().max(s.abs());
            let [r] = between([hole], [square], step as f64 / STEPS as f64);
            [r * c, r * s, z]
        })
        .collect()
}

fn rivet() -> Mesh {
    let profile = [
        [0.05, -0.02],
        [0.05, 0.01],
        [0.045, 0.02],
        [0.033, 0.03],
        [0.017, 0.035],
        [0.0, 0.037],
    ];
    lathe(&profile, 8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn count_of_the_report() {
        assert_eq!(plate().polygons(), 4054);
    }

    #[test]
    fn the_edge_is_square() {
        let (low, high) = plate().bounds();
        for k in 0..2 {
            assert!((low[k] + HALF).abs() < 1e-15 && (high[k] - HALF).abs() < 1e-15);
        }
    }
}
