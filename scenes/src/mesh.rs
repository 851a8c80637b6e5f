//! Polygon meshes.

use std::fmt::Write;

use crate::motion::Pose;
use crate::point::Point;

/// A set of convex planar faces, each counter-clockwise seen from outside.
///
/// Faces that meet share their vertices, by index as well as by exact coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The corners of all faces.
    pub vertices: Vec<Point>,
    /// Each face as indices into `vertices`.
    pub faces: Vec<Vec<u32>>,
}

impl Mesh {
    /// The number of faces.
    pub fn polygons(&self) -> usize {
        self.faces.len()
    }

    /// Adds the vertices and faces of `other`; nothing is merged.
    pub fn append(&mut self, other: &Mesh) {
        let base = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        let shifted = |face: &Vec<u32>| face.iter().map(|v| base + v).collect();
        self.faces.extend(other.faces.iter().map(shifted));
    }

    /// The mesh with `pose` applied to every vertex.
    pub fn moved(&self, pose: &Pose) -> Mesh {
        Mesh {
            vertices: self.vertices.iter().map(|&p| pose.apply(p)).collect(),
            faces: self.faces.clone(),
        }
    }

    /// The mesh as Wavefront OBJ text; coordinates read back to the same bits.
    pub fn to_obj(&self) -> String {
        let mut text = String::new();
        for [x, y, z] in &self.vertices {
            // Writing to a String cannot fail.
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in &self.faces {
            text.push('f');
            for v in face {
                let _ = write!(text, " {}", v + 1);
            }
            text.push('\n');
        }
        text
    }

    /// The least and greatest coordinates of the vertices; infinities the wrong way round if there are none.
    pub fn bounds(&self) -> (Point, Point) {
        let start = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        self.vertices.iter().fold(start, |(low, high), p| {
            (
                std::array::from_fn(|k| low[k].min(p[k])),
                std::array::from_fn(|k| high[k].max(p[k])),
            )
        })
    }

    /// Adds a vertex and returns its index.
    pub(crate) fn add_vertex(&mut self, point: Point) -> u32 {
        self.vertices.push(point);
        (self.vertices.len() - 1) as u32
    }

    /// Adds all faces of several meshes.
    pub(crate) fn union(parts: impl IntoIterator<Item = Mesh>) -> Mesh {
        let mut whole = Mesh::default();
        for part in parts {
            whole.append(&part);
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Mesh {
        Mesh {
            vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]],
            faces: vec![vec![0, 1, 2]],
        }
    }

    #[test]
    fn appended_faces_refer_to_their_own_vertices() {
        let mut mesh = triangle();
        mesh.append(&triangle().moved(&Pose::translation([0.0, 0.0, 2.0])));
        assert_eq!(mesh.faces, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(mesh.bounds(), ([0.0; 3], [1.0, 0.1, 2.0]));
    }

    #[test]
    fn obj_counts_from_one() {
        assert_eq!(
            triangle().to_obj(),
            "v 0 0 0\nv 1 0 0\nv 0 0.1 0\nf 1 2 3\n"
        );
    }
}
