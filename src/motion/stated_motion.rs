//! Motions as functions of time, with bounds that their makers state.

use std::cell::RefCell;

use super::coordinate_motion::{check_quaternions, speeds};
use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::robot::{CourseState, LinkMotions};
use crate::space::Space;

/// What a function gives may exceed its bounds by so much, relative: the rounding of both. Proofs use bounds that are larger by it.
const STATED_SLACK: f64 = 1e-9;

/// A motion through C-space as a function of the time from 0 to 1.
pub trait MotionFunction {
    /// Writes what the motion is at a time.
    fn at(&self, t: f64, moment: &mut MotionMoment) -> Result<()>;
}

/// A motion at one time: an entry per coordinate in each list.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionMoment {
    /// The configuration.
    pub q: Vec<f64>,
    /// Its first derivative, per unit of time.
    pub rates: Vec<f64>,
    /// Its second derivative.
    pub accelerations: Vec<f64>,
}

impl MotionMoment {
    /// Each coordinate with its derivatives.
    pub(super) fn coordinates(&self) -> impl Iterator<Item = CourseState> {
        let derivatives = self.rates.iter().zip(&self.accelerations);
        let all = self.q.iter().zip(derivatives);
        all.map(|(&value, (&rate, &acceleration))| CourseState {
            value,
            rate,
            acceleration,
        })
    }
}

/// What the maker of a function states of it, for all times from 0 to 1: an entry per coordinate in each list.
#[derive(Clone, Copy, Debug)]
pub struct MotionBounds<'a> {
    /// No first derivative has a larger absolute value.
    pub max_rates: &'a [f64],
    /// No second derivative has; where the first jumps there is none.
    pub max_accelerations: &'a [f64],
}

/// A function with its bounds.
pub(super) struct StatedMotion<'a> {
    space: &'a Space,
    function: &'a dyn MotionFunction,
    /// The configuration at time 0.
    pub start: Vec<f64>,
    /// What the function gave at time 0, and what it gave last, with their times.
    known: [RefCell<Option<(f64, MotionMoment)>>; 2],
    max_rates: Vec<f64>,
    max_accelerations: Vec<f64>,
}

impl<'a> StatedMotion<'a> {
    pub fn new(
        space: &'a Space,
        function: &'a dyn MotionFunction,
        bounds: &MotionBounds,
    ) -> Result<Self> {
        let larger = |given: &[f64], name: &str| {
            check_bounds(given, space.nq(), name)?;
            Ok(given
                .iter()
                .map(|bound| bound * (1.0 + STATED_SLACK))
                .collect())
        };
        let mut motion = Self {
            space,
            function,
            start: Vec::new(),
            known: [RefCell::new(None), RefCell::new(None)],
            max_rates: larger(bounds.max_rates, "max_rates")?,
            max_accelerations: larger(bounds.max_accelerations, "max_accelerations")?,
        };
        let rests = |c: usize| motion.max_rates[c] == 0.0;
        check_quaternions(
            space,
            rests,
            "as a function of coordinates: max_rates must be 0",
        )?;
        let first = motion.asked(0.0)?;
        motion.start.clone_from(&first.q);
        motion.known[0] = RefCell::new(Some((0.0, first)));
        Ok(motion)
    }

    /// What the function gives, with coordinates and derivatives that are numbers.
    fn asked(&self, t: f64) -> Result<MotionMoment> {
        let unwritten = || vec![f64::NAN; self.space.nq()];
        let mut moment = MotionMoment {
            q: unwritten(),
            rates: unwritten(),
            accelerations: unwritten(),
        };
        self.function.at(t, &mut moment)?;
        let named = |error: Error| error.within(format_args!("the motion at time {t}"));
        self.space.check_configuration(&moment.q).map_err(named)?;
        require_coordinates(&moment.rates, "rate").map_err(named)?;
        require_coordinates(&moment.accelerations, "acceleration").map_err(named)?;
        Ok(moment)
    }

