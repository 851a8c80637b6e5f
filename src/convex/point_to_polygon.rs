//! The distance of a point from a flat polygon.

use super::closest::Closest;
use super::placed::PlacedPrimitive;
use super::segment::Segment;
use crate::pose::Vec3;
use crate::primitive::Feature;

/// The closest points of a single point and a flat polygon.
pub fn point_to_polygon(point: &Vec3, polygon: &PlacedPrimitive) -> Closest {
    let vertex = Feature::vertex(0);
    let (height, is_over) = polygon.over_face(0, point);
    let on_face = || Closest {
        distance: height.abs(),
        ..Closest::between(
            [*point, point - polygon.normal(0) * height],
            [vertex, Feature::face(0)],
        )
    };
    if is_over && polygon.strictly_over_face(0, point).1 {
        return on_face();
    }
    let mut best = Closest {
        distance: f64::INFINITY,
        ..Closest::meeting_at(*point, [vertex; 2])
    };
    for (i, &ends) in (0..).zip(&polygon.shape.edges) {
        let edge = Segment::new(polygon.edge_ends(ends));
        let t = edge.nearest_parameter(point);
        let foot = edge.at(t);
        let distance = (point - foot).norm();
        if distance < best.distance {
            let feature = match t {
                0.0 => Feature::vertex(ends[0]),
                1.0 => Feature::vertex(ends[1]),
                _ => Feature::edge(i),
            };
            best = Closest {
                distance,
                ..Closest::between([*point, foot], [vertex, feature])
            };
        }
    }
    // The foot is on an edge, or beside one that is degenerate by rounding.
    if is_over && height.abs() < best.distance {
        best = on_face();
    }
    best
}
