//! Triangulates bodies, arrows and balls.

use super::curved::curved_surface;
use super::triangles::Triangles;
use crate::body::Body;
use crate::hierarchy::wrapper::Surface;
use crate::pose::Vec3;
use crate::primitive::{Convex, plane_axes};

/// The faces of a body's primitives, in the body's centred frame; points and segments are shown as small balls and thin
/// rods.
pub fn of_body(body: &Body) -> Triangles {
    let mut triangles = Triangles::default();
    for primitive in body.primitives().iter() {
        let primitive = primitive.moved(&Vec3::zeros());
        add_primitive(&mut triangles, &primitive, 0.004 * body.radius());
    }
    triangles
}

/// The faces of a primitive; a segment becomes a rod, a point a ball.
pub fn add_primitive(triangles: &mut Triangles, primitive: &Convex, thickness: f64) {
    if primitive.curve.is_some() {
        add_surface(triangles, &curved_surface(primitive));
        return;
    }
    for face in &primitive.faces {
        let corner = |i: usize| primitive.vertices[face.vertices[i] as usize];
        for i in 1..face.vertices.len() - 1 {
            triangles.push([corner(0), corner(i), corner(i + 1)], face.normal);
        }
    }
    if primitive.faces.is_empty() {
        let [i, j] = primitive.edges[0];
        let (a, b) = (
            primitive.vertices[i as usize],
            primitive.vertices[j as usize],
        );
        add_ball(triangles, &a, 2.0 * thickness);
        add_rod(triangles, &a, &b, thickness, thickness);
    }
}

/// The faces of a surface, each flat.
pub fn add_surface(triangles: &mut Triangles, surface: &Surface) {
    for face in &surface.faces {
        let corner = |k: usize| surface.vertices[face[k] as usize];
        let fan = (1..face.len() - 1).map(|k| [corner(0), corner(k), corner(k + 1)]);
        let sum: Vec3 = fan.clone().map(|[a, b, c]| (b - a).cross(&(c - a))).sum();
        let Some(normal) = sum.try_normalize(0.0) else {
            continue;
        };
        for corners in fan {
            triangles.push(corners, normal);
        }
    }
}

/// A rod from a to b, of these radii at its ends.
pub fn add_rod(triangles: &mut Triangles, a: &Vec3, b: &Vec3, radius_a: f64, radius_b: f64) {
    const SIDES: usize = 12;
    let Some(along) = (b - a).try_normalize(0.0) else {
        return;
    };
    let (x, y) = plane_axes(&along);
    let around = |i: usize| {
        let angle = std::f64::consts::TAU * (i % SIDES) as f64 / SIDES as f64;
        x * angle.cos() + y * angle.sin()
    };
    for i in 0..SIDES {
        let (u, v) = (around(i), around(i + 1));
        let out = (u + v).normalize();
        triangles.push([a + u * radius_a, a + v * radius_a, b + v * radius_b], out);
        triangles.push([a + u * radius_a, b + v * radius_b, b + u * radius_b], out);
        triangles.push([*a, a + v * radius_a, a + u * radius_a], -along);
        triangles.push([*b, b + u * radius_b, b + v * radius_b], along);
    }
}

/// An arrow that starts at `from`.
pub fn add_arrow(triangles: &mut Triangles, from: &Vec3, vector: &Vec3, radius: f64) {
    let neck = from + vector * 0.7;
    add_rod(triangles, from, &neck, radius, radius);
    add_rod(triangles, &neck, &(from + vector), 2.5 * radius, 0.0);
}

/// A ball of eight by sixteen facets.
pub fn add_ball(triangles: &mut Triangles, center: &Vec3, radius: f64) {
    use std::f64::consts::{PI, TAU};
    let at = |i: usize, j: usize| {
        let (polar, azimuth) = (PI * i as f64 / 8.0, TAU * j as f64 / 16.0);
        Vec3::new(
            polar.sin() * azimuth.cos(),
            polar.sin() * azimuth.sin(),
            polar.cos(),
        )
    };
    for i in 0..8 {
        for j in 0..16 {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let out = quad.iter().sum::<Vec3>().normalize();
            let [a, b, c, d] = quad.map(|p| center + p * radius);
            triangles.push([a, b, c], out);
            triangles.push([a, c, d], out);
        }
    }
}
