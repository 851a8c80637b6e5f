//! Finds a certificate of a motion that is known to be free: parts intervals and groups of primitives until entries show each part.

use super::carried_points::Course;
use super::certificate::{Certificate, Entry, Step};
use super::check::{halves_of_group, halves_of_time};
use super::fingerprint::fingerprint;
use super::measure::{Along, Measure, Part};
use super::order::order_of;
use super::statement::{Alternative, Carried, Claim, Item, Statement, What};
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{MotionAnswer, MotionOptions, MotionOutcome, checked_difference};
use crate::pose::Vec3;
use crate::query::{Configuration, QueryContext, World};
use crate::tolerance::LARGEST_COORDINATE;

/// Where groups are apart at the middle of an interval, it is halved as long as the motion takes off no more than so many times
/// that distance; else groups are halved, which leaves fewer primitives near.
const MAX_LOSS: f64 = 16.0;

/// A certificate has no more steps, so that its memory is bounded: 0.5 GB.
const MAX_STEPS: usize = 1 << 22;

/// The most chosen parts that are given up for others: within nested intersections each may be tried at each depth of the other.
const MAX_FAILURES: usize = 1000;

/// Why no certificate was found.
enum Stop {
    /// In this interval no entry could be shown: the motion comes as near the limit as rounding.
    Near([f64; 2]),
    /// The work of the call ended.
    Exceeded,
    Error(Error),
}

type Searched<T> = std::result::Result<T, Stop>;

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        match error.kind {
            ErrorKind::Limit => Self::Exceeded,
            _ => Self::Error(error),
        }
    }
}

impl QueryContext {
    /// The same as [`QueryContext::motion`], and where the motion is free a certificate of that. `None` where it is not; and where
    /// it is, but comes so near the threshold that no certificate shows it, the outcome is [`MotionOutcome::Near`]; where the work
    /// was limited, [`MotionOutcome::Undecided`].
    ///
    /// Certificates are of links against s-objects and each other, of attached objects, floors, the world box, limits, boxes,
    /// half-spaces and balls of C-space, and of unions and intersections of these. Complements, predicates, and bodies with a support
    /// function of the caller's are refused as [`ErrorKind::Unsupported`], naming the leaf, but for parts of intersections that are free
    /// without them.
    pub fn motion_certificate(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        options: &MotionOptions,
    ) -> Result<(MotionAnswer, Option<Certificate>)> {
        let asked = cobject.without_known()?;
        let cobject = asked.as_deref().unwrap_or(cobject);
        let ends = [q0, q1];
        let unshown = |outcome, times: [f64; 2]| MotionAnswer {
            outcome,
            times,
            configuration: cobject.space().interpolate(q0, q1, times[1]),
            distance: None,
        };
        self.with_statement(cobject, ends, options, |context, world, statement| {
            let found = context.motion_between_in(world, cobject, ends, options);
            let answer = MotionAnswer::or_undecided(found, || q0.to_vec())?;
            if answer.outcome != MotionOutcome::Free {
                return Ok((answer, None));
            }
            match context.search(statement, world, ends, options) {
                Ok(certificate) => Ok((answer, Some(certificate))),
                Err(Stop::Near(times)) => Ok((unshown(MotionOutcome::Near, times), None)),
                Err(Stop::Exceeded) => Ok((unshown(MotionOutcome::Undecided, [1.0; 2]), None)),
                Err(Stop::Error(error)) => Err(error),
            }
        })
    }

    /// Looks for a certificate without the proof of [`QueryContext::motion`]; `None` where it finds none. For tests of the one by the
    /// other.
    pub fn search_certificate(
        &mut self,
        cobject: &CObject,
        q0: &[f64],
        q1: &[f64],
        options: &MotionOptions,
    ) -> Result<Option<Certificate>> {
        let ends = [q0, q1];
        self.with_statement(
            cobject,
            ends,
            options,
            |context, world, statement| match context.search(statement, world, ends, options) {
                Ok(certificate) => Ok(Some(certificate)),
                Err(Stop::Near(_)) => Ok(None),
                Err(Stop::Exceeded) => context.scratch.meter().check().map(|()| None),
                Err(Stop::Error(error)) => Err(error),
            },
        )
    }

