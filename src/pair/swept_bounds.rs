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

/// Cutoffs above this, in units of the pair, hold a threshold and not rounding alone: then diagonals are tried too. Below, the code for
/// these alone would cost proofs half of their speed.
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
    if wanted.cutoff > CUTOFF_OF_THRESHOLD {
        gaps_beside_threshold(lanes, eight, one, sweep, wanted)
    } else {
        gaps_along_axes(lanes, eight, one, sweep, wanted)
    }
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
    let BoxSweep {
        twists,
        extension,
        bends,
    } = sweep;
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

/// The same along the diagonals too.
#[inline(always)]
fn gaps_beside_threshold<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    sweep: BoxSweep,
    wanted: GapsWanted,
) -> SweptGaps<I> {
    let boxes = SweptBoxes::new(lanes, eight, one, sweep);
    let mut gaps = SweptGaps {
        still: lanes.splat(f32::NEG_INFINITY),
        swept: lanes.splat(f32::NEG_INFINITY),
    };
    let upright = lanes.splat(AXIS_FACTOR);
    let GapsWanted { cutoff, among } = wanted;
    let open =
        |gaps: &SweptGaps<I>| lanes.not_above(lanes.mul(gaps.swept, upright), cutoff) & among;
    let along_eight = boxes.part_along_eight(&mut gaps);
    if open(&gaps) != 0 {
        let along_one = boxes.part_along_one(&mut gaps);
        if open(&gaps) & gaps.diagonals_may_part(lanes, cutoff) != 0 {
            boxes.part_along(&boxes.diagonal_of_eight(&along_eight), &mut gaps);
            if open(&gaps) != 0 {
                boxes.part_along(&boxes.diagonal_of_one(&along_one), &mut gaps);
            }
        }
    }
    SweptGaps {
        still: lanes.mul(gaps.still, upright),
        swept: lanes.mul(gaps.swept, upright),
    }
}

/// Eight boxes and one, with what all their axes take.
struct SweptBoxes<'a, I: Instructions> {
    lanes: I,
    eight: &'a EightBoxes<I>,
    one: &'a PackedBox,
    sweep: BoxSweep<'a>,
    /// From the centres of the eight to that of the one; along the axes of the eight, and of the one.
    apart: Triple<I>,
    along_eight: Triple<I>,
    along_one: Triple<I>,
    /// The products of the axes of the eight with those of the one.
    products: [Triple<I>; 3],
}

impl<'a, I: Instructions> SweptBoxes<'a, I> {
    #[inline(always)]
    fn new(lanes: I, eight: &'a EightBoxes<I>, one: &'a PackedBox, sweep: BoxSweep<'a>) -> Self {
        let [x, y, z] = splat(lanes, &one.center);
        let center = &eight.center;
        let apart = [
            lanes.sub(x, center[0]),
            lanes.sub(y, center[1]),
            lanes.sub(z, center[2]),
        ];
        let axes = &eight.axes;
        let [first, second, third] = &one.axes;
        let with_one = |axis: &Triple<I>| {
            [
                lanes.along(axis, first),
                lanes.along(axis, second),
                lanes.along(axis, third),
            ]
        };
        Self {
            lanes,
            eight,
            one,
            sweep,
            apart,
            along_eight: [
                lanes.dot(&axes[0], &apart),
                lanes.dot(&axes[1], &apart),
                lanes.dot(&axes[2], &apart),
            ],
            along_one: with_one(&apart),
            products: [with_one(&axes[0]), with_one(&axes[1]), with_one(&axes[2])],
        }
    }

    /// The velocity of the one's centre by a twist, and its sides turned by it.
    #[inline(always)]
    fn velocities(&self, twist: &Twist32) -> ([f32; 3], [[f32; 3]; 3]) {
        let turn = cross3(&twist.angular, &self.one.center);
        let sides = each3(|j| {
            let turned = cross3(&twist.angular, &self.one.axes[j]);
            each3(|k| turned[k] * self.one.half[j])
        });
        (each3(|k| twist.linear[k] + turn[k]), sides)
    }

    /// Along the axes of the eight; returns the gaps.
    #[inline(always)]
    fn part_along_eight(&self, gaps: &mut SweptGaps<I>) -> Triple<I> {
        let (lanes, axes) = (self.lanes, &self.eight.axes);
        let mut moved = [lanes.splat(self.sweep.bends[0]); 3];
        for twist in self.sweep.twists {
            let (velocity, sides) = self.velocities(twist);
            for k in 0..3 {
                let shift = lanes.along(&axes[k], &velocity);
                let nearer = nearer(lanes, shift, self.along_eight[k], self.sweep.extension);
                moved[k] = lanes.add(nearer, moved[k]);
                for side in &sides {
                    moved[k] = lanes.add(moved[k], lanes.abs(lanes.along(&axes[k], side)));
                }
            }
        }
        let half = splat(lanes, &self.one.half);
        let found = each3(|k| {
            let extent = extent_along(lanes, &self.products[k], &half, self.eight.half[k]);
            lanes.sub(lanes.abs(self.along_eight[k]), extent)
        });
        for (gap, moved) in found.into_iter().zip(moved) {
            gaps.offer(lanes, gap, moved, self.sweep.extension);
        }
        found
    }

