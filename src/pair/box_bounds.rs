//! Lower bounds of the distance between one oriented box and eight others, in single precision.
//!
//! For a unit vector n, two sets with centres c and c' are at least |n . (c - c')| minus their two extents along n apart. The
//! largest such gap along the three axes of one box and of the other is the plain bound. A sharper bound: the positive gaps
//! along the axes of a box are the sides of a box between the sets, and its diagonal is no longer than their distance. The gap
//! along the direction of the diagonal is a third bound. Along n = sum of d_i axis_i the extent of the box of these axes is sum
//! |d_i| half_i, that of the other box sum |n . axis_j| half_j.
//!
//! Axes: with the axes of a box as rows of M, M M^T differs from the identity by less than e = 2^-12 (see `WideNode`: each
//! component is within 2^-16, or 2^-15 for one that is 1). Along its own axes the extent of a box is its half side, along
//! others the sum above (see `PackedBox`), so each gap is exact except for the length of its axis, and a diagonal except for
//! the length of n. Either length may be too large by a factor of the root of 1 + e, for which [`AXIS_FACTOR`] corrects.
//!
//! Rounding: let u = 2^-24, and S the pair's size, which no vertex, centre or translation exceeds; a half side is at most the
//! radius of its body, so the three of a box add up to at most 3 S. The boxes contain their points for the stored axes and half
//! sides, with centres to within u S; each component of the motion's rotation and translation is within u of its exact value. A
//! centre moved into the other frame takes at most three products and three sums: with the rounding of the motion, it is within
//! 8 u S, its difference from another centre within 9 u S in each component, and the projection of that on an axis within 24 u
//! S. Each component of a rotated axis is within 5 u; of the third axis, a cross product of two rotated ones, within 14 u. The
//! product of a rotated axis with another box's axis is within 13 u, that of the third axis within 28 u. So the extent of a box
//! is within 60 u S for these and 7 u S for the sum. A gap is thus within 91 u S, and a diagonal within sqrt(3) times that. The
//! gap along the diagonal is within 42 u S for the centre and 95 u S for the extent, less than 150 u S. In all this is less
//! than 160 u S; bounds are lowered by [`ROUNDING`]. A direction given in double precision and rotated into a frame is within 6
//! u of unit length, its gap within 100 u S by the same count.
//!
//! The tree over objects compares boxes that were rotated in double precision. Their third axis is the cross product in double
//! precision (`ObjectTree`) or again in single precision: within 3 u of the axis that their sides were fitted to, so 9 u S in
//! all.

use crate::boxes::{EightBoxes, PackedBox};
use crate::lanes::{Instructions, Lanes8, Triple, each_axis};
use crate::pose::{Pose, Vec3};

/// The rounding error of a bound, times the pair's size: 256 * 2^-24.
pub const ROUNDING: f64 = 1.0 / 65536.0;

/// The factor by which a gap along an axis or a diagonal is reduced because the axis may be longer than 1.
pub(super) const AXIS_FACTOR: f32 = 1.0 - 1.0 / 8192.0;

/// Squares of lengths down to this are normal numbers.
const SHORTEST: f32 = 1e-18;

/// A rigid motion from one body's frame to the other's, in units of the pair.
#[derive(Clone, Copy, Debug)]
pub struct Motion32 {
    /// The columns in lane order: each twice, padded with a 0.
    rotation: [[f32; 8]; 3],
    translation: [f32; 8],
    /// The unit of the body that moves, in units of the pair.
    pub factor: f32,
}

impl Motion32 {
    /// The motion of a body with unit `unit`, in units of `scale`.
    #[inline(always)]
    pub fn new(pose: &Pose, unit: f64, scale: f64) -> Self {
        let inverse = 1.0 / scale;
        let twice = |v: [f64; 3]| {
            let [x, y, z] = each_axis!(k => v[k] as f32);
            [x, y, z, 0.0, x, y, z, 0.0]
        };
        Self {
            rotation: each_axis!(i => twice(each_axis!(k => pose.rotation[(k, i)]))),
            translation: twice(each_axis!(k => pose.translation[k] * inverse)),
            factor: (unit * inverse) as f32,
        }
    }

