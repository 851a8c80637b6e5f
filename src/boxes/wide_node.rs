//! Up to eight boxes in one node, in 16-bit numbers.
//!
//! A node takes four cache lines, so traversal of large trees waits for memory half as often as with single precision.

use std::borrow::Cow;

use super::extent::Extent;
use super::oriented_box::span;
use super::packed_box::PackedBox;
use crate::lanes::{Instructions, Lanes8, Triple, cross3, each3};
use crate::pose::{Mat3, Vec3};

/// The components of an axis are integers, so many to 1.
pub(crate) const AXIS_UNITS: f64 = 32768.0;
/// Their unit.
pub(super) const AXIS_STEP: f32 = 1.0 / AXIS_UNITS as f32;
/// The largest component of an axis.
pub(crate) const MAX_AXIS: f64 = 32767.0;
/// The largest coordinate of a centre, in steps.
pub(crate) const MAX_PLACE: f64 = 32767.0;
/// The largest half side in steps before rounding; the rest up to `u16::MAX` is for the rounding of the centres.
pub(super) const MAX_HALF: f64 = 65500.0;

/// An upper bound of the length of the axes and of the axes dual to them.
const LONGEST_AXIS: f64 = 1.0 + 1.0 / 4096.0;

/// The increase of the size code for a factor of two in size.
pub const SIZE_STEPS: i32 = 8;
/// The size code of size 1.
const SIZE_OF_ONE: i32 = 200;

/// The size code of a box of this squared size: `SIZE_OF_ONE` plus `SIZE_STEPS / 2` times the binary logarithm, rounded. It
/// is read off the number's bits; a logarithm is a function call.
#[inline(always)]
pub(super) fn size_code_of(square: f64) -> u8 {
    /// The fractions of 2^(1/8), 2^(3/8), 2^(5/8) and 2^(7/8), from which on the rounded logarithm is a step more.
    const STEPS: [i64; 4] = [
        0x1_72b8_3c7d_517b,
        0x4_bfda_d536_2a28,
        0x8_ace5_422a_a0dc,
        0xd_5818_dcfb_a488,
    ];
    let bits = square.to_bits() as i64;
    let exponent = (bits >> 52) as i32 - 1023;
    let fraction = bits & ((1 << 52) - 1);
    let more = STEPS.map(|step| i32::from(fraction >= step));
    let quarters = 4 * exponent + more[0] + more[1] + more[2] + more[3];
    (SIZE_OF_ONE + quarters).clamp(0, 255) as u8
}

/// The boxes of a node's children. Two axes of a box are stored; the third, along its shortest side, is their cross product
/// and so orthogonal to them. Centres are relative to an origin. Centres and half sides are in units of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(64))]
pub struct WideNode {
    pub(crate) axes: [[[i16; 8]; 3]; 2],
    pub(crate) center: [[i16; 8]; 3],
    pub(crate) half: [[u16; 8]; 3],
    /// The children, in the encoding of the tree that owns the node.
    pub children: [u32; 8],
    /// The origin, then the step.
    pub(crate) frame: [f32; 4],
    pub(crate) sizes: [u8; 8],
    pub count: u32,
    /// The lowest primitive below the node.
    pub lowest: u32,
}

/// The points that the box of a child bounds.
pub struct ChildPoints<'a> {
    pub points: Cow<'a, [Vec3]>,
    /// How far the child may extend beyond the points' hull.
    pub excess: f64,
    /// The axes of the box, that of its shortest side last.
    pub axes: Mat3,
}

/// Eight boxes in single precision.
pub struct EightBoxes<I: Instructions> {
    pub axes: [Triple<I>; 3],
    pub center: Triple<I>,
    pub half: Triple<I>,
}

/// The cube that three axes of a box span has a volume of about 1, of either sign; less than this, they are none.
const LEAST_VOLUME: f64 = 0.5;

impl WideNode {
    /// Fits the boxes of up to eight children; the caller sets `children`. Lengths are at most about 1.
    pub fn new(children: &[ChildPoints]) -> Self {
        let mut node = Self {
            count: children.len() as u32,
            ..Self::default()
        };
        let spans: Vec<(Vec3, Vec3)> = children
            .iter()
            .map(|child| {
                let (low, high) = span(&child.points, &child.axes);
                let grown = Vec3::repeat(child.excess);
                (
                    child.axes * ((low + high) * 0.5),
                    (high - low) * 0.5 + grown,
                )
            })
            .collect();
        let first = spans[0].0;
        let (low, high) = spans
            .iter()
            .fold((first, first), |(low, high), (center, _)| {
                (low.inf(center), high.sup(center))
            });
        let origin = (low + high) * 0.5;
        let [x, y, z]: [f64; 3] = origin.into();
        let halves = spans.iter().map(|(_, half)| half.amax());
        let mut step = (0.5 * (high - low).amax() / MAX_PLACE)
            .max(halves.fold(0.0, f64::max) / MAX_HALF)
            .max(1e-30);
        loop {
            node.frame = [x, y, z, step * (1.0 + 1e-6)].map(|x| x as f32);
            let mut lanes = children.iter().zip(&spans).enumerate();
            if lanes.all(|(lane, (child, (center, _)))| {
                node.set(lane, &child.points, child.excess, &child.axes, center)
            }) {
                return node;
            }
            // The boxes are tiny relative to their coordinates: the room for rounding was too small.
            step *= 1.25;
        }
    }

