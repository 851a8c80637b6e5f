//! The one place where parry's glam types and our nalgebra types meet.

use std::panic::catch_unwind;

use parry3d_f64::transformation::try_convex_hull;

use crate::pose::Vec3;

/// parry's proposal for the convex hull of `points`: vertices and outward triangles. `None` where parry gives up.
/// A proposal only: callers check it against all points (see `primitive::hull`).
pub fn propose_hull(points: &[Vec3]) -> Option<(Vec<Vec3>, Vec<[u32; 3]>)> {
    let given: Vec<_> = points
        .iter()
        .map(|p| parry3d_f64::math::Vector::new(p.x, p.y, p.z))
        .collect();
    // A panic on unusual input counts as giving up.
    let (vertices, triangles) = catch_unwind(|| try_convex_hull(&given)).ok()?.ok()?;
    let vertices = vertices.iter().map(|p| Vec3::new(p.x, p.y, p.z)).collect();
    Some((vertices, triangles))
}
