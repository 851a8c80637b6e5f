//! The gear of the gear, plate and motor, and the measures the three have in common.

use std::f64::consts::PI;

use crate::curve::{rounded_on, straight_on};
use crate::lathe::{circle, directions};
use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::point::Point;

/// Corners around gear, hole and spindle. The first corner of each points along x, so their flats are parallel.
pub(crate) const SIDES: usize = 56;

/// The gap between parallel flats: gear bore to spindle, and tooth tips to hole.
pub(crate) const CLEARANCE: f64 = 0.00125;

/// From the axis to a flat of the gear's bore.
pub(crate) const BORE: f64 = 0.1;

/// From the axis to the flat end of a tooth.
pub(crate) const TIP: f64 = 0.3;

/// The height of the gear, which is that of its hub.
pub(crate) const HEIGHT: f64 = 0.26;

/// The radius of the corners of a regular polygon with `SIDES` corners whose flats are `apothem` from the centre.
pub(crate) fn corner_radius(apothem: f64) -> f64 {
    apothem / (PI / SIDES as f64).cos()
}

/// A spur gear, 3920 polygons, with its axis on z, from z = 0 to 0.26, 0.3 in radius: 14 teeth 0.14 high, a thin web
/// with rounded corners, a hub with a bore of 56 flats 0.1 from the axis.
///
/// Of the four corners of a tooth two are at its tip: a flat 0.3 from the axis, parallel to a flat of the plate's
/// hole. One closed part. Reconstructs the moving model of figure 5 (§2.3.5), of which the report gives the count.
pub fn gear() -> Mesh {
    let middle = HEIGHT / 2.0;
    let side = half_section();
    let mut rings: Vec<Vec<Point>> = (0..=11)
        .map(|k| toothed(middle + 0.07 * (2.0 * f64::from(k) / 11.0 - 1.0)))
        .collect();
    rings.extend(side.iter().map(|&[r, h]| circle([r, middle + h], SIDES)));
    rings.extend(
        side.iter()
            .rev()
            .map(|&[r, h]| circle([r, middle - h], SIDES)),
    );
    loft(&rings, Ends::Joined)
}

/// The section of one face of the gear, from the rim inward to the bore, as radius and height over the middle.
fn half_section() -> Vec<[f64; 2]> {
    let mut section = vec![[0.255, 0.07]];
    straight_on(&mut section, [0.225, 0.07], 3);
    rounded_on(&mut section, [0.215, 0.03], [0.205, 0.03], 6);
    straight_on(&mut section, [0.165, 0.03], 6);
    rounded_on(&mut section, [0.14, 0.03], [0.14, 0.06], 6);
    straight_on(&mut section, [0.14, 0.12], 2);
    rounded_on(&mut section, [0.14, 0.13], [0.13, 0.13], 2);
    straight_on(&mut section, [0.106, 0.13], 2);
    section.push([corner_radius(BORE), 0.124]);
    section
}

/// The outline of the teeth at height `z`: root, tip, tip, root and so on.
fn toothed(z: f64) -> Vec<Point> {
    let radii = [0.262, corner_radius(TIP), corner_radius(TIP), 0.262];
    directions(SIDES)
        .iter()
        .zip(radii.iter().cycle())
        .map(|([c, s], r)| [r * c, r * s, z])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn count_of_the_report() {
        assert_eq!(gear().polygons(), 3920);
    }

    #[test]
    fn nothing_is_nearer_to_the_axis_than_the_bore() {
        let least = gear()
            .vertices
            .iter()
            .map(|p| p[0].hypot(p[1]))
            .fold(f64::INFINITY, f64::min);
        assert!((least - corner_radius(BORE)).abs() < 1e-15);
    }
}
