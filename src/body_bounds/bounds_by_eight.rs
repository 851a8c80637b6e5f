//! The bounds of bodies that move together, eight side by side.

use super::bounds::Bounds;
use super::box_frame::{BoxFrame, FrameLimits};
use crate::boxes::{BoxesByEight, EightBoxes};
use crate::lanes::{Doubles, F64x4, Instructions, Points64, dot64, each_axis, each3, sub64};
use crate::pose::{Pose, Vec3};

/// The bounds of bodies, by their numbers from 0 on: see [`Bounds`].
#[derive(Clone, Debug, Default)]
pub struct BoundsByEight {
    eights: Vec<[FourBounds; 2]>,
    count: usize,
}

/// The bounds of up to four bodies.
#[derive(Clone, Copy, Debug, Default)]
struct FourBounds {
    center: Points64,
    box_center: Points64,
    axes: [Points64; 2],
    largest_coordinate: F64x4,
    half: Points64,
    radius: F64x4,
    gap_to_center: F64x4,
    box_radius: F64x4,
    deviation: F64x4,
}

/// Some of the bodies: a bit for each, from a number on that is a multiple of 64.
#[derive(Clone, Copy, Debug)]
pub struct ChosenBodies<'w> {
    /// The number of the first, over 64.
    pub first: usize,
    /// Their bits.
    pub words: &'w [u64],
}

impl ChosenBodies<'_> {
    /// How many eights have bits.
    fn eights(&self) -> usize {
        8 * self.words.len()
    }

    /// The bits of one of them.
    #[inline(always)]
    fn of_eight(&self, eight: usize) -> u32 {
        (self.words[eight / 8] >> (8 * (eight % 8))) as u32 & 0xff
    }
}

impl BoundsByEight {
    /// Takes all out.
    pub fn clear(&mut self) {
        self.eights.clear();
        self.count = 0;
    }

    /// Gives a body the next number.
    pub fn push(&mut self, one: &Bounds) {
        let (eight, lane) = (self.count / 8, self.count % 8);
        if eight == self.eights.len() {
            self.eights.push(Default::default());
        }
        self.eights[eight][lane / 4].set(lane % 4, one);
        self.count += 1;
    }

    /// The bounds of a body.
    #[inline(always)]
    pub fn get(&self, number: usize) -> Bounds {
        let (eight, lane) = (number / 8, number % 8);
        self.eights[eight][lane / 4].get(lane % 4)
    }

    /// Becomes the bounds of bodies that others carry, from those in the carriers' frames: the body of a number is carried at the pose
    /// of place `carriers[number]`.
    #[inline(always)]
    pub fn carry<I: Instructions>(
        &mut self,
        lanes: I,
        own: &Self,
        carriers: &[usize],
        poses: &[Pose],
    ) {
        self.count = own.count;
        self.eights.resize(own.eights.len(), Default::default());
        for (eight, (all, own)) in self.eights.iter_mut().zip(&own.eights).enumerate() {
            for (half, (four, own)) in all.iter_mut().zip(own).enumerate() {
                let carriers = &carriers[(8 * eight + 4 * half).min(carriers.len())..];
                let [a, b, c, d] = match *carriers {
                    [a, b, c, d, ..] => [a, b, c, d],
                    [a, b, c] => [a, b, c, c],
                    [a, b] => [a, b, b, b],
                    [a] => [a; 4],
                    [] => continue,
                };
                four.carry(lanes, own, [&poses[a], &poses[b], &poses[c], &poses[d]]);
            }
        }
    }

    /// What a frame around a centre must hold for the chosen bodies.
    #[inline(always)]
    pub fn limits<I: Instructions>(
        &self,
        lanes: I,
        chosen: ChosenBodies,
        center: &Vec3,
    ) -> FrameLimits {
        let center = Doubles::point(lanes, &[center.x, center.y, center.z]);
        let none = Doubles::splat(lanes, 0.0);
        let (mut square, mut radius, mut largest, mut deviation) = (none, none, none, none);
        for place in 0..chosen.eights() {
            let bits = chosen.of_eight(place);
            if bits == 0 {
                continue;
            }
            for (half, four) in self.eights[8 * chosen.first + place].iter().enumerate() {
                let kept = bits >> (4 * half) & 0xf;
                let from_center = sub64(&Doubles::points(lanes, &four.box_center), &center);
                square = square.max(dot64(&from_center, &from_center).kept(kept));
                radius = radius.max(Doubles::load(lanes, &four.box_radius).kept(kept));
                let size = Doubles::load(lanes, &four.largest_coordinate);
                largest = largest.max(size.kept(kept));
                deviation = deviation.max(Doubles::load(lanes, &four.deviation).kept(kept));
            }
        }
        FrameLimits {
            size: square.greatest().sqrt() + radius.greatest(),
            largest_coordinate: largest.greatest(),
            deviation: deviation.greatest(),
        }
    }

