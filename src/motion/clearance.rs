//! The least distance along a whole motion. Distances at some times bound it from above; only proofs over the whole motion bound
//! it from below.

use super::motion::MotionOptions;
use super::motion_answer::MotionOutcome;
use super::set_tree::SetTree;
use super::valley::{Height, Valley};
use super::way::Way;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::query::{Configuration, Distance, DistanceKind, QueryContext, check_threshold};

/// What is asked of the clearance of a motion. Distances are lengths, or in units of C-space for pure sets without a scale.
#[derive(Clone, Copy, Debug)]
pub struct ClearanceOptions {
    /// The bounds are to be at most this far apart; larger than 0.
    pub tolerance: f64,
    /// Or this part of the upper bound, if that is more: at least 0 and less than 1.
    pub relative_tolerance: f64,
    /// Clearances above this are only known to be so.
    pub max_distance: f64,
}

impl ClearanceOptions {
    /// The exact tolerance, and no limit.
    pub fn with_tolerance(tolerance: f64) -> Self {
        Self {
            tolerance,
            relative_tolerance: 0.0,
            max_distance: f64::INFINITY,
        }
    }

    fn check(&self) -> Result<()> {
        require_finite(&[self.tolerance], "tolerance")?;
        if self.tolerance <= 0.0 {
            return Err(Error::invalid(format!(
                "tolerance is {}; it must be larger than 0",
                self.tolerance
            )));
        }
        require_finite(&[self.relative_tolerance], "relative_tolerance")?;
        if !(0.0..1.0).contains(&self.relative_tolerance) {
            return Err(Error::invalid(format!(
                "relative_tolerance {} is not from 0 to less than 1",
                self.relative_tolerance
            )));
        }
        check_threshold(self.max_distance, "max_distance")
    }

    /// Checks them, and that the least distance from the C-object can be known.
    pub(super) fn check_for(&self, cobject: &CObject) -> Result<()> {
        self.check()?;
        cobject.require_one_metric()?;
        if SetTree::new(cobject, false).is_plain_union() {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::Unsupported,
            format!(
                "C-object {} holds an intersection or a complement, from which no exact distance is known",
                cobject.serial()
            ),
        ))
    }

    /// A threshold a step below the upper bound.
    fn below(&self, upper: f64, step: f64) -> f64 {
        match upper - step {
            below if below.is_finite() => below.max(0.0).min(self.max_distance),
            _ if self.max_distance.is_finite() => self.max_distance,
            _ => 0.0,
        }
    }

    /// How far apart the bounds may be.
    pub(super) fn allowed(&self, upper: f64) -> f64 {
        if upper == f64::INFINITY {
            return self.tolerance;
        }
        self.tolerance.max(self.relative_tolerance * upper)
    }
}

/// What is known of a clearance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClearanceOutcome {
    /// The motion is proved free, and the bounds are within the tolerance.
    Known,
    /// There is contact at the time of the answer.
    Hit,
    /// Proved to be farther than the maximal distance at every time.
    BeyondMax,
    /// The C-object is empty: there is nothing to hit.
    Empty,
    /// The bounds hold, but rounding does not let them come within the tolerance, or leaves open whether the motion is free.
    Near,
    /// The work was limited; the bounds hold.
    Undecided,
}

/// The least distance along a motion.
#[derive(Clone, Debug)]
pub struct MotionClearance {
    /// What is known.
    pub outcome: ClearanceOutcome,
    /// Proved: no distance on the motion is smaller.
    pub lower: f64,
    /// The distance at the time is at most this: 0, or what rounding leaves, for contact; infinite beyond the maximal distance and if the set is empty.
    pub upper: f64,
    /// Where the nearest place was found, from 0 to 1.
    pub time: f64,
    /// The configuration there.
    pub configuration: Vec<f64>,
    /// The distance there, with its witness.
    pub distance: Distance,
}

/// A distance at a time of the motion.
#[derive(Clone)]
struct Sample {
    time: f64,
    distance: Distance,
}

impl Sample {
    /// Of the bodies grown by their stated deviations, as proofs know them.
    fn upper(&self) -> f64 {
        self.distance.upper_of_grown()
    }
}

/// The bounds so far.
struct ClearanceBounds {
    /// The largest threshold that the motion is proved to keep; `None` if it is not even proved free.
    proved: Option<f64>,
    nearest: Sample,
}

impl ClearanceBounds {
    /// Whether they are as near to each other as is asked for.
    fn are_within(&self, options: &ClearanceOptions) -> bool {
        let upper = self.nearest.upper();
        self.proved
            .is_some_and(|proved| upper - proved <= options.allowed(upper))
    }

