//! The shapes of URDF as primitives. Round ones may become polyhedra that hold them, so that what is called free is free.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::model::{Geometry, LinkElement, Shape};
use super::packages::resolve;
use crate::body::{BodyBuilder, Mesh, read_mesh_file};
use crate::error::{Result, require_finite};
use crate::pose::{Pose, Vec3};
use crate::xml::place;

/// Reads the links' geometry, each mesh file once.
pub struct ShapeReader<'a> {
    pub folder: &'a Path,
    pub search: &'a [PathBuf],
    /// Into how many sides a circle is divided; 0 for none.
    pub sides: usize,
    pub meshes: HashMap<PathBuf, Arc<Mesh>>,
}

impl ShapeReader<'_> {
    /// The link's shapes in its frame; primitives are tagged with the number of the shape, those of meshes with the face's
    /// number in its file.
    pub fn read(&mut self, link: &LinkElement) -> Result<BodyBuilder> {
        let mut builder = BodyBuilder::new(3)?;
        for (i, geometry) in link.geometry.iter().enumerate() {
            self.add(geometry, i as u64, &mut builder).map_err(|e| {
                e.within(format_args!(
                    "link \"{}\": {}",
                    link.name,
                    place(geometry.node)
                ))
            })?;
        }
        Ok(builder)
    }

    fn add(&mut self, geometry: &Geometry, tag: u64, builder: &mut BodyBuilder) -> Result<()> {
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
                let mut mesh = (*self.mesh(file)?).clone();
                for vertex in &mut mesh.vertices {
                    *vertex = at.transform_point(&vertex.component_mul(&Vec3::from(*scale)));
                }
                builder.add_mesh(&mesh).map_err(|e| e.within(file))
            }
        }
    }

    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>> {
        let path = resolve(name, self.folder, self.search)?;
        if let Some(known) = self.meshes.get(&path) {
            return Ok(known.clone());
        }
        let read = read_mesh_file(&path).map_err(|e| e.within(path.display()))?;
        // Before they are moved, so that the message tells the number that the file holds.
        for (i, vertex) in read.vertices.iter().enumerate() {
            require_finite(vertex.as_slice(), "coordinate")
                .map_err(|e| e.within(format_args!("{}: vertex {i}", path.display())))?;
        }
        let read = Arc::new(read);
        self.meshes.insert(path, read.clone());
        Ok(read)
    }
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

/// A regular polygon around a circle.
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

/// A polyhedron around a sphere: bands of latitude whose corners lie on a larger sphere that no face comes through.
fn around_sphere(radius: f64, sides: usize) -> Vec<Vec3> {
    let bands = (sides / 2).max(2);
    let tilt = std::f64::consts::PI / bands as f64;
    let turn = std::f64::consts::TAU / sides as f64;
    // A face's middle lies within half a band and half a side of its corners.
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
