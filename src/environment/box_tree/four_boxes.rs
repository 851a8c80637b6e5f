//! Packs oriented boxes into nodes, four at a time.

use super::oriented_box::OrientedBox;
use crate::boxes::{AXIS_UNITS, MAX_AXIS, MAX_PLACE, WideNode};
use crate::lanes::{F64x4, Points64, cross64, dot64, each3};

/// Up to four boxes as structure of arrays.
pub struct FourBoxes {
    pub center: Points64,
    /// The first two axes of each; the third is their cross product.
    pub axes: [Points64; 2],
    pub half: Points64,
}

impl FourBoxes {
    /// Gathers the boxes of the lanes set in `lanes`; the other lanes are points.
    #[inline(always)]
    pub fn of(lanes: u8, given: impl Fn(usize) -> OrientedBox) -> Self {
        let none = [F64x4::splat(0.0); 3];
        let mut four = Self {
            center: none,
            axes: [none; 2],
            half: none,
        };
        for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
            let one = given(lane);
            for k in 0..3 {
                four.center[k].0[lane] = one.center[k];
                four.half[k].0[lane] = one.half[k];
                four.axes[0][k].0[lane] = one.axes[0][k];
                four.axes[1][k].0[lane] = one.axes[1][k];
            }
        }
        four
    }
}

impl WideNode {
    /// Sets the boxes of those of four children from `first` on whose bits are set in `lanes`; each contains the given box.
    /// False if one does not fit the node. Does not set size codes.
    #[inline(always)]
    pub fn put(&mut self, first: usize, lanes: u8, given: &FourBoxes) -> bool {
        let first = first & 4;
        let step = f64::from(self.step());
        let inverse_step = 1.0 / step;
        let place = each3(|k| {
            let origin = F64x4::splat(f64::from(self.frame[k]));
            (given.center[k] - origin) * inverse_step
        });
        // The rounding direction of halves does not matter: the half sides compensate for it.
        let center = each3(|k| nearest(place[k], MAX_PLACE));
        let axes = [axis_units(&given.axes[0]), axis_units(&given.axes[1])];
        // The half sides are fitted to the rounded axes and centre, and bound the box in both senses of `PackedBox`.
        let unit = 1.0 / AXIS_UNITS;
        let (a, b) = (each3(|k| axes[0][k] * unit), each3(|k| axes[1][k] * unit));
        let c = single_cross(&a, &b);
        let rounded = [&a, &b, &c];
        let off = each3(|k| {
            let (step, origin) = (self.step(), self.frame[k]);
            given.center[k] - center[k].map(|x| f64::from(x as f32 * step + origin))
        });
        let [x, y] = &given.axes;
        let z = cross64(x, y);
        let farthest = each3(|i| {
            dot64(rounded[i], &off).abs()
                + given.half[0] * dot64(rounded[i], x).abs()
                + given.half[1] * dot64(rounded[i], y).abs()
                + given.half[2] * dot64(rounded[i], &z).abs()
        });
        // `farthest` bounds the projections. The coefficients are the projections times the inverse of the axes' Gram matrix,
        // I + E; the third axis is orthogonal to the others up to rounding to single precision.
        let one = F64x4::splat(1.0);
        let off_unit = each3(|i| (dot64(rounded[i], rounded[i]) - one).abs());
        let skew = off_unit[0]
            .max(off_unit[1])
            .max(off_unit[2])
            .max(dot64(&a, &b).abs());
        let rounding = farthest[0].max(farthest[1]).max(farthest[2]) * 1e-6;
        let skewed = skew * farthest[0].max(farthest[1]) * 2.5;
        let needed = [
            farthest[0] + skewed + rounding,
            farthest[1] + skewed + rounding,
            farthest[2] * (one + skew * 2.5) + rounding,
        ];
        // Slightly more, as the product with the step is rounded to single precision.
        let more = inverse_step * (1.0 + 1e-6);
        let half = each3(|i| needed[i].map(|x| (x * more).ceil()));
        let farthest_place = place[0].abs().max(place[1].abs()).max(place[2].abs());
        let largest_half = half[0].max(half[1]).max(half[2]);
        let is_set = |lane: usize| lanes >> lane & 1 == 1;
        for lane in 0..4 {
            let fits =
                farthest_place.0[lane] <= MAX_PLACE && largest_half.0[lane] <= f64::from(u16::MAX);
            if is_set(lane) && !fits {
                return false;
            }
        }
        for k in 0..3 {
            write(&mut self.center[k], first, lanes, &center[k], |x| x as i16);
            write(&mut self.axes[0][k], first, lanes, &axes[0][k], |x| {
                x as i16
            });
            write(&mut self.axes[1][k], first, lanes, &axes[1][k], |x| {
                x as i16
            });
            write(&mut self.half[k], first, lanes, &half[k], |x| x as u16);
        }
        true
    }
}

/// Rounds to the nearest integers of magnitude at most `max`.
#[inline(always)]
fn nearest(x: F64x4, max: f64) -> F64x4 {
    let whole = x.map(|x| (x + 0.5).floor());
    whole.min(F64x4::splat(max)).max(F64x4::splat(-max))
}

#[inline(always)]
fn axis_units(axis: &Points64) -> Points64 {
    each3(|k| nearest(axis[k] * AXIS_UNITS, MAX_AXIS))
}

/// The cross product computed in single precision, of numbers that are exact in it.
#[inline(always)]
fn single_cross(a: &Points64, b: &Points64) -> Points64 {
    each3(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let forth = a[i].zip(b[j], |x, y| f64::from(x as f32 * y as f32));
        let back = a[j].zip(b[i], |x, y| f64::from(x as f32 * y as f32));
        forth.zip(back, |x, y| f64::from(x as f32 - y as f32))
    })
}

/// Writes integers to the lanes set in `lanes`.
#[inline(always)]
fn write<N: Copy>(
    numbers: &mut [N; 8],
    first: usize,
    lanes: u8,
    values: &F64x4,
    number: impl Fn(i32) -> N,
) {
    for lane in 0..4 {
        let own = &mut numbers[first + lane];
        let new = number(values.0[lane] as i32);
        *own = if lanes >> lane & 1 == 1 { new } else { *own };
    }
}
