//! Joints: what connects a link to its parent, and how the coordinates move it.

use std::fmt;
use std::sync::Arc;

use smallvec::SmallVec;

use super::custom_joint::{CustomJoint, Twist};
use crate::error::Result;
use crate::euler::{AngularFrame, euler_rates};
use crate::pose::{Mat3, Pose, Vec3, rotation_about};

/// How a joint moves its link. Velocities are rates of the coordinates, except for quaternions: there they are linear and
/// angular velocity in the link's own frame.
#[derive(Clone)]
pub enum JointKind {
    /// Does not move.
    Fixed,
    /// Rotates about the axis; the coordinate is an angle in radians.
    Revolute,
    /// Translates along the axis; the coordinate is a length.
    Prismatic,
    /// Moves in the xy-plane of the joint's frame: x, y, and an angle about z.
    Planar,
    /// Rotates about the origin: a unit quaternion x, y, z, w; the velocity is angular.
    Spherical,
    /// Moves freely: x, y, z and a unit quaternion x, y, z, w; the velocity is linear, then angular.
    Free,
    /// Moves freely, by the report's x, y, z, yaw, pitch, roll (§4.1). Singular at cos(pitch) = 0: there no velocity turns
    /// the link about some axis.
    FreeEuler,
    /// Moves by a map of the caller.
    Custom(Arc<dyn CustomJoint>),
}

impl fmt::Debug for JointKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            JointKind::Fixed => "Fixed",
            JointKind::Revolute => "Revolute",
            JointKind::Prismatic => "Prismatic",
            JointKind::Planar => "Planar",
            JointKind::Spherical => "Spherical",
            JointKind::Free => "Free",
            JointKind::FreeEuler => "FreeEuler",
            JointKind::Custom(_) => "Custom",
        })
    }
}

impl JointKind {
    /// The number of coordinates.
    pub fn nq(&self) -> usize {
        match self {
            JointKind::Fixed => 0,
            JointKind::Revolute | JointKind::Prismatic => 1,
            JointKind::Planar => 3,
            JointKind::Spherical => 4,
            JointKind::Free => 7,
            JointKind::FreeEuler => 6,
            JointKind::Custom(joint) => joint.coordinates(),
        }
    }

    /// The number of velocities.
    pub fn nv(&self) -> usize {
        match self {
            JointKind::Spherical => 3,
            JointKind::Free => 6,
            other => other.nq(),
        }
    }

    /// Whether the joint moves its link along or about its axis.
    pub fn has_axis(&self) -> bool {
        matches!(self, JointKind::Revolute | JointKind::Prismatic)
    }
}

/// A joint of a robot, in the joint's frame.
#[derive(Clone, Debug)]
pub struct Joint {
    /// How it moves its link.
    pub kind: JointKind,
    /// A unit vector; used by revolute and prismatic joints.
    pub axis: Vec3,
    /// The first of its coordinates in the robot.
    pub coordinate: usize,
    /// The first of its velocities in the robot.
    pub velocity: usize,
    /// A revolute or prismatic joint moves by `multiplier * coordinate + offset`.
    pub multiplier: f64,
    /// See `multiplier`; radians or a length.
    pub offset: f64,
}

impl Joint {
    /// The link's pose in the joint's frame at configuration q of the robot.
    pub fn motion(&self, q: &[f64]) -> Result<Pose> {
        let own = &q[self.coordinate..self.coordinate + self.kind.nq()];
        Ok(match &self.kind {
            JointKind::Fixed => Pose::identity(),
            JointKind::Revolute => Pose {
                rotation: rotation_about(&self.axis, self.position(q)),
                translation: Vec3::zeros(),
            },
            JointKind::Prismatic => Pose::from_translation(self.axis * self.position(q)),
            JointKind::Planar => Pose {
                rotation: rotation_about(&Vec3::z(), own[2]),
                translation: Vec3::new(own[0], own[1], 0.0),
            },
            JointKind::Spherical => Pose::from_quaternion(Vec3::zeros(), array(own))?,
            JointKind::Free => {
                Pose::from_quaternion(Vec3::new(own[0], own[1], own[2]), array(&own[3..]))?
            }
            JointKind::FreeEuler => Pose::from_euler(&array(own)),
            JointKind::Custom(joint) => joint.pose(own)?,
        })
    }

    /// Appends one column per velocity: the link's twist, in the world. `frame` is the rotation of the joint's frame and
    /// `link` the pose of the link.
    pub(super) fn columns(
        &self,
        q: &[f64],
        frame: &Mat3,
        link: &Pose,
        columns: &mut SmallVec<[Twist; 6]>,
    ) -> Result<()> {
        let own = &q[self.coordinate..self.coordinate + self.kind.nq()];
        let shift = |matrix: &Mat3, k: usize| Twist {
            linear: matrix.column(k).into(),
            angular: Vec3::zeros(),
        };
        let turn = |matrix: &Mat3, k: usize| Twist {
            linear: Vec3::zeros(),
            angular: matrix.column(k).into(),
        };
        match &self.kind {
            JointKind::Fixed => {}
            // The joint's motion leaves the axis in place.
            JointKind::Revolute => columns.push(Twist {
                linear: Vec3::zeros(),
                angular: frame * self.axis * self.multiplier,
            }),
            JointKind::Prismatic => columns.push(Twist {
                linear: frame * self.axis * self.multiplier,
                angular: Vec3::zeros(),
            }),
            JointKind::Planar => {
                columns.extend([shift(frame, 0), shift(frame, 1), turn(frame, 2)]);
            }
            JointKind::Spherical => columns.extend((0..3).map(|k| turn(&link.rotation, k))),
            JointKind::Free => {
                columns.extend((0..3).map(|k| shift(&link.rotation, k)));
                columns.extend((0..3).map(|k| turn(&link.rotation, k)));
            }
            JointKind::FreeEuler => {
                let rates = frame * euler_rates(array(&own[3..]), AngularFrame::World);
                columns.extend((0..3).map(|k| shift(frame, k)));
                columns.extend((0..3).map(|k| turn(&rates, k)));
            }
            JointKind::Custom(joint) => {
                let mut given = Vec::new();
                joint.jacobian(own, &mut given)?;
                columns.extend(given.into_iter().map(|twist| Twist {
                    linear: frame * twist.linear,
                    angular: frame * twist.angular,
                }));
            }
        }
        Ok(())
    }

    /// The angle or length of a revolute or prismatic joint at configuration q of the robot.
    #[inline]
    pub(super) fn position(&self, q: &[f64]) -> f64 {
        self.multiplier * q[self.coordinate] + self.offset
    }
}

fn array<const N: usize>(values: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| values[i])
}
