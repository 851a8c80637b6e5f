//! Paths: polylines through configurations, each segment a motion, all in one state of the world.

use super::motion::MotionOptions;
use super::motion_answer::{MotionAnswer, MotionOutcome};
use super::way::Way;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result};
use crate::query::{QueryContext, World};
use crate::space::Space;

/// What was found of a path.
#[derive(Clone, Debug)]
pub struct PathAnswer {
    /// The number of the segment that the answer is about, from 0: the first that is not proved free, or the one with the contact
    /// if any contact was asked for. The last segment of a path that is free.
    pub segment: usize,
    /// The answer of that segment, with times from 0 to 1 within it.
    pub motion: MotionAnswer,
}

/// A path among obstacles.
pub(super) struct Path<'a> {
    pub world: &'a World,
    pub cobject: &'a CObject,
    /// Checked, one configuration after the other, at least one.
    pub points: &'a [f64],
}

/// The number of points; each is checked.
pub(super) fn checked_count(space: &Space, points: &[f64]) -> Result<usize> {
    let nq = space.nq();
    // A space without coordinates has one configuration.
    let count = points.len().checked_div(nq).unwrap_or(1);
    if count == 0 || points.len() != count * nq {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "the path has {} numbers, which are not one or more points of {nq} coordinates",
                points.len()
            ),
        ));
    }
    for i in 0..count {
        space
            .check_configuration(&points[i * nq..(i + 1) * nq])
            .map_err(|error| error.within(format_args!("point {i}")))?;
    }
    Ok(count)
}

impl Path<'_> {
    pub fn point(&self, number: usize) -> &[f64] {
        let nq = self.cobject.space().nq();
        &self.points[number * nq..(number + 1) * nq]
    }

    /// A single point is a segment that rests.
    pub fn segment_count(&self) -> usize {
        let nq = self.cobject.space().nq();
        let count = self.points.len().checked_div(nq).unwrap_or(1);
        (count - 1).max(1)
    }

    /// Asks about a segment.
    pub fn ask<T>(&self, segment: usize, query: impl FnOnce(&Way) -> Result<T>) -> Result<T> {
        let &Self { world, cobject, .. } = self;
        let space = cobject.space();
        let q = self.point(segment);
        let rests = self.points.len() == space.nq();
        let end = self.point(if rests { segment } else { segment + 1 });
        let answer = Way::between(world, cobject, [q, end], query);
        answer.map_err(|error| error.within(format_args!("segment {segment}")))
    }
}

/// The numbers below `count`, those that lie far apart first.
fn coarse_to_fine(count: usize) -> impl Iterator<Item = usize> {
    let half = |stride: usize| (stride > 1).then_some(stride / 2);
    let strides = std::iter::successors(half(count.next_power_of_two()), move |s| half(*s));
    let odd_multiples = move |stride: usize| (stride..count).step_by(2 * stride);
    std::iter::once(0).chain(strides.flat_map(odd_multiples))
}

impl QueryContext {
    /// Whether a path keeps clear of a C-object: proved for all its segments, or its first contact. `points` holds one
    /// configuration after the other; of a single one the answer tells its own contact. The tolerance of `options` is of each
    /// segment's time.
    ///
    /// Any contact, if asked for, is looked for at the points and at the middles of the segments before anything is proved. The
    /// limit of work counts for the whole path; where it ends the work, the answer is undecided. `progress` receives the fraction
    /// done before each of these configurations and before each segment, and 1 at the end; it may stop the work with an error.
    pub fn motion_path(
        &mut self,
        cobject: &CObject,
        points: &[f64],
        options: &MotionOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<PathAnswer> {
        checked_count(cobject.space(), points)?;
        let world = &self.begin_motion(cobject, options)?;
        let path = Path {
            world,
            cobject,
            points,
        };
        let segments = path.segment_count();
        let samples = if options.any_contact {
            2 * segments + 1
        } else {
            0
        };
        let mut done = 0;
        let mut step = || {
            progress(done as f64 / (samples + segments) as f64)?;
            done += 1;
            Ok(())
        };
        let mut found = None;
        if options.any_contact {
            found = self.sampled_contact(&path, options, samples, &mut step)?;
        }
        let answer = match found {
            Some(found) => found,
            None => self.prove_segments(&path, options, &mut step)?,
        };
        progress(1.0)?;
        Ok(answer)
    }

    /// A contact at the points or at the middles of the segments: of the samples, even ones are points.
    fn sampled_contact(
        &mut self,
        path: &Path,
        options: &MotionOptions,
        samples: usize,
        step: &mut dyn FnMut() -> Result<()>,
    ) -> Result<Option<PathAnswer>> {
        for sample in coarse_to_fine(samples) {
            step()?;
            let segment = (sample / 2).min(path.segment_count() - 1);
            let t = 0.5 * (sample - 2 * segment) as f64;
            let found = path.ask(segment, |way| self.contact_at(way, t, options));
            match found {
                Ok(None) => {}
                Ok(Some(motion)) => return Ok(Some(PathAnswer { segment, motion })),
                Err(error) if error.kind == ErrorKind::Limit => {
                    return Ok(Some(PathAnswer {
                        segment: 0,
                        motion: MotionAnswer::undecided(0.0, path.point(0).to_vec()),
                    }));
                }
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Proves one segment after the other, up to the first that is not free.
    pub(super) fn prove_segments(
        &mut self,
        path: &Path,
        options: &MotionOptions,
        step: &mut dyn FnMut() -> Result<()>,
    ) -> Result<PathAnswer> {
        let mut segment = 0;
        loop {
            step()?;
            let found = path.ask(segment, |way| self.motion_on(way, options));
            let motion = MotionAnswer::or_undecided(found, || path.point(segment).to_vec())?;
            if motion.outcome != MotionOutcome::Free || segment + 1 == path.segment_count() {
                return Ok(PathAnswer { segment, motion });
            }
            segment += 1;
        }
    }
}
