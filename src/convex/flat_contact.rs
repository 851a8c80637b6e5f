//! Whether a contact of a cylinder or a cone is more than a point: its cap or a ruling on a face, an edge or another of its kind. Of
//! polytopes the contacts that are listed say so.

use super::core::Core;
use super::placed::PlacedPrimitive;
use crate::pose::Vec3;
use crate::primitive::SmoothKind;

/// Directions that lie closer than this, in radians, are parallel.
const PARALLEL: f64 = 1e-9;

/// Points of a polytope that differ by less than this along a direction, times its size, are equally far along it.
const EQUALLY_FAR: f64 = 1e-9;

/// What is farthest along a direction.
#[derive(Clone, Copy, Debug)]
enum Farthest {
    Point,
    /// A segment along a unit vector.
    Line(Vec3),
    Plane,
}

/// Whether more than one point of A is nearest to B along the unit normal from B to A, where one of the two is smooth.
pub fn is_flat_contact(a: &PlacedPrimitive, b: &PlacedPrimitive, normal: &Vec3) -> bool {
    let [a, b] = [a, b].map(Core::of);
    if a.smooth().is_none() && b.smooth().is_none() {
        return false;
    }
    match (farthest(&a, &-normal), farthest(&b, normal)) {
        (Farthest::Point, _) | (_, Farthest::Point) => false,
        // Lines that cross have a point in common.
        (Farthest::Line(a), Farthest::Line(b)) => a.cross(&b).norm() <= PARALLEL,
        _ => true,
    }
}

fn farthest(core: &Core, direction: &Vec3) -> Farthest {
    let Some(smooth) = core.smooth() else {
        return farthest_of_vertices(core, direction);
    };
    let axis = Vec3::from(smooth.axes.column(2));
    let along = axis.dot(direction);
    let across = direction - axis * along;
    match *smooth.kind {
        SmoothKind::Cylinder { .. } if across.norm() <= PARALLEL => Farthest::Plane,
        SmoothKind::Cylinder { .. } if along.abs() <= PARALLEL => Farthest::Line(axis),
        SmoothKind::Cone { .. } if across.norm() <= PARALLEL && along < 0.0 => Farthest::Plane,
        SmoothKind::Cone { radius, height } => {
            // Along the normal of a ruling, from the rim to the apex, both are as far.
            let slant = radius.hypot(height);
            if (along * height - across.norm() * radius).abs() > PARALLEL * slant {
                return Farthest::Point;
            }
            let outwards = across.try_normalize(0.0).unwrap_or_default();
            Farthest::Line((axis * height - outwards * radius) / slant)
        }
        SmoothKind::Cylinder { .. } | SmoothKind::Ellipsoid { .. } | SmoothKind::Function(_) => {
            Farthest::Point
        }
    }
}

fn farthest_of_vertices(core: &Core, direction: &Vec3) -> Farthest {
    let vertices = || (0..core.placed().vertex_count()).map(|index| core.vertex(index as u32));
    let along = |v: &Vec3| v.dot(direction);
    let Some(first) = vertices().max_by(|a, b| along(a).total_cmp(&along(b))) else {
        return Farthest::Point;
    };
    let size = vertices().fold(0.0, |size: f64, v| size.max((v - first).norm()));
    let slack = EQUALLY_FAR * size;
    let from_first = || vertices().map(|v| v - first).filter(|v| -along(v) <= slack);
    let longest = from_first().max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let Some(line) = longest.and_then(|v| v.try_normalize(slack)) else {
        return Farthest::Point;
    };
    if from_first().all(|v| v.cross(&line).norm() <= slack) {
        Farthest::Line(line)
    } else {
        Farthest::Plane
    }
}
