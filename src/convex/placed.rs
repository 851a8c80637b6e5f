//! A primitive in the common frame of a pair.

use std::cell::{Cell, OnceCell};

use super::segment::Segment;
use crate::gjk::{Extreme, Names, PointCloud, Support};
use crate::pose::{Mat3, Pose, Vec3, turned, turned_back};
use crate::primitive::{Convex, Face, Feature, FeatureKind, Form, Incidence, Primitive};

/// The size and error of a pair of bodies, and whether it is planar.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// L, the largest coordinate of the pair in its common frame.
    pub size: f64,
    /// The error of a distance; at smaller distances the pair touches.
    pub error: f64,
    /// In planar worlds polygons are solid, and normals lie in the plane.
    pub planar: bool,
}

/// A primitive posed in a common frame. Its vertices are transformed one by one, or all at once when a caller needs all of
/// them.
#[derive(Clone, Copy)]
pub struct PlacedPrimitive<'a> {
    pub shape: &'a Convex,
    vertices: Vertices<'a>,
    /// The form of the shape, in the primitive's own frame; `None` if unknown.
    form: Option<&'a Form>,
}

#[derive(Clone, Copy)]
enum Vertices<'a> {
    /// Already in the common frame, and not rotated.
    Here(&'a [Vec3]),
    Moved {
        home: &'a [Vec3],
        pose: &'a Pose,
        buffer: &'a PlacedBuffer,
    },
    /// Already in the common frame, rotated by `rotation` and translated.
    Shifted {
        vertices: &'a [Vec3],
        rotation: Option<&'a Mat3>,
    },
}

/// Memory for one transformed primitive, reused from pair to pair.
#[derive(Default)]
pub struct PlacedBuffer {
    moved: OnceCell<Vec<Vec3>>,
    spare: Cell<Vec<Vec3>>,
}

impl PlacedBuffer {
    /// A primitive moved by `pose`.
    #[inline(always)]
    pub fn place<'a>(
        &'a mut self,
        primitive: impl Into<Primitive<'a>>,
        form: Option<&'a Form>,
        pose: &'a Pose,
    ) -> PlacedPrimitive<'a> {
        let primitive = primitive.into();
        if let Some(mut used) = self.moved.take() {
            used.clear();
            self.spare.set(used);
        }
        PlacedPrimitive {
            shape: primitive.shape,
            vertices: Vertices::Moved {
                home: primitive.vertices,
                pose,
                buffer: self,
            },
            form,
        }
    }

    /// All vertices, transformed.
    fn all(&self, home: &[Vec3], pose: &Pose) -> &[Vec3] {
        self.moved.get_or_init(|| {
            let mut moved = self.spare.take();
            moved.extend(home.iter().map(|v| pose.transform_point(v)));
            moved
        })
    }
}

impl<'a> PlacedPrimitive<'a> {
    /// A primitive in its own frame.
    pub fn at_home(primitive: impl Into<Primitive<'a>>, form: Option<&'a Form>) -> Self {
        let primitive = primitive.into();
        Self {
            shape: primitive.shape,
            vertices: Vertices::Here(primitive.vertices),
            form,
        }
    }

    /// The same primitive with translated vertices; its rotation stays.
    pub fn shifted<'b>(&'b self, vertices: &'b [Vec3]) -> PlacedPrimitive<'b> {
        PlacedPrimitive {
            shape: self.shape,
            vertices: Vertices::Shifted {
                vertices,
                rotation: self.rotation(),
            },
            form: None,
        }
    }

