//! Nodes from the spans of their boxes, four boxes at a time in lanes.

use super::refit::{AXIS_ROUNDING, AxisSpans};
use super::wide_node::{
    AXIS_STEP, AXIS_UNITS, MAX_AXIS, MAX_HALF, MAX_PLACE, WideNode, size_code_of,
};
use crate::lanes::{F64x4, Points64, cross64, dot64, each3, splat64, sub64};

/// The spans of four boxes, one in each lane (see [`AxisSpans`]).
#[derive(Clone, Copy, Debug)]
pub struct FourSpans {
    /// The components of the first two axes, as a node stores them.
    numbers: [[[i32; 4]; 3]; 2],
    /// The axes that the numbers stand for.
    axes: [Points64; 3],
    low: Points64,
    high: Points64,
}

impl Default for FourSpans {
    fn default() -> Self {
        let zero = splat64(&[0.0; 3]);
        Self {
            numbers: [[[0; 4]; 3]; 2],
            axes: [zero; 3],
            low: zero,
            high: zero,
        }
    }
}

/// The values of a function for the four lanes.
#[inline(always)]
fn each4<T>(f: impl Fn(usize) -> T) -> [T; 4] {
    [f(0), f(1), f(2), f(3)]
}

impl FourSpans {
    /// Sets the spans of one lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, one: &AxisSpans) {
        for k in 0..3 {
            for i in 0..2 {
                self.numbers[i][k][lane] = one.axes.numbers[i][k].into();
            }
            for i in 0..3 {
                self.axes[i][k].0[lane] = one.axes.axes[(k, i)];
            }
            self.low[k].0[lane] = one.low[k];
            self.high[k].0[lane] = one.high[k];
        }
    }

    /// Sets the lanes from one on to the first.
    #[inline(always)]
    fn repeat_first(&mut self, from: usize) {
        let points = self.axes.iter_mut().chain([&mut self.low, &mut self.high]);
        for coordinates in points.flatten() {
            let first = coordinates.0[0];
            coordinates.0[from..].fill(first);
        }
        for numbers in self.numbers.as_flattened_mut() {
            let first = numbers[0];
            numbers[from..].fill(first);
        }
    }

    /// Sets all lanes to triangles: their corners, and their unit normals. The axes are along the longest edge and in the plane
    /// across it. Returns which lanes have such axes; the others, whose triangles are almost without area, have none yet.
    #[inline(always)]
    pub fn set_triangles(&mut self, corners: &[Points64; 3], normal: &Points64) -> [bool; 4] {
        let longest = longest_edge(corners);
        let lift = dot64(normal, &longest);
        let along: Points64 = each3(|k| longest[k] - normal[k] * lift);
        let length = dot64(&along, &along).sqrt();
        let along = each3(|k| along[k].zip(length, |a, length| a / length));
        self.set_axes(&along, &cross64(normal, &along));
        let [a, b, c] = corners;
        for i in 0..3 {
            let [a, b, c] = [
                dot64(&self.axes[i], a),
                dot64(&self.axes[i], b),
                dot64(&self.axes[i], c),
            ];
            self.low[i] = a.min(b).min(c);
            self.high[i] = a.max(b).max(c);
        }
        each4(|lane| length.0[lane] > 0.0)
    }

    /// Rounds two orthonormal axes in each lane.
    #[inline(always)]
    fn set_axes(&mut self, first: &Points64, second: &Points64) {
        let (least, most) = (F64x4::splat(-MAX_AXIS), F64x4::splat(MAX_AXIS));
        let number = |x: F64x4| (x * AXIS_UNITS).max(least).min(most).nearest_integers();
        self.numbers = [each3(|k| number(first[k])), each3(|k| number(second[k]))];
        // In single precision, as the node computes them.
        let axis = |i: usize, k: usize| each4(|lane| self.numbers[i][k][lane] as f32 * AXIS_STEP);
        let (a, b) = (each3(|k| axis(0, k)), each3(|k| axis(1, k)));
        let cross =
            |i: usize, j: usize| each4(|lane| a[i][lane] * b[j][lane] - a[j][lane] * b[i][lane]);
        let double = |x: [f32; 4]| F64x4(each4(|lane| f64::from(x[lane])));
        self.axes = [
            each3(|k| double(a[k])),
            each3(|k| double(b[k])),
            [
                double(cross(1, 2)),
                double(cross(2, 0)),
                double(cross(0, 1)),
            ],
        ];
    }

    /// The points with given coordinates along the axes, were these orthonormal.
    #[inline(always)]
    fn points(&self, along: &Points64) -> Points64 {
        let [x, y, z] = &self.axes;
        each3(|k| x[k] * along[0] + y[k] * along[1] + z[k] * along[2])
    }

    /// The coordinates of points along the axes.
    #[inline(always)]
    fn places(&self, points: &Points64) -> Points64 {
        each3(|i| dot64(&self.axes[i], points))
    }

    /// The centres of the boxes between the planes: the points with the middle coordinate along each axis.
    #[inline(always)]
    fn centers(&self) -> Points64 {
        let middle = each3(|i| (self.low[i] + self.high[i]) * 0.5);
        let near = self.points(&middle);
        // One step of Newton's method for axes that are orthonormal but for rounding.
        let off = self.points(&sub64(&middle, &self.places(&near)));
        each3(|k| near[k] + off[k])
    }

    /// Half sides that bound the sets in both senses of [`PackedBox`](super::PackedBox) around other centres.
    #[inline(always)]
    fn halves_around(&self, centers: &Points64) -> Points64 {
        let place = self.places(centers);
        let along = each3(|i| (self.high[i] - place[i]).max(place[i] - self.low[i]));
        let [x, y, z] = &self.axes;
        // A point at coordinates s along the axes is the centre plus sum t_i axis_i, where s = (axes^T axes) t.
        let (xx, xy, yy) = (dot64(x, x), dot64(x, y), dot64(y, y));
        let determinant = xx * yy - xy * xy;
        let over = |a: F64x4, b: F64x4| a.zip(b, |a, b| a / b);
        let parts = [
            over(yy * along[0] + xy.abs() * along[1], determinant),
            over(xx * along[1] + xy.abs() * along[0], determinant),
            over(along[2], dot64(z, z)),
        ];
        let slack = (along[0] + along[1] + along[2]) * AXIS_ROUNDING;
        each3(|i| along[i].max(parts[i]) + slack)
    }
}

