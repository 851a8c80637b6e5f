//! Vector arithmetic and brute-force distances for the tests.

#![allow(dead_code)]

use cstk_scenes::{Mesh, Point, Pose, Scene};

pub fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

pub fn along(a: Point, d: Point, t: f64) -> Point {
    std::array::from_fn(|k| a[k] + t * d[k])
}

pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Point, b: Point) -> Point {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// The corners of each face.
pub fn polygons(mesh: &Mesh) -> Vec<Vec<Point>> {
    let corners = |face: &Vec<u32>| face.iter().map(|&v| mesh.vertices[v as usize]).collect();
    mesh.faces.iter().map(corners).collect()
}

/// Twice the area vector, about the first corner.
pub fn area_vector(polygon: &[Point]) -> Point {
    let mut sum = [0.0; 3];
    for pair in polygon.windows(2) {
        let c = cross(minus(pair[0], polygon[0]), minus(pair[1], polygon[0]));
        sum = along(sum, c, 1.0);
    }
    sum
}

/// A polygon with what brute force wants to know of it.
pub struct Boxed {
    pub corners: Vec<Point>,
    low: Point,
    high: Point,
}

impl Boxed {
    fn gap(&self, other: &Boxed) -> f64 {
        let apart: Point = std::array::from_fn(|k| {
            (other.low[k] - self.high[k])
                .max(self.low[k] - other.high[k])
                .max(0.0)
        });
        norm(apart)
    }
}

pub fn boxed(mesh: &Mesh) -> Vec<Boxed> {
    polygons(mesh)
        .into_iter()
        .map(|corners| Boxed {
            low: std::array::from_fn(|k| corners.iter().fold(f64::INFINITY, |m, p| m.min(p[k]))),
            high: std::array::from_fn(|k| {
                corners.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[k]))
            }),
            corners,
        })
        .collect()
}

/// The distance of two convex polygons.
pub fn polygon_distance(a: &[Point], b: &[Point]) -> f64 {
    if pierces(a, b) || pierces(b, a) {
        return 0.0;
    }
    let mut least = f64::INFINITY;
    for (one, other) in [(a, b), (b, a)] {
        for &p in one {
            least = least.min(point_to_face(p, other));
        }
    }
    for (p, q) in edges(a) {
        for (r, s) in edges(b) {
            least = least.min(segment_distance(p, q, r, s));
        }
    }
    least
}

fn edges(polygon: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    (0..polygon.len()).map(|i| (polygon[i], polygon[(i + 1) % polygon.len()]))
}

/// Whether the foot of `p` on the plane of `face` is inside the face.
fn above(p: Point, face: &[Point], normal: Point) -> bool {
    edges(face).all(|(a, b)| dot(cross(normal, minus(b, a)), minus(p, a)) >= 0.0)
}

/// The distance from the inside of a face, if the point is above or below it.
fn point_to_face(p: Point, face: &[Point]) -> f64 {
    let normal = area_vector(face);
    match above(p, face, normal) {
        true => dot(minus(p, face[0]), normal).abs() / norm(normal),
        false => f64::INFINITY,
    }
}

fn pierces(a: &[Point], b: &[Point]) -> bool {
    let normal = area_vector(b);
    edges(a).any(|(p, q)| {
        let (hp, hq) = (dot(normal, minus(p, b[0])), dot(normal, minus(q, b[0])));
        hp * hq < 0.0 && above(along(p, minus(q, p), hp / (hp - hq)), b, normal)
    })
}

/// The distance of two segments.
pub fn segment_distance(p: Point, q: Point, r: Point, s: Point) -> f64 {
    let (d, e, w) = (minus(q, p), minus(s, r), minus(p, r));
    let (dd, de, ee, dw, ew) = (dot(d, d), dot(d, e), dot(e, e), dot(d, w), dot(e, w));
    let determinant = dd * ee - de * de;
    let mut t = match determinant > 1e-12 * dd * ee {
        true => ((de * ew - ee * dw) / determinant).clamp(0.0, 1.0),
        false => 0.0,
    };
    let u = ((de * t + ew) / ee).clamp(0.0, 1.0);
    t = ((de * u - dw) / dd).clamp(0.0, 1.0);
    norm(minus(along(p, d, t), along(r, e, u)))
}

/// The distances at most `limit` of all polygon pairs of the moving body at `pose` and the obstacles.
pub fn distances_within(scene: &Scene, pose: &Pose, limit: f64) -> Vec<f64> {
    let moving = boxed(&scene.moving.moved(pose));
    let mut found = Vec::new();
    for obstacle in &scene.obstacles {
        for b in boxed(obstacle) {
            for a in moving.iter().filter(|a| a.gap(&b) <= limit) {
                let distance = polygon_distance(&a.corners, &b.corners);
                if distance <= limit {
                    found.push(distance);
                }
            }
        }
    }
    found
}

/// The distance of the moving body at `pose` from the obstacles.
pub fn distance(scene: &Scene, pose: &Pose) -> f64 {
    let moving = boxed(&scene.moving.moved(pose));
    let fixed: Vec<Boxed> = scene.obstacles.iter().flat_map(boxed).collect();
    let between = |a: &Boxed, b: &Boxed| polygon_distance(&a.corners, &b.corners);
    // Each polygon's partner with the nearest box gives a bound for most of the others.
    let mut least = f64::INFINITY;
    for a in &moving {
        let nearest = fixed
            .iter()
            .min_by(|b, c| a.gap(b).total_cmp(&a.gap(c)))
            .expect("a scene has obstacles");
        if a.gap(nearest) < least {
            least = least.min(between(a, nearest));
        }
    }
    for a in &moving {
        for b in &fixed {
            if a.gap(b) < least {
                least = least.min(between(a, b));
            }
        }
    }
    least
}