    #[inline(always)]
    fn rotation(&self) -> Option<&'a Mat3> {
        match self.vertices {
            Vertices::Here(_) => None,
            Vertices::Moved { pose, .. } => Some(&pose.rotation),
            Vertices::Shifted { rotation, .. } => rotation,
        }
    }

    /// A direction of the shape's frame, in the common frame.
    #[inline(always)]
    pub fn turned(&self, direction: &Vec3) -> Vec3 {
        self.rotation()
            .map_or(*direction, |rotation| turned(rotation, direction))
    }

    /// A direction of the common frame, in the shape's frame.
    #[inline(always)]
    pub fn turned_back(&self, direction: &Vec3) -> Vec3 {
        self.rotation()
            .map_or(*direction, |rotation| turned_back(rotation, direction))
    }

    /// A point of the common frame, in the shape's frame, in which its form and its smooth core are given. Only for a shape
    /// that is not shifted.
    #[inline(always)]
    pub fn seen(&self, point: &Vec3) -> Vec3 {
        match self.vertices {
            Vertices::Moved { pose, .. } => {
                turned_back(&pose.rotation, &(point - pose.translation))
            }
            _ => *point,
        }
    }

    /// A point of the shape's frame, in the common frame. Only for a shape that is not shifted.
    #[inline(always)]
    pub fn moved(&self, point: &Vec3) -> Vec3 {
        match self.vertices {
            Vertices::Moved { pose, .. } => pose.transform_point(point),
            _ => *point,
        }
    }

    /// The outward unit normal of a face.
    pub fn normal(&self, face: usize) -> Vec3 {
        self.turned(&self.shape.faces[face].normal)
    }

    /// Axes of the shape's frame, as columns, in the common frame.
    pub fn turned_axes(&self, axes: &Mat3) -> Mat3 {
        self.rotation()
            .map_or(*axes, |rotation| crate::pose::turned_axes(rotation, axes))
    }

    /// The form of the core, where the primitive has one and is not shifted.
    #[inline(always)]
    pub fn form(&self) -> Option<&'a Form> {
        self.form
    }

    /// Which edges and faces meet in each vertex, where that is known.
    pub fn incidence(&self) -> Option<&'a Incidence> {
        self.form?.incidence(self.shape)
    }

    /// The lowest-dimensional feature that holds the given vertices, or `None` if there is none.
    pub fn feature_of(&self, vertices: &[u32]) -> Option<Feature> {
        match (self.form, vertices) {
            (Some(form), _) => form.feature_of(self.shape, vertices),
            (None, [vertex]) => Some(Feature::vertex(*vertex)),
            (None, [_, _]) => {
                let is_between = |edge: &[u32; 2]| edge.iter().all(|end| vertices.contains(end));
                let edge = self.shape.edges.iter().position(is_between);
                edge.map(|edge| Feature::edge(edge as u32))
            }
            (None, _) => {
                let holds = |face: &Face| vertices.iter().all(|v| face.vertices.contains(v));
                let face = self.shape.faces.iter().position(holds);
                face.map(|face| Feature::face(face as u32))
            }
        }
    }

    /// Names of vertices that a feature lies between, by which [`Self::feature_of`] knows it; `None` for what is no feature of a polytope.
    #[inline(always)]
    pub fn names_of(&self, feature: Feature) -> Option<Names> {
        let index = feature.index as usize;
        Some(match feature.kind {
            FeatureKind::Vertex => Names::one(feature.index),
            FeatureKind::Edge => {
                let [start, end] = self.shape.edges[index];
                Names::two(start, end)
            }
            FeatureKind::Face => {
                let ring = &self.shape.faces[index].vertices;
                Names::three([ring[0], ring[1], ring[2]])
            }
            FeatureKind::Interior | FeatureKind::Surface => return None,
        })
    }

    /// The mean of the vertices, up to rounding.
    pub fn middle(&self) -> Vec3 {
        match self.form {
            Some(form) => self.moved(&form.middle(self.shape)),
            None => {
                let vertices = (0..self.vertex_count() as u32).map(|i| self.vertex(i));
                vertices.sum::<Vec3>() / self.vertex_count() as f64
            }
        }
    }

    /// All vertices in the common frame.
    pub fn vertices(&self) -> &'a [Vec3] {
        match self.vertices {
            Vertices::Here(vertices) | Vertices::Shifted { vertices, .. } => vertices,
            Vertices::Moved { home, pose, buffer } => buffer.all(home, pose),
        }
    }

    #[inline(always)]
    pub fn vertex_count(&self) -> usize {
        match self.vertices {
            Vertices::Here(vertices) | Vertices::Shifted { vertices, .. } => vertices.len(),
            Vertices::Moved { home, .. } => home.len(),
        }
    }

    #[inline(always)]
    pub fn vertex(&self, index: u32) -> Vec3 {
        match self.vertices {
            Vertices::Here(vertices) | Vertices::Shifted { vertices, .. } => {
                vertices[index as usize]
            }
            Vertices::Moved { home, pose, buffer } => match buffer.moved.get() {
                Some(all) => all[index as usize],
                None => pose.transform_point(&home[index as usize]),
            },
        }
    }

    #[inline(always)]
    pub fn edge_ends(&self, edge: [u32; 2]) -> (Vec3, Vec3) {
        (self.vertex(edge[0]), self.vertex(edge[1]))
    }

    /// The height of a point over a face's plane.
    pub fn height_over(&self, face: usize, point: &Vec3) -> f64 {
        let corner = self.vertex(self.shape.faces[face].vertices[0]);
        self.normal(face).dot(&(point - corner))
    }

    /// The faces in whose planes a point lies, to within `near`.
    pub fn faces_at(&self, point: &Vec3, near: f64) -> impl Iterator<Item = usize> {
        let heights = self.heights_over(point);
        let faces = heights.enumerate();
        faces.filter_map(move |(face, height)| (height.abs() <= near).then_some(face))
    }

    /// The corner or the edge of a face that a point of it is within `slack` of; `None` where it is inside, or for another feature.
    pub fn end_of_face(&self, face: Feature, point: &Vec3, slack: f64) -> Option<Feature> {
        if face.kind != FeatureKind::Face {
            return None;
        }
        let ring = &self.shape.faces[face.index as usize].vertices;
        let is_near = |&&i: &&u32| (self.vertex(i) - point).norm() <= slack;
        if let Some(&corner) = ring.iter().find(is_near) {
            return Some(Feature::vertex(corner));
        }
        (0..ring.len()).find_map(|i| {
            let ends = [ring[i], ring[(i + 1) % ring.len()]];
            let side = Segment::new(self.edge_ends(ends));
            let nearest = side.at(side.nearest_parameter(point));
            let is_near = (nearest - point).norm() <= slack;
            is_near.then(|| self.feature_of(&ends)).flatten()
        })
    }

    /// The heights of a point over the planes of the faces, in their order.
    fn heights_over(&self, point: &Vec3) -> impl Iterator<Item = f64> {
        // The point is turned once, not each normal.
        let turned = match self.vertices {
            Vertices::Moved { home, .. } => Some((home, self.seen(point))),
            Vertices::Here(home) => Some((home, *point)),
            Vertices::Shifted { .. } => None,
        };
        let point = *point;
        (0..self.shape.faces.len()).map(move |face| match &turned {
            Some((home, seen)) => {
                let Face {
                    vertices, normal, ..
                } = &self.shape.faces[face];
                normal.dot(&(seen - home[vertices[0] as usize]))
            }
            None => self.height_over(face, &point),
        })
    }

    /// The height of `point` over face `face`, and whether its foot lies inside the face.
    pub fn over_face(&self, face: usize, point: &Vec3) -> (f64, bool) {
        self.over(face, point, |side| side >= 0.0)
    }

    /// The same, where the face's edges do not count as inside.
    pub fn strictly_over_face(&self, face: usize, point: &Vec3) -> (f64, bool) {
        self.over(face, point, |side| side > 0.0)
    }

    #[inline(always)]
    fn over(&self, face: usize, point: &Vec3, is_inside: impl Fn(f64) -> bool) -> (f64, bool) {
        let normal = &self.normal(face);
        let ring = &self.shape.faces[face].vertices;
        let height = normal.dot(&(point - self.vertex(ring[0])));
        let mut has_area = false;
        let inside = (0..ring.len()).all(|i| {
            let a = self.vertex(ring[i]);
            let b = self.vertex(ring[(i + 1) % ring.len()]);
            let side = (b - a).cross(&(point - a)).dot(normal);
            has_area |= side > 0.0;
            is_inside(side)
        });
        // Nothing is over a face whose corners are rounded onto a line or a point.
        (height, inside && has_area)
    }

    /// How far a point of a face's plane is from the lines of the face's edges, at least; negative outside.
    pub fn depth_in_face(&self, face: usize, point: &Vec3) -> f64 {
        let normal = &self.normal(face);
        let ring = &self.shape.faces[face].vertices;
        let depths = (0..ring.len()).map(|i| {
            let a = self.vertex(ring[i]);
            let along = self.vertex(ring[(i + 1) % ring.len()]) - a;
            normal.cross(&along).normalize().dot(&(point - a))
        });
        depths.fold(f64::INFINITY, f64::min)
    }

    /// Whether a solid contains the point.
    pub fn contains(&self, point: &Vec3) -> bool {
        self.shape.is_solid()
            && self.shape.faces.iter().enumerate().all(|(f, face)| {
                let from_face = point - self.vertex(face.vertices[0]);
                self.normal(f).dot(&from_face) <= 0.0
            })
    }

    /// Whether a solid or a flat polygon holds the point, up to a height of `slack` over its faces.
    pub fn holds(&self, point: &Vec3, slack: f64) -> bool {
        if let Some(cuboid) = self.form.and_then(Form::cuboid) {
            let seen = cuboid.seen(&self.seen(point));
            return (seen.abs() - cuboid.half).max() <= slack;
        }
        if self.shape.is_solid() {
            return self.heights_over(point).all(|height| height <= slack);
        }
        self.shape.is_flat()
            && self.height_over(0, point).abs() <= slack
            && self.depth_in_face(0, point) >= -slack
    }

    /// The least of `direction . x` over the primitive's vertices.
    pub fn low_along(&self, direction: &Vec3) -> f64 {
        -self.high_along(&-direction)
    }

    /// The largest of `direction . x` over the primitive's vertices.
    pub fn high_along(&self, direction: &Vec3) -> f64 {
        if self.form.is_some() {
            return direction.dot(&self.extreme(direction).point);
        }
        let heights = self.vertices().iter().map(|v| direction.dot(v));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The extremes of `direction . x` over the primitive's vertices.
    pub fn extent_along(&self, direction: &Vec3) -> (f64, f64) {
        (self.low_along(direction), self.high_along(direction))
    }
}

