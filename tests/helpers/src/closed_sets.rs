//! Convex sets that the tests know by closed forms: support, membership, and the points of their faces.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder};
use cstk::error::Result;
use cstk::pose::{Mat3, Pose, Vec3, rotation_about};
use cstk::primitive::SupportFunction;

use super::random::Random;

/// A convex set around its own origin.
#[derive(Clone, Debug)]
pub enum Set {
    /// Radius and half length; the axis is z.
    Cylinder(f64, f64),
    /// Radius and height; the base is at z = -height / 2.
    Cone(f64, f64),
    Ellipsoid(Vec3),
    Ball(f64),
    /// Radius, and half the length of the segment along z.
    Capsule(f64, f64),
    /// Half extents.
    Cuboid(Vec3),
    /// A convex polygon in the plane z = 0: a surface.
    Sheet(Vec<Vec3>),
    /// The hull of points.
    Points(Vec<Vec3>),
    /// Another set, given to the library by its support function alone.
    Supported(Box<Set>),
}

use Set::{Ball, Capsule, Cone, Cuboid, Cylinder, Ellipsoid, Points, Sheet, Supported};

/// A boundary point of a set, with the outward normal of a plane that supports the set there.
pub struct Facing {
    pub point: Vec3,
    pub normal: Vec3,
}

impl SupportFunction for Set {
    fn support(&self, direction: &Vec3) -> Result<Vec3> {
        Ok(self.farthest(direction))
    }
}

impl Set {
    pub fn body(&self) -> Body {
        let mut builder = BodyBuilder::new(3).unwrap();
        let here = Pose::identity();
        let origin = Vec3::zeros();
        match self {
            Cylinder(radius, half) => builder.add_cylinder(&here, *radius, *half, 0),
            Cone(radius, height) => builder.add_cone(&here, *radius, *height, 0),
            Ellipsoid(axes) => builder.add_ellipsoid(&here, axes, 0),
            Ball(radius) => builder.add_sphere(&origin, *radius, 0),
            Capsule(radius, half) => {
                builder.add_capsule(&(Vec3::z() * -half), &(Vec3::z() * *half), *radius, 0)
            }
            Cuboid(half) => builder.add_box(&here, half, 0),
            Sheet(corners) => builder.add_polygon(corners, 0),
            Points(points) => builder.add_polyhedron(points, 0),
            Supported(set) => builder.add_support(Arc::new((**set).clone()), 0),
        }
        .unwrap();
        super::models::built(&builder, &Default::default())
    }

    /// The largest product of a direction with a point of the set.
    pub fn reach(&self, d: &Vec3) -> f64 {
        let across = d.x.hypot(d.y);
        match self {
            Cylinder(radius, half) => radius * across + half * d.z.abs(),
            Cone(radius, height) => (0.5 * height * d.z).max(radius * across - 0.5 * height * d.z),
            Ellipsoid(axes) => axes.component_mul(d).norm(),
            Ball(radius) => radius * d.norm(),
            Capsule(radius, half) => radius * d.norm() + half * d.z.abs(),
            Cuboid(half) => half.dot(&d.abs()),
            Sheet(points) | Points(points) => {
                points.iter().map(|p| p.dot(d)).fold(f64::MIN, f64::max)
            }
            Supported(set) => set.reach(d),
        }
    }

    /// The point farthest along a direction.
    pub fn farthest(&self, d: &Vec3) -> Vec3 {
        let across = d.x.hypot(d.y);
        let rim = |radius: f64, z: f64| match across {
            0.0 => Vec3::new(0.0, 0.0, z),
            _ => Vec3::new(d.x * radius / across, d.y * radius / across, z),
        };
        match self {
            Cylinder(radius, half) if d.z == 0.0 => rim(*radius, 0.0 * half),
            Cylinder(radius, half) => rim(*radius, half.copysign(d.z)),
            Cone(radius, height) if d.z * height > radius * across => Vec3::z() * (0.5 * height),
            Cone(radius, height) => rim(*radius, -0.5 * height),
            Ellipsoid(axes) => {
                let scaled = axes.component_mul(d);
                axes.component_mul(&scaled) / scaled.norm()
            }
            Ball(radius) => d * (radius / d.norm()),
            Capsule(radius, half) => d * (radius / d.norm()) + Vec3::z() * half.copysign(d.z),
            Cuboid(half) => half.zip_map(d, f64::copysign),
            Sheet(points) | Points(points) => {
                let along = |p: &&Vec3, q: &&Vec3| p.dot(d).total_cmp(&q.dot(d));
                *points.iter().max_by(along).unwrap()
            }
            Supported(set) => set.farthest(d),
        }
    }

