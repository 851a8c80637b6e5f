//! Octrees of occupied cells: changed cell by cell, read from OctoMap's files, as bodies, and as objects of an environment
//! that follow the changes.
//!
//! The occupied cells are cut into tiles: cubes of cells, each with a body of its own. A change builds the bodies of the tiles
//! that it touches, and replaces their objects in one change of the environment; the others stay.

mod cells;
mod cubes;
mod octomap_file;
#[allow(clippy::module_inception)]
mod octree;
mod placement;
mod tile_bodies;
mod tile_boxes;
mod tiles;

pub use cells::{Cells, Cube};
pub use octree::Octree;
