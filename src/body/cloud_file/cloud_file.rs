//! Reads files of point clouds: PCD and PLY, chosen by the file name's extension.

use std::path::Path;

use super::cloud::Cloud;
use super::pcd::parse_pcd;
use crate::body::mesh_file::{parse_ply, read_mesh_bytes};
use crate::error::{Error, ErrorKind, Result};

/// The formats of point clouds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CloudFormat {
    /// PCD 0.7 and its predecessors.
    Pcd,
    /// The vertices of a PLY file.
    Ply,
}

impl CloudFormat {
    /// The format by the file name's extension; fails for any other extension.
    pub fn of(path: &Path) -> Result<Self> {
        let ending = path
            .extension()
            .map(|e| e.to_string_lossy().to_ascii_lowercase())
            .unwrap_or_default();
        match ending.as_str() {
            "pcd" => Ok(Self::Pcd),
            "ply" => Ok(Self::Ply),
            _ => Err(Error::new(
                ErrorKind::Unsupported,
                "point clouds end in .pcd or .ply",
            )),
        }
    }

    /// Parses the bytes of a file. A file is read completely or refused.
    pub fn parse(self, bytes: &[u8]) -> Result<Cloud> {
        let cloud = match self {
            Self::Pcd => parse_pcd(bytes)?,
            Self::Ply => Cloud {
                points: parse_ply(bytes)?.vertices,
                left_out: 0,
            },
        };
        match cloud.points.is_empty() {
            false => Ok(cloud),
            true => Err(Error::new(ErrorKind::Empty, "the file holds no point")),
        }
    }
}

/// Reads a point cloud of the format that the file's extension names.
pub fn read_cloud_file(path: &Path) -> Result<Cloud> {
    let format = CloudFormat::of(path)?;
    format.parse(&read_mesh_bytes(path)?)
}
