//! SRDF files: what people say of a robot beside its URDF file. Read into the robot builder that holds the URDF's links:
//! disabled pairs of links, joint groups, named states, end effectors, virtual and passive joints.

mod groups;
mod reader;
mod report;
mod states;

pub use reader::{SrdfOptions, add_srdf_file, add_srdf_text};
pub use report::SrdfReport;
