//! Meshes from callers and mesh files.

use crate::error::{Error, Result, require_coordinates};
use crate::pose::{Pose, Vec3};
use crate::tolerance::SMALLEST_DIAMETER;

/// A mesh: vertices, and faces as runs of vertex indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The vertices, in the mesh's own frame.
    pub vertices: Vec<Vec3>,
    /// Number of vertices of each face.
    pub face_sizes: Vec<u32>,
    /// The vertex indices of all faces, face after face, counted from 0.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// The mesh scaled along its own axes, then moved by `pose`. If the scale mirrors it, its faces are reversed, so that they
    /// face outwards as before. With scale 1 and the identity pose it is unchanged to the last bit.
    pub fn placed(mut self, pose: &Pose, scale: &Vec3) -> Result<Self> {
        check_scale(scale)?;
        if *pose == Pose::identity() && *scale == Vec3::repeat(1.0) {
            return Ok(self);
        }
        for vertex in &mut self.vertices {
            *vertex = pose.transform_point(&vertex.component_mul(scale));
        }
        if scale.iter().filter(|factor| **factor < 0.0).count() % 2 == 1 {
            reverse_faces(&self.face_sizes, &mut self.indices);
        }
        Ok(self)
    }
}

/// Reverses faces, so that those of a mirrored mesh face outwards as before. Stops where sizes and indices do not match; the builder
/// that the mesh is added to reports that.
pub fn reverse_faces(face_sizes: &[u32], mut indices: &mut [u32]) {
    for &size in face_sizes {
        let Some((face, after)) = indices.split_at_mut_checked(size as usize) else {
            return;
        };
        face.reverse();
        indices = after;
    }
}

fn check_scale(scale: &Vec3) -> Result<()> {
    require_coordinates(scale.as_slice(), "scale entry")?;
    match scale
        .iter()
        .position(|factor| factor.abs() < SMALLEST_DIAMETER)
    {
        None => Ok(()),
        Some(i) => Err(Error::invalid(format!(
            "scale entry {i} is {}, but must be at least {SMALLEST_DIAMETER:e} or at most -{SMALLEST_DIAMETER:e}",
            scale[i]
        ))),
    }
}
