//! Pictures: the scene at a configuration as a glTF binary file (Appendix A's `show-c-object`).

mod boundary;
mod curved;
mod glb;
mod nodes;
mod scene;
mod shapes;

pub use boundary::show_map;
pub use nodes::{node_surfaces, show_nodes};
pub use scene::show;
