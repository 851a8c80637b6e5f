//! Joints defined by callbacks: the report's "arbitrary kinematics" (§4), given by a local forward map and its Jacobian.

use std::sync::Arc;

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::{Pose, Vec3};

/// The velocity of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// Velocity of the link's origin.
    pub linear: Vec3,
    /// Angular velocity.
    pub angular: Vec3,
}

/// Upper bounds of a link's speed when one coordinate of its joint changes at rate 1, at any configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speeds {
    /// Bounds the speed of the link's origin.
    pub linear: f64,
    /// Bounds the angular speed, in radians.
    pub angular: f64,
}

/// A joint with its own kinematics. Both maps must be pure; threads call them concurrently.
pub trait CustomJoint: Send + Sync {
    /// The number of coordinates, at most [`MAX_COORDINATES`].
    fn coordinates(&self) -> usize;

    /// The link's pose in the joint's frame.
    fn pose(&self, q: &[f64]) -> Result<Pose>;

    /// Appends one twist per coordinate, in the joint's frame: the derivative of the pose.
    fn jacobian(&self, q: &[f64], columns: &mut Vec<Twist>) -> Result<()>;

    /// Bounds of the link's speed per unit rate of a coordinate; `None` if unknown. Without them no motion can be proved
    /// free.
    fn speeds(&self) -> Option<Speeds>;
}

/// The most coordinates of a custom joint; more are taken for a mistake.
pub const MAX_COORDINATES: usize = 64;

/// Checks what a custom joint returns.
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
