//! Lower bounds of the gap between one moving oriented box and eight others over an interval of time, or over a box of
//! configurations, in single precision.
//!
//! Let the eight rest, and the one turn with angular velocity w and move so that its points x have the velocity v + w x x at the
//! middle of the interval; all is multiplied by half the interval's length. Along an axis n that rests with the eight, the
//! gap at the middle shrinks by no more than |n . u| + sum over its sides e_k a_k of e_k |n . (w x a_k)|, with u the velocity
//! of its centre, and by what the motion bends: half the square of time times the largest acceleration. Along an axis of the
//! one, which moves with it, the same holds of the eight, which move the other way: |n . v + m . c| + sum e_k |m . a_k| with
//! m = n x w and c the centre of each. A small box beside a long one that turns keeps a small term so, and a translation is
//! exact.
//!
//! Where boxes are compared at an end of the interval, they move one way ([`Extension::OneWay`]): with n from the eight to the one,
//! n . u is taken for -|n . u|, and what is then left of the other terms when the boxes part takes nothing off. All of these
//! terms are linear in time but for the bend, which grows with its square: the least gap is at one of the ends.
//!
//! A box of configurations has one such twist for each coordinate: the velocity times half the box's width in it. To first order a
//! configuration of the box moves the points by a sum of these, each times a factor from -1 to 1, so that the terms above are summed
//! over the twists.
//!
//! Rounding, with the terms of [`super::box_bounds`]: let M bound |v| + |w| S. Each component of w x c and of w x a_k takes two
//! products and a difference, is within 4 u M, and with the axis' error of 14 u within 20 u M of what it stands for; a product
//! of two such vectors within 60 u M, the sum of four such terms (sides add up to 3 S, which M has) within 240 u M. Together
//! with the gap's 160 u S less than [`super::ROUNDING`] (S + M) is lost. With N twists M bounds the sum over them, and the errors of
//! the products add up as before; but each of the 4 N sums is rounded too, by at most u times the largest, 4 M: 16 N u M more, of
//! which the first twist's are counted above. That is what [`sum_factor`] adds to M.

use super::box_bounds::{AXIS_FACTOR, dot, extent_along, splat};
use crate::boxes::{EightBoxes, PackedBox};
use crate::convex::Extension;
use crate::lanes::{Instructions, Lanes8, Triple, cross3, each3};

/// Velocities times the time from where boxes are compared to the end of the interval, in units of the pair.
#[derive(Clone, Copy, Debug)]
pub struct Twist32 {
    pub angular: [f32; 3],
    /// Of what is at the origin of the frame.
    pub linear: [f32; 3],
}

/// The largest gaps of eight boxes from one.
pub struct SweptGaps<I: Instructions> {
    /// Where they are compared.
    pub still: Lanes8<I>,
    /// Through all of it.
    pub swept: Lanes8<I>,
}

/// How much more the sums over several twists are rounded than that of one.
pub fn sum_factor(twists: usize) -> f64 {
    1.0 + twists.saturating_sub(1) as f64 / 16.0
}

/// Which gaps are of interest.
#[derive(Clone, Copy, Debug)]
pub struct GapsWanted {
    /// Larger ones need not be known better.
    pub cutoff: f32,
    /// The bit mask of the lanes that hold boxes.
    pub among: u32,
}