/// The first of the longest edges of triangles.
#[inline(always)]
fn longest_edge([a, b, c]: &[Points64; 3]) -> Points64 {
    let mut longest = sub64(a, c);
    let mut square = dot64(&longest, &longest);
    for edge in [sub64(b, a), sub64(c, b)] {
        let own = dot64(&edge, &edge);
        for lane in 0..4 {
            let is_longer = own.0[lane] > square.0[lane];
            for k in 0..3 {
                let before = longest[k].0[lane];
                longest[k].0[lane] = if is_longer { edge[k].0[lane] } else { before };
            }
        }
        square = square.max(own);
    }
    longest
}

impl WideNode {
    /// A node of up to eight boxes along stored axes; the caller sets `children`. Lengths are at most about 1.
    #[inline(always)]
    pub fn of_spans(boxes: &[AxisSpans]) -> Self {
        let mut fours = [FourSpans::default(); 2];
        for (i, one) in boxes.iter().enumerate() {
            fours[i / 4].set(i % 4, one);
        }
        Self::of_fours(&mut fours, boxes.len())
    }

    /// The same for the first `count` boxes of those in lanes. The rest of the last four is overwritten.
    #[inline(always)]
    pub fn of_fours(fours: &mut [FourSpans; 2], count: usize) -> Self {
        if !count.is_multiple_of(4) {
            fours[count / 4].repeat_first(count % 4);
        }
        let mut node = Self {
            count: count as u32,
            ..Self::default()
        };
        let fours = &fours[..count.div_ceil(4)];
        let mut centers = [splat64(&[0.0; 3]); 2];
        let mut low = splat64(&[f64::INFINITY; 3]);
        let mut high = splat64(&[f64::NEG_INFINITY; 3]);
        let mut longest = F64x4::splat(0.0);
        for (centers, four) in centers.iter_mut().zip(fours) {
            *centers = four.centers();
            for k in 0..3 {
                low[k] = low[k].min(centers[k]);
                high[k] = high[k].max(centers[k]);
                longest = longest.max((four.high[k] - four.low[k]) * 0.5);
            }
        }
        let (low, high) = (each3(|k| low[k].least()), each3(|k| high[k].greatest()));
        let [x, y, z] = each3(|k| (low[k] + high[k]) * 0.5);
        let spread = each3(|k| high[k] - low[k]);
        let spread = spread[0].max(spread[1]).max(spread[2]);
        let mut step = (0.5 * spread / MAX_PLACE)
            .max(longest.greatest() / MAX_HALF)
            .max(1e-30);
        loop {
            node.frame = [x, y, z, step * (1.0 + 1e-6)].map(|x| x as f32);
            let mut fit = true;
            // A loop: the closure of `all` would not be compiled for the widest instruction set.
            for (i, (four, centers)) in fours.iter().zip(&centers).enumerate() {
                fit &= node.set_four(4 * i, four, centers);
            }
            if fit {
                node.clear_from(count);
                return node;
            }
            // The boxes are tiny relative to their coordinates: the room for rounding was too small.
            step *= 1.25;
        }
    }

