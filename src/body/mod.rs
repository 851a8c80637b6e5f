//! Bodies: rigid unions of primitives with their hierarchy, immutable once built.

mod added_bodies;
mod b_spline;
mod bezier_patch;
#[allow(clippy::module_inception)]
mod body;
mod body_cache;
mod builder;
mod closed_surface;
pub mod cloud_file;
mod control_points;
mod convex_whole;
pub(crate) mod curved_cells;
mod farthest;
mod file;
mod file_reader;
mod file_writer;
mod hull;
mod joints;
mod mesh;
mod mesh_budget;
pub mod mesh_file;
mod mesh_form;
mod number_type;
mod nurbs_surface;
mod part;
pub(crate) mod patch_cell;
mod patch_triangles;
mod pieces;
mod refit;
mod shapes;
mod solid;
mod surface_edges;
mod vertex_numbers;

pub use bezier_patch::BezierPatch;
pub use body::{Body, BodyStatistics};
pub use body_cache::{BodyCache, BodyKey};
pub use builder::BodyBuilder;
pub use cloud_file::MAX_CLOUD_POINTS;
pub use farthest::Farthest;
pub use mesh::Mesh;
pub(crate) use mesh::reverse_faces;
pub use mesh_budget::{
    MAX_MESH_FILE_BYTES, MeshBudget, MeshSize, require_face_sizes, require_mesh_size,
};
pub use mesh_form::MeshForm;
pub use nurbs_surface::NurbsSurface;
pub use part::BodyPart;
pub use pieces::{Piece, Pieces};
pub use shapes::HeightField;
pub use solid::Solid;
