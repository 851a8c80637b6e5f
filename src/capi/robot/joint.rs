//! The kinds of joints.

use crate::robot::JointKind;

/// How a joint moves its link, and its coordinates. Velocities (and so steps and gradients) are the coordinates' rates, one
/// each, except for joints with a unit quaternion x, y, z, w, which state theirs.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_joint_kind {
    /// Does not move.
    CSTK_JOINT_FIXED = 0,
    /// Rotates about the axis; the coordinate is an angle in radians.
    CSTK_JOINT_REVOLUTE = 1,
    /// Translates along the axis; the coordinate is a length.
    CSTK_JOINT_PRISMATIC = 2,
    /// Moves in the xy-plane of the joint's frame: x, y, and an angle about z.
    CSTK_JOINT_PLANAR = 3,
    /// Rotates about the origin. Four coordinates, a quaternion; three velocities, angular, in the link's frame.
    CSTK_JOINT_SPHERICAL = 4,
    /// Moves freely. Seven coordinates: x, y, z and a quaternion; six velocities: linear, then angular, in the link's
    /// frame.
    CSTK_JOINT_FREE = 5,
    /// Moves freely, by the report's x, y, z, yaw, pitch, roll (§4.1): six coordinates. Singular at cos(pitch) = 0: there
    /// no velocity turns the link about some axis.
    CSTK_JOINT_FREE_EULER = 6,
    /// Moves by callbacks; see cstk_custom_joint.
    CSTK_JOINT_CUSTOM = 7,
}

impl cstk_joint_kind {
    /// The kind, unless it is custom or unknown.
    pub(crate) fn decode(value: i32) -> Option<JointKind> {
        [
            (Self::CSTK_JOINT_FIXED, JointKind::Fixed),
            (Self::CSTK_JOINT_REVOLUTE, JointKind::Revolute),
            (Self::CSTK_JOINT_PRISMATIC, JointKind::Prismatic),
            (Self::CSTK_JOINT_PLANAR, JointKind::Planar),
            (Self::CSTK_JOINT_SPHERICAL, JointKind::Spherical),
            (Self::CSTK_JOINT_FREE, JointKind::Free),
            (Self::CSTK_JOINT_FREE_EULER, JointKind::FreeEuler),
        ]
        .into_iter()
        .find_map(|(code, kind)| (code as i32 == value).then_some(kind))
    }

    pub(crate) fn of(kind: &JointKind) -> Self {
        match kind {
            JointKind::Fixed => Self::CSTK_JOINT_FIXED,
            JointKind::Revolute => Self::CSTK_JOINT_REVOLUTE,
            JointKind::Prismatic => Self::CSTK_JOINT_PRISMATIC,
            JointKind::Planar => Self::CSTK_JOINT_PLANAR,
            JointKind::Spherical => Self::CSTK_JOINT_SPHERICAL,
            JointKind::Free => Self::CSTK_JOINT_FREE,
            JointKind::FreeEuler => Self::CSTK_JOINT_FREE_EULER,
            JointKind::Custom(_) => Self::CSTK_JOINT_CUSTOM,
        }
    }
}
