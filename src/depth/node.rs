//! Nodes of the search for a depth, the least bound first.

use std::cmp::Ordering;

use crate::convex::HalfSpace;
use crate::pose::Vec3;

/// An intersection of half-spaces.
pub struct Node {
    /// No way out in it is shorter: the bound of its half-spaces, or that of the node it was parted from.
    pub bound: f64,
    /// The bound of its half-spaces alone.
    pub least: f64,
    /// The shortest translation in it.
    pub point: Vec3,
    pub faces: Vec<Face>,
}

/// A half-space of a node: beyond a face of a difference.
#[derive(Clone, Copy)]
pub struct Face {
    pub space: HalfSpace,
    pub difference: u32,
    /// The number of the half-space, or of the cone.
    pub part: u32,
}

impl Ord for Node {
    /// The least bound is the greatest node.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Node {}
