//! One tree over the bodies of an environment, so that a query asks only those that are near.

use super::SObject;
use crate::body::Body;
use crate::hierarchy::{Extent, ExtentTree};
use crate::pose::{Pose, Vec3};
use crate::tolerance;

/// The sphere around a body at a pose.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    pub center: Vec3,
    pub radius: f64,
    /// How far the body's primitives may be from what their features say (see `Body::deviation`).
    pub deviation: f64,
}

/// The objects of one state of an environment, by their places in it.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    tree: ExtentTree,
    balls: Vec<Ball>,
    /// The largest deviation, and the largest coordinate.
    deviation: f64,
    reach: f64,
}

impl Ball {
    pub fn of(body: &Body, pose: &Pose) -> Self {
        let root = body.tree().wrapper(0);
        Self {
            center: pose.transform_point(&(body.center() + root.center)),
            radius: root.radius,
            deviation: body.deviation(),
        }
    }

    fn reach(&self) -> f64 {
        self.center.amax() + self.radius
    }

    /// What a bound between two balls in the world must be lowered by, so that nothing it excludes could have mattered:
    /// its rounding, and the error of the distances on both sides of a comparison (see `Pairing::slack`).
    fn slack(reach: f64, deviation: f64) -> f64 {
        let rounding = tolerance::BOUND_ERROR + 2.0 * tolerance::DISTANCE_ERROR;
        4.0 * rounding * reach + 2.0 * deviation
    }

    /// A safe lower and a safe upper bound of the distance of the bodies in two balls.
    pub fn bounds(&self, other: &Ball) -> [f64; 2] {
        let apart = (self.center - other.center).norm();
        let radii = self.radius + other.radius;
        let reach = self.reach().max(other.reach());
        let slack = Self::slack(reach, self.deviation + other.deviation);
        [apart - radii - slack, apart + radii + slack]
    }
}

impl ObjectTree {
    pub fn new(objects: &[SObject]) -> Self {
        let balls: Vec<Ball> = objects
            .iter()
            .map(|object| Ball::of(&object.body, &object.pose))
            .collect();
        let extents = objects
            .iter()
            .zip(&balls)
            .map(|(object, ball)| extent(object, ball));
        Self {
            tree: ExtentTree::new(extents.collect()),
            deviation: balls.iter().map(|ball| ball.deviation).fold(0.0, f64::max),
            reach: balls.iter().map(Ball::reach).fold(0.0, f64::max),
            balls,
        }
    }

    pub fn ball(&self, place: usize) -> &Ball {
        &self.balls[place]
    }

    /// Visits the objects whose distance from a ball may be at most a limit, by their places. `visit` returns the limit
    /// from then on.
    pub fn visit_near(&self, ball: &Ball, limit: f64, mut visit: impl FnMut(usize) -> f64) {
        let reach = self.reach.max(ball.reach());
        let slack = Ball::slack(reach, self.deviation + ball.deviation);
        let farther = ball.radius + slack;
        let measure = |extent: &Extent| extent.distance(&ball.center) - farther;
        self.tree
            .visit_nearest_first(limit, measure, |place| visit(place as usize));
    }
}

/// The axis-aligned box around an object, which is in its ball and in the box that queries walk.
fn extent(object: &SObject, ball: &Ball) -> Extent {
    let packed = object.body.packed();
    let root = packed.bounding_box(packed.root());
    let scaled = |v: [f32; 3]| Vec3::from(v.map(f64::from)) * packed.scale();
    let center = object
        .pose
        .transform_point(&(object.body.center() + scaled(root.center)));
    let half = scaled(root.half);
    let mut reach = Vec3::zeros();
    for (i, axis) in root.axes.iter().enumerate() {
        let axis = object.pose.rotation * Vec3::from(axis.map(f64::from));
        reach += axis.abs() * half[i];
    }
    let reach = reach.inf(&Vec3::repeat(ball.radius + (center - ball.center).amax()));
    Extent {
        low: center - reach,
        high: center + reach,
    }
}
