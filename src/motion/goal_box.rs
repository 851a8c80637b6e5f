//! Where a slide is to lead: a configuration, or a box of them.

use crate::error::{Error, ErrorKind, Result};
use crate::robot::{BlockKind, Coordinate};
use crate::space::{Space, shorter_way};

/// A box of configurations to reach. On a circle it is the arc from its low end upwards to its high one.
#[derive(Clone, Copy)]
pub(super) struct GoalBox<'a> {
    space: &'a Space,
    low: &'a [f64],
    high: &'a [f64],
}

impl<'a> GoalBox<'a> {
    /// Refuses what is no box. A coordinate from minus to plus infinity may have any value; a quaternion is given, or wholly so.
    pub fn checked(space: &'a Space, low: &'a [f64], high: &'a [f64]) -> Result<Self> {
        let goal = Self { space, low, high };
        for (ends, name) in [(low, "goal_low"), (high, "goal_high")] {
            let mut finite = ends.to_vec();
            for (c, (end, neutral)) in finite.iter_mut().zip(space.neutral()).enumerate() {
                if goal.is_any(c) {
                    *end = neutral;
                }
            }
            let checked = space.check_configuration(&finite);
            checked.map_err(|error| error.within(name))?;
        }
        for (c, coordinate) in space.coordinates().iter().enumerate() {
            if *coordinate != Coordinate::Quaternion && low[c] > high[c] {
                return Err(Error::invalid(format!(
                    "coordinate {c} has goal_low {} above goal_high {}",
                    low[c], high[c]
                )));
            }
        }
        for block in space.blocks() {
            let c = block.coordinate + block.kind.nq() - 4.min(block.kind.nq());
            let is_rotation = block.kind != BlockKind::Line;
            let any = (c..c + 4).filter(|&c| goal.is_any(c)).count();
            if is_rotation && any != 4 && (any > 0 || low[c..c + 4] != high[c..c + 4]) {
                return Err(Error::new(
                    ErrorKind::Unsupported,
                    format!(
                        "coordinates {c} to {} are a quaternion, which must be the same in goal_low and goal_high, or infinite in both",
                        c + 3
                    ),
                ));
            }
        }
        Ok(goal)
    }

    /// Whether a coordinate may have any value.
    fn is_any(&self, c: usize) -> bool {
        let ends = [self.low, self.high].map(|ends| ends.get(c).copied());
        ends == [Some(f64::NEG_INFINITY), Some(f64::INFINITY)]
    }

    /// The configuration of the box nearest to q, coordinate by coordinate. What is within stays as it is, to the last bit.
    pub fn nearest(&self, q: &[f64]) -> Vec<f64> {
        let mut nearest = q.to_vec();
        for (c, coordinate) in self.space.coordinates().iter().enumerate() {
            if self.is_any(c) {
                continue;
            }
            let [low, high] = [self.low[c], self.high[c]];
            nearest[c] = match coordinate {
                Coordinate::Circle => nearest_on_arc(q[c], low, high),
                _ => q[c].clamp(low, high),
            };
        }
        nearest
    }
}

/// The angle of the arc from `low` upwards to `high` that is nearest to an angle.
fn nearest_on_arc(angle: f64, low: f64, high: f64) -> f64 {
    let half = 0.5 * (high - low);
    let from_middle = shorter_way(angle - (low + half));
    if from_middle.abs() <= half {
        angle
    } else if from_middle < 0.0 {
        low
    } else {
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Against a search through the arc.
    #[test]
    fn the_nearest_angle_of_an_arc_is_that_of_a_search() {
        let apart = |a: f64, b: f64| shorter_way(b - a).abs();
        for (low, high) in [(-0.5, 0.7), (3.0, 3.5), (-4.0, 1.0), (6.0, 7.0), (0.2, 0.2)] {
            for k in 0..200 {
                let angle = -7.0 + 0.0701 * f64::from(k);
                let found = nearest_on_arc(angle, low, high);
                let at = |i: i32| low + (high - low) * f64::from(i) / 1000.0;
                let best = (0..=1000)
                    .map(|i| apart(angle, at(i)))
                    .fold(f64::INFINITY, f64::min);
                assert!(apart(angle, found) <= best + 1e-12, "{angle} {low} {high}");
                // It is on the arc.
                let above = (found - low).rem_euclid(TAU);
                assert!(above <= high - low + 1e-12 || above > TAU - 1e-7);
            }
        }
    }
}
