//! The bounding volumes of a body at a pose.

use crate::body::Body;
use crate::boxes::Extent;
use crate::lanes::{Instructions, along64};
use crate::pose::{Pose, Vec3, column, columns, vector};
use crate::tolerance;

/// The bounding ball and the oriented bounding box of a body at a pose, in the world.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bounds {
    pub(super) center: Vec3,
    pub(super) radius: f64,
    /// How near the body comes to the centre: see `gap_to_center`.
    pub(super) gap_to_center: f64,
    /// The centre of the box.
    pub box_center: Vec3,
    /// The first two axes, orthonormal to within 2^-12 (see `PackedBox`); the third is their cross product.
    pub axes: [Vec3; 2],
    /// Half the side along each axis.
    pub half: Vec3,
    /// An upper bound of the distance of the box's corners from its centre.
    pub box_radius: f64,
    /// How far the body may be from what it stands for: the largest deviation of its primitives from their features (`Body::deviation`), and
    /// the one that was stated (`Body::stated_deviation`).
    pub deviation: f64,
    /// An upper bound of the coordinates in the computation, to which the rounding is proportional.
    pub largest_coordinate: f64,
}

impl Bounds {
    /// The bounds of a body at a pose, within code that is compiled for an instruction set.
    #[inline(always)]
    pub fn of<I: Instructions>(lanes: I, body: &Body, pose: &Pose) -> Self {
        let whole = body.packed().whole();
        let to_world = columns(lanes, &pose.rotation);
        let [x, y, z] = &whole.frame;
        let axis_x = along64(&to_world, &[x.0[0], y.0[0], z.0[0]]);
        let axis_y = along64(&to_world, &[x.0[1], y.0[1], z.0[1]]);
        let to_box = along64(&to_world, &[x.0[2], y.0[2], z.0[2]]);
        let to_ball = along64(&to_world, &[x.0[3], y.0[3], z.0[3]]);
        let center = body.center();
        let origin = along64(&to_world, &[center.x, center.y, center.z]) + column(lanes, pose, 3);
        Self {
            center: vector(origin + to_ball),
            radius: whole.ball_radius,
            gap_to_center: whole.gap_to_center,
            box_center: vector(origin + to_box),
            axes: [vector(axis_x), vector(axis_y)],
            half: whole.half,
            box_radius: whole.radius,
            deviation: body.deviation() + body.stated_deviation(),
            largest_coordinate: l1_norm(center) + l1_norm(&pose.translation) + body.radius(),
        }
    }

    /// A safe lower and a safe upper bound of the distance between two bodies, from their balls and from how near they come to the
    /// centres of these.
    #[inline(always)]
    pub fn distance(&self, other: &Bounds) -> [f64; 2] {
        let apart = (self.center - other.center).norm();
        let radii = self.radius + other.radius;
        let at_most = (apart + self.gap_to_center + other.gap_to_center).max(0.0);
        let largest_coordinate = self.largest_coordinate.max(other.largest_coordinate);
        let slack = slack(largest_coordinate, self.deviation + other.deviation);
        [apart - radii - slack, at_most + slack]
    }

    /// The axis-aligned box around the oriented one.
    #[inline(always)]
    pub fn extent(&self) -> Extent {
        let [x, y] = &self.axes;
        let extent = x.abs() * self.half.x + y.abs() * self.half.y + x.cross(y).abs() * self.half.z;
        Extent {
            low: self.box_center - extent,
            high: self.box_center + extent,
        }
    }
}

#[inline(always)]
fn l1_norm(v: &Vec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// The slack by which a bound in the world is lowered so that pruning is safe: its rounding, and the error of the distances
/// on both sides of a comparison (see `Pairing::slack`).
#[inline(always)]
pub fn slack(largest_coordinate: f64, deviation: f64) -> f64 {
    let rounding = tolerance::BOUND_ERROR + 2.0 * tolerance::DISTANCE_ERROR;
    4.0 * rounding * largest_coordinate + 2.0 * deviation
}
