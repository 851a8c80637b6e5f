//! Two boxes and the axes that may separate them: those of their faces, and the cross products of two edges.

use super::placed::PlacedPrimitive;
use crate::lanes::each3;
use crate::pose::{Mat3, Vec3, turned, turned_axes, turned_back};
use crate::primitive::Cuboid;
use crate::tolerance;

/// The rounding error of a gap, in L: of the two centres, of a box's vertices against its corners, and of the sum of six
/// rotated half extents.
pub const GAP_ERROR: f64 = 64.0 * tolerance::EPSILON;

/// Two boxes in the frame of the first, at its centre.
pub struct CuboidAxes {
    pub half_a: Vec3,
    pub half_b: Vec3,
    /// The centre of B.
    pub between: Vec3,
    /// The centre of B seen along the axes of B.
    pub seen_by_b: Vec3,
    /// The axes of B as columns.
    pub turn: Mat3,
}

/// The gap of two boxes along the cross product of an edge of each.
pub struct EdgeGap {
    /// The gap times the length of the cross product.
    pub gap: f64,
    /// The length of the cross product of the edges' directions.
    pub length: f64,
}

impl CuboidAxes {
    #[inline(always)]
    pub fn new([a, b]: [&PlacedPrimitive; 2], [on_a, on_b]: [&Cuboid; 2]) -> Self {
        let axes = a.turned_axes(&on_a.axes).transpose();
        let between = turned(&axes, &(b.moved(&on_b.center) - a.moved(&on_a.center)));
        let turn = turned_axes(&axes, &b.turned_axes(&on_b.axes));
        Self {
            half_a: on_a.half,
            half_b: on_b.half,
            between,
            seen_by_b: turned_back(&turn, &between),
            turn,
        }
    }

    /// The gaps along the normals of A's faces.
    #[inline(always)]
    pub fn gaps_at_a(&self) -> [f64; 3] {
        each3(|i| {
            let part = |j: usize| self.turn[(i, j)].abs() * self.half_b[j];
            self.between[i].abs() - self.half_a[i] - (part(0) + part(1) + part(2))
        })
    }

    /// The gaps along the normals of B's faces.
    #[inline(always)]
    pub fn gaps_at_b(&self) -> [f64; 3] {
        each3(|j| {
            let part = |i: usize| self.turn[(i, j)].abs() * self.half_a[i];
            self.seen_by_b[j].abs() - self.half_b[j] - (part(0) + part(1) + part(2))
        })
    }

    /// The gap along the cross product of A's axis i and B's axis j.
    #[inline(always)]
    pub fn edge_gap(&self, i: usize, j: usize) -> EdgeGap {
        let (turn, between) = (&self.turn, &self.between);
        let (half_a, half_b) = (&self.half_a, &self.half_b);
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        let (next_b, last_b) = ((j + 1) % 3, (j + 2) % 3);
        let (up, down) = (turn[(next, j)], turn[(last, j)]);
        let apart = (between[last] * up - between[next] * down).abs();
        let extent = half_a[next] * down.abs()
            + half_a[last] * up.abs()
            + half_b[next_b] * turn[(i, last_b)].abs()
            + half_b[last_b] * turn[(i, next_b)].abs();
        EdgeGap {
            gap: apart - extent,
            length: (up * up + down * down).sqrt(),
        }
    }

    /// The cross product of A's axis i and B's axis j, from A to B.
    #[inline(always)]
    pub fn across_edges(&self, i: usize, j: usize) -> Vec3 {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        let mut across = Vec3::zeros();
        across[next] = -self.turn[(last, j)];
        across[last] = self.turn[(next, j)];
        if across.dot(&self.between) < 0.0 {
            -across
        } else {
            across
        }
    }
}
