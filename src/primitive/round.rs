//! Round primitives: spheres and capsules, known by a point or a segment and a radius alone.

use super::Primitive;
use crate::pose::Vec3;

/// The points within a radius of a point or a segment, in space.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// The ends of the segment, in the body's frame; twice the centre of a sphere.
    pub ends: [Vec3; 2],
    /// Whether it has a segment, not a point.
    pub is_capsule: bool,
    /// Above 0.
    pub radius: f64,
}

impl Round {
    /// The sphere or capsule that a primitive is; `None` if it is another set.
    pub fn of(primitive: Primitive) -> Option<Self> {
        let curve = primitive.shape.curve.as_ref()?;
        let is_round = curve.smooth.is_none() && !curve.planar && curve.radius > 0.0;
        let (ends, is_capsule) = match (primitive.vertices, &primitive.shape.edges[..]) {
            (&[center], _) => ([center; 2], false),
            (&[start, end], [[0, 1]]) => ([start, end], true),
            _ => return None,
        };
        is_round.then_some(Self {
            ends,
            is_capsule,
            radius: curve.radius,
        })
    }
}
