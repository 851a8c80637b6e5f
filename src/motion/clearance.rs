//! The least distance along a whole motion. Distances at some times bound it from above; only proofs over the whole motion bound
//! it from below.

use super::linear_motion::LinearMotion;
use super::motion::{MotionOptions, MotionOutcome, checked_difference};
use super::set_tree::SetTree;
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
        let v = &checked_difference(cobject.space(), q0, q1)?;
        cobject.space().check_velocity(v, "velocity")?;
        let world = &self.look(cobject);
        let line = LinearMotion {
            world,
            cobject,
            q: q0,
            v,
        };
        self.clearance_on(&Way::straight_to(line, q1), options)
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
        let is_empty = bounds.nearest.distance.kind == DistanceKind::Empty;
        let any_contact = MotionOptions {
            any_contact: true,
            ..MotionOptions::default()
        };
        if bounds.nearest.distance.distance == 0.0
            && self.has_contact(way, bounds.nearest.time, &any_contact)?
        {
            return Ok(ClearanceOutcome::Hit);
        }
        // The threshold of a proof that failed without finding a smaller distance: rounding decides there.
        let mut ceiling = f64::INFINITY;
        let mut failures = 0;
        for _ in 0..MAX_PROOFS {
            let upper = bounds.nearest.upper();
            let allowed = options.allowed(upper);
            if ceiling - bounds.lower() <= 0.25 * allowed {
                break;
            }
            // Longer steps keep the proofs few, even if each failure lowers the upper bound by hardly more than the tolerance.
            let longer = allowed * 4f64.powi((failures - MAX_SHORT_STEPS).max(0));
            let half = 0.5 * (upper - bounds.lower());
            let step = STEP * allowed.max(longer.min(half));
            let mut threshold = match upper - step {
                below if below.is_finite() => below.max(0.0).min(options.max_distance),
                _ if options.max_distance.is_finite() => options.max_distance,
                _ => 0.0,
            };
            if threshold >= ceiling {
                threshold = 0.5 * (bounds.lower() + ceiling);
            }
            let answer = self.motion_on(
                way,
                &MotionOptions {
                    threshold,
                    ..any_contact
                },
            )?;
            match answer.outcome {
                MotionOutcome::Free if is_empty => {
                    bounds.proved = Some(f64::INFINITY);
                    return Ok(ClearanceOutcome::Empty);
                }
                MotionOutcome::Free => {
                    bounds.proved = Some(threshold);
                    if threshold >= options.max_distance {
                        return Ok(ClearanceOutcome::BeyondMax);
                    }
                    if upper - threshold <= allowed {
                        return Ok(ClearanceOutcome::Known);
                    }
                    failures = 0;
                }
                MotionOutcome::Hit | MotionOutcome::Near => {
                    let found = self.sample(way, answer.times[1], f64::INFINITY)?;
                    if answer.outcome == MotionOutcome::Hit && threshold == 0.0 {
                        bounds.nearest = found;
                        return Ok(ClearanceOutcome::Hit);
                    }
                    bounds.take(found.clone());
                    self.descend(way, found, options, bounds)?;
                    if bounds.nearest.upper() > upper - 0.5 * step {
                        ceiling = threshold;
                    }
                    failures += 1;
                }
                MotionOutcome::Undecided => return Ok(ClearanceOutcome::Undecided),
            }
        }
        Ok(ClearanceOutcome::Near)
    }

    /// Goes from a sample down to a place nearer than all around it, by parabolas and golden sections.
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
        let mut lowest = Height {
            time: from.time,
            upper: from.upper(),
        };
        // The samples before and after the lowest; itself at an end of the motion.
        let mut sides = [lowest; 2];
        for (side, time) in [(0, lowest.time - width), (1, lowest.time + width)] {
            sides[side] = height(time.clamp(0.0, 1.0))?;
        }
        for count in 0..MAX_DESCENT {
            if lowest.upper == 0.0 {
                break;
            }
            // Not between its neighbours yet: walk on.
            if let Some(side) = (0..2).find(|&side| sides[side].upper < lowest.upper) {
                sides[1 - side] = lowest;
                lowest = sides[side];
                let further = lowest.time + (lowest.time - sides[1 - side].time);
                sides[side] = height(further.clamp(0.0, 1.0))?;
                continue;
            }
            let spans = sides.map(|side| (side.time - lowest.time).abs());
            let rises = sides.map(|side| side.upper - lowest.upper);
            // By how much a convex function may fall below the lowest on the way to each side.
            let may_fall = |side: usize| match spans[1 - side] {
                0.0 => rises[side],
                other => rises[1 - side] / other * spans[side],
            };
            if may_fall(0).max(may_fall(1)) <= 0.25 * options.allowed(lowest.upper) {
                break;
            }
            if spans[0] + spans[1] < 1e-12 {
                break;
            }
            let is_at_end = spans.contains(&0.0);
            let time = match parabola_vertex(&lowest, &sides) {
                _ if is_at_end => {
                    let side = usize::from(spans[1] > 0.0);
                    lowest.time + (sides[side].time - lowest.time) * NEAR_END
                }
                Some(vertex) if count % 3 != 2 => vertex,
                _ => {
                    let side = usize::from(spans[1] > spans[0]);
                    lowest.time + (sides[side].time - lowest.time) * GOLDEN
                }
            };
            let side = usize::from(time > lowest.time);
            let found = height(time)?;
            if found.upper < lowest.upper {
                sides[1 - side] = lowest;
                lowest = found;
            } else if is_at_end {
                break;
            } else {
                sides[side] = found;
            }
        }
        Ok(())
    }
}

/// The upper bound of the distance at a time.
#[derive(Clone, Copy)]
struct Height {
    time: f64,
    upper: f64,
}

/// The part of an interval that a golden section takes off.
const GOLDEN: f64 = 0.381_966;

/// Where the first or the last time is the nearest, a time so near to it, as a part of the interval, shows whether the distance
/// rises at once.
const NEAR_END: f64 = 1.0 / 16.0;

/// The time at which the parabola through three samples is least, if it is between the two sides and not at one of the three.
fn parabola_vertex(lowest: &Height, sides: &[Height; 2]) -> Option<f64> {
    let [before, after] = sides.map(|side| (side.time - lowest.time, side.upper - lowest.upper));
    let denominator = before.1 * after.0 - after.1 * before.0;
    let numerator = before.1 * after.0 * after.0 - after.1 * before.0 * before.0;
    let step = 0.5 * numerator / denominator;
    let room = 0.02 * (after.0 - before.0);
    let is_inside = step > before.0 + room && step < after.0 - room;
    if !step.is_finite() || !is_inside {
        return None;
    }
    // A sample too near the lowest would tell nothing.
    let step = if step.abs() < room {
        room.copysign(step)
    } else {
        step
    };
    (step < after.0 && step > before.0).then_some(lowest.time + step)
}