    /// Checks a motion, and hands on what a certificate of it has to show.
    fn with_statement<T>(
        &mut self,
        cobject: &CObject,
        [q0, q1]: [&[f64]; 2],
        options: &MotionOptions,
        show: impl FnOnce(&mut Self, &World, &Statement) -> Result<T>,
    ) -> Result<T> {
        checked_difference(cobject.space(), q0, q1)?;
        let world = &self.begin_motion(cobject, options)?;
        let start = Configuration::Coordinates(q0);
        self.with_scene(cobject, world, start, |context, scene| {
            let statement = &Statement::of(cobject, scene, options.threshold)?;
            show(context, world, statement)
        })
    }

    fn search(
        &mut self,
        statement: &Statement,
        world: &World,
        [q0, q1]: [&[f64]; 2],
        options: &MotionOptions,
    ) -> Searched<Certificate> {
        let space = statement.space;
        let orders: Vec<Vec<u32>> = statement.bodies.iter().map(|body| order_of(body)).collect();
        let course = Course {
            space,
            q0,
            v: space.difference(q0, q1),
        };
        let mut search = Search {
            measure: Measure::new(course, q1, &orders),
            context: self,
            world,
            options,
            steps: Vec::new(),
            entries: Vec::new(),
            failures: 0,
        };
        search.claim(&statement.claim, [0.0, 1.0])?;
        let (steps, entries) = (search.steps, search.entries);
        Ok(Certificate {
            ends: [q0, q1].map(<[f64]>::to_vec),
            threshold: options.threshold,
            fingerprint: fingerprint(statement),
            orders,
            steps,
            entries,
        })
    }
}

struct Search<'a> {
    measure: Measure<'a>,
    context: &'a mut QueryContext,
    world: &'a World,
    options: &'a MotionOptions,
    steps: Vec<Step>,
    entries: Vec<Entry>,
    /// How many chosen parts could not be shown.
    failures: usize,
}

