//! The distance of a point from a flat polygon.

use super::closest::{Closest, Segment};
use super::placed::Placed;
use crate::pose::Vec3;
use crate::primitive::Feature;

/// The closest points of a lone point and a polygon, which is flat.
pub fn point_to_polygon(point: &Vec3, polygon: &Placed) -> Closest {
    let vertex = Feature::vertex(0);
    let (height, is_inside) = polygon.strictly_over_face(0, point);
    if is_inside {
        let foot = point - polygon.normal(0) * height;
        return Closest {
            distance: height.abs(),
            ..Closest::between([*point, foot], [vertex, Feature::face(0)])
        };
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
    best
}
