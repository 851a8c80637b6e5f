//! The convex bounding volume at a node.

use crate::pose::Vec3;

/// A convex wrapper: the hull of its corners grown by `excess`, and a bounding sphere for a first, cheap bound.
///
/// The corners are the vertices of a convex hull (maybe with some points inside it), those of a box, or a sphere's
/// centre, whose excess is then its radius.
#[derive(Clone, Copy, Debug)]
pub struct Wrapper<'a> {
    pub corners: &'a [Vec3],
    /// The largest distance of a covered point from the corners' hull.
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}
