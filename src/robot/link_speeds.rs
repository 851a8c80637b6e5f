//! Bounds of how fast links move in the world, and what rounding does to their places: all of them in one pass, by the lengths along
//! their chains alone. [`RatesFrom`](super::RatesFrom) says more, and takes longer.

use super::course::CourseBounds;
use super::link_motions::{Element, LinkMotions};
use super::motion_rates::ChainRounding;
use crate::pose::Vec3;

/// Bounds of how fast a link moves in the world on a motion.
#[derive(Clone, Copy, Debug, Default)]
pub struct LinkSpeed {
    /// Of its turn, in radians per unit of time.
    pub turn: f64,
    /// Of its origin.
    pub origin: f64,
    /// What the rounding of its places comes from, but for custom joints that move.
    pub rounding: ChainRounding,
    /// Whether a custom joint moves it, of which these say nothing.
    pub is_unknown: bool,
}

impl LinkSpeed {
    /// The speed of no point within `radius` of the link's origin is larger.
    pub fn at_radius(&self, radius: f64) -> f64 {
        self.origin + self.turn * radius
    }

    /// Goes on through one element: what comes before turns all of an arm, whichever way that points.
    fn push(&mut self, element: &Element, controls: &[f64]) {
        match element {
            Element::Fixed(pose) => {
                let length = pose.translation.norm();
                self.rounding.take_in_arm(length);
                self.origin += self.turn * length;
            }
            Element::Turn { angle, .. } => self.turn_by(&angle.bounds(controls)),
            Element::Shift { axis, length } => self.shift_along(axis, &length.bounds(controls)),
            Element::CircularArc(arc) => {
                self.shift_along(&arc.axis, &arc.way_bounds());
                self.turn_by(&arc.angle_bounds());
            }
        }
    }

    fn turn_by(&mut self, angle: &CourseBounds) {
        self.rounding.take_in_turn(angle);
        self.turn += angle.derivatives[0];
    }

    fn shift_along(&mut self, axis: &Vec3, length: &CourseBounds) {
        let unit = axis.norm();
        self.rounding.take_in_shift(unit, length);
        self.origin += unit * (self.turn * length.farthest + length.derivatives[0]);
    }
}

impl LinkMotions {
    /// The speeds of all links.
    pub fn speeds(&self, speeds: &mut Vec<LinkSpeed>) {
        speeds.clear();
        for link in 0..self.len() {
            let mut speed = self
                .parent(link)
                .map_or_else(LinkSpeed::default, |parent| speeds[parent]);
            speed.is_unknown |= !self.is_joint_known(link);
            for element in self.elements_of(link) {
                speed.push(element, self.controls());
            }
            speeds.push(speed);
        }
    }
}
