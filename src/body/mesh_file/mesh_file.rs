//! Reads mesh files: OBJ, STL, COLLADA and PLY, chosen by the file name's extension.

use std::path::Path;

use super::collada::parse_collada;
use super::obj::parse_obj;
use super::ply::parse_ply;
use super::stl::parse_stl;
use crate::body::{MAX_MESH_FILE_BYTES, Mesh, require_face_sizes};
use crate::error::{Error, ErrorKind, Result};
use crate::whole_file::read_whole;

/// The formats of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ.
    Obj,
    /// STL, ASCII or binary.
    Stl,
    /// COLLADA 1.4 or 1.5.
    Collada,
    /// PLY 1.0, ASCII or binary.
    Ply,
}

impl MeshFormat {
    /// The format by the file name's extension; fails for any other extension.
    pub fn of(path: &Path) -> Result<Self> {
        let ending = path
            .extension()
            .map(|e| e.to_string_lossy().to_ascii_lowercase())
            .unwrap_or_default();
        let refused = |what: &str| {
            let message = format!("mesh files end in .obj, .stl, .dae or .ply{what}");
            Err(Error::new(ErrorKind::Unsupported, message))
        };
        match ending.as_str() {
            "obj" => Ok(Self::Obj),
            "stl" => Ok(Self::Stl),
            "dae" => Ok(Self::Collada),
            "ply" => Ok(Self::Ply),
            "" => refused("; this name has no ending"),
            other => refused(&format!(", not \".{other}\"")),
        }
    }

    /// Parses the bytes of a file. A file is read completely or refused.
    pub fn parse(self, bytes: &[u8]) -> Result<Mesh> {
        let mesh = match self {
            Self::Obj => parse_obj(bytes),
            Self::Stl => parse_stl(bytes),
            Self::Collada => parse_collada(bytes),
            Self::Ply => parse_ply(bytes),
        }?;
        if mesh.face_sizes.is_empty() {
            return Err(Error::new(ErrorKind::Empty, "the file holds no face"));
        }
        require_face_sizes(&mesh)?;
        Ok(mesh)
    }
}

/// Reads the bytes of a mesh file of at most [`MAX_MESH_FILE_BYTES`].
pub fn read_mesh_bytes(path: &Path) -> Result<Vec<u8>> {
    read_whole(path, MAX_MESH_FILE_BYTES)
}

/// Reads a mesh file of the format that its extension names.
pub fn read_mesh_file(path: &Path) -> Result<Mesh> {
    let format = MeshFormat::of(path)?;
    format.parse(&read_mesh_bytes(path)?)
}
