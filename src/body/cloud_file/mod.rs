//! Point clouds from files: PCD and PLY.

#[allow(clippy::module_inception)]
mod cloud_file;
mod lzf;
mod pcd;

pub use cloud_file::{Cloud, CloudFormat, MAX_CLOUD_POINTS, read_cloud_file};
