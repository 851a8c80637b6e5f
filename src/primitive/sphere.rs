//! Spheres: points with a radius, known by a centre and a radius alone.

use super::Primitive;
use crate::pose::Vec3;

/// A point with a radius above 0, in space.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// In the body's frame.
    pub center: Vec3,
    /// Above 0.
    pub radius: f64,
}

impl Sphere {
    /// The sphere that a primitive is; `None` if it is another set.
    pub fn of(primitive: Primitive) -> Option<Self> {
        let curve = primitive.shape.curve.as_ref()?;
        let is_sphere = curve.smooth.is_none() && !curve.planar && curve.radius > 0.0;
        match *primitive.vertices {
            [center] if is_sphere => Some(Self {
                center,
                radius: curve.radius,
            }),
            _ => None,
        }
    }
}
