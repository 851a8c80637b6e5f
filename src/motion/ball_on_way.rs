//! The ball around a body that a link carries, on a whole motion: where it is at the middle, and what bounds its way from there.

use super::balls::Balls;
use super::carried::Carried;
use super::kinematics::{CenterMotion, Kinematics};
use super::span::Span;
use crate::body::Body;
use crate::robot::MotionRates;

/// From the middle to both ends.
const WHOLE: Span = Span::Around(0.5);

/// The ball around a body on a whole motion.
pub(super) struct BallOnWay<'a> {
    body: &'a Body,
    /// Of its centre, at the middle.
    center: CenterMotion,
    /// Of the centre's second and third derivatives.
    bounds: [f64; 2],
    /// What rounding may move the body.
    rounding: f64,
    /// How far the body goes from where it is at the middle, but for rounding.
    moved: f64,
}

impl<'a> BallOnWay<'a> {
    /// Given the kinematics at the middle, and bounds of the derivatives of the body's centre.
    pub fn new(body: &Carried<'a, usize>, middle: &mut Kinematics, rates: &MotionRates) -> Self {
        let [_, p2, p3] = rates.origin;
        Self {
            body: body.body,
            center: middle.center_in_world(body),
            bounds: [p2, p3],
            rounding: rates.rounding.of_places(body.body.radius(), WHOLE.reach()),
            moved: middle.shift(body, rates, WHOLE),
        }
    }

    /// Bounds how far the body goes in the world from where it is at the middle, but for rounding.
    pub fn moved(&self) -> f64 {
        self.moved
    }

    /// Whether two balls stay farther apart than a distance all the while.
    #[inline]
    pub fn stays_apart_from(&self, other: &Self, threshold: f64) -> bool {
        let balls = Balls::of_bodies([self.body, other.body], threshold);
        let bounds = [0, 1].map(|k| self.bounds[k] + other.bounds[k]);
        let rounding = self.rounding + other.rounding;
        balls.stay_apart_over(
            &self.center.seen_from(&other.center),
            bounds,
            WHOLE,
            rounding,
        )
    }
}
