//! Primitives after a rigid motion: their features keep their numbers, and nothing is searched for or checked again.

use smallvec::SmallVec;

use super::{Convex, Face, PrimitiveGroup, Primitives};
use crate::pose::{Pose, Vec3};

impl Convex {
    /// The primitive after a motion. Its deviation grows by the rounding of the moved vertices.
    pub fn posed(&self, pose: &Pose) -> Self {
        let vertices: SmallVec<[Vec3; 3]> = self
            .vertices
            .iter()
            .map(|vertex| pose.transform_point(vertex))
            .collect();
        let faces: SmallVec<[Face; 1]> = self
            .faces
            .iter()
            .map(|face| Face {
                vertices: face.vertices.clone(),
                normal: (pose.rotation * face.normal).normalize(),
            })
            .collect();
        let mut moved = Self {
            vertices,
            edges: self.edges.clone(),
            faces,
            deviation: 0.0,
            curve: None,
        };
        moved.deviation = match &moved.faces[..] {
            [] => self.deviation,
            // The heights of all vertices are all that deviates of a polygon, but for points that were left out.
            [_] => moved.height_off_faces().max(self.deviation),
            _ => self.deviation + moved.height_off_faces(),
        };
        if let Some(curve) = &self.curve {
            let mut curve = curve.clone();
            if let Some(smooth) = &mut curve.smooth {
                smooth.axes = pose.rotation * smooth.axes;
            }
            curve.bound(&moved);
            moved.curve = Some(curve);
        }
        moved
    }

    /// How far a polygon's vertices are off its plane at most; of a polyhedron, its corners off the planes of their faces.
    pub(super) fn height_off_faces(&self) -> f64 {
        let mut highest = 0.0f64;
        let is_polygon = self.faces.len() == 1;
        for face in &self.faces {
            let origin = self.vertices[face.vertices[0] as usize];
            let height = |vertex: &Vec3| face.normal.dot(&(vertex - origin)).abs();
            if is_polygon {
                highest = self.vertices.iter().map(height).fold(highest, f64::max);
            } else {
                let corners = face.vertices.iter().map(|&i| &self.vertices[i as usize]);
                highest = corners.map(height).fold(highest, f64::max);
            }
        }
        highest
    }
}

/// Primitives that come in between others, after a motion.
#[derive(Clone, Copy, Debug)]
pub struct PosedPrimitives<'a> {
    /// How many of the others come before them.
    pub before: usize,
    /// Before the motion.
    pub primitives: &'a Primitives,
    /// The motion.
    pub pose: Pose,
}

impl Primitives {
    /// These primitives moved by `-center`, with others in between, which are given in order.
    pub fn interleaved(&self, center: &Vec3, others: &[PosedPrimitives]) -> Self {
        let mut all = Self::default();
        all.reserve(self);
        for other in others {
            all.reserve(other.primitives);
        }
        let mut others = others.iter().peekable();
        let mut index = 0;
        for group in self.groups() {
            while let Some(other) = others.next_if(|other| other.before <= index) {
                all.append_posed(other.primitives, &other.pose);
            }
            match group {
                PrimitiveGroup::Shape(shape, tag) => {
                    all.push(shape.clone().recentered(center), tag);
                    index += 1;
                }
                PrimitiveGroup::Points(shape, points) => {
                    all.push_points(shape, points.iter().map(|point| point - center));
                    index += points.len();
                }
            }
        }
        for other in others {
            all.append_posed(other.primitives, &other.pose);
        }
        all.shrink();
        all
    }

    fn append_posed(&mut self, others: &Self, pose: &Pose) {
        for group in others.groups() {
            match group {
                PrimitiveGroup::Shape(shape, tag) => self.push(shape.posed(pose), tag),
                PrimitiveGroup::Points(shape, points) => {
                    let moved = points.iter().map(|point| pose.transform_point(point));
                    self.push_points(shape, moved);
                }
            }
        }
    }
}
