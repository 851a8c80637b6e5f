//! How far rounding may move what links carry, from one time of a motion to another.

use super::linear_motion::LinearMotion;
use crate::pose::Pose;
use crate::robot::LinkSpeeds;

/// The links on a motion.
pub(super) struct LinkRounding<'a> {
    pub motion: &'a LinearMotion<'a>,
    pub speeds: &'a LinkSpeeds<'a>,
    /// Of all links, at the one time.
    pub poses: &'a [Pose],
    /// Bounds of how far roundings put coordinates off the way (`Way::rounding`).
    pub of_coordinates: &'a [f64],
    /// No other time is farther away than this part of the motion.
    pub share: f64,
}

impl LinkRounding<'_> {
    /// Of what a link carries within a radius of its origin: where it is placed at both times.
    pub fn within(&self, link: usize, radius: f64) -> f64 {
        let LinearMotion { cobject, q, .. } = *self.motion;
        let of_coordinates =
            cobject
                .space()
                .motion_bound_of_radius(link, radius, q, self.of_coordinates);
        let of_places = self.speeds.rounding(link, self.poses);
        of_places.of_places(radius, self.share) + of_coordinates
    }
}