    /// How far a point is outside the set, about; at most 0 inside, and then the point is at least half so deep. Of hulls
    /// the distance outside; nothing is known to be inside of them, nor of sheets.
    pub fn excess(&self, p: &Vec3) -> f64 {
        let across = p.x.hypot(p.y);
        match self {
            Cylinder(radius, half) => (across - radius).max(p.z.abs() - half),
            Cone(radius, height) => {
                let slope = height.hypot(*radius);
                let beyond = (height * across + radius * (p.z - 0.5 * height)) / slope;
                beyond.max(-0.5 * height - p.z)
            }
            Ellipsoid(axes) => (p.component_div(axes).norm() - 1.0) * axes.min(),
            Ball(radius) => p.norm() - radius,
            Capsule(radius, half) => (p - Vec3::z() * p.z.clamp(-half, *half)).norm() - radius,
            Cuboid(half) => (p.abs() - half).max(),
            Sheet(points) | Points(points) => super::oracle::hull_distance(points, &[*p]).upper,
            Supported(set) => set.excess(p),
        }
    }

    pub fn size(&self) -> f64 {
        [Vec3::x(), Vec3::y(), Vec3::z()]
            .iter()
            .map(|axis| self.reach(axis).max(self.reach(&-axis)))
            .fold(0.0, f64::max)
    }

    /// A random boundary point: within a face, on a ruling, or the support point of any direction.
    pub fn facing(&self, random: &mut Random) -> Facing {
        let turned = |angle: f64, radius: f64, z: f64| {
            Vec3::new(radius * angle.cos(), radius * angle.sin(), z)
        };
        let angle = random.within(-3.15, 3.15);
        let share = random.within(0.0, 1.0);
        if random.below(3) == 0 {
            let normal = random.unit();
            return Facing {
                point: self.farthest(&normal),
                normal,
            };
        }
        let (point, normal) = match self {
            Cylinder(radius, half) if random.below(2) == 0 => {
                let z = (2.0 * share - 1.0) * half;
                (turned(angle, *radius, z), turned(angle, 1.0, 0.0))
            }
            Cylinder(radius, half) => {
                let side = [-1.0, 1.0][random.below(2)];
                (turned(angle, radius * share, side * half), Vec3::z() * side)
            }
            Cone(radius, height) if random.below(2) == 0 => {
                let normal = turned(angle, *height, *radius).normalize();
                let point = turned(angle, radius * (1.0 - share), height * (share - 0.5));
                (point, normal)
            }
            Cone(radius, height) => (turned(angle, radius * share, -0.5 * height), -Vec3::z()),
            Cuboid(half) => {
                let normal = [Vec3::x(), Vec3::y(), Vec3::z()][random.below(3)];
                let normal = if random.below(2) == 0 {
                    normal
                } else {
                    -normal
                };
                let within = random.point(1.0).component_mul(half);
                let point = within.zip_zip_map(&normal, half, |p, n, h| match n {
                    0.0 => p,
                    n => n * h,
                });
                (point, normal)
            }
            Sheet(points) => {
                let normal = if random.below(2) == 0 {
                    Vec3::z()
                } else {
                    -Vec3::z()
                };
                (mean(points, random), normal)
            }
            Points(points) => match face(points, random) {
                Some(found) => found,
                None => {
                    let normal = random.unit();
                    (self.farthest(&normal), normal)
                }
            },
            Supported(set) => return set.facing(random),
            Ellipsoid(_) | Ball(_) | Capsule(..) => {
                let normal = turned(angle, (1.0 - share * share).sqrt(), share);
                (self.farthest(&normal), normal)
            }
        };
        Facing { point, normal }
    }
}

/// A random convex combination.
fn mean(points: &[Vec3], random: &mut Random) -> Vec3 {
    let weights: Vec<f64> = points.iter().map(|_| random.within(0.0, 1.0)).collect();
    let sum: f64 = weights.iter().sum();
    points
        .iter()
        .zip(&weights)
        .map(|(p, w)| p * (w / sum))
        .sum()
}

/// A random point of a random face of a hull, and the face's normal.
fn face(points: &[Vec3], random: &mut Random) -> Option<(Vec3, Vec3)> {
    let n = points.len();
    for _ in 0..200 {
        let [i, j, k] = [(); 3].map(|()| random.below(n));
        let corners = [points[i], points[j], points[k]];
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let Some(normal) = normal.try_normalize(0.0) else {
            continue;
        };
        let height = |p: &Vec3| normal.dot(&(p - corners[0]));
        let others = (0..n).filter(|&m| ![i, j, k].contains(&m));
        if others.map(|m| height(&points[m])).all(|h| h <= 0.0) {
            return Some((mean(&corners, random), normal));
        }
    }
    None
}

/// Turns `from` to `to`, both of length 1, by the shortest way.
pub fn turn(from: &Vec3, to: &Vec3) -> Mat3 {
    let cross = from.cross(to);
    match cross.try_normalize(1e-300) {
        Some(axis) => rotation_about(&axis, cross.norm().atan2(from.dot(to))),
        None if from.dot(to) > 0.0 => Mat3::identity(),
        None => {
            let side = if from.x.abs() < 0.6 {
                Vec3::x()
            } else {
                Vec3::y()
            };
            rotation_about(&from.cross(&side).normalize(), std::f64::consts::PI)
        }
    }
}
