//! Joints by maps of the caller: the report's "arbitrary kinematics" (§4), given by a local forward map and its Jacobian.

use std::sync::Arc;

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Pose, Vec3};

/// How a link moves: the velocity of its origin, and its angular velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    pub linear: Vec3,
    pub angular: Vec3,
}

/// How fast a joint moves its link at most, whatever the configuration, when one coordinate changes at rate 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speeds {
    /// Of the link's origin.
    pub linear: f64,
    /// Of the link's turning, in radians.
    pub angular: f64,
}

/// A joint with kinematics of its own. Both maps must be pure; threads may call them at once.
pub trait CustomJoint: Send + Sync {
    /// How many coordinates it has; at most [`MAX_COORDINATES`].
    fn coordinates(&self) -> usize;

    /// The link's pose in the joint's frame.
    fn pose(&self, q: &[f64]) -> Result<Pose>;

    /// Appends one twist a coordinate, in the joint's frame: the derivative of the pose.
    fn jacobian(&self, q: &[f64], columns: &mut Vec<Twist>) -> Result<()>;

    /// Bounds of what a unit of any coordinate moves the link by; `None` if they are not known. Without them no motion can
    /// be proved free.
    fn speeds(&self) -> Option<Speeds>;
}

/// More coordinates than this are taken for a mistake.
pub const MAX_COORDINATES: usize = 64;

/// A custom joint whose answers are checked.
pub(super) struct Checked(pub Arc<dyn CustomJoint>);

impl CustomJoint for Checked {
    fn coordinates(&self) -> usize {
        self.0.coordinates()
    }

    fn pose(&self, q: &[f64]) -> Result<Pose> {
        let pose = self.0.pose(q)?;
        Pose::from_row_major(&pose.to_row_major()).map_err(|e| e.within("the joint's pose"))
    }

    fn jacobian(&self, q: &[f64], columns: &mut Vec<Twist>) -> Result<()> {
        let first = columns.len();
        self.0.jacobian(q, columns)?;
        let given = columns.len() - first;
        if given != self.coordinates() {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "the joint's Jacobian has {given} columns for {} coordinates",
                    self.coordinates()
                ),
            ));
        }
        for (i, twist) in columns[first..].iter().enumerate() {
            for part in [twist.linear, twist.angular] {
                require_coordinates(part.as_slice(), "entry")
                    .map_err(|e| e.within(format_args!("the joint's Jacobian, column {i}")))?;
            }
        }
        Ok(())
    }

    fn speeds(&self) -> Option<Speeds> {
        self.0.speeds()
    }
}
