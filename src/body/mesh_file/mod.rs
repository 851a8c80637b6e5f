//! Meshes from files: OBJ, STL, COLLADA and PLY.

mod collada;
#[allow(clippy::module_inception)]
mod mesh_file;
mod obj;
mod ply;
mod stl;

pub use mesh_file::{MeshFormat, read_mesh_bytes, read_mesh_file};
pub(in crate::body) use ply::{number_in, parse_ply};
