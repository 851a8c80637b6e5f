//! The step that slides along contacts instead of running into them (Appendix A: `slide`, `slide-step` and
//! `compute-spring-step` in one).

use super::answer::Distance;
use super::at_configuration::check_threshold;
use super::context::QueryContext;
use super::half_spaces::{HalfSpace, dot, nearest_in_half_spaces};
use super::scene::Configuration;
use super::segment::motion_bound;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::tolerance;

/// How to slide.
#[derive(Clone, Copy, Debug)]
pub struct SlideOptions {
    /// Contacts up to this distance constrain the step: the stand-off.
    pub max_shell: f64,
    /// The distance at which the robot slides; it is pushed out where it is nearer.
    pub desired_distance: f64,
    /// Lengthens the step along the contact to that of the step asked for, at most fourfold.
    pub keep_length: bool,
    /// At most so many witnesses are considered, the nearest first.
    pub max_witnesses: usize,
}

impl SlideOptions {
    /// The report's defaults: a desired distance of a tenth of the shell.
    pub fn with_shell(max_shell: f64) -> Self {
        Self {
            max_shell,
            desired_distance: max_shell / 10.0,
            keep_length: false,
            max_witnesses: 256,
        }
    }

    fn check(&self) -> Result<()> {
        check_threshold(self.max_shell, "max_shell")?;
        require_finite(&[self.max_shell], "max_shell")?;
        check_threshold(self.desired_distance, "desired_distance")?;
        if self.max_shell == 0.0 {
            return Err(Error::invalid(
                "max_shell is 0; a slide needs room to see contacts",
            ));
        }
        if self.desired_distance > self.max_shell {
            return Err(Error::invalid(format!(
                "desired_distance {} is larger than max_shell {}",
                self.desired_distance, self.max_shell
            )));
        }
        if self.max_witnesses == 0 {
            return Err(Error::invalid("max_witnesses is 0"));
        }
        Ok(())
    }
}

/// How a slide ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlideOutcome {
    /// A step was found; it keeps clear of the C-object all the way.
    Moved,
    /// The configuration is inside the C-object; there is no way to slide.
    Inside,
    /// No step leads on: the contacts, the coordinates' ranges or the world box are in the way.
    Blocked,
}

/// The step taken. Unless it moved, the configuration is the one given.
#[derive(Clone, Debug)]
pub struct SlideStep {
    pub outcome: SlideOutcome,
    pub configuration: Vec<f64>,
    /// The distance at the configuration given, and at the one reached.
    pub distance_before: f64,
    pub distance_after: f64,
    /// How many contacts constrained the step.
    pub contacts: usize,
}

impl QueryContext {
    /// One step from q: `step` itself where nothing is within the shell, else the nearest step that brings no contact
    /// nearer than the desired distance, shortened until the whole way is proved free.
    pub fn slide(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        step: &[f64],
        options: &SlideOptions,
    ) -> Result<SlideStep> {
        options.check()?;
        if step.len() != q.len() {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "the step has {} entries, the configuration {}",
                    step.len(),
                    q.len()
                ),
            ));
        }
        require_finite(step, "step entry")?;
        if let Some(i) = step
            .iter()
            .position(|x| x.abs() > tolerance::LARGEST_COORDINATE)
        {
            return Err(Error::invalid(format!(
                "step entry {i} is too large: {}",
                step[i]
            )));
        }
        // One state of the world for all that is asked: else the proof would join distances of several.
        let cobject = &cobject.frozen();
        let here =
            self.pseudo_normal(cobject, q, options.max_shell, options.max_witnesses, false)?;
        let ended = |outcome| SlideStep {
            outcome,
            configuration: q.to_vec(),
            distance_before: here.distance.distance,
            distance_after: here.distance.distance,
            contacts: here.list.contacts.len(),
        };
        // A touch is no reason to stay; an overlap is, of primitives or of what the margin adds to them.
        let too_deep = -1e-9 * options.max_shell;
        let overlaps = here
            .list
            .witnesses
            .iter()
            .any(|witness| witness.overlapping)
            || here
                .list
                .contacts
                .iter()
                .any(|contact| contact.clearance < too_deep);
        if overlaps {
            return Ok(ended(SlideOutcome::Inside));
        }
        let length = dot(step, step).sqrt();
        if length == 0.0 || !cobject.space().contains(q) {
            return Ok(ended(SlideOutcome::Blocked));
        }
        let half_spaces: Vec<HalfSpace> = here
            .list
            .contacts
            .iter()
            .zip(here.list.gradients.chunks_exact(q.len().max(1)))
            .map(|(contact, row)| HalfSpace {
                row,
                least: options.desired_distance - contact.clearance,
            })
            .collect();
        let Some(mut along) = nearest_in_half_spaces(step, &half_spaces) else {
            return Ok(ended(SlideOutcome::Blocked));
        };
        if options.keep_length && !half_spaces.is_empty() {
            let stretch = (length / dot(&along, &along).sqrt()).clamp(1.0, 4.0);
            let wish: Vec<f64> = step.iter().map(|x| x * stretch).collect();
            if let Some(longer) = nearest_in_half_spaces(&wish, &half_spaces)
                && dot(&longer, &longer).sqrt() <= 1.5 * length
            {
                along = longer;
            }
        }
        if dot(&along, &along).sqrt() <= 1e-3 * length {
            return Ok(ended(SlideOutcome::Blocked));
        }
        for _ in 0..8 {
            let wish: Vec<f64> = q.iter().zip(&along).map(|(x, s)| x + s).collect();
            let reached = cobject.space().clamp(&wish);
            if reached != q
                && cobject.space().check_configuration(&reached).is_ok()
                && cobject.space().contains(&reached)
                && self.may_move(cobject, q, &reached, &here.distance, options.max_shell)?
            {
                let after =
                    self.distance(cobject, Configuration::Coordinates(&reached), f64::INFINITY)?;
                return Ok(SlideStep {
                    outcome: SlideOutcome::Moved,
                    distance_after: after.distance,
                    configuration: reached,
                    ..ended(SlideOutcome::Moved)
                });
            }
            along.iter_mut().for_each(|s| *s *= 0.5);
        }
        Ok(ended(SlideOutcome::Blocked))
    }

    /// Whether the way is free. From a touching start no proof can begin: the first [`ON_TRUST`] of the shell is taken on
    /// the word of the contacts, which the step leaves or keeps to first order; the rest is proved.
    fn may_move(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        distance: &Distance,
        max_shell: f64,
    ) -> Result<bool> {
        let motion = motion_bound(cobject, q0, q1);
        let start = if distance.lower > 0.0 || motion == 0.0 {
            0.0
        } else {
            (ON_TRUST * max_shell / motion).min(1.0)
        };
        self.segment_is_free(cobject, q0, q1, start)
    }
}

/// How far, as a part of the shell, a touching robot may move before a distance must prove it free.
const ON_TRUST: f64 = 1e-4;
