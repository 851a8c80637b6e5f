//! Upright prisms.

use crate::loft::{Ends, loft};
use crate::mesh::Mesh;

/// The prism over a convex counter-clockwise outline, from height `low` to `high`.
pub(crate) fn prism(outline: &[[f64; 2]], low: f64, high: f64) -> Mesh {
    let at = |z: f64| outline.iter().map(|&[x, y]| [x, y, z]).collect();
    loft(&[at(low), at(high)], Ends::Capped)
}

/// The box between two opposite corners.
pub(crate) fn cuboid(low: [f64; 3], high: [f64; 3]) -> Mesh {
    let outline = [
        [low[0], low[1]],
        [high[0], low[1]],
        [high[0], high[1]],
        [low[0], high[1]],
    ];
    prism(&outline, low[2], high[2])
}
