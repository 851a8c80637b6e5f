//! Pictures: the scene at a configuration, or on a path, as a glTF binary file (Appendix A's `show-c-object`).

mod bodies;
mod boundary;
mod curved;
mod glb;
mod nodes;
mod path;
mod scene;
mod shapes;
mod triangles;

pub use boundary::show_map;
pub use nodes::{node_surfaces, show_nodes};
pub use path::show_path;
pub use scene::show;
