//! The depth of two bodies that meet: the least length of a translation after which they do not meet any more.
//!
//! The translations of A at which two convex sets meet are a convex set, their Minkowski difference; two bodies meet at the
//! union of the differences of their primitives, and at balls of translations where solids overlap. The depth is the distance
//! of the origin from the complement of that union. `search.rs` bounds it from both sides.

mod answer;
mod boundary;
mod covers;
mod difference;
mod inner_balls;
mod inside;
mod least;
mod meeting;
mod node;
mod search;
mod touching;

pub use answer::{Depth, DepthOptions, ExplainedDepth};
pub use inside::{require_exact, require_inside};
pub use search::DepthSearch;
pub use touching::{Touching, WayOut, touching_at};
