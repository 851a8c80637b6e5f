//! Collects primitives, checks each when it is added, and builds the body.

use std::path::Path;
use std::sync::Arc;

use super::added_bodies::AddedBodies;
use super::body::{Body, BodyStatistics};
use super::curved_cells::CurvedCells;
use super::mesh::Mesh;
use super::solid::{DegenerateFace, Solid};
use crate::body::cloud_file::read_cloud_file;
use crate::body::mesh_file::read_mesh_file;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::hierarchy::{HierarchyOptions, build_hierarchy, compose_hierarchy};
use crate::pose::{Pose, Vec3, check_dimension};
use crate::primitive::{
    Convex, FaceSplit, Primitives, convex_polygon, convex_polyhedron, split_face,
};
use crate::tolerance;

/// Collects the primitives of a body. A call that fails adds nothing.
#[derive(Debug)]
pub struct BodyBuilder {
    pub(super) dimension: u32,
    /// Those added by themselves.
    primitives: Primitives,
    added: AddedBodies,
    /// Per shape added (points have no entry), whether it is a polygon that may bound a solid.
    is_face: Vec<bool>,
    /// The faces of meshes, or parts of them, that had no area.
    scraps: Vec<DegenerateFace>,
    is_solid: bool,
    stated_deviation: f64,
    /// How far the triangles of patches are from them.
    patch_deviation: f64,
    /// The same of those that queries do not refine.
    flat_deviation: f64,
    /// The cells of patches that queries may refine, in the builder's frame.
    curved: CurvedCells,
    faces_split: u64,
    faces_dropped: u64,
}

impl BodyBuilder {
    /// An empty builder for planar (2) or spatial (3) bodies.
    pub fn new(dimension: u32) -> Result<Self> {
        check_dimension(dimension)?;
        Ok(Self {
            dimension,
            primitives: Primitives::default(),
            added: AddedBodies::default(),
            is_face: Vec::new(),
            scraps: Vec::new(),
            is_solid: false,
            stated_deviation: 0.0,
            patch_deviation: 0.0,
            flat_deviation: 0.0,
            curved: CurvedCells::default(),
            faces_split: 0,
            faces_dropped: 0,
        })
    }

    /// Adds a convex polygon, vertices in cyclic order.
    pub fn add_polygon(&mut self, vertices: &[Vec3], tag: u64) -> Result<()> {
        self.require_planar(vertices)?;
        self.push(convex_polygon(vertices)?, tag, true)
    }

    /// Adds the convex hull of points: a solid, or a flat polygon, segment or point if the points are degenerate.
    pub fn add_polyhedron(&mut self, points: &[Vec3], tag: u64) -> Result<()> {
        self.require_planar(points)?;
        self.push(convex_polyhedron(points)?, tag, false)
    }

    /// Declares that all polygons and mesh faces together are the closed boundary of a solid: a body wholly inside it meets
    /// it. [`BodyBuilder::build`] checks that it is closed; the rules are those of `cstk_body_builder_set_solid` in the
    /// header.
    pub fn set_solid(&mut self, is_solid: bool) {
        self.is_solid = is_solid;
    }

    /// States that the body stands for a set within this Hausdorff distance of it, such as a curved surface; the rules are those
    /// of `cstk_body_builder_set_deviation` in the header.
    pub fn set_deviation(&mut self, deviation: f64) -> Result<()> {
        require_finite(&[deviation], "deviation")?;
        if !(0.0..=tolerance::LARGEST_COORDINATE).contains(&deviation) {
            return Err(Error::invalid(format!(
                "deviation is {deviation}; it must be from 0 to {:e}",
                tolerance::LARGEST_COORDINATE
            )));
        }
        // No -0.
        self.stated_deviation = deviation.abs();
        Ok(())
    }

    /// Notes which primitives stand for cells of patches, if they are kept, and how far they are from them at most.
    pub(super) fn take_curved(&mut self, cells: Option<CurvedCells>, deviation: f64) {
        match cells {
            Some(cells) => self.curved.append(&cells, 0, &Pose::identity()),
            None => self.flat_deviation = self.flat_deviation.max(deviation),
        }
        self.patch_deviation = self.patch_deviation.max(deviation);
    }

    /// The cells of patches in the frame around a centre. None where the builder was told how far the body is from what it stands
    /// for: this is then not known of any part of it.
    fn curved_cells(&self, center: &Vec3) -> Option<CurvedCells> {
        if self.stated_deviation > 0.0 {
            return None;
        }
        let mut curved = CurvedCells::default();
        curved.append(&self.curved, 0, &Pose::from_translation(-center));
        self.added.append_curved(&mut curved, center);
        curved.sort();
        (!curved.is_empty()).then_some(curved)
    }

