//! Lower bounds of the distance between one oriented box and eight others, in single precision.
//!
//! For a direction n, two sets are apart by at least |n . (c - c')| less what each reaches from its centre c, c' along n.
//! Along the three axes of one box such gaps are the sides of a box between the sets, whose diagonal bounds the distance;
//! the larger of the two diagonals counts.
//!
//! Axes: with those of a box as rows of M, M M^T differs from the identity by less than e = 2^-12 (see `WideNode`: each
//! component is within 2^-16, or 2^-15 for one that is 1). Along its own axes the half sides say what a box reaches, along
//! others the sum of what the sides do (see `PackedBox`), so each gap holds as it is. The diagonal of three may be too long
//! by the root of 1 + e, for which [`UPRIGHT`] shortens it.
//!
//! Rounding: let u = 2^-24, and S the pair's size, which no vertex, centre or translation exceeds; a half side is at most
//! the radius of its body, so that the three of a box add up to at most 3 S. Axes, centres and half sides are what the
//! boxes hold their points by; the motion's rotation and translation are within u of what they stand for in each component.
//! Brought into the other frame, a centre takes three products and three sums: with the rounding of the motion, it is within
//! 8 u S, its difference from another centre within 9 u S in each component, and the projection of that on an axis within
//! 24 u S. An axis brought over is within 5 u in each component, its product with another within 13 u, so that the reach of
//! a box is within 39 u S for those and 7 u S for the sum. A gap is thus within 70 u S, a diagonal within sqrt(3) times
//! that. In all less than 140 u S, for which [`ROUNDING`] is taken off. A direction given in double precision and turned
//! into a frame is within 6 u of unit length, its gap within 100 u S by the same count.

use crate::hierarchy::{EightBoxes, PackedBox};
use crate::lanes::{F32x8, Points32, along32, dot32, each3};

/// The rounding of a bound, times the pair's size: 256 * 2^-24.
pub const ROUNDING: f64 = 1.0 / 65536.0;

/// What is left of a diagonal for certain.
const UPRIGHT: f32 = 1.0 - 1.0 / 8192.0;

/// A rigid motion from one body's frame to the other's, in units of the pair.
#[derive(Clone, Copy, Debug)]
pub struct Motion32 {
    /// By columns.
    pub rotation: [[f32; 3]; 3],
    pub translation: [f32; 3],
    /// The unit of the body that moves, in units of the pair.
    pub factor: f32,
}

impl Motion32 {
    #[inline(always)]
    pub fn turn(&self, v: &[f32; 3]) -> [f32; 3] {
        let [x, y, z] = &self.rotation;
        each3(|k| x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }

    /// A box in the other frame, in units of the pair.
    #[inline(always)]
    pub fn apply(&self, given: &PackedBox) -> PackedBox {
        let center = self.turn(&each3(|k| given.center[k] * self.factor));
        PackedBox {
            axes: each3(|i| self.turn(&given.axes[i])),
            center: each3(|k| center[k] + self.translation[k]),
            half: each3(|i| given.half[i] * self.factor),
        }
    }
}

/// Lower bounds of the distances of eight boxes from one, in units of the pair; where the boxes overlap, how deep they do
/// as a number below 0.
// Indices are those of the axes in the formulas.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub fn bounds(eight: &EightBoxes, one: &PackedBox) -> F32x8 {
    let apart: Points32 = each3(|k| F32x8::splat(one.center[k]) - eight.center[k]);
    let halves = &eight.half;
    // The reach of the one along the axes of the eight, and of the eight along those of the one.
    let mut reaches = [F32x8::splat(0.0); 3];
    let mut square = F32x8::splat(0.0);
    let mut deepest = F32x8::splat(f32::NEG_INFINITY);
    for i in 0..3 {
        let axis = &eight.axes[i];
        let mut reach = halves[i];
        for j in 0..3 {
            let along = along32(axis, &one.axes[j]).abs();
            reach = reach + along * one.half[j];
            reaches[j] = reaches[j] + along * halves[i];
        }
        let gap = dot32(axis, &apart).abs() - reach;
        deepest = deepest.max(gap);
        let gap = gap.max(F32x8::splat(0.0));
        square = square + gap * gap;
    }
    let mut other = F32x8::splat(0.0);
    for j in 0..3 {
        let gap = along32(&apart, &one.axes[j]).abs() - reaches[j] - F32x8::splat(one.half[j]);
        deepest = deepest.max(gap);
        let gap = gap.max(F32x8::splat(0.0));
        other = other + gap * gap;
    }
    // Where no gap is above 0 the diagonal is 0.
    let diagonal = square.max(other).sqrt() * UPRIGHT;
    diagonal + deepest.min(F32x8::splat(0.0))
}

/// Lower bounds of the same distances along a unit vector from the eight to the one; negative where they may overlap.
// Indices are those of the axes in the formulas.
#[allow(clippy::needless_range_loop)]
#[inline(always)]
pub fn gaps_along(eight: &EightBoxes, one: &PackedBox, direction: &[f32; 3]) -> F32x8 {
    let apart: Points32 = each3(|k| F32x8::splat(one.center[k]) - eight.center[k]);
    let mut reach = F32x8::splat(0.0);
    let mut across = 0.0;
    for i in 0..3 {
        reach = reach + along32(&eight.axes[i], direction).abs() * eight.half[i];
        across += dot(&one.axes[i], direction).abs() * one.half[i];
    }
    along32(&apart, direction) - reach - F32x8::splat(across)
}

/// How far apart two boxes are along a unit vector from the first to the second, at least; negative where they may meet.
#[inline(always)]
pub fn gap_along(first: &PackedBox, second: &PackedBox, direction: &[f32; 3]) -> f32 {
    let reach = |given: &PackedBox| {
        let [x, y, z] = each3(|i| dot(&given.axes[i], direction).abs() * given.half[i]);
        x + y + z
    };
    let apart = each3(|k| second.center[k] - first.center[k]);
    dot(&apart, direction) - reach(first) - reach(second)
}

#[inline(always)]
fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
