//! The convex bound at a node, and the lower bounds of distance it gives.

use super::oriented_box::oriented_box;
use crate::gjk::{MovedCloud, PointCloud, gjk};
use crate::pose::{Pose, Vec3};
use crate::primitive::{checked_hull, excess_over};

/// A convex wrapper: the hull of its corners grown by `excess`, and a sphere around it for a first, cheap bound.
#[derive(Clone, Debug)]
pub struct Wrapper {
    /// The vertices of a convex hull, or the corners of an oriented box.
    pub corners: Vec<Vec3>,
    /// How far a covered point may lie outside the corners' hull, at most.
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}

/// Covers the points by their convex hull, or by an oriented box where the hull has more than `vertex_limit` vertices.
/// Also says whether the corners are given points (a hull) rather than new ones (a box).
///
/// The hull is parry's proposal, checked against every point; what it misses becomes the excess, so that the wrapper
/// covers its points whatever was proposed.
pub fn cover(points: &[Vec3], vertex_limit: usize) -> (Wrapper, bool) {
    let low = points.iter().fold(points[0], |low, p| low.inf(p));
    let high = points.iter().fold(points[0], |high, p| high.sup(p));
    let center = (low + high) * 0.5;
    let radius = points
        .iter()
        .map(|p| (p - center).norm())
        .fold(0.0, f64::max);
    let wrapper = |corners: Vec<Vec3>, excess: f64| Wrapper {
        corners,
        excess,
        center,
        radius,
    };
    if points.len() <= 4 {
        return (wrapper(points.to_vec(), 0.0), true);
    }
    // An excess of a millionth of the size hardly loosens the bound; more, and the box is the better wrapper.
    let tolerated = 1e-6 * radius;
    let hull = checked_hull(points, tolerated, vertex_limit);
    if let Some(hull) = hull.filter(|hull| hull.excess <= tolerated) {
        let corners = hull.vertices.iter().map(|&i| points[i as usize]).collect();
        return (wrapper(corners, hull.excess), true);
    }
    if points.len() <= vertex_limit {
        return (wrapper(points.to_vec(), 0.0), true);
    }
    let corners = oriented_box(points);
    let joined: Vec<Vec3> = corners.iter().chain(points).copied().collect();
    let indices: Vec<u32> = (0..corners.len() as u32).collect();
    let (excess, _) = excess_over(&joined, &indices, f64::INFINITY);
    (wrapper(corners, excess), false)
}

impl Wrapper {
    /// A lower bound of the distance of the sets two wrappers cover, by their spheres. `pose` places `other`.
    pub fn sphere_bound(&self, other: &Wrapper, pose: &Pose) -> f64 {
        let apart = (pose.transform_point(&other.center) - self.center).norm();
        apart - self.radius - other.radius
    }

    /// A lower bound by the hulls. Stops early once the bound exceeds `cutoff`.
    pub fn hull_bound(&self, other: &Wrapper, pose: &Pose, cutoff: f64) -> f64 {
        let grown = self.excess + other.excess;
        let moved = MovedCloud {
            points: &other.corners,
            pose,
        };
        let start = self.center - pose.transform_point(&other.center);
        gjk(&PointCloud(&self.corners), &moved, start, cutoff + grown).lower - grown
    }
}
