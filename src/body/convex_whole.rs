//! The polyhedron that a solid is, where its boundary is convex: as one primitive its depth is exact.

use super::body::Body;
use super::hull::of_one_polyhedron;
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// Solids of more faces are not looked at, which takes time that grows with the faces times the corners.
const MAX_FACES: usize = 4096;

impl Body {
    /// The convex hull of a solid's boundary as a body of one polyhedron, in the same frame, if the solid is that up to rounding; and how
    /// far its points may be from the solid. Computed on first use.
    pub fn convex_whole(&self) -> Option<(&Body, f64)> {
        let whole = self.convex_whole.get_or_init(|| self.hull_of_convex());
        Some((whole.as_deref()?, 2.0 * self.rounding()))
    }

    /// What rounding of corners and planes amounts to.
    pub(super) fn rounding(&self) -> f64 {
        16.0 * EPSILON * (self.radius() + self.center().amax())
    }

    /// A closed boundary all of whose faces support the hull of its corners lies on the boundary of that hull, and so covers it wholly.
    fn hull_of_convex(&self) -> Option<Box<Body>> {
        let solid = self.solid()?;
        let count = self.primitives().len();
        let is_boundary = |number: usize| solid.sign(number as u32) != 0;
        if count > MAX_FACES || !(0..count).all(is_boundary) {
            return None;
        }
        let faces = (0..count).map(|number| self.primitives().get(number));
        let mut corners: Vec<Vec3> = faces
            .clone()
            .flat_map(|face| face.vertices.to_vec())
            .collect();
        corners.sort_by(|a, b| a.as_slice().partial_cmp(b.as_slice()).expect("finite"));
        corners.dedup();
        let rounding = self.rounding();
        for face in faces {
            let normal = face.shape.faces.first()?.normal;
            let origin = normal.dot(face.vertices.first()?);
            let heights = corners.iter().map(|corner| normal.dot(corner) - origin);
            let (low, high) = heights.fold((0.0f64, 0.0f64), |(low, high), height| {
                (low.min(height), high.max(height))
            });
            if high.min(-low) > rounding {
                return None;
            }
        }
        let points: Vec<Vec3> = corners
            .iter()
            .map(|corner| corner + self.center())
            .collect();
        of_one_polyhedron(&points)
    }
}
