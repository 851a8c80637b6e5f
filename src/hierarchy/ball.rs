//! Bounding balls of bodies, for a first lower bound of their distance.

use crate::boxes::Extent;
use crate::hierarchy::wrapper::outwards;
use crate::pose::{Pose, Vec3};
use crate::primitive::Primitives;

/// A bounding ball of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// In the body's own frame.
    pub center: Vec3,
    /// Rounded outwards.
    pub radius: f64,
}

impl Ball {
    /// The ball around at least one primitive.
    pub fn around(primitives: &Primitives) -> Self {
        if primitives.are_points() {
            return Self::around_points(primitives);
        }
        let all = primitives.iter();
        let extents = all.map(|p| Extent::of_points(p.bounding_points()));
        let whole = extents.reduce(|all, extent| all.union(&extent));
        let center = whole.unwrap_or_default().center();
        let points = primitives.iter().flat_map(|p| p.bounding_points());
        let squares = points.map(|p| (p - center).norm_squared());
        Self::enclosing(center, squares.fold(0.0, f64::max).sqrt())
    }

    /// The ball around points, maybe with radii. It is tighter than the ball around their bounding points.
    fn around_points(primitives: &Primitives) -> Self {
        let points = primitives.points();
        let center = Extent::of(points).center();
        let squares = points.iter().map(|p| (p - center).norm_squared());
        let farthest = squares.fold(0.0, f64::max).sqrt();
        Self::enclosing(center, farthest + primitives.largest_point_radius())
    }

    /// The ball around points that are `vertices` moved by `-origin`, given the lowest and highest coordinates of the vertices,
    /// and before it the radius of the ball around the origin. Both are bit for bit those of primitives whose bounding points
    /// these are, without a visit to each primitive.
    pub fn around_vertices(vertices: &[Vec3], origin: &Vec3, extent: &Extent) -> (f64, Self) {
        // Rounding keeps the order of numbers, so this is the box of the rounded differences.
        let moved = Extent {
            low: extent.low - origin,
            high: extent.high - origin,
        };
        let center = moved.center();
        let mut squares = [0.0f64; 2];
        for vertex in vertices {
            let point = vertex - origin;
            squares[0] = squares[0].max(point.norm_squared());
            squares[1] = squares[1].max((point - center).norm_squared());
        }
        let [radius, distance] = squares.map(f64::sqrt);
        (radius, Self::enclosing(center, distance))
    }

    fn enclosing(center: Vec3, distance: f64) -> Self {
        Self {
            center,
            radius: outwards(distance, &center),
        }
    }

    /// A lower bound of the distance between the bodies in two balls; negative if the balls overlap. `pose` places `other`
    /// in this ball's frame.
    pub fn apart(&self, other: &Self, pose: &Pose) -> f64 {
        let apart = (pose.transform_point(&other.center) - self.center).norm();
        apart - self.radius - other.radius
    }
}
