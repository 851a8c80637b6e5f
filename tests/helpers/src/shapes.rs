//! Bodies together with the vertices they were made of.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::primitive::Feature;

use super::oracle::{hull_distance, moved_exactly};

/// A body and, for each of its primitives in order, the vertices given.
#[derive(Clone)]
pub struct Shape {
    pub parts: Vec<Vec<Vec3>>,
    pub body: Arc<Body>,
}

fn build(builder: BodyBuilder, parts: Vec<Vec<Vec3>>) -> Shape {
    let body = builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap();
    assert_eq!(body.primitives().len(), parts.len());
    Shape {
        parts,
        body: Arc::new(body),
    }
}

/// The union of the hulls of some point sets.
pub fn hulls(parts: &[Vec<Vec3>]) -> Shape {
    let mut builder = BodyBuilder::new(3).unwrap();
    for part in parts {
        builder.add_polyhedron(part, 0).unwrap();
    }
    build(builder, parts.to_vec())
}

pub fn hull(points: &[Vec3]) -> Shape {
    hulls(&[points.to_vec()])
}

/// The union of convex polygons of the plane z = 0.
pub fn planar(parts: &[Vec<Vec3>]) -> Shape {
    let mut builder = BodyBuilder::new(2).unwrap();
    for part in parts {
        builder.add_polygon(part, 0).unwrap();
    }
    build(builder, parts.to_vec())
}

/// A mesh of triangles.
pub fn mesh(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Shape {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder
        .add_mesh(&Mesh {
            vertices: vertices.to_vec(),
            face_sizes: vec![3; triangles.len()],
            indices: triangles.concat(),
        })
        .unwrap();
    let parts = triangles
        .iter()
        .map(|t| t.iter().map(|&i| vertices[i as usize]).collect())
        .collect();
    build(builder, parts)
}

/// The corners of a box around the origin.
pub fn box_corners(sides: [f64; 3]) -> Vec<Vec3> {
    (0..8)
        .map(|i| {
            let end = |axis: usize| sides[axis] * if i >> axis & 1 == 0 { -0.5 } else { 0.5 };
            Vec3::new(end(0), end(1), end(2))
        })
        .collect()
}

pub fn cuboid(sides: [f64; 3]) -> Shape {
    hull(&box_corners(sides))
}

/// A cube's surface in triangles, around the origin.
pub fn cube_surface(side: f64) -> Shape {
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    mesh(&box_corners([side; 3]), &faces)
}

/// The largest gap along the fifteen axes of two boxes: negative where they overlap, and their distance where a face is
/// nearest.
pub fn widest_gap(sides: [[f64; 3]; 2], poses: [&Pose; 2]) -> f64 {
    let [a, b] = poses.map(|pose| [0, 1, 2].map(|k| pose.rotation.column(k).into_owned()));
    let mut axes: Vec<Vec3> = a.iter().chain(&b).copied().collect();
    for x in &a {
        axes.extend(b.iter().filter_map(|y| x.cross(y).try_normalize(1e-8)));
    }
    let between = poses[1].translation - poses[0].translation;
    axes.iter()
        .map(|axis| {
            let reach = |columns: &[Vec3; 3], sides: &[f64; 3]| {
                (0..3)
                    .map(|k| 0.5 * sides[k] * axis.dot(&columns[k]).abs())
                    .sum::<f64>()
            };
            axis.dot(&between).abs() - reach(&a, &sides[0]) - reach(&b, &sides[1])
        })
        .fold(f64::NEG_INFINITY, f64::max)
}

/// The vertices of a sphere by latitudes and longitudes. Those on the three axes are exact.
pub fn sphere_points(radius: f64, quarter: usize) -> Vec<Vec3> {
    let circle = |i: usize| -> (f64, f64) {
        let (turns, rest) = (i / quarter, i % quarter);
        let (sin, cos) = (rest as f64 / quarter as f64 * std::f64::consts::FRAC_PI_2).sin_cos();
        [(cos, sin), (-sin, cos), (-cos, -sin), (sin, -cos)][turns % 4]
    };
    let mut points = vec![Vec3::z() * radius, Vec3::z() * -radius];
    for latitude in 1..2 * quarter {
        let (height, ring) = circle(latitude);
        for longitude in 0..4 * quarter {
            let (x, y) = circle(longitude);
            points.push(Vec3::new(ring * x, ring * y, height) * radius);
        }
    }
    points
}

/// A closed, dented triangle surface: an icosahedron, divided once, its vertices moved in and out.
pub fn dented_ball(mut dent: impl FnMut() -> f64) -> Shape {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices: Vec<Vec3> = Vec::new();
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mut v = Vec3::zeros();
            (v[i], v[j], v[k]) = (0.0, s, t * phi);
            vertices.push(v.normalize());
        }
    }
    // The side is 1.05; the next longer distance of two vertices is 1.7.
    let near = |a: usize, b: usize| (vertices[a] - vertices[b]).norm() < 1.1;
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    triangles.push([a as u32, b as u32, c as u32]);
                }
            }
        }
    }
    assert_eq!(triangles.len(), 20);
    let mut middles = std::collections::BTreeMap::new();
    let mut fine = Vec::new();
    for [a, b, c] in triangles {
        let mut middle = |i: u32, j: u32| {
            *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                vertices.push((vertices[i as usize] + vertices[j as usize]).normalize());
                vertices.len() as u32 - 1
            })
        };
        let (d, e, f) = (middle(a, b), middle(b, c), middle(c, a));
        fine.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
    }
    for vertex in &mut vertices {
        *vertex *= dent();
    }
    mesh(&vertices, &fine)
}

impl Shape {
    /// The parts' vertices in the world, less `origin`, each rounded once.
    pub fn placed(&self, pose: &Pose, origin: &Vec3) -> Vec<Vec<Vec3>> {
        self.parts
            .iter()
            .map(|part| {
                part.iter()
                    .map(|v| moved_exactly(v, pose, origin))
                    .collect()
            })
            .collect()
    }
}

/// L of a pair: its largest coordinate, seen from the centre of A.
pub fn pair_size(a: &Shape, pose_a: &Pose, b: &Shape, pose_b: &Pose) -> f64 {
    let origin = pose_a.transform_point(a.body.center());
    let center_b = moved_exactly(b.body.center(), pose_b, &origin);
    a.body.radius().max(center_b.norm() + b.body.radius())
}

/// How far a point is from a feature of the only primitive: from the hull of its vertices.
pub fn off_feature((shape, pose): (&Shape, &Pose), feature: Feature, point: &Vec3) -> f64 {
    let primitive = shape.body.primitives().get(0).shape;
    let corners = primitive.feature_vertices(feature).unwrap();
    let placed = corners.iter().map(|&i| {
        let corner = primitive.vertices[i as usize] + shape.body.center();
        pose.transform_point(&corner)
    });
    hull_distance(&placed.collect::<Vec<_>>(), &[*point]).upper
}