    #[inline(always)]
    pub fn turn(&self, v: &[f32; 3]) -> [f32; 3] {
        let [x, y, z] = &self.rotation;
        each_axis!(k => x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }

    /// A box, given in lanes (see `WideNode::in_lanes`), in the other frame and in units of the pair.
    #[inline(always)]
    pub fn apply<I: Instructions>(&self, lanes: I, [axes, places]: [Lanes8<I>; 2]) -> PackedBox {
        let axes = self.turn_lanes(lanes, axes, lanes.splat(0.0));
        let others = lanes.swapped(axes);
        let across = lanes.sub(
            lanes.mul(axes, lanes.rolled(others)),
            lanes.mul(lanes.rolled(axes), others),
        );
        let places = lanes.mul(places, lanes.splat(self.factor));
        let translation = lanes.load(&self.translation);
        let center = lanes.array(self.turn_lanes(lanes, places, translation));
        let (axes, across) = (lanes.array(axes), lanes.array(lanes.rolled(across)));
        let half = lanes.array(places);
        PackedBox {
            axes: [
                [axes[0], axes[1], axes[2]],
                [axes[4], axes[5], axes[6]],
                [across[0], across[1], across[2]],
            ],
            center: [center[0], center[1], center[2]],
            half: [half[4], half[5], half[6]],
        }
    }

    /// Rotates the two vectors in the lanes and adds two others.
    #[inline(always)]
    fn turn_lanes<I: Instructions>(&self, lanes: I, v: Lanes8<I>, plus: Lanes8<I>) -> Lanes8<I> {
        let [x, y, z] = &self.rotation;
        let first = lanes.mul_add(lanes.load(x), lanes.spread::<0>(v), plus);
        let second = lanes.mul_add(lanes.load(y), lanes.spread::<1>(v), first);
        lanes.mul_add(lanes.load(z), lanes.spread::<2>(v), second)
    }
}

/// Lower bounds of the distances of eight boxes from one, in units of the pair; where boxes overlap, minus their smallest
/// overlap along an axis.
#[inline(always)]
pub fn bounds<I: Instructions>(lanes: I, eight: &EightBoxes<I>, one: &PackedBox) -> Lanes8<I> {
    let [first, second] = &sides(lanes, eight, one);
    let largest = lanes.max(first.largest(lanes), second.largest(lanes));
    lanes.mul(largest, lanes.splat(AXIS_FACTOR))
}

/// The same by the balls around the boxes, which takes less and says less. The centres' distance is within 17 u S, and each half
/// diagonal, of at most 3 S, within 3 u of itself.
#[inline(always)]
pub fn gaps_of_balls<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
) -> Lanes8<I> {
    let apart = apart(lanes, eight, &one.center);
    let radius = lanes.splat(dot(&one.half, &one.half).sqrt());
    let radii = lanes.sqrt(lanes.dot(&eight.half, &eight.half));
    let between = lanes.sqrt(lanes.dot(&apart, &apart));
    lanes.sub(between, lanes.add(radii, radius))
}

/// Options of [`sharper_bounds`]: how bounds are sharpened, and for which boxes.
pub struct BoundRefinement<'a> {
    /// A unit vector from the eight boxes to the one, tried first as a separating direction.
    pub direction: Option<&'a [f32; 3]>,
    /// Bounds above this are not sharpened further.
    pub cutoff: f32,
    /// The bit mask of the lanes that hold boxes.
    pub among: u32,
}

/// Lower bounds as of `bounds`, and sharper ones unless those are all above the cutoff already; where the gaps along the direction are,
/// these alone.
#[inline(always)]
pub fn sharper_bounds<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    wanted: &BoundRefinement,
) -> Lanes8<I> {
    let mut known = lanes.splat(f32::NEG_INFINITY);
    if let Some(direction) = wanted.direction {
        known = gaps_along(lanes, eight, one, direction);
        if lanes.at_most(known, wanted.cutoff) & wanted.among == 0 {
            return known;
        }
    }
    let [first, second] = &sides(lanes, eight, one);
    let largest = [first.largest(lanes), second.largest(lanes)];
    let upright = lanes.splat(AXIS_FACTOR);
    known = lanes.max(known, lanes.mul(lanes.max(largest[0], largest[1]), upright));
    if lanes.at_most(known, wanted.cutoff) & wanted.among == 0 {
        return known;
    }
    // Where no gap is above 0, the diagonal is 0 and the bound is the negative gap.
    let zero = lanes.splat(0.0);
    let first = lanes.add(first.along_diagonal(lanes), lanes.min(largest[0], zero));
    let second = lanes.add(second.along_diagonal(lanes), lanes.min(largest[1], zero));
    lanes.max(known, lanes.mul(lanes.max(first, second), upright))
}

