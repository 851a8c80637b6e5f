//! How a motion ends: what its proof found, with the time, the place and the distance of its contact.

use super::interval_proof::Proof;
use crate::error::{Error, ErrorKind, Result};
use crate::query::Distance;

/// How a motion ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionOutcome {
    /// Proved free for every time from 0 to 1.
    Free,
    /// There is contact at the second of the times; unless any contact was asked for, all before the first is proved free, and the
    /// two are no farther apart than the tolerance.
    Hit,
    /// All before the times is free; between them, no farther apart than the tolerance, it comes so near the threshold that neither
    /// a proof nor a contact was found.
    Near,
    /// The work of a call was limited (see [`crate::query::QueryContext::set_limit`]); all before the first time is free.
    Undecided,
}

/// What was found of a motion.
#[derive(Clone, Debug)]
pub struct MotionAnswer<C = Vec<f64>> {
    /// How it ends.
    pub outcome: MotionOutcome,
    /// See [`MotionOutcome`]; 1 and 1 for a motion that is free.
    pub times: [f64; 2],
    /// The configuration at the second time; of two bodies, their poses.
    pub configuration: C,
    /// The distance there, with its witness: of hits and of what is near, unless any contact was asked for, or lengths and units of
    /// C-space mix in the set.
    pub distance: Option<Distance>,
}

/// What is asked at times of a motion.
pub(super) trait Moments {
    /// A configuration, or the poses of two bodies.
    type Configuration;

    fn at(&self, t: f64) -> Result<Self::Configuration>;

    /// Whether there is contact at a time.
    fn meet(&mut self, t: f64) -> Result<bool>;

    /// The distance to be told where there is contact.
    fn distance(&mut self, at: &Self::Configuration) -> Result<Option<Distance>>;
}

impl<C> MotionAnswer<C> {
    /// How a proof ended.
    pub(super) fn of_proof(
        proof: Proof,
        tolerance: f64,
        moments: &mut impl Moments<Configuration = C>,
    ) -> Result<Self> {
        let (outcome, times) = match proof {
            Proof::Free => (MotionOutcome::Free, [1.0, 1.0]),
            Proof::Contact(times) => (MotionOutcome::Hit, times),
            Proof::Exceeded(time) => (MotionOutcome::Undecided, [time, time]),
            Proof::Undecided([start, end]) => match certain_contact(start, end, tolerance, moments)
            {
                Err(error) if is_limit(&error) => (MotionOutcome::Undecided, [start, start]),
                found => match found? {
                    Some(time) => (MotionOutcome::Hit, [start, time]),
                    None => (MotionOutcome::Near, [start, end]),
                },
            },
        };
        Self::new(outcome, times, moments)
    }

    /// An outcome with what is told of it.
    pub(super) fn new(
        outcome: MotionOutcome,
        times: [f64; 2],
        moments: &mut impl Moments<Configuration = C>,
    ) -> Result<Self> {
        let at = moments.at(times[1])?;
        let distance = match outcome {
            MotionOutcome::Hit | MotionOutcome::Near => moments.distance(&at),
            MotionOutcome::Free | MotionOutcome::Undecided => Ok(None),
        };
        match distance {
            Err(error) if is_limit(&error) => Ok(Self::undecided(times[0], moments.at(times[0])?)),
            distance => Ok(Self {
                outcome,
                times,
                configuration: at,
                distance: distance?,
            }),
        }
    }

    /// Where the work ended: all before is free.
    pub(super) fn undecided(time: f64, configuration: C) -> Self {
        Self {
            outcome: MotionOutcome::Undecided,
            times: [time; 2],
            configuration,
            distance: None,
        }
    }

    /// The answer of a motion, also where the limit of work ended it before anything was proved.
    pub(crate) fn or_undecided(found: Result<Self>, start: impl FnOnce() -> C) -> Result<Self> {
        match found {
            Err(error) if is_limit(&error) => Ok(Self::undecided(0.0, start())),
            found => found,
        }
    }
}

/// Where rounding hides the moment of contact, it may be certain as soon as the tolerance allows.
fn certain_contact(
    start: f64,
    end: f64,
    tolerance: f64,
    moments: &mut impl Moments,
) -> Result<Option<f64>> {
    for later in [end, (start + tolerance).min(1.0)] {
        if moments.meet(later)? {
            return Ok(Some(later));
        }
    }
    Ok(None)
}

fn is_limit(error: &Error) -> bool {
    error.kind == ErrorKind::Limit
}