    /// A node without children. Its boxes may have centres within `half` of `center` along each axis, and half sides up to
    /// almost twice `half`.
    pub fn around(center: &Vec3, half: f64) -> Self {
        let origin = each3(|k| center[k] as f32);
        let off = (0..3).map(|k| (center[k] - f64::from(origin[k])).abs());
        let step = ((half + off.fold(0.0, f64::max)) / MAX_PLACE).max(1e-30) * (1.0 + 1e-6);
        Self {
            frame: [origin[0], origin[1], origin[2], step as f32],
            ..Self::default()
        }
    }

    /// The children, in the encoding of the tree that owns the node.
    pub fn children(&self) -> &[u32] {
        &self.children[..self.count as usize]
    }

    /// The axis-aligned box around one of the boxes.
    pub fn extent(&self, lane: usize) -> Extent {
        let own = self.get(lane);
        let extent = |k: usize| {
            (0..3)
                .map(|i| own.axes[i][k].abs() * own.half[i])
                .sum::<f32>()
        };
        let [low, high] = [-1.0, 1.0].map(|side| each3(|k| own.center[k] + side * extent(k)));
        Extent {
            low: low.map(f64::from).into(),
            high: high.map(f64::from).into(),
        }
    }

    /// Removes a child; the last child moves to its lane.
    pub fn take_out(&mut self, lane: usize) {
        self.count -= 1;
        let last = self.count as usize;
        let numbers = self.axes.as_flattened_mut().iter_mut();
        let numbers = numbers.chain(&mut self.center);
        numbers.for_each(|numbers| numbers[lane] = numbers[last]);
        let halves = self.half.iter_mut();
        halves.for_each(|halves| halves[lane] = halves[last]);
        self.sizes[lane] = self.sizes[last];
        self.children[lane] = self.children[last];
    }

    /// Sets the box of a child; false if it does not fit the step. Axes that are not upright, as files that somebody made up bring
    /// them, are replaced by the frame's.
    fn set(
        &mut self,
        lane: usize,
        points: &[Vec3],
        excess: f64,
        axes: &Mat3,
        center: &Vec3,
    ) -> bool {
        let upright = Mat3::identity();
        let axes = if axes.determinant().abs() > LEAST_VOLUME {
            axes
        } else {
            &upright
        };
        for k in 0..3 {
            for i in 0..2 {
                let component = (axes[(k, i)] * AXIS_UNITS).round();
                self.axes[i][k][lane] = component.clamp(-MAX_AXIS, MAX_AXIS) as i16;
            }
        }
        self.set_center(lane, center);
        // The half sides are fitted to the rounded axes and centre, and bound the points in both senses of `PackedBox`.
        let rounded = self.get(lane);
        let center = Vec3::from(rounded.center.map(f64::from));
        let axes = Mat3::from_columns(&rounded.axes.map(|axis| Vec3::from(axis.map(f64::from))));
        let inverse = axes.try_inverse().expect("the axes are almost upright");
        let needed = Vec3::from(each3(|i| {
            let farthest = points.iter().fold(0.0, |farthest: f64, p| {
                let from_center = p - center;
                let along = axes.column(i).dot(&from_center).abs();
                let place = inverse.row(i).dot(&from_center.transpose()).abs();
                farthest.max(along).max(place)
            });
            farthest + excess * LONGEST_AXIS
        }));
        self.set_half(lane, &needed)
    }

    /// Sets the centre of a box, rounded to the node's steps.
    #[inline(always)]
    fn set_center(&mut self, lane: usize, center: &Vec3) {
        for k in 0..3 {
            let place = (center[k] - f64::from(self.frame[k])) / f64::from(self.step());
            self.center[k][lane] = place.round().clamp(-MAX_PLACE, MAX_PLACE) as i16;
        }
    }

    /// One coordinate of a box's centre.
    #[inline(always)]
    fn center_of(&self, lane: usize, k: usize) -> f32 {
        f32::from(self.center[k][lane]) * self.step() + self.frame[k]
    }

    /// Sets the half sides of a box, rounded up, and its size; false if they do not fit the step.
    #[inline(always)]
    fn set_half(&mut self, lane: usize, needed: &Vec3) -> bool {
        for i in 0..3 {
            let mut half = (needed[i] / f64::from(self.step())).ceil() as u16;
            while f64::from(f32::from(half) * self.step()) < needed[i] {
                match half.checked_add(1) {
                    Some(more) => half = more,
                    None => return false,
                }
            }
            self.half[i][lane] = half;
        }
        let size = Vec3::from(each3(|i| {
            f64::from(f32::from(self.half[i][lane]) * self.step())
        }));
        self.sizes[lane] = size_code_of(size.norm_squared());
        true
    }