    fn lower(&self) -> f64 {
        self.proved.unwrap_or(0.0)
    }

    fn take(&mut self, sample: Sample) {
        if sample.upper() < self.nearest.upper() {
            self.nearest = sample;
        }
    }
}

/// The motion is sampled at the ends of this many intervals, to begin a descent near its nearest place. More samples take longer
/// than the proofs they save: on the random robots of tests/motions a clearance takes 3.4 times a proof of the motion with 4
/// intervals, 3.9 times with 8, and 4.6 times with 16, at a tolerance of a tenth; 4.9, 5.2 and 6.3 times at a thousandth.
const INTERVALS: usize = 4;

/// A descent to the nearest place takes at most this many distances; where it ends early, proofs find what is left.
const MAX_DESCENT: usize = 40;

/// More proofs than this are not tried. Their number grows with the logarithm of the distance over the tolerance.
const MAX_PROOFS: usize = 1000;

/// After this many failed proofs in a row, each next one is tried at a four times longer step below the upper bound. Most motions
/// have only a few near places, and need no longer steps.
const MAX_SHORT_STEPS: i32 = 2;

/// A proof is tried at this part of the tolerance below the upper bound: less than 1 for the rounding of the difference.
pub(super) const STEP: f64 = 0.99;

/// The proofs that were tried.
struct Attempts {
    /// The threshold of a proof that failed without finding a smaller distance: rounding decides there.
    ceiling: f64,
    /// So many failed since the last that did not.
    failures: i32,
}

/// A proof to be tried.
struct Attempt {
    threshold: f64,
    /// The upper bound, and how far below it the threshold is meant to be.
    upper: f64,
    step: f64,
}

impl Attempts {
    /// `None` where there is nothing to ask for between what is proved and what is found.
    fn next(&self, bounds: &ClearanceBounds, options: &ClearanceOptions) -> Option<Attempt> {
        let (lower, upper) = (bounds.lower(), bounds.nearest.upper());
        let allowed = options.allowed(upper);
        if self.ceiling - lower <= 0.25 * allowed {
            return None;
        }
        // Longer steps keep the proofs few, even if each failure lowers the upper bound by hardly more than the tolerance.
        let longer = allowed * 4f64.powi((self.failures - MAX_SHORT_STEPS).max(0));
        let half = 0.5 * (upper - lower);
        let step = STEP * allowed.max(longer.min(half));
        let mut threshold = options.below(upper, step);
        if threshold >= self.ceiling {
            threshold = 0.5 * (lower + self.ceiling);
        }
        let is_proved = bounds.proved.is_some_and(|proved| threshold <= proved);
        (!is_proved).then_some(Attempt {
            threshold,
            upper,
            step,
        })
    }

    /// An attempt failed, and the upper bound is this now.
    fn failed(&mut self, attempt: &Attempt, upper: f64) {
        if upper.is_infinite() || upper > attempt.upper - 0.5 * attempt.step {
            self.ceiling = attempt.threshold;
        }
        self.failures += 1;
    }
}

impl QueryContext {
    /// The least distance from a C-object, a union of induced and pure sets, along the motion from q0 to q1, as
    /// [`crate::space::Space::interpolate`] makes it.
    pub fn motion_clearance(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        options: &ClearanceOptions,
    ) -> Result<MotionClearance> {
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        options.check_for(cobject)?;
        let world = &self.look(cobject);
        let ask = |way: &Way| self.clearance_on(way, options);
        Way::between(world, cobject, [q0, q1], ask)
    }

    /// The same on a way, with options that were checked for its set.
    pub(super) fn clearance_on(
        &mut self,
        way: &Way,
        options: &ClearanceOptions,
    ) -> Result<MotionClearance> {
        let mut bounds = ClearanceBounds {
            proved: None,
            nearest: self.sample(way, 0.0, options.max_distance)?,
        };
        let outcome = match self.narrow(way, options, &mut bounds) {
            Err(error) if error.kind == ErrorKind::Limit => ClearanceOutcome::Undecided,
            outcome => outcome?,
        };
        let (lower, nearest) = (bounds.lower(), bounds.nearest);
        Ok(MotionClearance {
            outcome,
            lower: lower.min(nearest.upper()),
            upper: nearest.distance.upper,
            time: nearest.time,
            configuration: way.at(nearest.time)?,
            distance: nearest.distance,
        })
    }

