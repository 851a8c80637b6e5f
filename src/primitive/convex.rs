//! A convex primitive with its features.

use super::{Feature, FeatureKind};
use crate::pose::Vec3;

/// A face: its vertices in counter-clockwise order around the unit normal. The normal of a solid's face points outwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    pub vertices: Vec<u32>,
    pub normal: Vec3,
}

/// The convex hull of its vertices as a closed set: a point (one edge from a vertex to itself, no face), a segment (no
/// face), a flat polygon (one face, seen from both sides) or a solid (four faces or more).
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    pub vertices: Vec<Vec3>,
    pub edges: Vec<[u32; 2]>,
    pub faces: Vec<Face>,
    /// How far a point that belongs to the set may lie from the vertices' hull, or a vertex from the plane of a face that
    /// stands for it, at most: 0 but for polygons that are planar, and hulls that are complete, within a tolerance.
    pub deviation: f64,
}

impl Convex {
    pub fn is_solid(&self) -> bool {
        self.faces.len() > 1
    }

    /// A flat polygon from vertices in cyclic order around `normal`, of which `corners` form a strictly convex outline.
    pub(super) fn from_cycle(vertices: Vec<Vec3>, corners: Vec<u32>, normal: Vec3) -> Self {
        let n = vertices.len() as u32;
        let origin = vertices[corners[0] as usize];
        let heights = vertices.iter().map(|v| normal.dot(&(v - origin)).abs());
        let deviation = heights.fold(0.0, f64::max);
        Self {
            vertices,
            edges: (0..n).map(|i| [i, (i + 1) % n]).collect(),
            faces: vec![Face {
                vertices: corners,
                normal,
            }],
            deviation,
        }
    }

    /// The same primitive moved by `-center`.
    pub fn recentered(mut self, center: &Vec3) -> Self {
        for vertex in &mut self.vertices {
            *vertex -= center;
        }
        self
    }

    /// The vertices of a feature; `None` if the primitive has no such feature.
    pub fn feature_vertices(&self, feature: Feature) -> Option<Vec<u32>> {
        let i = feature.index as usize;
        match feature.kind {
            FeatureKind::Vertex => (i < self.vertices.len()).then(|| vec![feature.index]),
            FeatureKind::Edge => self.edges.get(i).map(|edge| edge.to_vec()),
            FeatureKind::Face => self.faces.get(i).map(|face| face.vertices.clone()),
            FeatureKind::Interior => (i == 0).then(|| (0..self.vertices.len() as u32).collect()),
        }
    }
}
