//! Displacements of rigid bodies, to first order.

use super::pose::{Mat3, Vec3, turned_back};

/// A displacement of a rigid body: its points x, seen from a point of it, move by `linear + angular x x`.
#[derive(Clone, Copy, Debug)]
pub struct Displacement {
    /// Of the point.
    pub linear: Vec3,
    /// The turn, in radians, about this axis.
    pub angular: Vec3,
}

impl Displacement {
    /// How the point of the body moves that is here, seen from the displacement's own.
    #[inline(always)]
    pub fn of_point(&self, x: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(x)
    }

    /// The same displacement, told of another point of the body.
    #[inline(always)]
    pub fn told_of(&self, x: &Vec3) -> Self {
        Self {
            linear: self.of_point(x),
            ..*self
        }
    }

    /// With components along the axes of a frame, the columns of `rotation`.
    #[inline(always)]
    pub fn turned_back(&self, rotation: &Mat3) -> Self {
        Self {
            linear: turned_back(rotation, &self.linear),
            angular: turned_back(rotation, &self.angular),
        }
    }
}