impl Search<'_> {
    fn push(&mut self, step: Step) -> Searched<()> {
        if self.steps.len() == MAX_STEPS {
            return Err(Stop::Error(Error::new(
                ErrorKind::Limit,
                format!("the certificate needs more than {MAX_STEPS} steps"),
            )));
        }
        self.steps.push(step);
        Ok(())
    }

    fn claim(&mut self, claim: &Claim, times: [f64; 2]) -> Searched<()> {
        match claim {
            Claim::All(parts) => parts.iter().try_for_each(|part| self.claim(part, times)),
            Claim::One { parts, refused } => {
                for (number, part) in (0..).zip(parts) {
                    if let Some(claim) = &part.claim
                        && self.is_free(part, times)?
                    {
                        let before = [self.steps.len(), self.entries.len()];
                        self.push(Step(Step::CHOOSE_FIRST + number))?;
                        match self.claim(claim, times) {
                            // A motion can be proved free nearer to a set than a certificate shows: another part may be farther, or
                            // this one in a half.
                            Err(Stop::Near(_)) if self.failures < MAX_FAILURES => {
                                self.failures += 1;
                                self.steps.truncate(before[0]);
                                self.entries.truncate(before[1]);
                            }
                            done => return done,
                        }
                    }
                }
                let Some(halves) = halves_of_time(times) else {
                    return Err(match refused {
                        Some(error) => Stop::Error(error.clone()),
                        None => Stop::Near(times),
                    });
                };
                self.push(Step::HALVE_TIME)?;
                halves
                    .into_iter()
                    .try_for_each(|half| self.claim(claim, half))
            }
            Claim::Item(item) => {
                let groups = item.whole();
                let part = &Part { groups, times };
                let start = match &item.what {
                    What::Bodies(sides) => self.measure.between_centers(sides, part)?,
                    _ => None,
                };
                self.part(item, part, start)?;
                match self.measure.is_outside(item, times[0])? {
                    true => Ok(()),
                    false => Err(Stop::Near([times[0]; 2])),
                }
            }
        }
    }

    /// Whether the motion keeps out of a part of an intersection over an interval.
    fn is_free(&mut self, part: &Alternative, [start, end]: [f64; 2]) -> Searched<bool> {
        let Some(set) = &part.set else {
            return Ok(false);
        };
        let options = MotionOptions {
            tolerance: 1.0,
            any_contact: true,
            ..*self.options
        };
        let [q, reached] = [start, end].map(|time| self.measure.configuration(time));
        let found = (self.context).motion_between_in(self.world, set, [&q, &reached], &options)?;
        match found.outcome {
            MotionOutcome::Undecided => Err(Stop::Exceeded),
            outcome => Ok(outcome == MotionOutcome::Free),
        }
    }

    /// Shows an item for two groups of primitives over an interval. `hint` is a direction that may part them.
    fn part(&mut self, item: &Item, part: &Part, hint: Option<Along>) -> Searched<()> {
        let meter = self.context.scratch.meter_mut();
        meter.count_nodes(1);
        meter.count_primitives(part.groups.iter().map(|group| u64::from(group[1])).sum());
        if meter.is_exceeded() {
            return Err(Stop::Exceeded);
        }
        let What::Bodies(sides) = &item.what else {
            let direction = match &item.what {
                What::Plane { normal, .. } => *normal,
                _ => Vec3::zeros(),
            };
            let along = Along {
                carrier: 1,
                direction,
            };
            return match self.entry(item, part, &along)? {
                None => Ok(()),
                Some(_) => self.halve_time(item, part, None),
            };
        };
        let mut best: Option<(f64, Along)> = None;
        for attempt in 0..3 {
            let along = match attempt {
                0 => hint,
                _ => self.measure.parting(sides, part, 2 - attempt)?,
            };
            let Some(along) = along else {
                continue;
            };
            match self.entry(item, part, &along)? {
                None => return Ok(()),
                Some(left) if best.is_none_or(|(most, _)| left > most) => {
                    best = Some((left, along));
                }
                Some(_) => {}
            }
        }
        let hint = best.map(|(_, along)| along);
        let left = best.map_or(f64::NEG_INFINITY, |(left, _)| left);
        match self.side_to_halve(item, sides, part, left)? {
            None => self.halve_time(item, part, hint),
            Some((side, halves)) => {
                self.push([Step::HALVE_FIRST, Step::HALVE_SECOND][side])?;
                halves.into_iter().try_for_each(|half| {
                    let mut groups = part.groups;
                    groups[side] = half;
                    self.part(item, &Part { groups, ..*part }, hint)
                })
            }
        }
    }

    fn halve_time(&mut self, item: &Item, part: &Part, hint: Option<Along>) -> Searched<()> {
        let Some(halves) = halves_of_time(part.times) else {
            return Err(Stop::Near(part.times));
        };
        self.push(Step::HALVE_TIME)?;
        halves
            .into_iter()
            .try_for_each(|times| self.part(item, &Part { times, ..*part }, hint))
    }

    /// Adds an entry along a direction, or says what it leaves of the limit.
    fn entry(&mut self, item: &Item, part: &Part, along: &Along) -> Searched<Option<f64>> {
        let found = self.measure.of(item, part, along)?;
        // A little less than what is true, so that the last digits of another computer do not matter.
        let entry = Entry {
            item: item.number,
            links: item.links(),
            bodies: item.bodies(),
            groups: part.groups,
            times: part.times,
            carrier: along.carrier as u32,
            direction: along.direction.into(),
            gap: (found.gap - found.rounding).min(LARGEST_COORDINATE),
            displacement: found.displacement * (1.0 + 1e-12),
        };
        if !entry.is_enough_for(item) {
            return Ok(Some(entry.gap - entry.displacement - item.limit));
        }
        self.push(Step::PROVED)?;
        self.entries.push(entry);
        Ok(None)
    }

    /// Whether a group is to be halved instead of the interval: which, and its halves. `left` is the largest gap found, less the
    /// limit.
    fn side_to_halve(
        &mut self,
        item: &Item,
        sides: &[Carried; 2],
        part: &Part,
        left: f64,
    ) -> Searched<Option<(usize, [[u32; 2]; 2])>> {
        let halves = part.groups.map(halves_of_group);
        let middle = 0.5 * (part.times[0] + part.times[1]);
        let mut sizes = [0.0; 2];
        let mut ways = [Vec3::zeros(); 2];
        for side in 0..2 {
            let group = self.measure.group(&sides[side], part.groups[side]);
            let center = group.center();
            let own = sides[side].pose.transform_point(&center);
            sizes[side] = group.radius(&sides[side].pose, &own);
            let [start, end] = part
                .times
                .map(|time| self.measure.place(&sides[side], time));
            ways[side] = end?.transform_point(&center) - start?.transform_point(&center);
        }
        let larger = usize::from(sizes[1] > sizes[0]);
        let Some(side) = [larger, 1 - larger]
            .into_iter()
            .find(|side| halves[*side].is_some())
        else {
            return Ok(None);
        };
        let apart = self.measure.distance(sides, part, middle)? - item.limit;
        let passes_by = (ways[0] - ways[1]).norm() > sizes[0] + sizes[1];
        let is_time_better = passes_by || (apart > 0.0 && apart - left <= MAX_LOSS * apart);
        Ok(halves[side]
            .filter(|_| !is_time_better)
            .map(|halves| (side, halves)))
    }
}
