//! A primitive's coordinates in the frame in which a pair is examined.

use crate::pose::{Mat3, Pose, Vec3};
use crate::primitive::{Convex, Primitive};

/// The lengths that decide about a pair of bodies, their dimension with them.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// L, the largest coordinate of the pair in the frame in which it is examined.
    pub size: f64,
    /// A distance is known to this; below it the pair touches.
    pub error: f64,
    /// In planar worlds polygons are solid, and normals lie in the plane.
    pub planar: bool,
}

/// A primitive with its vertices and face normals expressed in some common frame.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    pub shape: &'a Convex,
    pub vertices: &'a [Vec3],
    /// Turns the shape's directions into the frame, unless the frame is its own.
    pub(super) rotation: Option<&'a Mat3>,
}

/// Memory for one moved primitive, reused from pair to pair.
#[derive(Default)]
pub struct PlacedBuffer(Vec<Vec3>);

impl PlacedBuffer {
    /// A primitive moved by `pose`.
    pub fn place<'a>(
        &'a mut self,
        primitive: impl Into<Primitive<'a>>,
        pose: &'a Pose,
    ) -> Placed<'a> {
        let primitive = primitive.into();
        self.0.clear();
        let moved = primitive.vertices.iter().map(|v| pose.transform_point(v));
        self.0.extend(moved);
        Placed {
            shape: primitive.shape,
            vertices: &self.0,
            rotation: Some(&pose.rotation),
        }
    }
}

impl<'a> Placed<'a> {
    /// A primitive in its own frame.
    pub fn at_home(primitive: impl Into<Primitive<'a>>) -> Self {
        let primitive = primitive.into();
        Self {
            shape: primitive.shape,
            vertices: primitive.vertices,
            rotation: None,
        }
    }

    /// The outward unit normal of a face.
    pub fn normal(&self, face: usize) -> Vec3 {
        let normal = self.shape.faces[face].normal;
        self.rotation.map_or(normal, |rotation| rotation * normal)
    }

    /// Directions of the shape, as columns, in the frame.
    pub fn turned(&self, axes: &Mat3) -> Mat3 {
        self.rotation.map_or(*axes, |rotation| rotation * axes)
    }

    /// The mean of the vertices.
    pub fn middle(&self) -> Vec3 {
        self.vertices.iter().sum::<Vec3>() / self.vertices.len() as f64
    }

    pub fn vertex(&self, index: u32) -> Vec3 {
        self.vertices[index as usize]
    }

    pub fn edge_ends(&self, edge: [u32; 2]) -> (Vec3, Vec3) {
        (self.vertex(edge[0]), self.vertex(edge[1]))
    }

    /// The height of `point` over face `face`, and whether its foot lies inside the face.
    pub fn over_face(&self, face: usize, point: &Vec3) -> (f64, bool) {
        let normal = &self.normal(face);
        let ring = &self.shape.faces[face].vertices;
        let height = normal.dot(&(point - self.vertex(ring[0])));
        let inside = (0..ring.len()).all(|i| {
            let a = self.vertex(ring[i]);
            let b = self.vertex(ring[(i + 1) % ring.len()]);
            (b - a).cross(&(point - a)).dot(normal) >= 0.0
        });
        (height, inside)
    }

    /// Whether a solid contains the point.
    pub fn contains(&self, point: &Vec3) -> bool {
        self.shape.is_solid()
            && self.shape.faces.iter().enumerate().all(|(f, face)| {
                let from_face = point - self.vertex(face.vertices[0]);
                self.normal(f).dot(&from_face) <= 0.0
            })
    }

    /// The extremes of `direction . x` over the primitive.
    pub fn extent_along(&self, direction: &Vec3) -> (f64, f64) {
        self.vertices
            .iter()
            .map(|v| direction.dot(v))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                (low.min(x), high.max(x))
            })
    }
}