/// The signed gap of the projections along the unit vector `direction`, from B to A.
pub fn gap_of_primitives(a: &PlacedPrimitive, b: &PlacedPrimitive, direction: &Vec3) -> f64 {
    a.low_along(direction) - b.high_along(direction)
}

/// The gaps along a line, the larger one first, each with the unit direction from B to A that has it. `along` is a unit vector of either
/// sign.
pub fn gaps_along(a: &PlacedPrimitive, b: &PlacedPrimitive, along: &Vec3) -> [(f64, Vec3); 2] {
    let [ahead, back] = [*along, -along].map(|n| (gap_of_primitives(a, b, &n), n));
    if back.0 > ahead.0 {
        [back, ahead]
    } else {
        [ahead, back]
    }
}

/// The larger of these.
pub fn larger_gap(a: &PlacedPrimitive, b: &PlacedPrimitive, along: &Vec3) -> (f64, Vec3) {
    gaps_along(a, b, along)[0]
}

/// The support function of the hull of the vertices, each named by its index.
impl Support for PlacedPrimitive<'_> {
    #[inline(always)]
    fn extreme(&self, direction: &Vec3) -> Extreme {
        let vertex = match (self.form, self.vertices) {
            (Some(form), _) => form.farthest(self.shape, &self.turned_back(direction)),
            (None, Vertices::Moved { home, .. }) => {
                PointCloud(home).extreme(&self.turned_back(direction)).name
            }
            (None, Vertices::Here(vertices) | Vertices::Shifted { vertices, .. }) => {
                PointCloud(vertices).extreme(direction).name
            }
        };
        Extreme {
            point: self.vertex(vertex),
            name: vertex,
        }
    }
}