/// The terms of the gaps along the axes of the eight boxes, and along the axes of the one.
#[inline(always)]
fn sides<I: Instructions>(lanes: I, eight: &EightBoxes<I>, one: &PackedBox) -> [Gaps<I>; 2] {
    let apart = apart(lanes, eight, &one.center);
    let half = splat(lanes, &one.half);
    // The products of the axes of the eight with those of the one.
    let [x, y, z] = &one.axes;
    let [a, b, c] = &eight.axes;
    let [ax, ay, az] = [lanes.along(a, x), lanes.along(a, y), lanes.along(a, z)];
    let [bx, by, bz] = [lanes.along(b, x), lanes.along(b, y), lanes.along(b, z)];
    let [cx, cy, cz] = [lanes.along(c, x), lanes.along(c, y), lanes.along(c, z)];
    [
        Gaps::new(
            lanes,
            [
                lanes.dot(a, &apart),
                lanes.dot(b, &apart),
                lanes.dot(c, &apart),
            ],
            [eight.half, half],
            [[ax, ay, az], [bx, by, bz], [cx, cy, cz]],
        ),
        Gaps::new(
            lanes,
            [
                lanes.along(&apart, x),
                lanes.along(&apart, y),
                lanes.along(&apart, z),
            ],
            [half, eight.half],
            [[ax, bx, cx], [ay, by, cy], [az, bz, cz]],
        ),
    ]
}

/// The diagonals of the positive gaps along the axes of the eight boxes, and along those of the one, from the eight to the one; 0 where
/// no gap is positive.
#[inline(always)]
pub(super) fn diagonals<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
) -> [Triple<I>; 2] {
    let [of_eight, of_one] = &sides(lanes, eight, one);
    let (of_eight, of_one) = (of_eight.beyond(lanes), of_one.beyond(lanes));
    [
        each_axis!(k => {
            let axes = each_axis!(i => eight.axes[i][k]);
            lanes.dot(&of_eight, &axes)
        }),
        each_axis!(k => lanes.along(&of_one, &each_axis!(j => one.axes[j][k]))),
    ]
}

/// The terms of the gaps along the axes of a box.
struct Gaps<I: Instructions> {
    /// The other box's centre, projected on the axes.
    places: Triple<I>,
    half: Triple<I>,
    other_half: Triple<I>,
    /// The products of the axes with those of the other box.
    along: [Triple<I>; 3],
    /// The sum of both boxes' extents along the axes.
    extents: Triple<I>,
}

impl<I: Instructions> Gaps<I> {
    #[inline(always)]
    fn new(
        lanes: I,
        places: Triple<I>,
        [half, other_half]: [Triple<I>; 2],
        along: [Triple<I>; 3],
    ) -> Self {
        let extents = [
            extent_along(lanes, &along[0], &other_half, half[0]),
            extent_along(lanes, &along[1], &other_half, half[1]),
            extent_along(lanes, &along[2], &other_half, half[2]),
        ];
        Self {
            places,
            half,
            other_half,
            along,
            extents,
        }
    }

    /// The largest gap along an axis.
    #[inline(always)]
    fn largest(&self, lanes: I) -> Lanes8<I> {
        let [x, y, z] = [
            lanes.sub(lanes.abs(self.places[0]), self.extents[0]),
            lanes.sub(lanes.abs(self.places[1]), self.extents[1]),
            lanes.sub(lanes.abs(self.places[2]), self.extents[2]),
        ];
        lanes.max(lanes.max(x, y), z)
    }

    /// The diagonal of the positive gaps, along the axes.
    #[inline(always)]
    fn beyond(&self, lanes: I) -> Triple<I> {
        each_axis!(i => {
            let (place, extent) = (self.places[i], self.extents[i]);
            let below = lanes.sub(lanes.splat(0.0), extent);
            lanes.sub(place, lanes.max(lanes.min(place, extent), below))
        })
    }

