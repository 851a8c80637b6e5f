//! Robots from URDF files: parsed, checked to be trees, and added to a robot builder link by link.
//!
//! The parser is our own, on top of the crate roxmltree: the crate urdf-rs does not say which element failed, skips numbers
//! that it cannot read, and adds fifteen dependencies.

mod assemble;
mod bodies;
mod link_forms;
mod model;
mod packages;
mod report;
mod shapes;

pub use assemble::{BaseJoint, UrdfGeometry, UrdfOptions, add_urdf_file, add_urdf_text};
pub use link_forms::LinkForms;
pub use report::UrdfReport;
