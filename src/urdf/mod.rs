//! Robots from URDF files: read, checked as a tree, and added to a robot builder link by link.
//!
//! The file is read here, over the crate roxmltree: the crate urdf-rs does not say at which element it failed, passes over
//! numbers it cannot read, and brings fifteen crates along.

mod assemble;
mod model;
mod packages;
mod shapes;

pub use assemble::{BaseJoint, UrdfGeometry, UrdfOptions, add_urdf_file};