    /// The larger of the diagonal of the positive gaps and the gap along its direction; at most 0 if no gap is positive.
    #[inline(always)]
    fn along_diagonal(&self, lanes: I) -> Lanes8<I> {
        let beyond = self.beyond(lanes);
        let mut square = lanes.splat(0.0);
        let mut own = lanes.splat(0.0);
        for (i, &beyond) in beyond.iter().enumerate() {
            square = lanes.mul_add(beyond, beyond, square);
            let outside = lanes.sub(lanes.abs(self.places[i]), self.half[i]);
            own = lanes.mul_add(outside, lanes.abs(beyond), own);
        }
        let diagonal = lanes.sqrt(square);
        let [a, b, c] = &self.along;
        let across = [
            lanes.dot(&beyond, &[a[0], b[0], c[0]]),
            lanes.dot(&beyond, &[a[1], b[1], c[1]]),
            lanes.dot(&beyond, &[a[2], b[2], c[2]]),
        ];
        let extent = extent_along(lanes, &across, &self.other_half, lanes.splat(0.0));
        // The squares of a shorter diagonal may have underflowed; dividing by more only lowers the bound.
        let length = lanes.max(diagonal, lanes.splat(SHORTEST));
        lanes.max(lanes.div(lanes.sub(own, extent), length), diagonal)
    }
}

/// The gaps along a unit vector from the eight to the one: lower bounds of the same distances, negative where they may overlap.
#[inline(always)]
fn gaps_along<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    direction: &[f32; 3],
) -> Lanes8<I> {
    let extent = lanes.splat(extent_of(one, direction));
    gaps_beyond(lanes, eight, &one.center, extent, direction)
}

/// The gaps along a unit vector from the eight to a point, and to all that lies beyond the point along it.
#[inline(always)]
pub fn gaps_to_point<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    point: &[f32; 3],
    direction: &[f32; 3],
) -> Lanes8<I> {
    gaps_beyond(lanes, eight, point, lanes.splat(0.0), direction)
}

/// The gaps along a unit vector from the eight to what extends so far around a point.
#[inline(always)]
fn gaps_beyond<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    point: &[f32; 3],
    extent: Lanes8<I>,
    direction: &[f32; 3],
) -> Lanes8<I> {
    let [a, b, c] = &eight.axes;
    let along = [
        lanes.along(a, direction),
        lanes.along(b, direction),
        lanes.along(c, direction),
    ];
    let place = lanes.along(&apart(lanes, eight, point), direction);
    lanes.sub(place, extent_along(lanes, &along, &eight.half, extent))
}

/// The vectors from the centres of the eight to a point.
#[inline(always)]
pub(super) fn apart<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    point: &[f32; 3],
) -> Triple<I> {
    let [x, y, z] = splat(lanes, point);
    let [a, b, c] = eight.center;
    [lanes.sub(x, a), lanes.sub(y, b), lanes.sub(z, c)]
}

/// `beyond` plus the extents of boxes along a direction, given its products with their axes.
#[inline(always)]
pub(super) fn extent_along<I: Instructions>(
    lanes: I,
    along: &Triple<I>,
    half: &Triple<I>,
    beyond: Lanes8<I>,
) -> Lanes8<I> {
    let first = lanes.mul_add(lanes.abs(along[0]), half[0], beyond);
    let second = lanes.mul_add(lanes.abs(along[1]), half[1], first);
    lanes.mul_add(lanes.abs(along[2]), half[2], second)
}

#[inline(always)]
pub(super) fn splat<I: Instructions>(lanes: I, v: &[f32; 3]) -> Triple<I> {
    [lanes.splat(v[0]), lanes.splat(v[1]), lanes.splat(v[2])]
}

/// The gap of two boxes along a unit vector from the first to the second: a lower bound of their distance, negative where they
/// may meet.
#[inline(always)]
pub fn gap_of_boxes(first: &PackedBox, second: &PackedBox, direction: &Vec3) -> f32 {
    let direction = &each_axis!(k => direction[k] as f32);
    let apart = each_axis!(k => second.center[k] - first.center[k]);
    dot(&apart, direction) - extent_of(first, direction) - extent_of(second, direction)
}

#[inline(always)]
fn extent_of(given: &PackedBox, direction: &[f32; 3]) -> f32 {
    let [x, y, z] = each_axis!(i => dot(&given.axes[i], direction).abs() * given.half[i]);
    x + y + z
}

#[inline(always)]
pub(super) fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
