//! Bodies: rigid unions of primitives with their hierarchy, immutable once built.

#[allow(clippy::module_inception)]
mod body;
mod builder;
mod closed_surface;
mod collada;
mod farthest;
mod file;
mod file_reader;
mod file_writer;
mod mesh;
mod mesh_file;
mod pieces;
mod shapes;
mod solid;
mod surface_edges;
mod vertex_numbers;

pub use body::{Body, BodyStatistics};
pub use builder::BodyBuilder;
pub use farthest::Farthest;
pub use mesh::Mesh;
pub use mesh_file::read_mesh_file;
pub use pieces::{Piece, Pieces};
pub use shapes::HeightField;
pub use solid::Solid;
