//! Converts URDF shapes to primitives. Round shapes may become polyhedra that enclose them, so that an answer of "free"
//! stays conservative.

use std::collections::HashMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use super::model::{Geometry, LinkElement, Shape};
use super::packages::PackageFolders;
use crate::body::mesh_file::{MeshFormat, read_mesh_bytes};
use crate::body::{BodyBuilder, BodyKey, Mesh, MeshBudget, MeshForm, MeshSize};
use crate::error::{Error, Result, require_finite};
use crate::pose::{Pose, Vec3};
use crate::xml::place;

/// Reads the links' shapes, each mesh file once.
pub struct ShapeReader<'a> {
    packages: PackageFolders<'a>,
    /// The number of sides that a circle is divided into; 0 keeps round shapes exact.
    sides: usize,
    /// Indices into `files`, by the name in the URDF file.
    names: HashMap<String, usize>,
    /// Indices into `files`, by canonical path: one file may have several names.
    paths: HashMap<PathBuf, usize>,
    files: Vec<MeshFile>,
    budget: MeshBudget,
}

struct MeshFile {
    path: PathBuf,
    digest: String,
    content: Content,
}

/// The content of a mesh file. It is parsed only when a body needs to be built from it.
enum Content {
    Bytes(MeshFormat, Vec<u8>),
    Mesh(Arc<Mesh>),
}

impl<'a> ShapeReader<'a> {
    pub fn new(packages: PackageFolders<'a>, sides: usize) -> Self {
        Self {
            packages,
            sides,
            names: HashMap::new(),
            paths: HashMap::new(),
            files: Vec::new(),
            budget: MeshBudget::default(),
        }
    }

    /// The mesh files read so far.
    pub fn file_count(&self) -> usize {
        self.files.len()
    }

    /// Describes everything that the link's shapes depend on. Links with equal descriptions have equal shapes.
    pub fn describe(&mut self, link: &LinkElement, form: MeshForm) -> Result<String> {
        let mut text = format!("sides {}\n", self.sides);
        // Surfaces are described as they were before there were other forms: caches stay good.
        if form != MeshForm::Surface {
            let _ = writeln!(text, "form {form:?}");
        }
        for geometry in &link.geometry {
            let origin = geometry.origin.to_row_major();
            let shape = match &geometry.shape {
                Shape::Mesh { file, scale } => {
                    let file = self.file(file).map_err(|e| at(link, geometry, e))?;
                    let MeshFile { path, digest, .. } = &self.files[file];
                    let format = MeshFormat::of(path)?;
                    format!("{format:?} {digest} {scale:?}")
                }
                other => format!("{other:?}"),
            };
            let _ = writeln!(text, "{origin:?} {shape}");
        }
        Ok(text)
    }

    /// Reads the meshes of a link whose body must be built, and takes its size from the budget.
    pub fn prepare(&mut self, link: &LinkElement) -> Result<()> {
        for geometry in &link.geometry {
            self.count(geometry).map_err(|e| at(link, geometry, e))?;
        }
        Ok(())
    }

    fn count(&mut self, geometry: &Geometry) -> Result<()> {
        let sides = self.sides as u64;
        let on_sphere = 2 + (sides / 2) * sides;
        let points = match &geometry.shape {
            Shape::Mesh { file, .. } => {
                let index = self.file(file)?;
                let is_repeated = matches!(self.files[index].content, Content::Mesh(_));
                let mesh = self.mesh(index)?;
                let size = MeshSize::of(&mesh);
                let taken = self.budget.take(size, is_repeated);
                return taken.map_err(|e| e.within(file));
            }
            Shape::Box { .. } => 8,
            Shape::Cylinder { .. } => 2 * sides,
            Shape::Sphere { .. } => on_sphere,
            Shape::Capsule { .. } => 2 * on_sphere,
        };
        // A polyhedron has fewer than two faces per vertex.
        let size = MeshSize {
            faces: 2 * points,
            indices: 6 * points,
            squares: 0,
        };
        self.budget.take(size, false)
    }

    /// The link's shapes in its frame. Primitives are tagged with the number of the shape, those of a mesh with the number
    /// of the face in its file.
    pub fn read(&mut self, link: &LinkElement, form: MeshForm) -> Result<BodyBuilder> {
        let mut builder = BodyBuilder::new(3)?;
        for (i, geometry) in link.geometry.iter().enumerate() {
            self.add(geometry, form, i as u64, &mut builder)
                .map_err(|e| at(link, geometry, e))?;
        }
        Ok(builder)
    }

