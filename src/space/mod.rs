//! Spaces: the coordinates of one or more robots, their topology and limits, and the world box (§4.4).

mod limits;
mod link_bodies;
mod motion_bounds;
mod rigid_step;
mod sampling;
#[allow(clippy::module_inception)]
mod space;
mod tangent;
mod world_box;

pub use crate::robot::Coordinate;
pub(crate) use rigid_step::screw_between;
pub use sampling::{Sample, Sampler};
pub use space::{Offset, Space};
pub use tangent::shorter_way;
pub use world_box::WorldBox;