/// The largest gap along the axes of the eight and of the one, which has the twists, or of which the eight have the opposite. `bends`
/// are what the acceleration may take off: along axes that rest with the eight, and with the one. Where the axes of the eight part all
/// boxes by more than the cutoff, those of the one are not tried.
#[inline(always)]
pub fn swept_gaps<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    twists: &[Twist32],
    extension: Extension,
    bends: [f32; 2],
    wanted: GapsWanted,
) -> SweptGaps<I> {
    let [x, y, z] = splat(lanes, &one.center);
    let center = &eight.center;
    let apart = [
        lanes.sub(x, center[0]),
        lanes.sub(y, center[1]),
        lanes.sub(z, center[2]),
    ];
    let half = splat(lanes, &one.half);
    let axes = &eight.axes;
    let [first, second, third] = &one.axes;
    let products: [Triple<I>; 3] = [
        [
            lanes.along(&axes[0], first),
            lanes.along(&axes[0], second),
            lanes.along(&axes[0], third),
        ],
        [
            lanes.along(&axes[1], first),
            lanes.along(&axes[1], second),
            lanes.along(&axes[1], third),
        ],
        [
            lanes.along(&axes[2], first),
            lanes.along(&axes[2], second),
            lanes.along(&axes[2], third),
        ],
    ];
    let mut gaps = SweptGaps {
        still: lanes.splat(f32::NEG_INFINITY),
        swept: lanes.splat(f32::NEG_INFINITY),
    };
    let places_of_eight = [
        lanes.dot(&axes[0], &apart),
        lanes.dot(&axes[1], &apart),
        lanes.dot(&axes[2], &apart),
    ];
    let mut of_one = [lanes.splat(bends[0]); 3];
    for twist in twists {
        let turn = cross3(&twist.angular, &one.center);
        let velocity = each3(|k| twist.linear[k] + turn[k]);
        let sides = each3(|j| {
            let turned = cross3(&twist.angular, &one.axes[j]);
            each3(|k| turned[k] * one.half[j])
        });
        for k in 0..3 {
            let shift = lanes.along(&axes[k], &velocity);
            let nearer = nearer(lanes, shift, places_of_eight[k], extension);
            of_one[k] = lanes.add(nearer, of_one[k]);
            for side in &sides {
                of_one[k] = lanes.add(of_one[k], lanes.abs(lanes.along(&axes[k], side)));
            }
        }
    }
    for k in 0..3 {
        let gap = lanes.sub(
            lanes.abs(places_of_eight[k]),
            extent_along(lanes, &products[k], &half, eight.half[k]),
        );
        gaps.offer(lanes, gap, of_one[k], extension);
    }
    let upright = lanes.splat(AXIS_FACTOR);
    let GapsWanted { cutoff, among } = wanted;
    if lanes.not_above(lanes.mul(gaps.swept, upright), cutoff) & among != 0 {
        let places_of_one = [
            lanes.along(&apart, first),
            lanes.along(&apart, second),
            lanes.along(&apart, third),
        ];
        let mut of_eight = [lanes.splat(bends[1]); 3];
        for twist in twists {
            for (j, axis) in one.axes.iter().enumerate() {
                let arm = cross3(axis, &twist.angular);
                let [ax, ay, az] = splat(lanes, &arm);
                let origin = lanes.splat(dot(axis, &twist.linear));
                let first = lanes.mul_add(center[0], ax, origin);
                let at_center = lanes.mul_add(center[2], az, lanes.mul_add(center[1], ay, first));
                let nearer = nearer(lanes, at_center, places_of_one[j], extension);
                let moved = lanes.add(nearer, of_eight[j]);
                let turned = [
                    lanes.along(&axes[0], &arm),
                    lanes.along(&axes[1], &arm),
                    lanes.along(&axes[2], &arm),
                ];
                of_eight[j] = extent_along(lanes, &turned, &eight.half, moved);
            }
        }
        for j in 0..3 {
            let along = [products[0][j], products[1][j], products[2][j]];
            let extent = extent_along(lanes, &along, &eight.half, lanes.splat(one.half[j]));
            let gap = lanes.sub(lanes.abs(places_of_one[j]), extent);
            gaps.offer(lanes, gap, of_eight[j], extension);
        }
    }
    SweptGaps {
        still: lanes.mul(gaps.still, upright),
        swept: lanes.mul(gaps.swept, upright),
    }
}

/// What a shift of a centre takes off its distance from others along an axis, which is the size of `place`.
#[inline(always)]
fn nearer<I: Instructions>(
    lanes: I,
    shift: Lanes8<I>,
    place: Lanes8<I>,
    extension: Extension,
) -> Lanes8<I> {
    match extension {
        Extension::BothWays => lanes.abs(shift),
        Extension::OneWay => lanes.sub(lanes.splat(0.0), lanes.signed_as(shift, place)),
    }
}

impl<I: Instructions> SweptGaps<I> {
    /// Takes in the gap along one axis, and what the motion takes off it.
    #[inline(always)]
    fn offer(&mut self, lanes: I, gap: Lanes8<I>, moved: Lanes8<I>, extension: Extension) {
        let moved = match extension {
            Extension::BothWays => moved,
            // What is no number stays so.
            Extension::OneWay => lanes.max(lanes.splat(0.0), moved),
        };
        self.still = lanes.max(self.still, gap);
        self.swept = lanes.max(self.swept, lanes.sub(gap, moved));
    }
}
