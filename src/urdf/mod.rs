//! Robots from URDF files: parsed, checked to be trees, and added to a robot builder link by link.
//!
//! The parser is our own, on top of the crate roxmltree: the crate urdf-rs does not say which element failed, skips numbers
//! that it cannot read, and adds fifteen dependencies.

mod assemble;
mod bodies;
mod link_forms;
mod link_tree;
mod mimic;
mod model;
mod options;
mod packages;
mod report;
mod shapes;

pub use assemble::{add_urdf_file, add_urdf_text};
pub use link_forms::LinkForms;
pub use options::{BaseJoint, UrdfGeometry, UrdfOptions};
pub use report::UrdfReport;
