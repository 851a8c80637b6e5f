//! Lower bounds of the distance between one oriented box and eight others, in single precision.
//!
//! For a unit vector n, two sets are apart by at least |n . (c - c')| less what each reaches from its centre c, c' along n.
//! The largest such gap along the three axes of one box and of the other is a bound. Refined, the gaps along the axes of a
//! box are the sides of a box between the sets, whose diagonal bounds the distance; it bounds the gap along its own
//! direction too, by the sum of what the reaches along the axes make of it, and that gap is measured. Along n = sum of
//! d_i axis_i the box of these axes reaches sum |d_i| half_i, the other's sum |n . axis_j| half_j.
//!
//! Axes: with those of a box as rows of M, M M^T differs from the identity by less than e = 2^-12 (see `WideNode`: each
//! component is within 2^-16, or 2^-15 for one that is 1). Along its own axes the half sides say what a box reaches, along
//! others the sum of what the sides do (see `PackedBox`), so each gap holds but for the length of its axis, and a diagonal
//! but for that of n: either may be too long by the root of 1 + e, for which [`UPRIGHT`] shortens it.
//!
//! Rounding: let u = 2^-24, and S the pair's size, which no vertex, centre or translation exceeds; a half side is at most
//! the radius of its body, so that the three of a box add up to at most 3 S. Axes and half sides are what the boxes hold
//! their points by, and centres to within u S; the motion's rotation and translation are within u of what they stand for
//! in each component. Brought into the other frame, a centre takes three products and three sums at most: with the rounding
//! of the motion, it is within 8 u S, its difference from another centre within 9 u S in each component, and the projection
//! of that on an axis within 24 u S. An axis brought over is within 5 u in each component, the third, the cross product of
//! two such, within 14 u, its product with another within 13 u, that of the third within 28 u, so that the reach of a box is
//! within 60 u S for those and 7 u S for the sum. A gap is thus within 91 u S, a diagonal within sqrt(3) times that; refined,
//! within 42 u S for the centre and 95 u S for the reach, less than 150 u S. In all less than 160 u S, for which
//! [`ROUNDING`] is taken off. A direction given in double precision and turned into a frame is within 6 u of unit length,
//! its gap within 100 u S by the same count.
//!
//! The tree over objects compares boxes that were turned in double precision, with the third axis as the cross product there
//! (`ObjectTree`) or anew in single precision: within 3 u of the one their sides were fitted to, and so 9 u S in all.

use crate::boxes::{EightBoxes, PackedBox};
use crate::lanes::{Instructions, Lanes8, Triple, each3};
use crate::pose::{Pose, Vec3};

/// The rounding of a bound, times the pair's size: 256 * 2^-24.
pub const ROUNDING: f64 = 1.0 / 65536.0;

/// What is left for certain of a gap along an axis or a diagonal.
pub(super) const UPRIGHT: f32 = 1.0 - 1.0 / 8192.0;

/// The squares of sides down to this are numbers of full precision.
const SHORTEST: f32 = 1e-18;

/// A rigid motion from one body's frame to the other's, in units of the pair.
#[derive(Clone, Copy, Debug)]
pub struct Motion32 {
    /// By columns, each twice and with a 0 behind, as lanes take it.
    rotation: [[f32; 8]; 3],
    translation: [f32; 8],
    /// The unit of the body that moves, in units of the pair.
    pub factor: f32,
}

impl Motion32 {
    /// Of a body whose unit is `unit`, in units of `scale`.
    #[inline(always)]
    pub fn new(pose: &Pose, unit: f64, scale: f64) -> Self {
        let inverse = 1.0 / scale;
        let twice = |v: [f64; 3]| {
            let [x, y, z] = each3(|k| v[k] as f32);
            [x, y, z, 0.0, x, y, z, 0.0]
        };
        Self {
            rotation: each3(|i| twice(each3(|k| pose.rotation[(k, i)]))),
            translation: twice(each3(|k| pose.translation[k] * inverse)),
            factor: (unit * inverse) as f32,
        }
    }

    #[inline(always)]
    pub fn turn(&self, v: &[f32; 3]) -> [f32; 3] {
        let [x, y, z] = &self.rotation;
        each3(|k| x[k] * v[0] + y[k] * v[1] + z[k] * v[2])
    }

    /// A box in the other frame, in units of the pair: given in lanes (see `WideNode::in_lanes`).
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

    /// Two vectors turned, plus two others.
    #[inline(always)]
    fn turn_lanes<I: Instructions>(&self, lanes: I, v: Lanes8<I>, plus: Lanes8<I>) -> Lanes8<I> {
        let [x, y, z] = &self.rotation;
        let first = lanes.mul_add(lanes.load(x), lanes.spread::<0>(v), plus);
        let second = lanes.mul_add(lanes.load(y), lanes.spread::<1>(v), first);
        lanes.mul_add(lanes.load(z), lanes.spread::<2>(v), second)
    }
}

/// Lower bounds of the distances of eight boxes from one, in units of the pair; where the boxes overlap, how deep they do
/// as a number below 0.
#[inline(always)]
pub fn bounds<I: Instructions>(lanes: I, eight: &EightBoxes<I>, one: &PackedBox) -> Lanes8<I> {
    let [first, second] = &sides(lanes, eight, one);
    let largest = lanes.max(first.largest(lanes), second.largest(lanes));
    lanes.mul(largest, lanes.splat(UPRIGHT))
}

