//! Primitives with other vertices: their topology stays, and they are checked as a body builder checks new ones.

use smallvec::SmallVec;

use super::point_tree::PointTree;
use super::polygon::{
    check_convex_polygon, convex_polygon, extent_of, newell_normal, quick_triangle_normal, upright,
};
use super::{Convex, Face, PrimitiveGroup, Primitives};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Vec3;
use crate::tolerance;

impl Primitives {
    /// The lowest and highest coordinates of the primitives if they had other vertices, given one primitive after the other.
    pub fn extent_with(&self, vertices: &[Vec3]) -> (Vec3, Vec3) {
        let union = |all: (Vec3, Vec3), one: (Vec3, Vec3)| (all.0.inf(&one.0), all.1.sup(&one.1));
        if self.are_hulls() {
            let each = vertices.iter().map(|vertex| (*vertex, *vertex));
            return each.reduce(union).unwrap_or_default();
        }
        let mut rest = vertices;
        let each = self.iter().map(|primitive| {
            let (own, after) = rest.split_at(primitive.vertices.len());
            rest = after;
            primitive.shape.extent_of(own)
        });
        each.reduce(union).unwrap_or_default()
    }

    /// The primitives with other vertices, given one primitive after the other, as many as before; moved by `-center` once they
    /// are checked. The message of an error names the primitive.
    pub fn with_vertices(&self, vertices: &[Vec3], center: &Vec3) -> Result<Self> {
        let mut moved = Self::default();
        moved.reserve(self);
        let mut rest = vertices;
        // The iterator itself loops: a `for` loop would ask anew at each shape which run and sort of group it is in.
        self.groups().try_for_each(|group| {
            let named = |error: Error, more: usize| {
                error.within(format_args!("primitive {}", moved.len() + more))
            };
            match group {
                PrimitiveGroup::Shape(shape, tag) => {
                    let (own, after) = rest.split_at(shape.vertices.len());
                    rest = after;
                    // Most primitives are triangles that need no closer look.
                    match shape.triangle_with(own, center) {
                        Some(triangle) => moved.push(triangle, tag),
                        None => {
                            let shape = shape.with_vertices(own).map_err(|e| named(e, 0))?;
                            moved.push(shape.recentered(center), tag);
                        }
                    }
                }
                PrimitiveGroup::Points(shape, points) => {
                    let (own, after) = rest.split_at(points.len());
                    for (i, point) in own.iter().enumerate() {
                        let checked = require_coordinates(point.as_slice(), "coordinate");
                        checked.map_err(|error| named(error, i))?;
                    }
                    rest = after;
                    moved.push_points(shape, own.iter().map(|point| point - center));
                }
            }
            Ok(())
        })?;
        moved.shrink();
        Ok(moved)
    }
}

impl Convex {
    /// The primitive with other vertices, as many as before.
    fn with_vertices(&self, vertices: &[Vec3]) -> Result<Self> {
        let mut moved = match &self.faces[..] {
            [] => self.point_or_segment(vertices)?,
            [_] => self.polygon(vertices)?,
            _ => self.polyhedron(vertices)?,
        };
        if let Some(curve) = &self.curve {
            let mut curve = curve.clone();
            curve.bound(&moved);
            moved.curve = Some(curve);
        }
        Ok(moved)
    }

    fn point_or_segment(&self, vertices: &[Vec3]) -> Result<Self> {
        let extent = extent_of(vertices)?;
        let is_short =
            extent.spread < tolerance::SMALLEST_DIAMETER || extent.diameter <= extent.tolerance;
        if vertices.len() > 1 && is_short {
            return Err(Error::new(
                ErrorKind::Degenerate,
                "the ends of the segment coincide",
            ));
        }
        Ok(Self {
            vertices: SmallVec::from_slice(vertices),
            edges: self.edges.clone(),
            faces: SmallVec::new(),
            deviation: self.deviation,
            curve: None,
        })
    }

    /// The triangle with other corners, moved by `-center`, as most primitives of most bodies are; `None` of other primitives,
    /// and of triangles with so little area that they need a closer look.
    #[inline(always)]
    fn triangle_with(&self, corners: &[Vec3], center: &Vec3) -> Option<Self> {
        let ([a, b, c], [_], None) = (corners, &self.faces[..], &self.curve) else {
            return None;
        };
        let normal = quick_triangle_normal([a, b, c])?;
        Some(self.triangle([a, b, c], normal, center))
    }

    #[inline(always)]
    fn triangle(&self, [a, b, c]: [&Vec3; 3], normal: Vec3, center: &Vec3) -> Self {
        let height = |corner: &Vec3| normal.dot(&(corner - a)).abs();
        Self {
            vertices: SmallVec::from_buf([a - center, b - center, c - center]),
            edges: self.edges.clone(),
            faces: SmallVec::from_buf([Face {
                vertices: self.faces[0].vertices.clone(),
                normal,
            }]),
            deviation: height(b).max(height(c)),
            curve: None,
        }
    }

    fn polygon(&self, vertices: &[Vec3]) -> Result<Self> {
        let [a, b, c] = vertices else {
            return convex_polygon(vertices);
        };
        let normal = match quick_triangle_normal([a, b, c]) {
            Some(normal) => normal,
            None => check_convex_polygon(vertices)?,
        };
        Ok(self.triangle([a, b, c], normal, &Vec3::zeros()))
    }

    fn polyhedron(&self, vertices: &[Vec3]) -> Result<Self> {
        let extent = extent_of(vertices)?;
        let tree = PointTree::new(vertices);
        let mut faces = SmallVec::with_capacity(self.faces.len());
        let mut is_corner = vec![false; vertices.len()];
        let (mut above, mut thickness) = (0.0f64, f64::INFINITY);
        for (f, face) in self.faces.iter().enumerate() {
            let ring: Vec<Vec3> = face
                .vertices
                .iter()
                .map(|&i| vertices[i as usize])
                .collect();
            let normal = newell_normal(&ring).ok_or_else(|| {
                Error::new(ErrorKind::Degenerate, format!("face {f} has no area"))
            })?;
            let normal = upright(&normal, &ring);
            for (&i, corner) in face.vertices.iter().zip(&ring) {
                is_corner[i as usize] = true;
                let height = normal.dot(&(corner - ring[0])).abs();
                if height > extent.tolerance {
                    let message = format!("vertex {i} is {height:.3e} off the plane of face {f}");
                    return Err(Error::new(ErrorKind::NotPlanar, message));
                }
            }
            let (highest, vertex) = tree.farthest(&normal, &ring[0]);
            if highest > extent.tolerance {
                let message = format!("vertex {vertex} is {highest:.3e} above face {f}");
                return Err(Error::new(ErrorKind::NotConvex, message));
            }
            above = above.max(highest);
            thickness = thickness.min(tree.farthest(&-normal, &ring[0]).0);
            faces.push(Face {
                vertices: face.vertices.clone(),
                normal,
            });
        }
        if thickness <= extent.tolerance {
            let message = format!("the polyhedron is flat: its thickness is {thickness:e}");
            return Err(Error::new(ErrorKind::Degenerate, message));
        }
        let mut moved = Self {
            vertices: SmallVec::from_slice(vertices),
            edges: self.edges.clone(),
            faces,
            deviation: 0.0,
            curve: None,
        };
        moved.deviation = moved.height_off_faces().max(above);
        if is_corner.contains(&false) {
            moved.deviation += extent.tolerance;
        }
        Ok(moved)
    }
}
