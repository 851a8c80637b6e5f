//! Joints: what connects a link to its parent.

use crate::pose::{Pose, Vec3, rotation_about};

/// How a joint moves its link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// Turns it about the axis; the coordinate is an angle in radians.
    Revolute,
    /// Shifts it along the axis; the coordinate is a length.
    Prismatic,
}

/// A joint in its own frame: it sits at the link's origin.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    pub kind: JointKind,
    /// A unit vector; unused by fixed joints.
    pub axis: Vec3,
    /// Which of the robot's coordinates moves it; unused by fixed joints.
    pub coordinate: usize,
}

impl Joint {
    /// The motion of the link at configuration q.
    pub fn motion(&self, q: &[f64]) -> Pose {
        match self.kind {
            JointKind::Fixed => Pose::identity(),
            JointKind::Revolute => Pose {
                rotation: rotation_about(&self.axis, q[self.coordinate]),
                translation: Vec3::zeros(),
            },
            JointKind::Prismatic => Pose::from_translation(self.axis * q[self.coordinate]),
        }
    }
}
