//! Bounds of bodies at poses: what decides which pairs of bodies are looked at.

mod bounds;
mod bounds_by_eight;
mod box_frame;

pub use bounds::{Bounds, slack};
pub use bounds_by_eight::{BoundsByEight, ChosenBodies};
pub use box_frame::{BoxFrame, FrameLimits, SMALLEST_UNIT};
