//! What a mesh stands for: its faces, the solid inside them, or its convex hull.

use super::builder::BodyBuilder;
use super::{Body, Mesh};
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::HierarchyOptions;
use crate::pose::Vec3;

/// What the meshes of a body stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MeshForm {
    /// The faces: a body wholly inside them does not meet them.
    #[default]
    Surface,
    /// The solid that the faces bound, where all meshes of the body together are closed; else the faces.
    Solid,
    /// The convex hull of the vertices, a solid.
    Hull,
}

impl BodyBuilder {
    /// Adds a mesh in this form. The hull is one primitive, tagged with `tag`; faces are tagged with their indices.
    pub fn add_mesh_as(&mut self, mesh: &Mesh, form: MeshForm, tag: u64) -> Result<()> {
        if form != MeshForm::Hull {
            return self.add_mesh(mesh);
        }
        // Vertices of no face are not part of the mesh.
        let mut used = mesh.indices.clone();
        used.sort_unstable();
        used.dedup();
        let corners = used.iter().map(|&i| mesh.vertices.get(i as usize).copied());
        let corners = corners.collect::<Option<Vec<Vec3>>>().ok_or_else(|| {
            let count = mesh.vertices.len();
            Error::new(
                ErrorKind::NotFound,
                format!("a face refers to a vertex that is not there; there are {count}"),
            )
        })?;
        self.add_polyhedron(&corners, tag)
    }

    /// Builds the body; in the form of solids, as one if its faces are closed.
    pub fn build_as(
        &mut self,
        form: MeshForm,
        options: &HierarchyOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Body> {
        if form == MeshForm::Solid {
            self.set_solid(true);
            match self.build(options, progress) {
                Err(e) if matches!(e.kind, ErrorKind::NotClosed | ErrorKind::Degenerate) => {}
                built => return built,
            }
            self.set_solid(false);
        }
        self.build(options, progress)
    }
}