    #[inline(always)]
    pub(crate) fn step(&self) -> f32 {
        self.frame[3]
    }

    /// A rounded logarithm of a box's size, in 1 / `SIZE_STEPS` of a factor of two.
    #[inline(always)]
    pub fn size_code(&self, lane: usize) -> i32 {
        i32::from(self.sizes[lane])
    }

    /// One of the boxes.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> PackedBox {
        let [a, b] = [0, 1].map(|i: usize| each3(|k| f32::from(self.axes[i][k][lane]) * AXIS_STEP));
        PackedBox {
            axes: [a, b, cross3(&a, &b)],
            center: each3(|k| self.center_of(lane, k)),
            half: each3(|i| f32::from(self.half[i][lane]) * self.step()),
        }
    }

    /// One of the boxes in two times eight lanes: the first two axes; the centre and the half sides. Every fourth lane is
    /// unused.
    #[inline(always)]
    pub fn in_lanes<I: Instructions>(&self, lanes: I, lane: usize) -> [Lanes8<I>; 2] {
        let lane = lane & 7;
        let [[ax, ay, az], [bx, by, bz]] = &self.axes;
        let axis = |numbers: &[i16; 8]| numbers[lane];
        let axes = [
            axis(ax),
            axis(ay),
            axis(az),
            0,
            axis(bx),
            axis(by),
            axis(bz),
            0,
        ];
        let [cx, cy, cz] = &self.center;
        let [hx, hy, hz] = &self.half;
        let place = |numbers: &[i16; 8]| i32::from(numbers[lane]);
        let half = |numbers: &[u16; 8]| i32::from(numbers[lane]);
        let places = [
            place(cx),
            place(cy),
            place(cz),
            0,
            half(hx),
            half(hy),
            half(hz),
            0,
        ];
        [
            lanes.mul(lanes.signed(&axes), lanes.splat(AXIS_STEP)),
            lanes.mul_add(
                lanes.whole(&places),
                lanes.splat(self.step()),
                lanes.four(&self.frame),
            ),
        ]
    }

    /// All boxes at once, bit for bit as by [`WideNode::get`] but for the centres. Lengths are multiplied by `unit`, a power
    /// of two.
    #[inline(always)]
    pub fn boxes<I: Instructions>(&self, lanes: I, unit: f32) -> EightBoxes<I> {
        let axis_step = lanes.splat(AXIS_STEP);
        let step = lanes.splat(self.step() * unit);
        let axis = |numbers| lanes.mul(lanes.signed(numbers), axis_step);
        let ([ax, ay, az], [bx, by, bz]) = (&self.axes[0], &self.axes[1]);
        let a = [axis(ax), axis(ay), axis(az)];
        let b = [axis(bx), axis(by), axis(bz)];
        let [x, y, z] = &self.center;
        let place = |numbers, origin: f32| {
            lanes.mul_add(lanes.signed(numbers), step, lanes.splat(origin * unit))
        };
        let [i, j, k] = &self.half;
        let half = |numbers| lanes.mul(lanes.unsigned(numbers), step);
        EightBoxes {
            axes: [a, b, lanes.cross(&a, &b)],
            center: [
                place(x, self.frame[0]),
                place(y, self.frame[1]),
                place(z, self.frame[2]),
            ],
            half: [half(i), half(j), half(k)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn size_codes_are_rounded_logarithms() {
        for i in -4000..2000 {
            let size = (f64::from(i) * 0.01).exp2();
            let code = f64::from(SIZE_OF_ONE) + f64::from(SIZE_STEPS) * size.log2();
            let expected = code.round().clamp(0.0, 255.0);
            assert_eq!(f64::from(size_code_of(size * size)), expected, "{size}");
        }
        assert_eq!(size_code_of(0.0), 0);
        assert_eq!(size_code_of(f64::MAX), 255);
    }

    /// Axes that no box has: parallel ones, none, no numbers.
    #[test]
    fn boxes_hold_their_points_whatever_the_axes() {
        let points = [[0.1, 0.2, 0.3], [-0.4, 0.0, 0.2], [0.3, -0.3, -0.1]].map(Vec3::from);
        let parallel = Mat3::from_columns(&[Vec3::x(), Vec3::x(), Vec3::zeros()]);
        for axes in [parallel, Mat3::zeros(), Mat3::repeat(f64::NAN)] {
            let mut node = WideNode::around(&Vec3::zeros(), 1.0);
            assert!(node.set(0, &points, 0.0, &axes, &Vec3::zeros()));
            let extent = node.extent(0);
            for point in &points {
                assert!((0..3).all(|k| extent.low[k] <= point[k] && point[k] <= extent.high[k]));
            }
        }
    }
}
