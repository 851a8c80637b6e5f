//! The curved part of a primitive: a radius, a smooth core, or both.

use super::planar_hull::plane_axes;
use super::{Convex, Smooth};
use crate::pose::{Mat3, Vec3};

/// The curved part of a primitive, which is the set of points within `radius` of its core. The core is the hull of the
/// primitive's vertices, or the smooth set placed at its only vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The radius around the core, at least 0. Body builders give none to a smooth core; a body file may.
    pub radius: f64,
    /// The smooth core; `None` where the core is the hull of the vertices.
    pub smooth: Option<Smooth>,
    /// In planar worlds the radius extends only within the plane z = 0.
    pub planar: bool,
    /// Points whose hull contains the set.
    bounds: Vec<Vec3>,
}

impl Curve {
    /// The curved part for a core, with its bounding points.
    pub fn new(core: &Convex, radius: f64, smooth: Option<Smooth>, planar: bool) -> Self {
        let mut curve = Self {
            radius,
            smooth,
            planar,
            bounds: Vec::new(),
        };
        curve.bound(core);
        curve
    }

    /// Points whose hull contains the set: corners of a box around each vertex of the core, or around the smooth set.
    pub fn bounds(&self) -> &[Vec3] {
        &self.bounds
    }

    /// Recomputes the bounding points after the core has moved.
    pub(super) fn bound(&mut self, core: &Convex) {
        let origin = core.vertices[0];
        let grown: Vec<Vec3> = match &self.smooth {
            Some(smooth) => {
                let points = smooth.kind.bounding_points();
                points.iter().map(|p| origin + smooth.axes * p).collect()
            }
            None => core.vertices.to_vec(),
        };
        if self.radius == 0.0 {
            self.bounds = grown;
            return;
        }
        let axes = match &self.smooth {
            Some(smooth) => smooth.axes,
            None if self.planar => planar_axes(core),
            None => box_axes(core),
        };
        let axes = axes * self.radius;
        // If the core is a segment, the inner corners lie within the hull of the outer ones.
        let is_segment = self.smooth.is_none() && grown.len() == 2;
        let signs = [-1.0, 1.0];
        self.bounds.clear();
        for (i, point) in grown.iter().enumerate() {
            for along in signs {
                if is_segment && (along > 0.0) != (i == 1) {
                    continue;
                }
                for across in signs {
                    let in_plane = point + axes.column(0) * along + axes.column(1) * across;
                    if self.planar {
                        self.bounds.push(in_plane);
                    } else {
                        let up = signs.map(|s| in_plane + axes.column(2) * s);
                        self.bounds.extend(up);
                    }
                }
            }
        }
    }
}

/// Axes along the core's first edge and normal to its first face.
fn box_axes(core: &Convex) -> Mat3 {
    let Some(along) = along_first_edge(core) else {
        return Mat3::identity();
    };
    let (y, z) = match core.faces.first() {
        Some(face) => (face.normal.cross(&along), face.normal),
        None => plane_axes(&along),
    };
    // By rounding, an edge may be off its face's plane.
    let y = (y - along * along.dot(&y)).normalize();
    let z = if along.cross(&y).dot(&z) < 0.0 {
        -1.0
    } else {
        1.0
    } * along.cross(&y);
    Mat3::from_columns(&[along, y, z])
}

fn planar_axes(core: &Convex) -> Mat3 {
    match along_first_edge(core) {
        Some(x) => Mat3::from_columns(&[x, Vec3::new(-x.y, x.x, 0.0), Vec3::z()]),
        None => Mat3::identity(),
    }
}

fn along_first_edge(core: &Convex) -> Option<Vec3> {
    let [i, j] = *core.edges.first()?;
    (core.vertices[j as usize] - core.vertices[i as usize]).try_normalize(0.0)
}
