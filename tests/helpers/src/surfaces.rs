//! Closed meshes, and how they wind around points by a sum of solid angles.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::error::{Error, Result};
use cstk::hierarchy::HierarchyOptions;
use cstk::pair::{RayScratch, winding};
use cstk::pose::{Pose, Vec3};

use super::shapes::box_corners;

pub fn mesh(vertices: Vec<Vec3>, faces: &[Vec<u32>]) -> Mesh {
    Mesh {
        vertices,
        face_sizes: faces.iter().map(|face| face.len() as u32).collect(),
        indices: faces.concat(),
    }
}

pub fn faces(mesh: &Mesh) -> Vec<Vec<u32>> {
    let mut rest = &mesh.indices[..];
    mesh.face_sizes
        .iter()
        .map(|&size| {
            let (face, after) = rest.split_at(size as usize);
            rest = after;
            face.to_vec()
        })
        .collect()
}

/// Six squares that face outwards.
pub fn cube(half: f64) -> Mesh {
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    mesh(box_corners([2.0 * half; 3]), &quads.map(Vec::from))
}

/// Around the z axis; the tube has about the given radius, and faces outwards.
pub fn torus(radius: f64, tube: f64, sides: usize, around: usize) -> Mesh {
    let vertices = (0..sides * around).map(|i| {
        let (u, v) = (
            TAU * (i / around) as f64 / sides as f64,
            TAU * (i % around) as f64 / around as f64,
        );
        let out = radius + tube * v.cos();
        Vec3::new(out * u.cos(), out * u.sin(), tube * v.sin())
    });
    let at = |i: usize, j: usize| (i % sides * around + j % around) as u32;
    let mut triangles = Vec::new();
    for i in 0..sides {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    mesh(vertices.collect(), &triangles)
}

/// By latitudes and longitudes, in triangles that face outwards.
pub fn sphere(radius: f64, bands: usize) -> Mesh {
    let sides = 2 * bands;
    let mut vertices = vec![Vec3::z() * -radius, Vec3::z() * radius];
    for k in 1..bands {
        let (ring, height) = (PI * k as f64 / bands as f64).sin_cos();
        for i in 0..sides {
            let (y, x) = (TAU * i as f64 / sides as f64).sin_cos();
            vertices.push(Vec3::new(ring * x, ring * y, -height) * radius);
        }
    }
    let at = |k: usize, i: usize| (2 + (k - 1) * sides + i % sides) as u32;
    let mut triangles = Vec::new();
    for i in 0..sides {
        triangles.push(vec![0, at(1, i + 1), at(1, i)]);
        triangles.push(vec![1, at(bands - 1, i), at(bands - 1, i + 1)]);
        for k in 1..bands - 1 {
            let [a, b, c, d] = [at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)];
            triangles.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    mesh(vertices, &triangles)
}

/// The same with all faces the other way round.
pub fn inside_out(given: &Mesh) -> Mesh {
    let turned = faces(given)
        .into_iter()
        .map(|face| face.into_iter().rev().collect());
    mesh(given.vertices.clone(), &turned.collect::<Vec<Vec<u32>>>())
}

pub fn moved(given: &Mesh, pose: &Pose) -> Mesh {
    Mesh {
        vertices: given
            .vertices
            .iter()
            .map(|v| pose.transform_point(v))
            .collect(),
        ..given.clone()
    }
}

pub fn shifted(given: &Mesh, by: [f64; 3]) -> Mesh {
    moved(given, &Pose::from_translation(by.into()))
}

/// A cube of half side 1 with a cubic void of half side 0.6.
pub fn hollow_cube() -> Vec<Mesh> {
    vec![cube(1.0), inside_out(&cube(0.6))]
}

/// A cube of half side 1, the top in two pieces that meet its front in a vertex, which is so far before it; and the sliver
/// between.
pub fn with_sliver(width: f64) -> Mesh {
    let mut given = cube(1.0);
    given.vertices.push(Vec3::new(0.0, -1.0 - width, 1.0));
    with_faces(&given, |faces| {
        faces[1] = vec![4, 8, 6];
        faces.extend([vec![8, 5, 7, 6], vec![8, 4, 5]]);
    })
}

pub fn builder(meshes: &[Mesh]) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).unwrap();
    for mesh in meshes {
        builder.add_mesh(mesh).unwrap();
    }
    builder
}

pub fn build(builder: &BodyBuilder) -> Result<Arc<Body>> {
    builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .map(Arc::new)
}

pub fn surface(meshes: &[Mesh]) -> Arc<Body> {
    build(&builder(meshes)).unwrap()
}

pub fn surface_one(mesh: &Mesh) -> Arc<Body> {
    surface(std::slice::from_ref(mesh))
}

pub fn solid_of(mut builder: BodyBuilder) -> Result<Arc<Body>> {
    builder.set_solid(true);
    build(&builder)
}

pub fn solid(meshes: &[Mesh]) -> Arc<Body> {
    solid_of(builder(meshes)).unwrap()
}

pub fn solid_one(mesh: &Mesh) -> Arc<Body> {
    solid(std::slice::from_ref(mesh))
}

/// Why a mesh bounds no solid.
pub fn refused(given: &Mesh) -> Error {
    solid_of(builder(std::slice::from_ref(given))).unwrap_err()
}

pub fn with_faces(given: &Mesh, change: impl FnOnce(&mut Vec<Vec<u32>>)) -> Mesh {
    let mut list = faces(given);
    change(&mut list);
    mesh(given.vertices.clone(), &list)
}

/// The winding number of a body around a point of the frame in which it was given.
pub fn number_at(body: &Body, p: Vec3) -> i32 {
    winding(body, &(p - body.center()), &mut RayScratch::default()).number
}

/// How often faces wind around a point, by the solid angles of their triangles (van Oosterom and Strackee 1983). NaN for a
/// point on a face, or as good as on it.
pub fn turns_around(mesh: &Mesh, point: &Vec3) -> f64 {
    let mut sum = 0.0;
    for face in faces(mesh) {
        let seen: Vec<Vec3> = face
            .iter()
            .map(|&i| mesh.vertices[i as usize] - point)
            .collect();
        for two in seen[1..].windows(2) {
            let [a, b, c] = [seen[0], two[0], two[1]];
            let [x, y, z] = [a.norm(), b.norm(), c.norm()];
            let over = a.dot(&b.cross(&c));
            let under = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
            let rounding = 1e-9 * x * y * z;
            if over.abs() <= rounding && under <= rounding {
                return f64::NAN;
            }
            sum += 2.0 * over.atan2(under);
        }
    }
    sum / (4.0 * PI)
}
