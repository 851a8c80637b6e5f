//! What is asked of a search for a depth, and what it answers.

use super::touching::{Touching, WayOut};
use crate::pose::Vec3;

/// How far and how long to search.
#[derive(Clone, Copy, Debug)]
pub struct DepthOptions {
    /// The search ends when the bounds are this close; 0 stands for [`DepthOptions::RELATIVE`] of the pair's size.
    pub tolerance: f64,
    /// Nodes to take, at most.
    pub max_steps: u64,
}

impl DepthOptions {
    /// The tolerance if none is given, times the pair's size.
    pub const RELATIVE: f64 = 1e-6;
}

impl Default for DepthOptions {
    fn default() -> Self {
        Self {
            tolerance: 0.0,
            max_steps: 1000,
        }
    }
}

/// Bounds of a depth, with a way out.
#[derive(Clone, Debug)]
pub struct Depth {
    /// No shorter translation parts the bodies.
    pub lower: f64,
    /// The length of `way`.
    pub upper: f64,
    /// A translation of A after which the bodies are proved apart, in A's centred frame.
    pub way: Vec3,
    /// The bounds are within the tolerance.
    pub is_tight: bool,
    /// Nodes taken.
    pub steps: u64,
}

/// A depth, and what it is owed to: what its derivative needs.
#[derive(Clone, Debug)]
pub struct ExplainedDepth {
    pub depth: Depth,
    /// What touches after the way out.
    pub out: WayOut,
    /// The contact that `out` names first, or the nearest one; `None` without contacts.
    pub first: Option<Touching>,
    /// Another way out, of the same length but elsewhere, is known or not excluded.
    pub has_rival: bool,
}
