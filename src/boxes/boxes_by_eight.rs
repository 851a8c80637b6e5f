//! Boxes eight side by side, in no tree.

use super::{EightBoxes, PackedBox};
use crate::lanes::{Instructions, Triple, each3};

/// Boxes eight side by side, put in one after the other.
#[derive(Clone, Debug, Default)]
pub struct BoxesByEight {
    eights: Vec<Eight>,
    count: usize,
}

/// Up to eight boxes.
#[derive(Clone, Copy, Debug, Default)]
struct Eight {
    axes: [[[f32; 8]; 3]; 3],
    center: [[f32; 8]; 3],
    half: [[f32; 8]; 3],
}

impl BoxesByEight {
    /// Takes all out.
    pub fn clear(&mut self) {
        self.eights.clear();
        self.count = 0;
    }

    /// Puts a box in the next place.
    #[inline(always)]
    pub fn push(&mut self, one: &PackedBox) {
        let lane = self.count % 8;
        if lane == 0 {
            self.eights.push(Eight::default());
        }
        if let Some(eight) = self.eights.last_mut() {
            for k in 0..3 {
                for (axis, given) in eight.axes.iter_mut().zip(&one.axes) {
                    axis[k][lane] = given[k];
                }
                eight.center[k][lane] = one.center[k];
                eight.half[k][lane] = one.half[k];
            }
        }
        self.count += 1;
    }

    /// Puts eight boxes in places from `8 * number` on.
    #[inline(always)]
    pub fn put<I: Instructions>(&mut self, lanes: I, number: usize, boxes: &EightBoxes<I>) {
        if self.eights.len() <= number {
            self.eights.resize(number + 1, Eight::default());
        }
        self.count = self.count.max(8 * (number + 1));
        let eight = &mut self.eights[number];
        let [x, y, z] = &boxes.axes;
        eight.axes = [arrays(lanes, x), arrays(lanes, y), arrays(lanes, z)];
        eight.center = arrays(lanes, &boxes.center);
        eight.half = arrays(lanes, &boxes.half);
    }

    /// The box of a place.
    #[inline(always)]
    pub fn get(&self, place: usize) -> PackedBox {
        let (eight, lane) = (&self.eights[place / 8], place % 8);
        let of_lane = |numbers: &[[f32; 8]; 3]| each3(|k| numbers[k][lane]);
        PackedBox {
            axes: each3(|i| of_lane(&eight.axes[i])),
            center: of_lane(&eight.center),
            half: of_lane(&eight.half),
        }
    }

    /// The number of boxes.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The numbers of the eights, each with the bits of the lanes that hold boxes.
    pub fn lanes(&self) -> impl Iterator<Item = (u32, u8)> {
        (0..).zip(&self.eights).map(|(number, _)| {
            let held = (self.count - 8 * number as usize).min(8);
            (number, ((1u32 << held) - 1) as u8)
        })
    }

    /// Eight of them, those from place `8 * number` on.
    #[inline(always)]
    pub fn load<I: Instructions>(&self, lanes: I, number: u32) -> EightBoxes<I> {
        let eight = &self.eights[number as usize];
        let triple = |[x, y, z]: &[[f32; 8]; 3]| [lanes.load(x), lanes.load(y), lanes.load(z)];
        EightBoxes {
            axes: [
                triple(&eight.axes[0]),
                triple(&eight.axes[1]),
                triple(&eight.axes[2]),
            ],
            center: triple(&eight.center),
            half: triple(&eight.half),
        }
    }
}

#[inline(always)]
fn arrays<I: Instructions>(lanes: I, [x, y, z]: &Triple<I>) -> [[f32; 8]; 3] {
    [lanes.array(*x), lanes.array(*y), lanes.array(*z)]
}
