//! Whether two boxes are within a distance of one another, by the separating axis test: the boxes' axes, and the cross products
//! of two.

use super::placed::PlacedPrimitive;
use crate::gjk::DistanceLimits;
use crate::lanes::{Instructions, Work, each3, with_widest};
use crate::pose::{turned, turned_axes, turned_back};
use crate::primitive::Cuboid;
use crate::tolerance;

/// The rounding error of a gap, in L: of the two centres, of a box's vertices against its corners, and of the sum of six
/// rotated half extents.
const GAP_ERROR: f64 = 64.0 * tolerance::EPSILON;

/// `Some(true)` if two boxes meet, `Some(false)` if they are farther apart than the cutoff, else `None`. `size` is no less than
/// any coordinate of the two.
pub fn cuboids_within(
    placed: [&PlacedPrimitive; 2],
    cuboids: [&Cuboid; 2],
    size: f64,
    limits: DistanceLimits,
) -> Option<bool> {
    with_widest(Axes {
        placed,
        cuboids,
        error: GAP_ERROR * size,
        size,
        cutoff: limits.cutoff,
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
        let [a, b] = self.placed;
        let [on_a, on_b] = self.cuboids;
        // Everything in the frame of A's box.
        let axes = a.turned_axes(&on_a.axes).transpose();
        let between = b.moved(&on_b.center) - a.moved(&on_a.center);
        let between = turned(&axes, &between);
        let turn = turned_axes(&axes, &b.turned_axes(&on_b.axes));
        let (half_a, half_b) = (on_a.half, on_b.half);
        let extent_of_b = each3(|i| {
            let part = |j: usize| turn[(i, j)].abs() * half_b[j];
            part(0) + part(1) + part(2)
        });
        let extent_of_a = each3(|j| {
            let part = |i: usize| turn[(i, j)].abs() * half_a[i];
            part(0) + part(1) + part(2)
        });
        let seen_by_b = turned_back(&turn, &between);
        let across_a = each3(|k| between[k].abs() - half_a[k] - extent_of_b[k]);
        let across_b = each3(|k| seen_by_b[k].abs() - half_b[k] - extent_of_a[k]);
        let most = |gaps: [f64; 3]| gaps[0].max(gaps[1]).max(gaps[2]);
        let across = most(across_a).max(most(across_b));
        if across > self.cutoff + self.error {
            return Some(false);
        }
        let mut meet = across < -self.error;
        for i in 0..3 {
            let (next, last) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (up, down) = (turn[(next, j)], turn[(last, j)]);
                let length = (up * up + down * down).sqrt();
                if length < tolerance::PARALLEL_EDGES {
                    // If the cross product of nearly parallel edges separates the boxes, so does a face axis once one box is
                    // rotated until the edges are parallel.
                    meet &= across < -(8.0 * length * self.size + self.error);
                    continue;
                }
                let apart = (between[last] * up - between[next] * down).abs();
                let (next_b, last_b) = ((j + 1) % 3, (j + 2) % 3);
                let extent = half_a[next] * down.abs()
                    + half_a[last] * up.abs()
                    + half_b[next_b] * turn[(i, last_b)].abs()
                    + half_b[last_b] * turn[(i, next_b)].abs();
                let gap = apart - extent;
                if gap > length * self.cutoff + self.error {
                    return Some(false);
                }
                meet &= gap < -self.error;
            }
        }
        meet.then_some(true)
    }
}
