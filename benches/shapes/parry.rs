//! parry's queries.

use std::sync::Arc;
use std::time::Instant;

use parry3d_f64::math::{Matrix, Pose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{
    Ball, Capsule, Compound, Cone, ConvexPolyhedron, Cuboid, Cylinder, SharedShape, TriMesh,
};

use super::case::Triangles;
use super::placement::Placement;
use super::question::{Query, Question};
use super::shape::{Kind, Shape};

/// A pass that takes longer is given up.
const MAX_SECONDS: f64 = 2.0;

pub struct Parry {
    shapes: [SharedShape; 2],
    /// Of the shapes at each query; parry's axes are y.
    poses: Vec<[Pose; 2]>,
}

impl Parry {
    /// None where it lacks a shape or the query.
    pub fn new(shapes: &[Shape; 2], question: &Question) -> Option<Self> {
        if matches!(question.query, Query::Contacts(_)) {
            return None;
        }
        let ours = [0, 1].map(|i| &shapes[i]);
        let place = |placed: &Placement| [0, 1].map(|i| pose(&placed.poses[i]) * to_z(ours[i]));
        Some(Self {
            shapes: [shape(ours[0])?, shape(ours[1])?],
            poses: question.placed.iter().map(place).collect(),
        })
    }

    pub fn run(&self, question: &Question) -> Option<(f64, Vec<f64>)> {
        let mut answers = Vec::with_capacity(self.poses.len());
        let start = Instant::now();
        for (poses, threshold) in self.poses.iter().zip(&question.thresholds) {
            answers.push(self.answer(poses, question.query, *threshold)?);
            if answers.len() % 16 == 0 && start.elapsed().as_secs_f64() > MAX_SECONDS {
                return None;
            }
        }
        Some((start.elapsed().as_secs_f64(), answers))
    }

    fn answer(&self, [p, q]: &[Pose; 2], asked: Query, threshold: f64) -> Option<f64> {
        let (a, b) = (&*self.shapes[0].0, &*self.shapes[1].0);
        let yes = |yes: bool| f64::from(u8::from(yes));
        match asked {
            Query::Distance => Some(query::distance(p, a, q, b).ok()?.distance),
            Query::Within(_) => {
                let near = query::closest_points(p, a, q, b, threshold).ok()?;
                Some(yes(!matches!(near, query::ClosestPoints::Disjoint)))
            }
            Query::Collide => {
                let met = query::intersection_test(p, a, q, b).ok()?;
                Some(yes(met.intersecting))
            }
            Query::Contacts(_) => None,
        }
    }
}

fn shape(shape: &Shape) -> Option<SharedShape> {
    Some(match &shape.kind {
        Kind::Sphere { radius } => SharedShape(Arc::new(Ball::new(*radius))),
        Kind::Capsule { radius, length } => {
            SharedShape(Arc::new(Capsule::new_z(length / 2.0, *radius)))
        }
        Kind::Box { half } => SharedShape(Arc::new(Cuboid::new(Vector::from(*half)))),
        Kind::Cylinder { radius, length } => {
            SharedShape(Arc::new(Cylinder::new(length / 2.0, *radius)))
        }
        Kind::Cone { radius, length } => SharedShape(Arc::new(Cone::new(length / 2.0, *radius))),
        Kind::Ellipsoid { .. } => return None,
        Kind::Hull(hull) => {
            let made = ConvexPolyhedron::from_convex_mesh(points(hull), triangles(hull));
            SharedShape(Arc::new(made?))
        }
        Kind::Mesh(mesh) => {
            let made = TriMesh::new(points(mesh), triangles(mesh).to_vec());
            SharedShape(Arc::new(made.ok()?))
        }
        Kind::Cloud {
            points: cloud,
            radius,
        } => {
            let ball = SharedShape(Arc::new(Ball::new(*radius)));
            let place = |p: Vector| (Pose::from_translation(p), ball.clone());
            let balls = points(cloud).into_iter().map(place);
            SharedShape(Arc::new(Compound::new(balls.collect())))
        }
    })
}

fn points(mesh: &Triangles) -> Vec<Vector> {
    let (points, _) = mesh.vertices.as_chunks::<3>();
    points.iter().map(|p| Vector::from(*p)).collect()
}

fn triangles(mesh: &Triangles) -> &[[u32; 3]] {
    mesh.triangles.as_chunks().0
}

/// From parry's y to z, where it makes a difference.
fn to_z(shape: &Shape) -> Pose {
    match shape.kind {
        Kind::Cylinder { .. } | Kind::Cone { .. } => {
            let turn = Matrix::from_cols(Vector::X, Vector::Z, -Vector::Y);
            Pose::from_parts(Vector::ZERO, Rotation::from_mat3(&turn))
        }
        _ => Pose::identity(),
    }
}

fn pose(m: &[f64; 12]) -> Pose {
    let column = |k: usize| Vector::new(m[k], m[4 + k], m[8 + k]);
    let turn = Matrix::from_cols(column(0), column(1), column(2));
    Pose::from_parts(column(3), Rotation::from_mat3(&turn))
}
