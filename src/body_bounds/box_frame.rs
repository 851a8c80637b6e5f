//! Where the boxes of one traversal are compared in single precision.

use super::bounds::{Bounds, slack};
use crate::boxes::PackedBox;
use crate::hierarchy::packed::power_of_two_above;
use crate::lanes::{cross3, each3};
use crate::pair::ROUNDING;
use crate::pose::Vec3;

/// No unit is less than this. Points that all lie in one place have no extent to take it from, and a quotient of units must be a number.
pub const SMALLEST_UNIT: f64 = 1e-150;

/// A place of the world and a unit in which boxes are compared in single precision: a power of two about as large as the extent of
/// everything.
#[derive(Clone, Copy, Debug)]
pub struct BoxFrame {
    /// Boxes are placed relative to it.
    pub center: Vec3,
    /// The unit.
    pub scale: f64,
    /// 1 over it.
    pub inverse_scale: f64,
    /// By what bounds are lowered.
    slack: f64,
}

/// What a frame must hold.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameLimits {
    /// No point of a box is farther from the frame's centre.
    pub size: f64,
    /// An upper bound of the coordinates in the world.
    pub largest_coordinate: f64,
    /// The largest deviation of a body, with the one that was stated.
    pub deviation: f64,
}

impl FrameLimits {
    /// Takes in another body.
    #[inline(always)]
    pub fn take_in(&mut self, center: &Vec3, body: &Bounds) {
        let from_center = body.box_center - center;
        self.size = self.size.max(from_center.norm() + body.box_radius);
        self.largest_coordinate = self.largest_coordinate.max(body.largest_coordinate);
        self.deviation = self.deviation.max(body.deviation);
    }
}

impl BoxFrame {
    /// Two bodies of the frame deviate by at most `deviation` together.
    #[inline(always)]
    pub fn new(center: Vec3, limits: &FrameLimits, deviation: f64) -> Self {
        let size = limits.size.max(SMALLEST_UNIT);
        let scale = power_of_two_above(size);
        Self {
            center,
            scale,
            inverse_scale: 1.0 / scale,
            slack: slack(limits.largest_coordinate, deviation) + ROUNDING * size,
        }
    }

    /// A body's box.
    #[inline(always)]
    pub fn pack(&self, body: &Bounds) -> PackedBox {
        self.pack_box(
            &[body.axes[0], body.axes[1]],
            &(body.box_center - self.center),
            &body.half,
        )
    }

    /// A box, by two of its axes, its centre relative to the frame's and its half sides.
    #[inline(always)]
    pub fn pack_box(&self, [x, y]: &[Vec3; 2], center: &Vec3, half: &Vec3) -> PackedBox {
        let (x, y) = (each3(|k| x[k] as f32), each3(|k| y[k] as f32));
        let scale = self.inverse_scale;
        PackedBox {
            axes: [x, y, cross3(&x, &y)],
            center: each3(|k| (center[k] * scale) as f32),
            // Rounded up: the next number after x is at most x (1 + EPSILON). What is 0 here is so to within ROUNDING.
            half: each3(|i| (half[i] * scale) as f32 * (1.0 + f32::EPSILON)),
        }
    }

    /// A single-precision bound above this proves that the distance is above `limit`.
    #[inline(always)]
    pub fn cutoff(&self, limit: f64) -> f32 {
        (((limit + self.slack) * self.inverse_scale) as f32).next_up()
    }

    /// The safe lower bound of the distance that follows from a single-precision bound.
    #[inline(always)]
    pub fn lower(&self, bound: f32) -> f64 {
        f64::from(bound) * self.scale - self.slack
    }
}