    /// Adds the faces of a mesh, each tagged with its index. Faces that are not convex or not planar become triangles. Faces
    /// without area are counted and become no primitive; they only serve to close the boundary of a solid.
    pub fn add_mesh(&mut self, mesh: &Mesh) -> Result<()> {
        self.require_planar(&mesh.vertices)?;
        let mut added: Vec<(Convex, u64)> = Vec::new();
        let mut scraps: Vec<DegenerateFace> = Vec::new();
        let (mut split, mut dropped) = (0, 0);
        let mut rest = &mesh.indices[..];
        for (f, &size) in mesh.face_sizes.iter().enumerate() {
            let named = |error: Error| error.within(format_args!("face {f}"));
            let (face, after) = rest.split_at_checked(size as usize).ok_or_else(|| {
                Error::new(
                    ErrorKind::WrongSize,
                    format!(
                        "face {f} needs {size} indices, but only {} are left",
                        rest.len()
                    ),
                )
            })?;
            rest = after;
            let corners = face
                .iter()
                .map(|&i| mesh.vertices.get(i as usize).copied())
                .collect::<Option<Vec<Vec3>>>()
                .ok_or_else(|| {
                    let count = mesh.vertices.len();
                    let missing = face.iter().find(|&&i| i as usize >= count);
                    Error::new(
                        ErrorKind::NotFound,
                        format!(
                            "face {f} refers to vertex {}; there are {count}, counted from 0",
                            missing.copied().unwrap_or_default()
                        ),
                    )
                })?;
            let tag = f as u64;
            let mut drop = |vertices: Vec<Vec3>| scraps.push(DegenerateFace { vertices, tag });
            match split_face(&corners).map_err(named)? {
                FaceSplit::Convex => added.push((convex_polygon(&corners)?, tag)),
                FaceSplit::Degenerate => {
                    dropped += 1;
                    drop(corners);
                }
                FaceSplit::Triangles(triangles) => {
                    split += 1;
                    left_out(&corners, &triangles).for_each(&mut drop);
                    for triangle in triangles {
                        let corners = triangle.map(|i| corners[i as usize]);
                        match convex_polygon(&corners) {
                            Ok(polygon) => added.push((polygon, tag)),
                            // A triangle without area covers nothing beyond its neighbours.
                            Err(error) if error.kind == ErrorKind::Degenerate => {
                                drop(corners.to_vec());
                            }
                            Err(error) => return Err(named(error)),
                        }
                    }
                }
            }
        }
        if !rest.is_empty() {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!("{} indices are left after the last face", rest.len()),
            ));
        }
        self.push_all(added, true)?;
        // A scrap of two vertices uses its edge once each way, which closes nothing.
        self.scraps
            .extend(scraps.into_iter().filter(|s| s.vertices.len() > 2));
        self.faces_split += split;
        self.faces_dropped += dropped;
        Ok(())
    }

    /// Adds the mesh in an OBJ, STL, COLLADA or PLY file, scaled and moved as by [`Mesh::placed`].
    pub fn add_mesh_file(&mut self, path: &Path, pose: &Pose, scale: &Vec3) -> Result<()> {
        let named = |error: Error| error.within(path.display());
        let mesh = read_mesh_file(path).map_err(named)?;
        let mesh = mesh.placed(pose, scale).map_err(named)?;
        self.add_mesh(&mesh).map_err(named)
    }

    /// Adds balls of one radius around the points in a PCD file, or around the vertices in a PLY file, scaled and moved as by
    /// [`Mesh::placed`]; they are tagged with their indices. Points that a PCD file marks as not measured are left out; returns
    /// their number.
    pub fn add_cloud_file(
        &mut self,
        path: &Path,
        pose: &Pose,
        scale: &Vec3,
        radius: f64,
    ) -> Result<u64> {
        let named = |error: Error| error.within(path.display());
        let cloud = read_cloud_file(path).map_err(named)?;
        let mesh = Mesh {
            vertices: cloud.points,
            ..Mesh::default()
        };
        let points = mesh.placed(pose, scale).map_err(named)?.vertices;
        self.add_points(&points, radius).map_err(named)?;
        Ok(cloud.left_out)
    }

    /// Adds a body at a pose. Its primitives keep their order, tags and features; its hierarchy is taken over. If it is a
    /// solid it stays one, whatever [`BodyBuilder::set_solid`] says of the faces added by themselves.
    pub fn add_body(&mut self, body: &Arc<Body>, pose: &Pose, tag: u64) -> Result<()> {
        if body.dimension != self.dimension {
            return Err(Error::invalid(format!(
                "the body's dimension is {}, the builder's {}",
                body.dimension, self.dimension
            )));
        }
        if self.dimension == 2 && !pose.is_planar() {
            return Err(Error::invalid("the pose leaves the plane z = 0"));
        }
        self.require_room(body.primitives().len())?;
        let first = self.len();
        self.added.push(body, first, pose, tag)
    }

    /// Number of primitives added so far.
    pub fn len(&self) -> usize {
        self.primitives.len() + self.added.primitive_count()
    }

    /// Whether no primitive was added yet.
    pub fn is_empty(&self) -> bool {
        self.primitives.is_empty() && self.added.is_empty()
    }

    /// Builds the body from the primitives added so far; the builder does not change and may be used further. Fails without
    /// primitives, and for a body declared solid whose boundary is not closed (the message names edges) or bounds nothing.
    pub fn build(
        &self,
        options: &HierarchyOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Body> {
        if self.is_empty() {
            return Err(Error::new(
                ErrorKind::Empty,
                if self.faces_dropped > 0 {
                    format!(
                        "the body has no primitive: all {} faces had no area",
                        self.faces_dropped
                    )
                } else {
                    "the body has no primitive".to_string()
                },
            ));
        }
        let singles = self.added.single_numbers(self.primitives.len());
        let boundary = match self.is_solid && self.dimension == 3 {
            true => Some(Solid::checked(
                &self.primitives,
                &self.is_face,
                &self.scraps,
                |single| singles[single as usize],
            )?),
            false => None,
        };
        let (low, high) = self.added.extent(&self.primitives);
        let center = low * 0.5 + high * 0.5;
        let primitives = self.added.centered(&self.primitives, &center);
        let solid = self.added.solid(boundary, &center, &primitives);
        let built = match self.added.is_empty() {
            true => build_hierarchy(&primitives, options, progress)?,
            false => {
                let parts = self.added.hierarchies(&center);
                compose_hierarchy(&primitives, &singles, &parts, options, progress)?
            }
        };
        let sum =
            |count: fn(&BodyStatistics) -> u64| -> u64 { self.added.statistics().map(count).sum() };
        let statistics = BodyStatistics {
            is_solid: self.is_solid || self.added.statistics().any(|of_body| of_body.is_solid),
            primitives: primitives.len() as u64,
            faces_split: self.faces_split + sum(|of_body| of_body.faces_split),
            faces_dropped: self.faces_dropped + sum(|of_body| of_body.faces_dropped),
            nodes: built.nodes as u64,
            depth: built.depth as u64,
            low: low.into(),
            high: high.into(),
            times: built.times,
        };
        Ok(Body::assemble(
            self.dimension,
            center,
            primitives.radius(),
            primitives,
            built.wrappers,
            built.packed,
            statistics,
        )
        .with_solid(solid)
        .with_parts(self.added.parts())
        .with_stated_deviation(
            self.stated_deviation
                .max(self.patch_deviation)
                .max(self.added.stated_deviation()),
        )
        .with_curved(
            self.curved_cells(&center),
            self.flat_deviation.max(self.added.flat_deviation()),
        ))
    }

    pub(super) fn push(&mut self, primitive: Convex, tag: u64, is_face: bool) -> Result<()> {
        self.require_room(1)?;
        self.primitives.push(primitive, tag);
        self.is_face.push(is_face);
        Ok(())
    }

    /// Adds points of one shape, tagged with their indices in `points`: all of them or none.
    pub(super) fn push_points(&mut self, shape: &Convex, points: &[Vec3]) -> Result<()> {
        self.require_room(points.len())?;
        self.primitives.reserve_points(points.len())?;
        self.primitives.push_points(shape, points.iter().copied());
        Ok(())
    }

    /// Adds all primitives or none; `are_faces` says whether they are polygons that may bound a solid.
    pub(super) fn push_all(&mut self, added: Vec<(Convex, u64)>, are_faces: bool) -> Result<()> {
        self.require_room(added.len())?;
        for (primitive, tag) in added {
            self.primitives.push(primitive, tag);
            self.is_face.push(are_faces);
        }
        Ok(())
    }

    fn require_room(&self, more: usize) -> Result<()> {
        if self.len() + more > u32::MAX as usize / 2 {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "a body holds at most 2^31 primitives",
            ));
        }
        Ok(())
    }

    pub(super) fn require_planar(&self, points: &[Vec3]) -> Result<()> {
        // Coordinates that are not finite are refused later, with their own message.
        match points.iter().position(|p| p.z != 0.0 && p.z.is_finite()) {
            Some(i) if self.dimension == 2 => Err(Error::new(
                ErrorKind::NotPlanar,
                format!("vertex {i} of a planar body has z = {}, not 0", points[i].z),
            )),
            _ => Ok(()),
        }
    }
}

/// The rings between a face and its triangles where the triangulation skips vertices that repeat others.
fn left_out(face: &[Vec3], triangles: &[[u32; 3]]) -> impl Iterator<Item = Vec<Vec3>> {
    let n = face.len();
    let mut is_used = vec![false; n];
    for &i in triangles.as_flattened() {
        is_used[i as usize] = true;
    }
    let used: Vec<usize> = (0..n).filter(|&i| is_used[i]).collect();
    let ends = (0..used.len()).map(move |k| {
        let (from, to) = (used[k], used[(k + 1) % used.len()]);
        (from, if to > from { to } else { to + n })
    });
    let rings = ends.filter(|(from, to)| to - from > 1);
    rings.map(move |(from, to)| (from..=to).map(|i| face[i % n]).collect())
}
