//! Pictures: the scene at a configuration as a glTF binary file (Appendix A's `show-c-object`).

mod glb;
mod scene;
mod shapes;

pub use scene::show;
