//! Robots from URDF files: read, checked as a tree, and added to a robot builder link by link.
//!
//! The file is read here, over the crate roxmltree: the crate urdf-rs does not say at which element it failed, passes over
//! numbers it cannot read, and brings fifteen crates along.

mod assemble;
mod bodies;
mod model;
mod packages;
mod report;
mod shapes;

pub use assemble::{BaseJoint, UrdfGeometry, UrdfOptions, add_urdf_file};
pub use report::UrdfReport;
