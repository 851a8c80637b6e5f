//! How much geometry one file may make: a small file can instance a mesh again and again, and ask for any amount.

use super::mesh::Mesh;
use crate::error::{Error, ErrorKind, Result};

/// The largest collision meshes known have a few million triangles. A body of as many takes some 10 GB while it is built.
pub const MAX_FACES: u64 = 1 << 23;

/// Indices of all faces: four for each of the most faces there may be.
pub const MAX_INDICES: u64 = 4 * MAX_FACES;

/// Faces that a file does not write out, but makes by referring to a mesh once more.
pub const MAX_REPEATED_FACES: u64 = 1 << 20;
pub const MAX_REPEATED_INDICES: u64 = 4 * MAX_REPEATED_FACES;

/// Corners of one face. A face that is not convex is split in time that grows with their square: some 10 s for as many.
const MAX_FACE_CORNERS: u32 = 1 << 14;

/// The largest mesh file that is read, 1 GiB: ASCII STL needs some 128 bytes for a face.
pub const MAX_MESH_FILE_BYTES: u64 = 1 << 30;

/// What a mesh, or several, come to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshSize {
    pub faces: u64,
    pub indices: u64,
}

impl MeshSize {
    pub fn of(mesh: &Mesh) -> Self {
        Self {
            faces: mesh.face_sizes.len() as u64,
            indices: mesh.indices.len() as u64,
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            faces: self.faces.saturating_add(other.faces),
            indices: self.indices.saturating_add(other.indices),
        }
    }

    fn require(self, max: Self, how: &str) -> Result<()> {
        let counts = [
            ("faces", self.faces, max.faces),
            ("indices of faces", self.indices, max.indices),
        ];
        match counts.into_iter().find(|(_, count, max)| count > max) {
            None => Ok(()),
            Some((what, count, max)) => Err(Error::new(
                ErrorKind::Unsupported,
                format!("{count} {what}{how}; at most {max} are possible"),
            )),
        }
    }
}

/// What the instances of one file, or of one robot, come to so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshBudget {
    all: MeshSize,
    repeated: MeshSize,
}

impl MeshBudget {
    /// Counts an instance of a mesh before it is made. `is_repeated` says that the mesh was instanced before.
    pub fn take(&mut self, size: MeshSize, is_repeated: bool) -> Result<()> {
        self.all = self.all.plus(size);
        let max = MeshSize {
            faces: MAX_FACES,
            indices: MAX_INDICES,
        };
        self.all.require(max, "")?;
        if is_repeated {
            self.repeated = self.repeated.plus(size);
        }
        let max = MeshSize {
            faces: MAX_REPEATED_FACES,
            indices: MAX_REPEATED_INDICES,
        };
        self.repeated.require(max, " of repeated meshes")
    }
}

/// Fails for a face that would take too long to split.
pub fn require_face_sizes(mesh: &Mesh) -> Result<()> {
    let sizes = mesh.face_sizes.iter().enumerate();
    let mut large = sizes.filter(|(_, size)| **size > MAX_FACE_CORNERS);
    match large.next() {
        None => Ok(()),
        Some((face, size)) => Err(Error::new(
            ErrorKind::Unsupported,
            format!("face {face} has {size} corners; at most {MAX_FACE_CORNERS} are possible"),
        )),
    }
}

/// Fails for a mesh that is larger than one file may make.
pub fn require_mesh_size(mesh: &Mesh) -> Result<()> {
    MeshBudget::default().take(MeshSize::of(mesh), false)
}
