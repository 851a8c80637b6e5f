//! Bodies: rigid unions of primitives with their hierarchy, immutable once built.

#[allow(clippy::module_inception)]
mod body;
mod builder;
mod collada;
mod file;
mod file_reader;
mod file_writer;
mod mesh_file;

pub use body::{Body, BodyStatistics};
pub use builder::{BodyBuilder, Mesh};
pub use mesh_file::read_mesh_file;
