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
//! The axes of two boxes that lie diagonally to each other part them by as little as their distance over the root of 3, which a
//! threshold below the distance may exceed however small the boxes are. There the diagonals of the positive gaps along the axes of the
//! eight, and of the one, are axes too (see [`super::box_bounds`]): as they are where the boxes are compared, at rest with the eight.
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
//! which the first twist's are counted above. That is what [`sum_factor`] adds to M. A diagonal is the computed
//! one, divided by its length: what its products with the axes lose by that is 6 u of 1, so that the two extents lose 36 u S, and the
//! centres' distance 16 u S as before.

use super::box_bounds::{AXIS_FACTOR, apart, diagonals, dot, extent_along, splat};
use crate::boxes::{EightBoxes, PackedBox};
use crate::convex::Extension;
use crate::lanes::{Instructions, Lanes8, Triple, cross3, each_axis, each3};
use crate::pose::Vec3;

/// Velocities times the time from where boxes are compared to the end of the interval, in units of the pair.
#[derive(Clone, Copy, Debug)]
pub struct Twist32 {
    pub angular: [f32; 3],
    /// Of what is at the origin of the frame.
    pub linear: [f32; 3],
}

/// Lengths in single precision, as what boxes are compared by has them: times the inverse of a unit.
#[derive(Clone, Copy)]
pub struct SingleUnits {
    pub inverse: f64,
}

impl SingleUnits {
    #[inline(always)]
    pub fn twist(self, linear: &Vec3, angular: &Vec3) -> Twist32 {
        Twist32 {
            angular: each3(|k| angular[k] as f32),
            linear: each3(|k| (linear[k] * self.inverse) as f32),
        }
    }

    /// No less than a length.
    #[inline(always)]
    pub fn above(self, length: f64) -> f32 {
        ((length * self.inverse) as f32).next_up()
    }

    /// [`BoxSweep::bends`]: a thousandth covers the axes' lengths in single precision (see `pair::box_bounds`).
    #[inline(always)]
    pub fn bends(self, bends: [f64; 2]) -> [f32; 2] {
        bends.map(|x| self.above(x) * 1.001)
    }
}

/// How one box moves against eight others, from where they are compared.
#[derive(Clone, Copy, Debug)]
pub struct BoxSweep<'a> {
    /// Those of the one, or the opposite of those of the eight.
    pub twists: &'a [Twist32],
    pub extension: Extension,
    /// What the acceleration may take off: along axes that rest with the eight, and with the one.
    pub bends: [f32; 2],
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

/// Cutoffs above this, in units of the pair, hold a threshold and not rounding alone.
const CUTOFF_OF_THRESHOLD: f32 = 1e-3;

/// The largest gap along the axes of the eight and of the one, and where there is a threshold along the diagonals of these gaps. Further
/// axes are tried as long as those before do not part all boxes by more than the cutoff.
#[inline(always)]
pub fn swept_gaps<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    wanted: GapsWanted,
) -> SweptGaps<I> {
    let gaps = gaps_along_axes(lanes, eight, one, sweep, wanted);
    // Nothing of the diagonals is computed before: that would make the axes alone, which most looks end with, twice as dear.
    if wanted.cutoff > CUTOFF_OF_THRESHOLD {
        return with_diagonals(lanes, eight, one, sweep, wanted, gaps);
    }
    gaps
}

/// The same along the axes alone.
#[inline(always)]
fn gaps_along_axes<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    wanted: GapsWanted,
) -> SweptGaps<I> {
    let extension = sweep.extension;
    let apart = apart(lanes, eight, &one.center);
    // By the axes of the eight, then of the one.
    let products: [Triple<I>; 3] =
        each_axis!(k => each_axis!(j => lanes.along(&eight.axes[k], &one.axes[j])));
    let mut gaps = SweptGaps {
        still: lanes.splat(f32::NEG_INFINITY),
        swept: lanes.splat(f32::NEG_INFINITY),
    };
    let places = each_axis!(k => lanes.dot(&eight.axes[k], &apart));
    let moved = moved_along_eight(lanes, eight, one, sweep, &places);
    let half = splat(lanes, &one.half);
    for k in 0..3 {
        let extent = extent_along(lanes, &products[k], &half, eight.half[k]);
        let gap = lanes.sub(lanes.abs(places[k]), extent);
        gaps.offer(lanes, gap, moved[k], extension);
    }
    let upright = lanes.splat(AXIS_FACTOR);
    let GapsWanted { cutoff, among } = wanted;
    if lanes.not_above(lanes.mul(gaps.swept, upright), cutoff) & among != 0 {
        let places = each_axis!(j => lanes.along(&apart, &one.axes[j]));
        let moved = moved_along_one(lanes, eight, one, sweep, &places);
        for j in 0..3 {
            let along = each_axis!(k => products[k][j]);
            let extent = extent_along(lanes, &along, &eight.half, lanes.splat(one.half[j]));
            let gap = lanes.sub(lanes.abs(places[j]), extent);
            gaps.offer(lanes, gap, moved[j], extension);
        }
    }
    SweptGaps {
        still: lanes.mul(gaps.still, upright),
        swept: lanes.mul(gaps.swept, upright),
    }
}

