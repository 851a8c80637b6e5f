//! Builds wrappers around points: hulls, boxes and spheres that contain every point in spite of rounding.

use std::cmp::Ordering;

use super::bounding_sphere::bounding_sphere;
use crate::boxes::{Extent, oriented_box};
use crate::hierarchy::extremes;
use crate::pose::Vec3;
use crate::primitive::{checked_hull, frame_of};
use crate::tolerance;

/// Up to this many points are all used as corners: a few points inside the hull cost less than computing the hull.
const MAX_UNHULLED: usize = 16;

/// The corners of a wrapper around points.
pub enum Corners {
    /// All the points.
    Points,
    /// The vertices of the points' hull.
    Hull(Vec<Vec3>),
    /// New points: the corners of a box, or the centre of a sphere.
    New(Vec<Vec3>),
}

/// A wrapper without its corners (see [`Wrapper`](super::Wrapper)).
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}

impl Cover {
    /// Adds a bounding sphere of the points. The hull of the wrapper's corners, grown by `excess`, covers the points.
    fn around(points: &[Vec3], extent: &Extent, excess: f64) -> Self {
        let center = extent.center();
        Self {
            excess,
            center,
            radius: radius_around(points, &center),
        }
    }

    /// A sphere as a wrapper: its corner is the centre, its excess the radius.
    fn sphere(center: Vec3, radius: f64) -> Self {
        Self {
            excess: radius,
            center,
            radius,
        }
    }

    /// The points' convex hull, or an oriented box if the hull has more than `vertex_limit` vertices. `extent` is the points'.
    pub fn hull(points: &[Vec3], extent: &Extent, vertex_limit: usize) -> (Self, Corners) {
        if points.len() <= MAX_UNHULLED.min(vertex_limit) {
            return (Self::around(points, extent, 0.0), Corners::Points);
        }
        let extremes = extremes(points);
        if extremes.len() <= vertex_limit && !has_more_vertices(points, vertex_limit) {
            // An excess of 1e-6 of the diameter hardly loosens the bound; above that the box is the better wrapper.
            let max_excess = 1e-6 * extent.diameter();
            let hull = checked_hull(points, max_excess, vertex_limit);
            if let Some(hull) = hull.filter(|hull| hull.excess <= max_excess) {
                let corners = hull.vertices.iter().map(|&i| points[i as usize]).collect();
                let excess = hull.excess + rounding(extent);
                return (Self::around(points, extent, excess), Corners::Hull(corners));
            }
            if points.len() <= vertex_limit {
                return (Self::around(points, extent, 0.0), Corners::Points);
            }
        }
        Self::boxed(points, extent, &extremes)
    }

    /// An oriented box of about the least volume.
    pub fn oriented_box(points: &[Vec3], extent: &Extent) -> (Self, Corners) {
        Self::boxed(points, extent, &extremes(points))
    }

    fn boxed(points: &[Vec3], extent: &Extent, extremes: &[Vec3]) -> (Self, Corners) {
        let corners = oriented_box(points, extremes);
        let cover = Self::around(points, extent, rounding(extent));
        (cover, Corners::New(corners))
    }

    /// The axis-aligned box itself.
    pub fn aligned_box(extent: &Extent) -> (Self, Corners) {
        let corners = extent.corners();
        let cover = Self::around(&corners, extent, 0.0);
        (cover, Corners::New(corners.into()))
    }

    /// A nearly smallest enclosing sphere of the points.
    pub fn tight_sphere(points: &[Vec3]) -> (Self, Corners) {
        let center = bounding_sphere(points);
        let cover = Self::sphere(center, radius_around(points, &center));
        (cover, Corners::New(vec![center]))
    }

    /// The smallest sphere around two spheres.
    pub fn merged_sphere(a: &Self, b: &Self) -> (Self, Corners) {
        let apart = (b.center - a.center).norm();
        let cover = if apart + b.radius <= a.radius {
            *a
        } else if apart + a.radius <= b.radius {
            *b
        } else {
            let radius = 0.5 * (apart + a.radius + b.radius);
            let center = a.center + (b.center - a.center) * ((radius - a.radius) / apart);
            let farthest = |child: &Self| (child.center - center).norm() + child.radius;
            let radius = farthest(a).max(farthest(b));
            Self::sphere(center, outwards(radius, &center))
        };
        (cover, Corners::New(vec![cover.center]))
    }

    /// The same wrapper grown by `excess`.
    pub fn grown(mut self, excess: f64) -> Self {
        self.excess += excess;
        self.radius += excess;
        self
    }
}

/// Whether the points have more than `limit` extreme points after stretching to unit extents. Then the hull need not be
/// computed, which is expensive for thousands of vertices. Without stretching, few directions hit the vertices of a
/// shallow cap.
fn has_more_vertices(points: &[Vec3], limit: usize) -> bool {
    if points.len() <= 2 * limit {
        return false;
    }
    let (center, stretch) = frame_of(points);
    let stretched: Vec<Vec3> = points.iter().map(|p| stretch * (p - center)).collect();
    extremes(&stretched).len() > limit
}

/// The radius of the enclosing sphere at `center`, rounded outwards.
fn radius_around(points: &[Vec3], center: &Vec3) -> f64 {
    let farthest = points
        .iter()
        .map(|p| (p - center).norm_squared())
        .fold(0.0, f64::max);
    outwards(farthest.sqrt(), center)
}

/// A distance from `center` plus the error bound of its computation.
pub fn outwards(distance: f64, center: &Vec3) -> f64 {
    distance + tolerance::WRAPPER_ERROR * (distance + center.amax())
}

/// Bounds the rounding error in the distance of a point of the box from a hull or another box.
fn rounding(extent: &Extent) -> f64 {
    tolerance::WRAPPER_ERROR * extent.low.amax().max(extent.high.amax())
}

/// The lexicographic order of points in the lists that [`merge_sorted`] merges.
pub fn by_coordinates(p: &Vec3, q: &Vec3) -> Ordering {
    let by_x = p.x.total_cmp(&q.x);
    by_x.then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z))
}

/// Merges two sorted lists without duplicates into one.
pub fn merge_sorted(a: &[Vec3], b: &[Vec3]) -> Vec<Vec3> {
    let mut merged = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        let order = by_coordinates(&a[i], &b[j]);
        merged.push(if order.is_le() { a[i] } else { b[j] });
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    merged.extend_from_slice(&a[i..]);
    merged.extend_from_slice(&b[j..]);
    merged
}