    /// Sets four boxes from a lane on; false if one does not fit the step.
    #[inline(always)]
    fn set_four(&mut self, first: usize, four: &FourSpans, centers: &Points64) -> bool {
        let step = self.step();
        let in_steps = |x: F64x4| x.map(|x| x / f64::from(step));
        for (axes, numbers) in self.axes.iter_mut().zip(&four.numbers) {
            for (components, numbers) in axes.iter_mut().zip(numbers) {
                store(components, first, |lane| numbers[lane] as i16);
            }
        }
        let (least, most) = (F64x4::splat(-MAX_PLACE), F64x4::splat(MAX_PLACE));
        let mut stored = *centers;
        for k in 0..3 {
            let origin = self.frame[k];
            let place = in_steps(centers[k] - F64x4::splat(f64::from(origin)));
            let place = place.max(least).min(most).nearest_integers();
            store(&mut self.center[k], first, |lane| place[lane] as i16);
            stored[k] = F64x4(each4(|lane| f64::from(place[lane] as f32 * step + origin)));
        }
        let needed = four.halves_around(&stored);
        let mut fits = true;
        let mut square = F64x4::splat(0.0);
        for i in 0..3 {
            let length = |half: F64x4| half.map(|half| f64::from(half as f32 * step));
            // The product in single precision may be less than needed, by far less than another step.
            let half = in_steps(needed[i].max(F64x4::splat(0.0))).ceiling();
            let short = length(half).zip(
                needed[i],
                |own, needed| {
                    if own < needed { 1.0 } else { 0.0 }
                },
            );
            let half = half + short;
            let length = length(half);
            for lane in 0..4 {
                fits &= !(half.0[lane] > 65535.0 || length.0[lane] < needed[i].0[lane]);
            }
            let number = half.nearest_integers();
            store(&mut self.half[i], first, |lane| number[lane] as u16);
            square = square + length * length;
        }
        store(&mut self.sizes, first, |lane| size_code_of(square.0[lane]));
        fits
    }

    /// Zeroes the lanes from one on.
    #[inline(always)]
    fn clear_from(&mut self, count: usize) {
        // Masks of whole lanes: a loop over the rest of each array takes longer.
        let mask: [u16; 8] = std::array::from_fn(|lane| if lane < count { u16::MAX } else { 0 });
        let signed = self.axes.as_flattened_mut().iter_mut();
        for numbers in signed.chain(&mut self.center) {
            for lane in 0..8 {
                numbers[lane] &= mask[lane] as i16;
            }
        }
        for lane in 0..8 {
            for numbers in &mut self.half {
                numbers[lane] &= mask[lane];
            }
            self.sizes[lane] &= mask[lane] as u8;
        }
    }
}

/// Sets four lanes of eight.
#[inline(always)]
fn store<T>(numbers: &mut [T; 8], first: usize, number: impl Fn(usize) -> T) {
    let four = &mut numbers.as_chunks_mut::<4>().0[first / 4];
    *four = each4(number);
}