    /// Along the axes of the one; returns the gaps.
    #[inline(always)]
    fn part_along_one(&self, gaps: &mut SweptGaps<I>) -> Triple<I> {
        let (lanes, eight, one) = (self.lanes, self.eight, self.one);
        let (center, axes) = (&eight.center, &eight.axes);
        let mut moved = [lanes.splat(self.sweep.bends[1]); 3];
        for twist in self.sweep.twists {
            for (j, axis) in one.axes.iter().enumerate() {
                let arm = cross3(axis, &twist.angular);
                let [ax, ay, az] = splat(lanes, &arm);
                let origin = lanes.splat(dot(axis, &twist.linear));
                let first = lanes.mul_add(center[0], ax, origin);
                let at_center = lanes.mul_add(center[2], az, lanes.mul_add(center[1], ay, first));
                let nearer = nearer(lanes, at_center, self.along_one[j], self.sweep.extension);
                let turned = [
                    lanes.along(&axes[0], &arm),
                    lanes.along(&axes[1], &arm),
                    lanes.along(&axes[2], &arm),
                ];
                moved[j] = extent_along(lanes, &turned, &eight.half, lanes.add(nearer, moved[j]));
            }
        }
        let found = each3(|j| {
            let along = [
                self.products[0][j],
                self.products[1][j],
                self.products[2][j],
            ];
            let extent = extent_along(lanes, &along, &eight.half, lanes.splat(one.half[j]));
            lanes.sub(lanes.abs(self.along_one[j]), extent)
        });
        for (gap, moved) in found.into_iter().zip(moved) {
            gaps.offer(lanes, gap, moved, self.sweep.extension);
        }
        found
    }

    /// The diagonal of the positive gaps along the axes of the eight.
    #[inline(always)]
    fn diagonal_of_eight(&self, gaps: &Triple<I>) -> Triple<I> {
        let (lanes, axes) = (self.lanes, &self.eight.axes);
        let [a, b, c] = sides_between(lanes, gaps, &self.along_eight);
        each3(|k| {
            let first = lanes.mul(axes[0][k], a);
            lanes.mul_add(axes[2][k], c, lanes.mul_add(axes[1][k], b, first))
        })
    }

    /// The same along the axes of the one.
    #[inline(always)]
    fn diagonal_of_one(&self, gaps: &Triple<I>) -> Triple<I> {
        let (lanes, axes) = (self.lanes, &self.one.axes);
        let sides = sides_between(lanes, gaps, &self.along_one);
        each3(|k| lanes.along(&sides, &[axes[0][k], axes[1][k], axes[2][k]]))
    }

    /// Along vectors of any length, by which the products with them are divided at the end. One of length 0 says that nothing is less
    /// than 0 apart.
    #[inline(always)]
    fn part_along(&self, way: &Triple<I>, gaps: &mut SweptGaps<I>) {
        let (lanes, eight, one) = (self.lanes, self.eight, self.one);
        let length = lanes.sqrt(lanes.dot(way, way));
        let divisor = lanes.max(length, lanes.splat(SHORTEST_WAY));
        let inverse = lanes.div(lanes.splat(1.0), divisor);
        let place = lanes.dot(way, &self.apart);
        let mut moved = lanes.splat(0.0);
        for twist in self.sweep.twists {
            let (velocity, sides) = self.velocities(twist);
            let shift = lanes.along(way, &velocity);
            moved = lanes.add(moved, nearer(lanes, shift, place, self.sweep.extension));
            for side in &sides {
                moved = lanes.add(moved, lanes.abs(lanes.along(way, side)));
            }
        }
        let with_one = each3(|j| lanes.along(way, &one.axes[j]));
        let with_eight = each3(|k| lanes.dot(way, &eight.axes[k]));
        let half = splat(lanes, &one.half);
        let of_one = extent_along(lanes, &with_one, &half, lanes.splat(0.0));
        let extents = extent_along(lanes, &with_eight, &eight.half, of_one);
        let gap = lanes.mul(lanes.sub(lanes.abs(place), extents), inverse);
        let moved = lanes.mul_add(moved, inverse, lanes.splat(self.sweep.bends[0]));
        gaps.offer(lanes, gap, moved, self.sweep.extension);
    }
}

/// Ways shorter than this are taken to be so long.
const SHORTEST_WAY: f32 = 1e-12;

/// The gaps that are positive, with the signs of the places that they lead to.
#[inline(always)]
fn sides_between<I: Instructions>(lanes: I, gaps: &Triple<I>, places: &Triple<I>) -> Triple<I> {
    each3(|k| lanes.signed_as(lanes.max(gaps[k], lanes.splat(0.0)), places[k]))
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
