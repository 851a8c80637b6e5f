//! Whether two boxes are within a distance of one another, by the separating axis test.

use super::cuboid_axes::{CuboidAxes, EdgeGap, GAP_ERROR};
use super::placed::PlacedPrimitive;
use crate::lanes::{Instructions, Work, with_widest};
use crate::primitive::Cuboid;
use crate::tolerance;

/// `Some(true)` if two boxes meet, `Some(false)` if they are farther apart than the cutoff, else `None`. `size` is no less than
/// any coordinate of the two.
pub fn cuboids_within(
    placed: [&PlacedPrimitive; 2],
    cuboids: [&Cuboid; 2],
    size: f64,
    cutoff: f64,
) -> Option<bool> {
    with_widest(Axes {
        placed,
        cuboids,
        error: GAP_ERROR * size,
        size,
        cutoff,
    })
}

struct Axes<'a> {
    placed: [&'a PlacedPrimitive<'a>; 2],
    cuboids: [&'a Cuboid; 2],
    size: f64,
    error: f64,
    cutoff: f64,
}

impl Work for Axes<'_> {
    type Output = Option<bool>;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Option<bool> {
        let axes = CuboidAxes::new(self.placed, self.cuboids);
        let most = |gaps: [f64; 3]| gaps[0].max(gaps[1]).max(gaps[2]);
        let across = most(axes.gaps_at_a()).max(most(axes.gaps_at_b()));
        if across > self.cutoff + self.error {
            return Some(false);
        }
        let mut meet = across < -self.error;
        for i in 0..3 {
            for j in 0..3 {
                let EdgeGap { gap, length } = axes.edge_gap(i, j);
                if length < tolerance::PARALLEL_EDGES {
                    // If the cross product of nearly parallel edges separates the boxes, so does a face axis once one box is
                    // rotated until the edges are parallel.
                    meet &= across < -(8.0 * length * self.size + self.error);
                    continue;
                }
                if gap > length * self.cutoff + self.error {
                    return Some(false);
                }
                meet &= gap < -self.error;
            }
        }
        meet.then_some(true)
    }
}
