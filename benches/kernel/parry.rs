//! parry's queries: each moving mesh against all obstacles as one.

use std::time::Instant;

use cstk::body::Mesh;
use cstk::pose::Pose;
use parry3d_f64::math::{Matrix, Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::TriMesh;

use super::case::{Case, Mode, Triangles, merged};

/// A pass that takes longer is given up.
const MAX_SECONDS: f64 = 5.0;

pub struct Parry {
    moving: Vec<TriMesh>,
    still: TriMesh,
    poses: Vec<Vec<ParryPose>>,
}

impl Parry {
    pub fn new(case: &Case) -> Self {
        Self {
            moving: case.moving.iter().map(trimesh).collect(),
            still: trimesh(&merged(&case.obstacles)),
            poses: case
                .poses
                .iter()
                .map(|poses| poses.iter().map(parry_pose).collect())
                .collect(),
        }
    }

    pub fn run(&self, mode: Mode) -> Option<(f64, Vec<f64>)> {
        let mut answers = Vec::with_capacity(self.poses.len());
        let start = Instant::now();
        for poses in &self.poses {
            answers.push(self.answer(poses, mode)?);
            if start.elapsed().as_secs_f64() > MAX_SECONDS {
                return None;
            }
        }
        Some((start.elapsed().as_secs_f64(), answers))
    }

    fn answer(&self, poses: &[ParryPose], mode: Mode) -> Option<f64> {
        let origin = ParryPose::identity();
        let pairs = self.moving.iter().zip(poses);
        match mode {
            Mode::Distance => {
                let mut least = f64::INFINITY;
                for (mesh, pose) in pairs {
                    let found = query::distance(pose, mesh, &origin, &self.still).ok()?;
                    least = least.min(found.distance);
                }
                Some(least)
            }
            Mode::Within(threshold) => {
                for (mesh, pose) in pairs {
                    let near =
                        query::closest_points(pose, mesh, &origin, &self.still, threshold).ok()?;
                    if !matches!(near, query::ClosestPoints::Disjoint) {
                        return Some(1.0);
                    }
                }
                Some(0.0)
            }
            Mode::Collide => {
                for (mesh, pose) in pairs {
                    let met = query::intersection_test(pose, mesh, &origin, &self.still).ok()?;
                    if met.intersecting {
                        return Some(1.0);
                    }
                }
                Some(0.0)
            }
        }
    }
}

fn trimesh(mesh: &Mesh) -> TriMesh {
    let mesh = Triangles::of(mesh);
    let vertices = mesh
        .vertices
        .chunks_exact(3)
        .map(|p| Vector::new(p[0], p[1], p[2]));
    let (triangles, _) = mesh.triangles.as_chunks::<3>();
    TriMesh::new(vertices.collect(), triangles.to_vec()).expect("a mesh")
}

fn parry_pose(pose: &Pose) -> ParryPose {
    let column = |k: usize| {
        let m = &pose.rotation;
        Vector::new(m[(0, k)], m[(1, k)], m[(2, k)])
    };
    let rotation = Matrix::from_cols(column(0), column(1), column(2));
    let t = &pose.translation;
    ParryPose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_mat3(&rotation))
}