    fn sample(&mut self, way: &Way, time: f64, max_distance: f64) -> Result<Sample> {
        let q = &way.at(time)?;
        let at = Configuration::Coordinates(q);
        let distance = self.distance_in(way.line.world, way.line.cobject, at, max_distance)?;
        Ok(Sample { time, distance })
    }

    /// Brings the bounds together.
    fn narrow(
        &mut self,
        way: &Way,
        options: &ClearanceOptions,
        bounds: &mut ClearanceBounds,
    ) -> Result<ClearanceOutcome> {
        self.look_along(way, options, bounds)?;
        let any_contact = MotionOptions {
            any_contact: true,
            ..MotionOptions::default()
        };
        let nearest = &bounds.nearest;
        if nearest.distance.distance == 0.0 && self.has_contact(way, nearest.time, &any_contact)? {
            return Ok(ClearanceOutcome::Hit);
        }
        let is_empty = nearest.distance.kind == DistanceKind::Empty;
        let mut attempts = Attempts {
            ceiling: f64::INFINITY,
            failures: 0,
        };
        for _ in 0..MAX_PROOFS {
            if !is_empty && bounds.are_within(options) {
                return Ok(ClearanceOutcome::Known);
            }
            let Some(attempt) = attempts.next(bounds, options) else {
                break;
            };
            let threshold = attempt.threshold;
            let at_threshold = MotionOptions {
                threshold,
                ..any_contact
            };
            let answer = self.motion_on(way, &at_threshold)?;
            match answer.outcome {
                MotionOutcome::Free if is_empty => {
                    bounds.proved = Some(f64::INFINITY);
                    return Ok(ClearanceOutcome::Empty);
                }
                MotionOutcome::Free => {
                    bounds.proved = Some(bounds.lower().max(threshold));
                    if threshold >= options.max_distance {
                        return Ok(ClearanceOutcome::BeyondMax);
                    }
                    attempts.failures = 0;
                }
                MotionOutcome::Hit | MotionOutcome::Near => {
                    let found = self.sample(way, answer.times[1], f64::INFINITY)?;
                    if answer.outcome == MotionOutcome::Hit && threshold == 0.0 {
                        bounds.nearest = found;
                        return Ok(ClearanceOutcome::Hit);
                    }
                    bounds.take(found.clone());
                    if found.upper().is_finite() {
                        self.descend(way, found, options, bounds)?;
                    }
                    attempts.failed(&attempt, bounds.nearest.upper());
                }
                MotionOutcome::Undecided => return Ok(ClearanceOutcome::Undecided),
            }
        }
        Ok(ClearanceOutcome::Near)
    }

    /// Samples the way, and goes down from the nearest of the samples.
    fn look_along(
        &mut self,
        way: &Way,
        options: &ClearanceOptions,
        bounds: &mut ClearanceBounds,
    ) -> Result<()> {
        for i in 1..=INTERVALS {
            if bounds.nearest.upper() == 0.0 {
                break;
            }
            let limit = options.max_distance.min(bounds.nearest.upper());
            let time = i as f64 / INTERVALS as f64;
            bounds.take(self.sample(way, time, limit)?);
        }
        if bounds.nearest.upper().is_finite() {
            self.descend(way, bounds.nearest.clone(), options, bounds)?;
        }
        Ok(())
    }

    /// Goes from a sample down to a place nearer than all around it.
    fn descend(
        &mut self,
        way: &Way,
        from: Sample,
        options: &ClearanceOptions,
        bounds: &mut ClearanceBounds,
    ) -> Result<()> {
        let mut height = |time: f64| -> Result<Height> {
            let sample = self.sample(way, time, f64::INFINITY)?;
            let upper = sample.upper();
            bounds.take(sample);
            Ok(Height { time, upper })
        };
        let width = 0.5 / INTERVALS as f64;
        let lowest = Height {
            time: from.time,
            upper: from.upper(),
        };
        let before = height((lowest.time - width).clamp(0.0, 1.0))?;
        let after = height((lowest.time + width).clamp(0.0, 1.0))?;
        let mut valley = Valley::new(lowest, [before, after]);
        for count in 0..MAX_DESCENT {
            let lowest = valley.lowest.upper;
            if lowest == 0.0 {
                break;
            }
            if let Some(side) = valley.lower_side() {
                let time = valley.walk_to(side);
                valley.set_side(side, height(time)?);
                continue;
            }
            if valley.may_fall() <= 0.25 * options.allowed(lowest) || valley.is_point() {
                break;
            }
            let found = height(valley.time_between(count))?;
            if !valley.take(found) {
                break;
            }
        }
        Ok(())
    }
}