/// How bounds are made sharper, and for which boxes that is worth it.
pub struct BoundRefinement<'a> {
    /// A unit vector from the eight to the one, along which they may be apart.
    pub direction: Option<&'a [f32; 3]>,
    /// Boxes that are farther apart than this need not be known better.
    pub cutoff: f32,
    /// Which of the eight there are, as bits.
    pub among: u32,
}

/// The same, sharper where boxes are apart, if by the first bounds some of them are near enough to matter.
#[inline(always)]
pub fn sharper_bounds<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    wanted: &BoundRefinement,
) -> Lanes8<I> {
    let [first, second] = &sides(lanes, eight, one);
    let largest = [first.largest(lanes), second.largest(lanes)];
    let upright = lanes.splat(UPRIGHT);
    let mut known = lanes.mul(lanes.max(largest[0], largest[1]), upright);
    if let Some(direction) = wanted.direction {
        known = lanes.max(known, gaps_along(lanes, eight, one, direction));
    }
    if lanes.at_most(known, wanted.cutoff) & wanted.among == 0 {
        return known;
    }
    // Where no gap is above 0 the diagonal is 0, and how deep the boxes overlap counts.
    let zero = lanes.splat(0.0);
    let first = lanes.add(first.along_diagonal(lanes), lanes.min(largest[0], zero));
    let second = lanes.add(second.along_diagonal(lanes), lanes.min(largest[1], zero));
    lanes.max(known, lanes.mul(lanes.max(first, second), upright))
}

/// What the gaps along the axes of the eight follow from, and those along the axes of the one.
#[inline(always)]
fn sides<I: Instructions>(lanes: I, eight: &EightBoxes<I>, one: &PackedBox) -> [Gaps<I>; 2] {
    let apart = apart(lanes, eight, one);
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

/// What the gaps along the axes of a box follow from.
struct Gaps<I: Instructions> {
    /// Where the other box is along the axes.
    places: Triple<I>,
    half: Triple<I>,
    other_half: Triple<I>,
    /// The products of the axes with those of the other box.
    along: [Triple<I>; 3],
    /// What both boxes reach along the axes.
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

    /// The gap along the diagonal of those that are above 0, or less; 0 or less if there is none.
    #[inline(always)]
    fn along_diagonal(&self, lanes: I) -> Lanes8<I> {
        let mut beyond = self.places;
        let mut square = lanes.splat(0.0);
        let mut own = lanes.splat(0.0);
        for (i, beyond) in beyond.iter_mut().enumerate() {
            let (place, extent) = (*beyond, self.extents[i]);
            let below = lanes.sub(lanes.splat(0.0), extent);
            let within = lanes.max(lanes.min(place, extent), below);
            *beyond = lanes.sub(place, within);
            square = lanes.mul_add(*beyond, *beyond, square);
            let outside = lanes.sub(lanes.abs(place), self.half[i]);
            own = lanes.mul_add(outside, lanes.abs(*beyond), own);
        }
        let diagonal = lanes.sqrt(square);
        let [a, b, c] = &self.along;
        let across = [
            lanes.dot(&beyond, &[a[0], b[0], c[0]]),
            lanes.dot(&beyond, &[a[1], b[1], c[1]]),
            lanes.dot(&beyond, &[a[2], b[2], c[2]]),
        ];
        let extent = extent_along(lanes, &across, &self.other_half, lanes.splat(0.0));
        // So short a diagonal may have lost its squares; divided by more, the gap is only less.
        let length = lanes.max(diagonal, lanes.splat(SHORTEST));
        lanes.max(lanes.div(lanes.sub(own, extent), length), diagonal)
    }
}

/// Lower bounds of the same distances along a unit vector from the eight to the one; negative where they may overlap.
#[inline(always)]
fn gaps_along<I: Instructions>(
    lanes: I,
    eight: &EightBoxes<I>,
    one: &PackedBox,
    direction: &[f32; 3],
) -> Lanes8<I> {
    let [a, b, c] = &eight.axes;
    let along = [
        lanes.along(a, direction),
        lanes.along(b, direction),
        lanes.along(c, direction),
    ];
    let across = lanes.splat(extent_of(one, direction));
    let place = lanes.along(&apart(lanes, eight, one), direction);
    lanes.sub(place, extent_along(lanes, &along, &eight.half, across))
}

/// From the centres of the eight to that of the one.
#[inline(always)]
fn apart<I: Instructions>(lanes: I, eight: &EightBoxes<I>, one: &PackedBox) -> Triple<I> {
    let [x, y, z] = splat(lanes, &one.center);
    let [a, b, c] = eight.center;
    [lanes.sub(x, a), lanes.sub(y, b), lanes.sub(z, c)]
}

/// What boxes reach along a direction, given its products with their axes, beyond what is given.
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

/// How far apart two boxes are along a unit vector from the first to the second, at least; negative where they may meet.
#[inline(always)]
pub fn gap_along(first: &PackedBox, second: &PackedBox, direction: &Vec3) -> f32 {
    let direction = &each3(|k| direction[k] as f32);
    let apart = each3(|k| second.center[k] - first.center[k]);
    dot(&apart, direction) - extent_of(first, direction) - extent_of(second, direction)
}

#[inline(always)]
fn extent_of(given: &PackedBox, direction: &[f32; 3]) -> f32 {
    let [x, y, z] = each3(|i| dot(&given.axes[i], direction).abs() * given.half[i]);
    x + y + z
}

#[inline(always)]
pub(super) fn dot(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
