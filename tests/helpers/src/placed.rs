//! Shapes at poses, and what is asked of two of them.

use cstk::body::Body;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, QueryContext};

use super::random::Random;
use super::shapes::{Shape, dented_ball, hull, pair_size};

/// A body at a pose.
#[derive(Clone)]
pub struct PlacedPrimitive {
    pub shape: Shape,
    pub pose: Pose,
}

impl PlacedPrimitive {
    pub fn new(shape: Shape, pose: Pose) -> Self {
        Self { shape, pose }
    }

    pub fn side(&self) -> (&Body, &Pose) {
        (&self.shape.body, &self.pose)
    }

    pub fn moved(&self, common: &Pose) -> Self {
        Self::new(self.shape.clone(), common.compose(&self.pose))
    }
}

pub fn size_of(a: &PlacedPrimitive, b: &PlacedPrimitive) -> f64 {
    pair_size(&a.shape, &a.pose, &b.shape, &b.pose)
}

pub fn cold(a: &PlacedPrimitive, b: &PlacedPrimitive) -> Distance {
    QueryContext::new()
        .pair_distance(a.side(), b.side(), f64::INFINITY)
        .unwrap()
}

pub fn hull_at(points: &[Vec3], pose: Pose) -> PlacedPrimitive {
    PlacedPrimitive::new(hull(points), pose)
}

pub fn shifted(points: &[Vec3], by: Vec3) -> Vec<Vec3> {
    points.iter().map(|p| p + by).collect()
}

pub fn dented(random: &mut Random) -> Shape {
    dented_ball(|| random.within(0.6, 1.0))
}
