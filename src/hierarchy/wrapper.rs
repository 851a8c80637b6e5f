//! The convex bound at a node, and the lower bounds of distance it gives.

use crate::pose::{Pose, Vec3};

/// A convex wrapper: the hull of its corners grown by `excess`, and a sphere around it for a first, cheap bound.
///
/// The corners are the vertices of a convex hull (maybe with some points inside it), those of a box, or a sphere's
/// centre, whose excess is then its radius.
#[derive(Clone, Copy, Debug)]
pub struct Wrapper<'a> {
    pub corners: &'a [Vec3],
    /// How far a covered point may lie outside the corners' hull, at most.
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}

impl Wrapper<'_> {
    /// A lower bound of the distance of the sets two wrappers cover, by their spheres. `pose` places `other`.
    pub fn sphere_bound(&self, other: &Wrapper, pose: &Pose) -> f64 {
        let apart = (pose.transform_point(&other.center) - self.center).norm();
        apart - self.radius - other.radius
    }
}
