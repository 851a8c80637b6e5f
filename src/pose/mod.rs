//! Rigid poses as homogeneous transforms, §4.1 eq. (8)–(11).

mod columns;
mod displacement;
#[allow(clippy::module_inception)]
mod pose;

pub use columns::turned_axes;
pub(crate) use columns::{PoseColumns, column, columns, vector};
pub use displacement::Displacement;
#[cfg(test)]
pub(crate) use pose::IsPose;
pub use pose::{Mat3, Pose, Vec3, check_dimension, rotation_about, turned, turned_back};
pub(crate) use pose::{Rows, is_pose};
