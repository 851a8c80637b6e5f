//! The balls around two bodies: as long as they stay apart, nothing else of the bodies needs to be looked at. A ball does not turn, so
//! that only the way of its centre counts.

use super::kinematics::CenterMotion;
use super::span::Span;
use crate::body::Body;
use crate::pose::Vec3;
use crate::tolerance::SUM_SLACK;

/// The balls around two bodies, which count as meeting up to some distance.
pub(super) struct Balls<'a> {
    pub bodies: [&'a Body; 2],
    pub threshold: f64,
}

impl<'a> Balls<'a> {
    /// Of bodies that count as meeting up to a distance, and up to what they may be off by as they state.
    #[inline]
    pub fn of_bodies(bodies: [&'a Body; 2], threshold: f64) -> Self {
        let [a, b] = bodies;
        Self {
            bodies,
            threshold: threshold + a.stated_deviation() + b.stated_deviation(),
        }
    }

    /// Whether the balls stay apart through a piece, along the line between their centres. `apart` leads from B's centre to A's;
    /// `center_moves` bounds how far A's centre moves along it, given with its length.
    #[inline(always)]
    pub fn stay_apart(
        &self,
        apart: &Vec3,
        center_moves: impl Fn(&Vec3, f64) -> f64,
        kinematics_error: f64,
    ) -> bool {
        let [a, b] = self.bodies;
        let distance = apart.norm();
        let moved = center_moves(apart, distance);
        let radii = a.radius() + b.radius();
        let errors = kinematics_error + 1e-9 * (distance + radii) + a.deviation() + b.deviation();
        distance > radii + self.threshold + moved * SUM_SLACK + errors
    }

    /// The same over an interval, through which the second and third derivative of A's centre are at most `bounds`.
    #[inline(always)]
    pub fn stay_apart_over(
        &self,
        center: &CenterMotion,
        bounds: [f64; 2],
        span: Span,
        kinematics_error: f64,
    ) -> bool {
        let reach = span.reach();
        let center_moves = |apart: &Vec3, distance: f64| {
            let [p2, p3] = bounds;
            let acceleration = p2.min(center.acceleration.norm() + reach * p3 / 3.0);
            let parts = center.velocity.dot(apart) / distance.max(f64::MIN_POSITIVE);
            let bend = 0.5 * reach * reach * acceleration;
            match span {
                Span::Around(_) => reach * parts.abs() + bend,
                Span::Before(_) => (reach * parts + bend).max(0.0),
            }
        };
        self.stay_apart(&center.apart, center_moves, kinematics_error)
    }
}
