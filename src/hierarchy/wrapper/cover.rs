//! Wrappers around points: hulls, boxes and spheres that leave no point out, whatever rounding does.

use std::cmp::Ordering;

use super::bounding_sphere::bounding_sphere;
use crate::boxes::{Extent, oriented_box};
use crate::hierarchy::extremes;
use crate::pose::Vec3;
use crate::primitive::{checked_hull, frame_of};
use crate::tolerance;

/// So few points are their own hull: what a hull would leave out costs less than finding it.
const FEW: usize = 16;

/// The corners of a wrapper around points.
pub enum Corners {
    /// All the points.
    Points,
    /// Those of the points that are corners of their hull.
    Hull(Vec<Vec3>),
    /// Corners of a box, or the centre of a sphere.
    New(Vec<Vec3>),
}

/// A wrapper but for its corners.
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}

impl Cover {
    /// With a sphere around all the points; the corners' hull grown by `excess` covers them.
    fn around(points: &[Vec3], extent: &Extent, excess: f64) -> Self {
        let center = extent.center();
        Self {
            excess,
            center,
            radius: radius_around(points, &center),
        }
    }

    /// The sphere of a given centre as its own wrapper.
    fn sphere(center: Vec3, radius: f64) -> Self {
        Self {
            excess: radius,
            center,
            radius,
        }
    }

    /// The points' convex hull, or an oriented box where it has more than `vertex_limit` vertices. `extent` is the points'.
    pub fn hull(points: &[Vec3], extent: &Extent, vertex_limit: usize) -> (Self, Corners) {
        if points.len() <= FEW.min(vertex_limit) {
            return (Self::around(points, extent, 0.0), Corners::Points);
        }
        let extremes = extremes(points);
        if extremes.len() <= vertex_limit && !has_more_vertices(points, vertex_limit) {
            // An excess of a millionth of the size hardly loosens the bound; more, and the box is the better wrapper.
            let tolerated = 1e-6 * extent.diameter();
            let hull = checked_hull(points, tolerated, vertex_limit);
            if let Some(hull) = hull.filter(|hull| hull.excess <= tolerated) {
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

    pub fn aligned_box(extent: &Extent) -> (Self, Corners) {
        let corners = extent.corners();
        let cover = Self::around(&corners, extent, 0.0);
        (cover, Corners::New(corners.into()))
    }

    /// A nearly least sphere around the points.
    pub fn tight_sphere(points: &[Vec3]) -> (Self, Corners) {
        let center = bounding_sphere(points);
        let cover = Self::sphere(center, radius_around(points, &center));
        (cover, Corners::New(vec![center]))
    }

    /// The sphere around two spheres.
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

    /// The same grown by `excess`.
    pub fn grown(mut self, excess: f64) -> Self {
        self.excess += excess;
        self.radius += excess;
        self
    }
}

/// Whether the hull of many points shows more than `limit` vertices once it is stretched to unit extents: few directions
/// meet those of a shallow cap, and the hull of thousands is dear to find only to be refused.
fn has_more_vertices(points: &[Vec3], limit: usize) -> bool {
    if points.len() <= 2 * limit {
        return false;
    }
    let (center, stretch) = frame_of(points);
    let round: Vec<Vec3> = points.iter().map(|p| stretch * (p - center)).collect();
    extremes(&round).len() > limit
}

/// The radius of a sphere around the points, rounded outwards.
fn radius_around(points: &[Vec3], center: &Vec3) -> f64 {
    let farthest = points
        .iter()
        .map(|p| (p - center).norm_squared())
        .fold(0.0, f64::max);
    outwards(farthest.sqrt(), center)
}

/// A distance from `center`, with what its computation may have lost.
pub fn outwards(distance: f64, center: &Vec3) -> f64 {
    distance + tolerance::WRAPPER_ERROR * (distance + center.amax())
}

/// What rounding can hide of the distance of a point in the box from a hull or another box.
fn rounding(extent: &Extent) -> f64 {
    tolerance::WRAPPER_ERROR * extent.low.amax().max(extent.high.amax())
}

/// The order of points in lists that are merged.
pub fn by_coordinates(p: &Vec3, q: &Vec3) -> Ordering {
    let by_x = p.x.total_cmp(&q.x);
    by_x.then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z))
}

/// Two sorted lists as one, each point once.
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
