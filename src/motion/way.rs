//! A motion through C-space as a function of time, from 0 to 1: straight, or on a Bezier curve.

use super::segment::LinearMotion;
use crate::error::Result;
use crate::pose::Pose;
use crate::query::Scene;
use crate::robot::{LinkMotions, bezier};

/// A motion in one state of the world.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    /// The motion itself; of a curve, one from the same start whose velocities no coordinate exceeds, with signs that lead away
    /// from zero: bounds of its motion hold for the curve too.
    pub line: LinearMotion<'a>,
    /// The control points of a curve, one configuration after another.
    pub controls: Option<&'a [f64]>,
}

impl<'a> Way<'a> {
    pub fn straight(line: LinearMotion<'a>) -> Self {
        Self {
            line,
            controls: None,
        }
    }

    /// The configuration at a time.
    pub fn at(&self, t: f64) -> Vec<f64> {
        let Some(controls) = self.controls else {
            return self.line.at(t);
        };
        let nq = self.line.q.len();
        let coordinate = |c: usize| bezier(controls.iter().skip(c).step_by(nq).copied(), t);
        (0..nq).map(coordinate).collect()
    }

    /// The world at a configuration.
    pub fn scene<'s>(&'s self, q: &'s [f64]) -> Result<Scene<'s>> {
        self.line.scene(q)
    }

    /// The poses of all links at a time.
    pub fn link_poses(&self, t: f64) -> Result<Vec<Pose>> {
        self.line.cobject.space().link_poses(&self.at(t))
    }

    /// The motions of all links.
    pub fn link_motions(&self) -> LinkMotions {
        let space = self.line.cobject.space();
        match self.controls {
            Some(controls) => space.link_motions_on_curve(controls),
            None => space.link_motions(self.line.q, self.line.v),
        }
    }
}
