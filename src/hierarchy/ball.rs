//! Balls around bodies.

use crate::boxes::Extent;
use crate::hierarchy::wrapper::outwards;
use crate::pose::{Pose, Vec3};
use crate::primitive::Primitives;

/// A ball around a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    pub center: Vec3,
    pub radius: f64,
}

impl Ball {
    /// That around primitives, of which there is at least one.
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
        Self::reaching(center, squares.fold(0.0, f64::max).sqrt())
    }

    /// The corners of what bounds a round point are left out: its radius is enough.
    fn around_points(primitives: &Primitives) -> Self {
        let points = primitives.points();
        let center = Extent::of(points).center();
        let squares = points.iter().map(|p| (p - center).norm_squared());
        let farthest = squares.fold(0.0, f64::max).sqrt();
        Self::reaching(center, farthest + primitives.largest_point_radius())
    }

    fn reaching(center: Vec3, distance: f64) -> Self {
        Self {
            center,
            radius: outwards(distance, &center),
        }
    }

    /// A lower bound of the distance of the bodies in two balls. `pose` places `other`.
    pub fn apart(&self, other: &Self, pose: &Pose) -> f64 {
        let apart = (pose.transform_point(&other.center) - self.center).norm();
        apart - self.radius - other.radius
    }
}
