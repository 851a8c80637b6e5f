//! Maps of C-space: what is free on a grid over some coordinates, the others held.

mod blocks;
mod build;
mod grid;
#[allow(clippy::module_inception)]
mod map;
mod npy;
mod png;

pub use build::{MapKind, MapOptions};
pub use grid::MapAxis;
pub use map::{Map, MapValues};
