//! What kind of set a primitive is.

use super::{Convex, SmoothKind};

/// The kinds of primitives: cores of each dimension, those with a radius, and smooth ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrimitiveKind {
    /// A single vertex.
    Point,
    /// Two vertices and the edge between them.
    Segment,
    /// A flat convex polygon.
    Polygon,
    /// A solid convex polyhedron.
    Polyhedron,
    /// A point with a radius.
    Sphere,
    /// A segment with a radius.
    Capsule,
    /// A polygon with a radius.
    RoundedPolygon,
    /// A polyhedron with a radius.
    RoundedPolyhedron,
    /// A cylinder, possibly with a radius around it.
    Cylinder,
    /// A cone, possibly with a radius around it.
    Cone,
    /// An ellipsoid, possibly with a radius around it.
    Ellipsoid,
    /// A set given by the caller's support function, possibly with a radius around it.
    SupportFunction,
}

impl Convex {
    /// The kind of this primitive.
    pub fn kind(&self) -> PrimitiveKind {
        let is_round = self.radius() > 0.0;
        match self.smooth().map(|smooth| &smooth.kind) {
            Some(SmoothKind::Cylinder { .. }) => PrimitiveKind::Cylinder,
            Some(SmoothKind::Cone { .. }) => PrimitiveKind::Cone,
            Some(SmoothKind::Ellipsoid { .. }) => PrimitiveKind::Ellipsoid,
            Some(SmoothKind::Function(_)) => PrimitiveKind::SupportFunction,
            None => match (self.vertices.len(), self.faces.len()) {
                (1, _) if is_round => PrimitiveKind::Sphere,
                (1, _) => PrimitiveKind::Point,
                (2, _) if is_round => PrimitiveKind::Capsule,
                (2, _) => PrimitiveKind::Segment,
                (_, 1) if is_round => PrimitiveKind::RoundedPolygon,
                (_, 1) => PrimitiveKind::Polygon,
                _ if is_round => PrimitiveKind::RoundedPolyhedron,
                _ => PrimitiveKind::Polyhedron,
            },
        }
    }

    /// The numbers of vertices, edges and faces: those of the core for a primitive with a radius, none for a smooth set.
    pub fn feature_counts(&self) -> [usize; 3] {
        match self.smooth() {
            Some(_) => [0; 3],
            // A point's edge from its vertex to itself does not count.
            None if self.vertices.len() == 1 => [1, 0, 0],
            None => [self.vertices.len(), self.edges.len(), self.faces.len()],
        }
    }
}