    /// The motion at a time. Fails where it is not within its bounds, or where it and its rates do not fit what the function gave at
    /// time 0 and when it was asked last.
    pub fn at(&self, t: f64) -> Result<MotionMoment> {
        if let Some((time, moment)) = &*self.known[1].borrow()
            && *time == t
        {
            return Ok(moment.clone());
        }
        let moment = self.asked(t)?;
        for c in 0..self.space.nq() {
            let (from, to) = (self.start[c], moment.q[c]);
            // What is to rest has to; the rest is rounded.
            let size = from.abs().max(to.abs()) + self.max_rates[c];
            let rounding = if self.max_rates[c] == 0.0 {
                0.0
            } else {
                16.0 * f64::EPSILON * size
            };
            let exceeds = |what: &str, value: f64, bound: &str| {
                Err(Error::invalid(format!(
                    "the motion at time {t}: {what} of coordinate {c} is {value}, more than {bound} says"
                )))
            };
            if (to - from).abs() > self.max_rates[c] * t + rounding {
                return exceeds("the change", to - from, "max_rates");
            }
            if moment.rates[c].abs() > self.max_rates[c] {
                return exceeds("the rate", moment.rates[c], "max_rates");
            }
            if moment.accelerations[c].abs() > self.max_accelerations[c] {
                let value = moment.accelerations[c];
                return exceeds("the acceleration", value, "max_accelerations");
            }
        }
        for known in &self.known {
            if let Some(known) = &*known.borrow() {
                self.check_between(known, (t, &moment))?;
            }
        }
        *self.known[1].borrow_mut() = Some((t, moment.clone()));
        Ok(moment)
    }

    /// Refuses two moments that no motion has whose second derivatives are within their bounds: rates change by no more than the
    /// bound times the time between, and what a motion is off the straight line along its rate by half of it times the
    /// square of that time.
    fn check_between(
        &self,
        (t0, before): &(f64, MotionMoment),
        (t1, after): (f64, &MotionMoment),
    ) -> Result<()> {
        let time = t1 - t0;
        for c in 0..self.space.nq() {
            let most = self.max_accelerations[c] * time.abs();
            let rate_slack = STATED_SLACK * self.max_rates[c];
            let size = before.q[c].abs().max(after.q[c].abs()) + self.max_rates[c];
            let slack = rate_slack * time.abs() + 64.0 * f64::EPSILON * size;
            let [v0, v1] = [before.rates[c], after.rates[c]];
            let change = after.q[c] - before.q[c];
            let off = (change - v0 * time).abs().max((change - v1 * time).abs());
            if (v1 - v0).abs() > most + rate_slack || off > 0.5 * most * time.abs() + slack {
                return Err(Error::invalid(format!(
                    "the motion at times {t0} and {t1}: coordinate {c} changes by {change} with rates of {v0} and {v1}, which are \
                     not its derivative, or max_accelerations is too small"
                )));
            }
        }
        Ok(())
    }

    pub fn link_motions(&self) -> LinkMotions {
        let Self {
            start,
            max_rates,
            max_accelerations,
            ..
        } = self;
        let space = self.space;
        space.link_motions_given(start, max_rates, max_accelerations)
    }

    /// Two configurations between which the motion stays.
    pub fn farthest(&self) -> [Vec<f64>; 2] {
        [-1.0, 1.0].map(|sign| {
            let coordinates = self.start.iter().zip(&self.max_rates);
            coordinates.map(|(x, rate)| x + sign * rate).collect()
        })
    }

    /// The largest speed of every coordinate, with signs that lead away from zero.
    pub fn speeds(&self) -> Vec<f64> {
        speeds(self.space, &self.start, |c| self.max_rates[c])
    }
}

/// Refuses lists that bound nothing.
fn check_bounds(given: &[f64], nq: usize, name: &str) -> Result<()> {
    if given.len() != nq {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "{name} has {} entries, but the space has {nq} coordinates",
                given.len()
            ),
        ));
    }
    require_coordinates(given, name)?;
    match given.iter().position(|bound| *bound < 0.0) {
        Some(c) => Err(Error::invalid(format!(
            "{name}[{c}] is {}, less than 0",
            given[c]
        ))),
        None => Ok(()),
    }
}
