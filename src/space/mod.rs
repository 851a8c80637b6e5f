//! Spaces: the coordinates of one or more robots, their topology and limits, and the world box (§4.4).

mod coordinate;
#[allow(clippy::module_inception)]
mod space;

pub use coordinate::Coordinate;
pub use space::{Space, WorldBox};
