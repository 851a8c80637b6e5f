//! A turn at a constant rate in which the origin moves too: what a screw is across its axis.

use super::course::CourseBounds;
use crate::pose::Vec3;

/// A turn at a constant rate in which the origin moves too.
#[derive(Clone, Copy, Debug)]
pub struct CircularArc {
    pub axis: Vec3,
    /// In radians per unit of time, above 0.
    pub rate: f64,
    /// The velocity with which the origin starts, across the axis. The point that stays is this over the rate away: for slow turns so
    /// far that poses computed from there would lose all digits.
    pub across: Vec3,
}

impl CircularArc {
    /// Of the way from the origin's place at time 0: at most the arc's length, and at most the circle's diameter.
    pub fn way_bounds(&self) -> CourseBounds {
        let (rate, speed) = (self.rate, self.across.norm());
        CourseBounds {
            farthest: speed * (2.0 / rate).min(1.0),
            summed: speed,
            derivatives: [speed, speed * rate, speed * rate * rate],
            degree: 0,
        }
    }

    pub fn angle_bounds(&self) -> CourseBounds {
        CourseBounds {
            farthest: self.rate,
            summed: self.rate,
            derivatives: [self.rate, 0.0, 0.0],
            degree: 0,
        }
    }
}