/// What the motion takes off the gaps along the axes of the eight; `places` are those of the one along them.
#[inline(always)]
fn moved_along_eight<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    places: &Triple<I>,
) -> Triple<I> {
    let mut moved = [lanes.splat(sweep.bends[0]); 3];
    for twist in sweep.twists {
        let (velocity, sides) = twist.of_box(one);
        for k in 0..3 {
            let shift = lanes.along(&eight.axes[k], &velocity);
            let nearer = nearer(lanes, shift, places[k], sweep.extension);
            moved[k] = lanes.add(nearer, moved[k]);
            for side in &sides {
                moved[k] = lanes.add(moved[k], lanes.abs(lanes.along(&eight.axes[k], side)));
            }
        }
    }
    moved
}

/// The same along the axes of the one, which move with it.
#[inline(always)]
fn moved_along_one<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    places: &Triple<I>,
) -> Triple<I> {
    let mut moved = [lanes.splat(sweep.bends[1]); 3];
    for twist in sweep.twists {
        for (j, axis) in one.axes.iter().enumerate() {
            let arm = cross3(axis, &twist.angular);
            let [ax, ay, az] = splat(lanes, &arm);
            let center = &eight.center;
            let origin = lanes.splat(dot(axis, &twist.linear));
            let first = lanes.mul_add(center[0], ax, origin);
            let at_center = lanes.mul_add(center[2], az, lanes.mul_add(center[1], ay, first));
            let nearer = nearer(lanes, at_center, places[j], sweep.extension);
            let shifted = lanes.add(nearer, moved[j]);
            let turned = each_axis!(k => lanes.along(&eight.axes[k], &arm));
            moved[j] = extent_along(lanes, &turned, &eight.half, shifted);
        }
    }
    moved
}

/// The same with the diagonals too, where they may part boxes that the axes do not.
#[inline(always)]
fn with_diagonals<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    wanted: GapsWanted,
    mut gaps: SweptGaps<I>,
) -> SweptGaps<I> {
    let GapsWanted { cutoff, among } = wanted;
    if lanes.not_above(gaps.swept, cutoff) & among & gaps.diagonals_may_part(lanes, cutoff) == 0 {
        return gaps;
    }
    for diagonal in &diagonals(lanes, eight, one) {
        gaps.part_along(lanes, eight, one, sweep, diagonal);
        if lanes.not_above(gaps.swept, cutoff) & among == 0 {
            break;
        }
    }
    gaps
}

impl Twist32 {
    /// The velocity of a box's centre, and its sides turned.
    #[inline(always)]
    fn of_box(&self, one: &PackedBox) -> ([f32; 3], [[f32; 3]; 3]) {
        let turn = cross3(&self.angular, &one.center);
        let sides = each_axis!(j => {
            let turned = cross3(&self.angular, &one.axes[j]);
            each_axis!(k => turned[k] * one.half[j])
        });
        (each_axis!(k => self.linear[k] + turn[k]), sides)
    }
}

/// Ways shorter than this are taken to be so long.
const SHORTEST_WAY: f32 = 1e-12;

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
    /// The boxes that diagonals, at most the root of 3 longer than the largest gap, may part by more than the cutoff. A cutoff far below
    /// that gap is seldom between it and a diagonal.
    #[inline(always)]
    fn diagonals_may_part(&self, lanes: I, cutoff: f32) -> u32 {
        const ROOT_OF_3: f32 = 1.732_051;
        const LEAST_CUTOFF: f32 = 0.125;
        let taken_off = lanes.sub(self.still, self.swept);
        let longest = lanes.mul(self.still, lanes.splat(ROOT_OF_3));
        let may_part = lanes.at_most(lanes.sub(taken_off, longest), -cutoff);
        may_part & lanes.at_most(lanes.mul(self.still, lanes.splat(LEAST_CUTOFF)), cutoff)
    }

    /// Takes in the gaps along vectors of any length, by which the products with them are divided at the end. One of length 0 says that
    /// nothing is less than 0 apart.
    #[inline(always)]
    fn part_along(
        &mut self,
        lanes: I,
        eight: &EightBoxes<I>,
        one: &PackedBox,
        sweep: BoxSweep,
        way: &Triple<I>,
    ) {
        let length = lanes.sqrt(lanes.dot(way, way));
        let divisor = lanes.max(length, lanes.splat(SHORTEST_WAY));
        let upright = lanes.splat(AXIS_FACTOR);
        let inverse = lanes.div(upright, divisor);
        let place = lanes.dot(way, &apart(lanes, eight, &one.center));
        let mut moved = lanes.splat(0.0);
        for twist in sweep.twists {
            let (velocity, sides) = twist.of_box(one);
            let shift = lanes.along(way, &velocity);
            moved = lanes.add(moved, nearer(lanes, shift, place, sweep.extension));
            for side in &sides {
                moved = lanes.add(moved, lanes.abs(lanes.along(way, side)));
            }
        }
        let with_one = each_axis!(j => lanes.along(way, &one.axes[j]));
        let with_eight = each_axis!(k => lanes.dot(way, &eight.axes[k]));
        let half = splat(lanes, &one.half);
        let of_one = extent_along(lanes, &with_one, &half, lanes.splat(0.0));
        let extents = extent_along(lanes, &with_eight, &eight.half, of_one);
        let gap = lanes.mul(lanes.sub(lanes.abs(place), extents), inverse);
        let bend = lanes.mul(lanes.splat(sweep.bends[0]), upright);
        let moved = lanes.mul_add(moved, inverse, bend);
        self.offer(lanes, gap, moved, sweep.extension);
    }

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
