//! Steps on rotations and rigid placements: the exponential and the logarithm of SO(3) and SE(3) (Murray, Li, Sastry 1994,
//! ch. 2).

use nalgebra::{Quaternion, Rotation3, UnitQuaternion};

use crate::nonzero::product;
use crate::pose::{Pose, Vec3};

/// A unit quaternion from its entries x, y, z, w, whose norm may be off 1 by rounding.
pub fn rotation(xyzw: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(xyzw[3], xyzw[0], xyzw[1], xyzw[2]))
}

/// The entries x, y, z, w of a rotation.
pub fn entries(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    let q = rotation.quaternion();
    [q.i, q.j, q.k, q.w]
}

/// The shortest rotation vector that takes one rotation to another, in the frame of the first.
pub fn turn_between(from: &UnitQuaternion<f64>, to: &UnitQuaternion<f64>) -> Vec3 {
    let between = from.inverse() * to;
    // Both q and -q stand for the rotation; this is the one with an angle of at most pi.
    let q = between.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    let (v, w) = (Vec3::new(q.i, q.j, q.k) * sign, q.w * sign);
    let s = v.norm();
    // 2 atan2(s, w) / s, which tends to 2 / w as s vanishes.
    if s < 1e-8 {
        v * (2.0 / w)
    } else {
        v * (2.0 * s.atan2(w) / s)
    }
}

/// A position and an orientation.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    pub translation: Vec3,
    pub rotation: UnitQuaternion<f64>,
}

impl Placement {
    pub fn read(q: &[f64]) -> Self {
        Self {
            translation: Vec3::new(q[0], q[1], q[2]),
            rotation: rotation(&q[3..7]),
        }
    }

    pub fn write(&self, q: &mut [f64]) {
        q[..3].copy_from_slice(self.translation.as_slice());
        q[3..7].copy_from_slice(&entries(&self.rotation));
    }

    /// The placement reached with a constant twist, in the moved frame, after a unit of time: the exponential of SE(3).
    pub fn step(&self, linear: &Vec3, angular: &Vec3) -> Self {
        let angle = angular.norm();
        let (a, b) = screw_coefficients(angle);
        let across = angular.cross(linear);
        let shift = linear + across * a + angular.cross(&across) * b;
        Self {
            translation: self.translation + self.rotation * shift,
            rotation: self.rotation * UnitQuaternion::from_scaled_axis(*angular),
        }
    }

    /// For each coordinate of the position, how far it is at most from the line between its ends on the way of such a step: an eighth of the
    /// largest second derivative, which is the coordinate of angular x linear, turned about the angular velocity.
    pub fn bends(&self, linear: &Vec3, angular: &Vec3) -> [f64; 3] {
        let to_moved = self.rotation.inverse();
        [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| {
            // Only what is across the angular velocity turns about it, and all of the product is across.
            let across = (to_moved * axis).cross(angular).norm();
            0.125 * product(across, linear.norm())
        })
    }

    /// The twist that leads to another placement in a unit of time, with the shortest rotation: the logarithm of SE(3).
    pub fn difference(&self, to: &Self) -> [Vec3; 2] {
        let angular = turn_between(&self.rotation, &to.rotation);
        let shift = self.rotation.inverse() * (to.translation - self.translation);
        let angle = angular.norm();
        // 1 / angle^2 - cot(angle / 2) / (2 angle); for small angles, where this cancels, by its series.
        let c = if angle < 1e-2 {
            let square = angle * angle;
            1.0 / 12.0 + square / 720.0 + square * square / 30240.0
        } else {
            let half = angle / 2.0;
            (1.0 - half * half.cos() / half.sin()) / (angle * angle)
        };
        let across = angular.cross(&shift);
        let linear = shift - across * 0.5 + angular.cross(&across) * c;
        [linear, angular]
    }
}

/// The twist that leads from one pose to another in a unit of time, linear and angular velocity in the moved frame, with the
/// shortest rotation.
pub fn screw_between(from: &Pose, to: &Pose) -> [Vec3; 2] {
    let shift = to.translation - from.translation;
    if from.rotation == to.rotation {
        return [from.rotation.tr_mul(&shift), Vec3::zeros()];
    }
    let placement = |pose: &Pose| Placement {
        translation: pose.translation,
        rotation: UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(
            pose.rotation,
        )),
    };
    placement(from).difference(&placement(to))
}

/// (1 - cos x) / x^2 and (x - sin x) / x^3; for small x, where they cancel, by their series.
fn screw_coefficients(x: f64) -> (f64, f64) {
    let square = x * x;
    if x < 1e-2 {
        (
            0.5 - square / 24.0 + square * square / 720.0,
            1.0 / 6.0 - square / 120.0 + square * square / 5040.0,
        )
    } else {
        let half = (0.5 * x).sin();
        (2.0 * half * half / square, (x - x.sin()) / (square * x))
    }
}
