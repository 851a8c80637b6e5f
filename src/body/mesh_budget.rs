//! Limits the geometry that one file may create: a small file can instance a mesh many times over.

use super::mesh::Mesh;
use crate::error::{Error, ErrorKind, Result};

/// The most faces of a mesh. The largest collision meshes known have a few million triangles. A body of that many takes some
/// 10 GB while it is built.
pub const MAX_FACES: u64 = 1 << 23;

/// The most indices of all faces: four per face.
pub const MAX_INDICES: u64 = 4 * MAX_FACES;

/// The most faces that a file creates by instancing meshes again, without listing them.
pub const MAX_REPEATED_FACES: u64 = 1 << 20;
/// The most indices of such faces: four per face.
pub const MAX_REPEATED_INDICES: u64 = 4 * MAX_REPEATED_FACES;

/// The most corners of one face. Splitting a face that is not convex takes quadratic time: a second or two for this many corners.
const MAX_FACE_CORNERS: u32 = 1 << 14;

/// The most that the squares of the corners of all faces may add up to: 128 of the largest faces, which take some three minutes.
pub const MAX_SQUARES: u64 = 1 << 35;
/// The same of the faces of meshes that are instanced again: some ten seconds.
pub const MAX_REPEATED_SQUARES: u64 = 1 << 31;

/// The largest mesh file that is read, 1 GiB: ASCII STL takes some 128 bytes per face.
pub const MAX_MESH_FILE_BYTES: u64 = 1 << 30;

/// The size of one or several meshes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshSize {
    /// Number of faces.
    pub faces: u64,
    /// Number of vertex indices of all faces.
    pub indices: u64,
    /// The squares of the faces' numbers of corners, added up.
    pub squares: u64,
}

impl MeshSize {
    /// The size of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let squares = mesh.face_sizes.iter().map(|&n| u64::from(n).pow(2));
        Self {
            faces: mesh.face_sizes.len() as u64,
            indices: mesh.indices.len() as u64,
            squares: squares.fold(0, u64::saturating_add),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            faces: self.faces.saturating_add(other.faces),
            indices: self.indices.saturating_add(other.indices),
            squares: self.squares.saturating_add(other.squares),
        }
    }

    fn require(self, max: Self, how: &str) -> Result<()> {
        let counts = [
            ("faces", self.faces, max.faces),
            ("indices of faces", self.indices, max.indices),
            ("squares of corners of faces", self.squares, max.squares),
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

/// The total size of the mesh instances of one file or one robot so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshBudget {
    all: MeshSize,
    repeated: MeshSize,
}

impl MeshBudget {
    /// Counts an instance of a mesh before it is created; fails above the limits. `is_repeated` says whether the mesh was
    /// instanced before.
    pub fn take(&mut self, size: MeshSize, is_repeated: bool) -> Result<()> {
        self.all = self.all.plus(size);
        let max = MeshSize {
            faces: MAX_FACES,
            indices: MAX_INDICES,
            squares: MAX_SQUARES,
        };
        self.all.require(max, "")?;
        if is_repeated {
            self.repeated = self.repeated.plus(size);
        }
        let max = MeshSize {
            faces: MAX_REPEATED_FACES,
            indices: MAX_REPEATED_INDICES,
            squares: MAX_REPEATED_SQUARES,
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

/// Fails for a mesh above the limits of one file.
pub fn require_mesh_size(mesh: &Mesh) -> Result<()> {
    MeshBudget::default().take(MeshSize::of(mesh), false)
}