    fn add(
        &mut self,
        geometry: &Geometry,
        form: MeshForm,
        tag: u64,
        builder: &mut BodyBuilder,
    ) -> Result<()> {
        let at = &geometry.origin;
        match &geometry.shape {
            Shape::Box { size } => {
                let corners = (0..8).map(|i| {
                    let half =
                        |axis: usize| size[axis] * if i >> axis & 1 == 0 { -0.5 } else { 0.5 };
                    Vec3::new(half(0), half(1), half(2))
                });
                add_polyhedron(builder, corners, at, tag)
            }
            Shape::Sphere { radius } if self.sides == 0 => {
                builder.add_sphere(&at.translation, *radius, tag)
            }
            Shape::Cylinder { radius, length } if self.sides == 0 => {
                builder.add_cylinder(at, *radius, 0.5 * length, tag)
            }
            Shape::Capsule { radius, length } if self.sides == 0 => {
                let [a, b] =
                    [-0.5, 0.5].map(|end| at.transform_point(&(Vec3::z() * (end * length))));
                builder.add_capsule(&a, &b, *radius, tag)
            }
            Shape::Sphere { radius } => {
                let points = around_sphere(*radius, self.sides);
                add_polyhedron(builder, points.into_iter(), at, tag)
            }
            Shape::Cylinder { radius, length } => {
                let rim = rim(*radius, self.sides);
                let ends = [-0.5 * length, 0.5 * length];
                let points = ends
                    .into_iter()
                    .flat_map(|z| rim.iter().map(move |[x, y]| Vec3::new(*x, *y, z)));
                add_polyhedron(builder, points, at, tag)
            }
            Shape::Capsule { radius, length } => {
                let ball = around_sphere(*radius, self.sides);
                let ends = [-0.5 * length, 0.5 * length];
                let points = ends
                    .into_iter()
                    .flat_map(|z| ball.iter().map(move |p| p + Vec3::z() * z));
                add_polyhedron(builder, points, at, tag)
            }
            Shape::Mesh { file, scale } => {
                let index = self.file(file)?;
                let mesh = (*self.mesh(index)?).clone();
                let placed = mesh.placed(at, &Vec3::from(*scale));
                let added = placed.and_then(|mesh| builder.add_mesh_as(&mesh, form, tag));
                added.map_err(|e| e.within(file))
            }
        }
    }

    /// The index of a mesh file, which is read when it is first named. One file may have several names.
    fn file(&mut self, name: &str) -> Result<usize> {
        if let Some(&index) = self.names.get(name) {
            return Ok(index);
        }
        let path = self.packages.resolve(name)?;
        let named = |e: Error| e.within(path.display());
        let real = path.canonicalize().map_err(Error::io).map_err(named)?;
        let place = match self.paths.get(&real) {
            Some(&index) => index,
            None => {
                let format = MeshFormat::of(&path).map_err(named)?;
                let bytes = read_mesh_bytes(&path).map_err(named)?;
                self.files.push(MeshFile {
                    path,
                    digest: BodyKey::digest(&bytes),
                    content: Content::Bytes(format, bytes),
                });
                self.paths.insert(real, self.files.len() - 1);
                self.files.len() - 1
            }
        };
        self.names.insert(name.to_string(), place);
        Ok(place)
    }

    fn mesh(&mut self, index: usize) -> Result<Arc<Mesh>> {
        let file = &mut self.files[index];
        let (format, bytes) = match &file.content {
            Content::Mesh(mesh) => return Ok(mesh.clone()),
            Content::Bytes(format, bytes) => (format, bytes),
        };
        let path = &file.path;
        let read = format.parse(bytes).map_err(|e| e.within(path.display()))?;
        // Checked before they are transformed, so that the message shows the number in the file.
        for (i, vertex) in read.vertices.iter().enumerate() {
            require_finite(vertex.as_slice(), "coordinate")
                .map_err(|e| e.within(format_args!("{}: vertex {i}", path.display())))?;
        }
        let read = Arc::new(read);
        file.content = Content::Mesh(read.clone());
        Ok(read)
    }
}

/// Adds the link and the shape to an error message.
fn at(link: &LinkElement, geometry: &Geometry, error: Error) -> Error {
    error.within(format_args!(
        "link \"{}\": {}",
        link.name,
        place(geometry.node)
    ))
}

fn add_polyhedron(
    builder: &mut BodyBuilder,
    points: impl Iterator<Item = Vec3>,
    at: &Pose,
    tag: u64,
) -> Result<()> {
    let points: Vec<Vec3> = points.map(|p| at.transform_point(&p)).collect();
    builder.add_polyhedron(&points, tag)
}

/// The corners of a regular polygon circumscribed about a circle.
fn rim(radius: f64, sides: usize) -> Vec<[f64; 2]> {
    let step = std::f64::consts::TAU / sides as f64;
    let outer = radius / (0.5 * step).cos();
    (0..sides)
        .map(|i| {
            let (s, c) = (step * i as f64).sin_cos();
            [outer * c, outer * s]
        })
        .collect()
}

/// The corners of a polyhedron that encloses a sphere: rings of latitude on a larger sphere, so large that no face cuts
/// into the smaller one.
fn around_sphere(radius: f64, sides: usize) -> Vec<Vec3> {
    let bands = (sides / 2).max(2);
    let tilt = std::f64::consts::PI / bands as f64;
    let turn = std::f64::consts::TAU / sides as f64;
    // A face's centre is within half a band and half a side of its corners.
    let outer = radius / ((0.5 * tilt).cos() * (0.5 * turn).cos());
    let mut points = vec![Vec3::z() * outer, Vec3::z() * -outer];
    for band in 1..bands {
        let (ring, z) = (tilt * band as f64).sin_cos();
        for i in 0..sides {
            let (s, c) = (turn * i as f64).sin_cos();
            points.push(Vec3::new(ring * c, ring * s, z) * outer);
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::convex_polyhedron;

    #[test]
    fn round_shapes_lie_within_their_polyhedra() {
        for sides in [3, 4, 5, 8, 32] {
            let ball = convex_polyhedron(&around_sphere(2.0, sides)).unwrap();
            let nearest = ball.faces.iter().map(|face| {
                let corner = ball.vertices[face.vertices[0] as usize];
                face.normal.dot(&corner)
            });
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest >= 2.0, "{sides}: {nearest}");
            assert!(sides < 32 || nearest < 2.05);
        }
    }
}
