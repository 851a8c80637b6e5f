//! Point clouds from files: PCD and PLY.

mod cloud;
#[allow(clippy::module_inception)]
mod cloud_file;
mod lzf;
mod pcd;

pub use cloud::{Cloud, MAX_CLOUD_POINTS};
pub use cloud_file::{CloudFormat, read_cloud_file};