    /// Packs the boxes of the chosen bodies, at the places of their bits. What the other places hold means nothing.
    #[inline(always)]
    pub fn pack<I: Instructions>(
        &self,
        lanes: I,
        chosen: ChosenBodies,
        frame: &BoxFrame,
        boxes: &mut BoxesByEight,
    ) {
        for place in 0..chosen.eights() {
            if chosen.of_eight(place) != 0 {
                let fours = &self.eights[8 * chosen.first + place];
                boxes.put(lanes, place, &packed(lanes, fours, frame));
            }
        }
    }
}

/// The boxes of eight bodies in a frame: see [`BoxFrame::pack_box`].
#[inline(always)]
fn packed<I: Instructions>(
    lanes: I,
    [first, second]: &[FourBounds; 2],
    frame: &BoxFrame,
) -> EightBoxes<I> {
    let load = |numbers: &F64x4| Doubles::load(lanes, numbers);
    let x = each_axis!(k => load(&first.axes[0][k]).rounded(load(&second.axes[0][k])));
    let y = each_axis!(k => load(&first.axes[1][k]).rounded(load(&second.axes[1][k])));
    let scale = Doubles::splat(lanes, frame.inverse_scale);
    let up = lanes.splat(1.0 + f32::EPSILON);
    EightBoxes {
        axes: [x, y, lanes.cross(&x, &y)],
        center: each_axis!(k => {
            let center = Doubles::splat(lanes, frame.center[k]);
            let first = (load(&first.box_center[k]) - center) * scale;
            first.rounded((load(&second.box_center[k]) - center) * scale)
        }),
        half: each_axis!(k => {
            let first = load(&first.half[k]) * scale;
            lanes.mul(first.rounded(load(&second.half[k]) * scale), up)
        }),
    }
}

impl FourBounds {
    fn set(&mut self, lane: usize, one: &Bounds) {
        let put = |points: &mut Points64, v: &Vec3| {
            for (coordinate, &value) in points.iter_mut().zip(v) {
                coordinate.0[lane] = value;
            }
        };
        put(&mut self.center, &one.center);
        put(&mut self.box_center, &one.box_center);
        put(&mut self.axes[0], &one.axes[0]);
        put(&mut self.axes[1], &one.axes[1]);
        put(&mut self.half, &one.half);
        self.largest_coordinate.0[lane] = one.largest_coordinate;
        self.radius.0[lane] = one.radius;
        self.gap_to_center.0[lane] = one.gap_to_center;
        self.box_radius.0[lane] = one.box_radius;
        self.deviation.0[lane] = one.deviation;
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> Bounds {
        let point = |points: &Points64| Vec3::from(each3(|k| points[k].0[lane]));
        Bounds {
            center: point(&self.center),
            radius: self.radius.0[lane],
            gap_to_center: self.gap_to_center.0[lane],
            box_center: point(&self.box_center),
            axes: [point(&self.axes[0]), point(&self.axes[1])],
            half: point(&self.half),
            box_radius: self.box_radius.0[lane],
            deviation: self.deviation.0[lane],
            largest_coordinate: self.largest_coordinate.0[lane],
        }
    }

    /// Becomes the bounds of bodies at poses, from those in their own frames. What [`Bounds::of`] adds in the world, two centres in a
    /// body's frame, is added there: one more rounding of EPSILON L, which `BOUND_ERROR` has room for.
    #[inline(always)]
    fn carry<I: Instructions>(&mut self, lanes: I, own: &Self, at: [&Pose; 4]) {
        let rows = each_axis!(i => each_axis!(j => {
            let entry = [
                at[0].rotation[(i, j)],
                at[1].rotation[(i, j)],
                at[2].rotation[(i, j)],
                at[3].rotation[(i, j)],
            ];
            Doubles::four(lanes, &entry)
        }));
        let origin = each_axis!(i => {
            let entry = [
                at[0].translation[i],
                at[1].translation[i],
                at[2].translation[i],
                at[3].translation[i],
            ];
            Doubles::four(lanes, &entry)
        });
        let axes = [&own.axes[0], &own.axes[1]];
        let [x, y] = [
            Doubles::points(lanes, axes[0]),
            Doubles::points(lanes, axes[1]),
        ];
        let center = Doubles::points(lanes, &own.center);
        let box_center = Doubles::points(lanes, &own.box_center);
        let size = origin[0].abs() + origin[1].abs() + origin[2].abs();
        *self = Self {
            center: each_axis!(i => (dot64(&rows[i], &center) + origin[i]).array()),
            box_center: each_axis!(i => (dot64(&rows[i], &box_center) + origin[i]).array()),
            axes: [
                each_axis!(i => dot64(&rows[i], &x).array()),
                each_axis!(i => dot64(&rows[i], &y).array()),
            ],
            largest_coordinate: (Doubles::load(lanes, &own.largest_coordinate) + size).array(),
            ..*own
        };
    }
}
