//! What a robot does in a proof: a motion through C-space as a function of time, from 0 to 1, or any of the straight motions from the
//! middle of a box of configurations to another of the box.

use super::linear_motion::LinearMotion;
use super::set_tree::SetTree;
use super::span::Span;
use super::stated_motion::StatedMotion;
use crate::cobject::{Around, CObject, ClearCells};
use crate::error::Result;
use crate::pose::Pose;
use crate::query::{Scene, World};
use crate::robot::{LinkMotions, bezier};
use crate::space::Space;
use crate::tolerance::EPSILON;

/// Added to times: more than a configuration is rounded where its motion starts, or goes, far from it.
const TIME_SLACK: f64 = 64.0 * EPSILON;

/// The rounding of a coordinate on its way, relative to where it starts and how far it goes: of the difference of both ends, of its part, and
/// of their sum. On a curve of degree n, whose control points are no farther off than its speed goes, it is n times as much.
const COORDINATE_ERROR: f64 = 8.0 * EPSILON;

/// A motion, or the motions in a box, in one state of the world.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    /// The motion itself; of a curve or a function, one from the same start whose velocities no coordinate exceeds, with signs that lead away
    /// from zero; of a box, from its middle with its half widths for velocities. Bounds of this motion that hold whatever the signs
    /// of its velocities hold for all.
    pub line: LinearMotion<'a>,
    pub kind: WayKind<'a>,
    /// Where a straight motion is asked to end: q and v sum up to it but for their rounding.
    pub end: Option<&'a [f64]>,
}

#[derive(Clone, Copy)]
pub(super) enum WayKind<'a> {
    Line,
    Curve {
        /// The control points, one configuration after another.
        controls: &'a [f64],
    },
    /// As a function gives it.
    Stated(&'a StatedMotion<'a>),
    Box {
        /// The lowest coordinates.
        low: &'a [f64],
        /// The highest.
        high: &'a [f64],
    },
}

impl<'a> Way<'a> {
    pub fn straight(line: LinearMotion<'a>) -> Self {
        Self {
            line,
            kind: WayKind::Line,
            end: None,
        }
    }

    /// Asks about the straight motion between two configurations, which are checked.
    pub fn between<T>(
        world: &World,
        cobject: &CObject,
        [q0, q1]: [&[f64]; 2],
        ask: impl FnOnce(&Way) -> Result<T>,
    ) -> Result<T> {
        let v = &checked_difference(cobject.space(), q0, q1)?;
        let line = LinearMotion {
            world,
            cobject,
            q: q0,
            v,
        };
        ask(&Way {
            end: Some(q1),
            ..Way::straight(line)
        })
    }

    /// The configuration at a time; of a box the one in its middle.
    pub fn at(&self, t: f64) -> Result<Vec<f64>> {
        Ok(match self.kind {
            WayKind::Line => match self.end {
                Some(end) if t == 1.0 => {
                    self.line.cobject.space().interpolate(self.line.q, end, 1.0)
                }
                _ => self.line.at(t),
            },
            WayKind::Stated(motion) => motion.at(t)?.q,
            WayKind::Curve { controls } => {
                let nq = self.line.q.len();
                let coordinate = |c: usize| bezier(controls.iter().skip(c).step_by(nq).copied(), t);
                (0..nq).map(coordinate).collect()
            }
            WayKind::Box { .. } => self.line.q.to_vec(),
        })
    }

    /// Whether the caller's word alone keeps the whole way out of a set.
    pub fn is_free_by_word(&self, tree: &SetTree) -> Result<bool> {
        if !self.line.cobject.has_known() {
            return Ok(false);
        }
        let whole = match self.kind {
            WayKind::Line | WayKind::Curve { .. } | WayKind::Stated(_) => {
                Some((0.5, Span::Around(0.5)))
            }
            WayKind::Box { .. } => None,
        };
        let space = self.line.cobject.space();
        self.with_around(whole, |around| tree.is_free_by_word(space, around))
    }

    /// Whether the whole way is in cells that are proved. They are looked up for straight motions only.
    pub fn stays_in(&self, cells: &ClearCells) -> bool {
        match self.kind {
            WayKind::Line => cells.contain_motion(self.line.q, self.line.v),
            WayKind::Curve { .. } | WayKind::Stated(_) | WayKind::Box { .. } => false,
        }
    }

    /// The configurations of an interval, given as a time and how far it goes from there; of a box, all of it.
    pub fn with_around<T>(
        &self,
        interval: Option<(f64, Span)>,
        ask: impl FnOnce(&Around) -> T,
    ) -> Result<T> {
        let (q, part) = match interval {
            None => (self.at(0.0)?, 1.0),
            Some((time, Span::Around(half))) => (self.at(time)?, half + TIME_SLACK),
            Some((time, Span::Before(length))) => {
                let half = 0.5 * length;
                (self.at(time - half)?, half + TIME_SLACK)
            }
        };
        let half: Vec<f64> = self.line.v.iter().map(|rate| rate * part).collect();
        Ok(ask(&Around {
            q: &q,
            half: &half,
            is_line: matches!(self.kind, WayKind::Line),
        }))
    }

    /// Bounds how far roundings put configurations off the way, where it moves them: a velocity for a unit of time, of any signs.
    pub fn rounding(&self) -> Vec<f64> {
        let (q, v) = (self.line.q, self.line.v);
        let mut rounding = vec![0.0; v.len()];
        let error = match self.kind {
            WayKind::Curve { controls } => COORDINATE_ERROR * (controls.len() / q.len()) as f64,
            WayKind::Line | WayKind::Stated(_) | WayKind::Box { .. } => COORDINATE_ERROR,
        };
        for block in self.line.cobject.space().blocks() {
            let (c, k) = (block.coordinate, block.velocity);
            // Quaternions are of length 1.
            let lines = block.kind.lines();
            for i in 0..block.kind.nv() {
                let size = if i < lines { q[c + i].abs() } else { 1.0 };
                if v[k + i] != 0.0 {
                    rounding[k + i] = error * (size + v[k + i].abs());
                }
            }
        }
        rounding
    }

    /// The world at a configuration.
    pub fn scene<'s>(&'s self, q: &'s [f64]) -> Result<Scene<'s>> {
        self.line.scene(q)
    }

    /// The poses of all links at a time.
    pub fn link_poses(&self, t: f64) -> Result<Vec<Pose>> {
        self.line.cobject.space().link_poses(&self.at(t)?)
    }

    /// The motions of all links.
    pub fn link_motions(&self) -> LinkMotions {
        let space = self.line.cobject.space();
        match self.kind {
            WayKind::Line => space.link_motions(self.line.q, self.line.v),
            WayKind::Curve { controls } => space.link_motions_on_curve(controls),
            WayKind::Stated(motion) => motion.link_motions(),
            WayKind::Box { .. } => space.link_motions_in_box(self.line.q, self.line.v),
        }
    }
}

/// The velocity that leads from q0 to q1 in a unit of time.
pub(crate) fn checked_difference(space: &Space, q0: &[f64], q1: &[f64]) -> Result<Vec<f64>> {
    for (q, name) in [(q0, "q0"), (q1, "q1")] {
        space
            .check_configuration(q)
            .map_err(|error| error.within(name))?;
    }
    let v = space.difference(q0, q1);
    space.check_velocity(&v, "velocity")?;
    Ok(v)
}
