//! The depth of two bodies that meet: the least length of a translation after which they do not meet any more.
//!
//! The translations of A at which two convex sets meet are a convex set, their Minkowski difference; two bodies meet at the
//! union of the differences of their primitives, and at balls of translations where solids overlap. The depth is the distance
//! of the origin from the complement of that union. `search.rs` bounds it from both sides.

mod difference;
mod inner_balls;
mod least;
mod meeting;
mod search;
mod touching;

pub use search::{Depth, DepthOptions, DepthSearch, require_inside};
pub use touching::{Touching, WayOut, touching_at};
