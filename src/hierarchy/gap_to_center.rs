//! How near a body comes to a point of its frame: with it a body at a pose bounds the distance from others by that of two points.

use super::wrapper::outwards;
use crate::pose::Vec3;
use crate::primitive::{Convex, Primitive, Primitives, SmoothKind};

/// An upper bound of the distance of the body from `center`, rounded outwards. Below 0 where a primitive holds a ball around the centre:
/// minus the radius of such a ball.
pub fn gap_to_center(primitives: &Primitives, center: &Vec3) -> f64 {
    let of_each = primitives.iter().map(|primitive| {
        let from_core = distance_from_core(primitive, center);
        from_core - primitive.shape.radius()
    });
    let gap = of_each.fold(f64::INFINITY, f64::min);
    let size = gap.abs();
    gap + (outwards(size, center) - size)
}

/// The same for what a radius is around.
fn distance_from_core(primitive: Primitive, center: &Vec3) -> f64 {
    let vertices = primitive.vertices;
    let first = vertices[0];
    if let Some(smooth) = primitive.shape.smooth() {
        return (center - first).norm() - inner_radius(&smooth.kind);
    }
    match *vertices {
        [point] => (center - point).norm(),
        [start, end] => {
            let along = end - start;
            let length = along.norm_squared();
            let part = match length > 0.0 {
                true => (along.dot(&(center - start)) / length).clamp(0.0, 1.0),
                false => 0.0,
            };
            (center - (start + along * part)).norm()
        }
        _ => {
            let middle = vertices.iter().sum::<Vec3>() / vertices.len() as f64;
            let nearest = vertices.iter().map(|v| (center - v).norm_squared());
            let nearest = nearest.fold(f64::INFINITY, f64::min).sqrt();
            let from_inside = (center - middle).norm() - depth(primitive.shape, &middle);
            nearest.min(from_inside)
        }
    }
}

/// The radius of a ball around the origin of a smooth set that the set holds.
fn inner_radius(kind: &SmoothKind) -> f64 {
    match kind {
        SmoothKind::Cylinder {
            radius,
            half_length,
        } => radius.min(*half_length),
        SmoothKind::Cone { radius, height } => {
            // Nearest is the side; the base is half the height away.
            0.5 * height * radius / radius.hypot(*height)
        }
        SmoothKind::Ellipsoid { semi_axes } => semi_axes.min(),
        SmoothKind::Function(_) => 0.0,
    }
}

/// How deep a point is in a solid, at most; 0 where it is none.
fn depth(shape: &Convex, point: &Vec3) -> f64 {
    if !shape.is_solid() {
        return 0.0;
    }
    let of_faces = shape.faces.iter().map(|face| {
        let corner = shape.vertices[face.vertices[0] as usize];
        face.normal.dot(&(corner - point))
    });
    of_faces.fold(f64::INFINITY, f64::min).max(0.0)
}
