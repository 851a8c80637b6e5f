//! Features that face each other: a feature of each of two bodies, with a direction that belongs to it alone, and the pose at
//! which the two are at a given distance.

use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::primitive::Convex;
use nalgebra::Rotation3;

use super::random::Random;

/// A point of a feature's inside, and a direction along which the feature alone is farthest.
pub struct Supported {
    pub point: Vec3,
    pub normal: Vec3,
    /// Of an edge.
    along: Option<Vec3>,
}

/// Weights of `n` things, none of them small.
fn shares(random: &mut Random, n: usize) -> Vec<f64> {
    let drawn: Vec<f64> = (0..n).map(|_| random.within(0.5, 1.0)).collect();
    let sum: f64 = drawn.iter().sum();
    drawn.iter().map(|x| x / sum).collect()
}

fn mixed(items: &[Vec3], random: &mut Random) -> Vec3 {
    let weights = shares(random, items.len());
    items.iter().zip(weights).map(|(item, w)| item * w).sum()
}

fn outward(shape: &Convex, planar: bool, touches: impl Fn(&[u32]) -> bool) -> Vec<Vec3> {
    if !planar {
        let own = shape.faces.iter().filter(|face| touches(&face.vertices));
        return own.map(|face| face.normal).collect();
    }
    let center: Vec3 = shape.vertices.iter().sum::<Vec3>() / shape.vertices.len() as f64;
    let own = shape.edges.iter().filter(|edge| touches(&edge[..]));
    own.map(|&[a, b]| {
        let [a, b] = [a, b].map(|i| shape.vertices[i as usize]);
        let normal = Vec3::new(b.y - a.y, a.x - b.x, 0.0).normalize();
        if normal.dot(&(a - center)) < 0.0 {
            -normal
        } else {
            normal
        }
    })
    .collect()
}

/// A feature of the kind: 'v', 'e' or 'f'.
pub fn supported(shape: &Convex, kind: char, planar: bool, random: &mut Random) -> Supported {
    let corners: Vec<u32> = match kind {
        'v' => vec![random.below(shape.vertices.len()) as u32],
        'e' => shape.edges[random.below(shape.edges.len())].to_vec(),
        _ => shape.faces[random.below(shape.faces.len())]
            .vertices
            .to_vec(),
    };
    let points: Vec<Vec3> = corners
        .iter()
        .map(|&i| shape.vertices[i as usize])
        .collect();
    let normals = outward(shape, planar, |of| corners.iter().all(|i| of.contains(i)));
    Supported {
        point: mixed(&points, random),
        normal: mixed(&normals, random).normalize(),
        along: (kind == 'e').then(|| (points[1] - points[0]).normalize()),
    }
}

/// The pose of r at which its feature faces that of s, `apart` from it.
pub fn facing(
    r: &Supported,
    s: &Supported,
    pose_s: &Pose,
    apart: f64,
    planar: bool,
    random: &mut Random,
) -> (Pose, Vec3) {
    let normal = pose_s.rotation * s.normal;
    let rotation: Mat3 = if planar {
        let angle = (-normal.y).atan2(-normal.x) - r.normal.y.atan2(r.normal.x);
        rotation_about(&Vec3::z(), angle)
    } else {
        let half_turn = || Rotation3::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI);
        let turned = Rotation3::rotation_between(&r.normal, &-normal).unwrap_or_else(half_turn);
        // Edges that are nearly parallel are near a tie: their contact runs along them.
        loop {
            let spin = rotation_about(&normal, random.within(-3.0, 3.0)) * turned.into_inner();
            match (r.along, s.along) {
                (Some(e), Some(f)) if (spin * e).cross(&(pose_s.rotation * f)).norm() < 0.1 => {}
                _ => break spin,
            }
        }
    };
    let meeting = pose_s.transform_point(&s.point) + normal * apart;
    let translation = meeting - rotation * r.point;
    (
        Pose {
            rotation,
            translation,
        },
        normal,
    )
}
