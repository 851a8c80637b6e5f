//! The convex hull of a body: one direction that parts the hulls of two bodies parts all that they are made of.

use super::body::Body;
use super::builder::BodyBuilder;
use crate::hierarchy::HierarchyOptions;
use crate::pose::Vec3;

/// Of bodies with more points no hull is computed, which takes time and memory in proportion.
const MAX_POINTS: usize = 1 << 14;

impl Body {
    /// The convex hull of the body's primitives, as a body of one polyhedron in the same frame, and how far rounding may leave a point
    /// outside of it; the body itself if it is one primitive. `None` for planar bodies, for a single smooth primitive, for bodies of many
    /// points, and where all points are in a plane. What is smooth among several is held by the points that bound it, so that the hull may
    /// have another centre than the body. Computed on first use.
    pub fn hull(&self) -> Option<(&Body, f64)> {
        if let Some(only) = self.primitives().only() {
            return only.shape.smooth().is_none().then_some((self, 0.0));
        }
        let hull = self.hull.get_or_init(|| self.hull_of_points());
        Some((hull.as_deref()?, 2.0 * self.rounding()))
    }

    fn hull_of_points(&self) -> Option<Box<Body>> {
        let primitives = self.primitives();
        if self.dimension() != 3 || primitives.have_functions() || primitives.len() > MAX_POINTS {
            return None;
        }
        let mut points: Vec<Vec3> = Vec::new();
        for primitive in primitives.iter() {
            points.extend(primitive.bounding_points().map(|p| p + self.center()));
        }
        points.sort_unstable_by(|a, b| a.as_slice().partial_cmp(b.as_slice()).expect("finite"));
        points.dedup();
        if points.len() > MAX_POINTS {
            return None;
        }
        let hull = of_one_polyhedron(&points)?;
        let is_solid = hull.primitives().only()?.shape.is_solid();
        is_solid.then_some(hull)
    }
}

/// The convex hull of points of space, as a body.
pub(super) fn of_one_polyhedron(points: &[Vec3]) -> Option<Box<Body>> {
    let mut builder = BodyBuilder::new(3).ok()?;
    builder.add_polyhedron(points, 0).ok()?;
    let body = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    body.ok().map(Box::new)
}
