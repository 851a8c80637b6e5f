//! Bounds of bodies at poses: what decides which pairs of bodies are looked at.

mod bounds;
mod box_frame;

pub use bounds::{Bounds, slack};
pub use box_frame::{BoxFrame, FrameLimits};
