//! A convex primitive with its features.

use smallvec::{SmallVec, smallvec};

use super::{Curve, Feature, FeatureKind, SharedList, Smooth, SmoothKind};
use crate::gjk::{PointCloud, Support};
use crate::pose::Vec3;

/// A face: its vertices in counter-clockwise order around the unit normal. The normal of a solid's face points outwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Indices of its corners into the primitive's vertices.
    pub vertices: SharedList<u32>,
    /// The unit normal, in the primitive's frame.
    pub normal: Vec3,
}

/// The convex hull of its vertices as a closed set: a point (one edge from a vertex to itself, no face), a segment (no face), a
/// flat polygon (one two-sided face) or a solid (four faces or more). A curved primitive is the set of all points within a
/// radius of that hull, its core; or within a radius of a smooth core placed at its only vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    /// The vertices of the core, in the primitive's frame. Up to three stand in the primitive itself: most primitives are
    /// triangles.
    pub vertices: SmallVec<[Vec3; 3]>,
    /// The two vertices of each edge, by index.
    pub edges: SharedList<[u32; 2]>,
    /// The faces; none for points and segments.
    pub faces: SmallVec<[Face; 1]>,
    /// The representation error, as a length: how far a point of the set may lie outside the vertices' hull, or a vertex off
    /// the plane of its face. Above 0 only for polygons that are planar, and hulls that are complete, within a tolerance. For a
    /// smooth set, the error of its distances.
    pub deviation: f64,
    /// The curved part; `None` if the set is the hull of its vertices.
    pub curve: Option<Box<Curve>>,
}

impl Convex {
    /// Whether the core is a solid polyhedron.
    pub fn is_solid(&self) -> bool {
        self.faces.len() > 1
    }

    /// Whether this is a flat polygon without a curved part.
    pub fn is_flat(&self) -> bool {
        self.faces.len() == 1 && self.curve.is_none()
    }

    /// The radius around the core.
    pub fn radius(&self) -> f64 {
        self.curve.as_ref().map_or(0.0, |curve| curve.radius)
    }

    /// The smooth core, which is placed at the only vertex.
    pub fn smooth(&self) -> Option<&Smooth> {
        self.curve.as_ref().and_then(|curve| curve.smooth.as_ref())
    }

    /// Whether the core is known by a function of the caller's alone, whose farthest points have an error of their own.
    pub fn is_function(&self) -> bool {
        let smooth = self.smooth();
        smooth.is_some_and(|smooth| matches!(smooth.kind, SmoothKind::Function(_)))
    }

    /// Points whose hull contains the set: the vertices, unless it is curved.
    pub fn bounding_points(&self) -> &[Vec3] {
        self.curve.as_ref().map_or(&self.vertices, |c| c.bounds())
    }

    /// The point of the set that is farthest along a direction.
    pub fn farthest(&self, direction: &Vec3) -> Vec3 {
        self.farthest_of(&self.vertices, direction)
    }

    /// The same for other positions of the vertices.
    pub(super) fn farthest_of(&self, vertices: &[Vec3], direction: &Vec3) -> Vec3 {
        let Some(curve) = &self.curve else {
            return PointCloud(vertices).support(direction);
        };
        let core = match &curve.smooth {
            Some(smooth) => {
                let local = smooth.kind.support(&smooth.axes.tr_mul(direction));
                vertices[0] + smooth.axes * local
            }
            None => PointCloud(vertices).support(direction),
        };
        let mut outwards = *direction;
        if curve.planar {
            outwards.z = 0.0;
        }
        core + outwards.try_normalize(0.0).unwrap_or_default() * curve.radius
    }

    /// The lowest and highest coordinates of the set.
    pub fn extent(&self) -> (Vec3, Vec3) {
        self.extent_of(&self.vertices)
    }

    /// The same for other positions of the vertices.
    pub(super) fn extent_of(&self, vertices: &[Vec3]) -> (Vec3, Vec3) {
        if self.curve.is_none() {
            let first = (vertices[0], vertices[0]);
            let ends = |(low, high): (Vec3, Vec3), p: &Vec3| (low.inf(p), high.sup(p));
            return vertices.iter().fold(first, ends);
        }
        let along = |axis: usize, sign: f64| {
            let mut direction = Vec3::zeros();
            direction[axis] = sign;
            self.farthest_of(vertices, &direction)[axis]
        };
        let [low, high] = [-1.0, 1.0].map(|s| Vec3::new(along(0, s), along(1, s), along(2, s)));
        (low, high)
    }

    /// A flat polygon from vertices in cyclic order around `normal`, of which `corners` form a strictly convex outline.
    pub(super) fn from_cycle(
        vertices: SmallVec<[Vec3; 3]>,
        corners: Vec<u32>,
        normal: Vec3,
    ) -> Self {
        let origin = vertices[corners[0] as usize];
        let heights = vertices.iter().map(|v| normal.dot(&(v - origin)).abs());
        let deviation = heights.fold(0.0, f64::max);
        let edges = SharedList::cycle(vertices.len());
        let face = Face {
            vertices: SharedList::of_corners(corners),
            normal,
        };
        Self {
            vertices,
            edges,
            faces: smallvec![face],
            deviation,
            curve: None,
        }
    }

    /// The same primitive moved by `-center`.
    pub fn recentered(mut self, center: &Vec3) -> Self {
        self.recenter(center);
        self
    }

    /// Moves the primitive by `-center`.
    pub(super) fn recenter(&mut self, center: &Vec3) {
        for vertex in &mut self.vertices {
            *vertex -= center;
        }
        if let Some(mut curve) = self.curve.take() {
            curve.bound(self);
            self.curve = Some(curve);
        }
    }

    /// The vertices of a feature; `None` if the primitive has no such feature.
    pub fn feature_vertices(&self, feature: Feature) -> Option<Vec<u32>> {
        let i = feature.index as usize;
        match feature.kind {
            FeatureKind::Vertex => (i < self.vertices.len()).then(|| vec![feature.index]),
            FeatureKind::Edge => self.edges.get(i).map(|edge| edge.to_vec()),
            FeatureKind::Face => self.faces.get(i).map(|face| face.vertices.to_vec()),
            FeatureKind::Interior => (i == 0).then(|| (0..self.vertices.len() as u32).collect()),
            FeatureKind::Surface => (i == 0 && self.smooth().is_some()).then(Vec::new),
        }
    }
}
