//! Meshes from files: OBJ, STL and COLLADA.

mod collada;
#[allow(clippy::module_inception)]
mod mesh_file;
mod obj;
mod stl;

pub use mesh_file::{MeshFormat, read_mesh_bytes, read_mesh_file};
