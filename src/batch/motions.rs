//! Batches of straight motions.

use super::batch::Batch;
use super::configurations::Configurations;
use super::job::{BatchJob, BatchSummary, ItemAnswer};
use super::slots::Slots;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{MotionAnswer, MotionOptions, MotionOutcome};
use crate::query::{QueryContext, World};

/// A thread is begun for each motion: one takes longer than to begin a thread.
const PER_THREAD: usize = 1;

/// Motions, each from a start to the end of the same number.
#[derive(Clone, Copy, Debug)]
pub struct Segments<'a> {
    /// The starts.
    pub starts: Configurations<'a>,
    /// As many ends. They may share their array with the starts: those of a path are its points but for the first.
    pub ends: Configurations<'a>,
}

impl Batch {
    /// Whether each motion keeps clear of a C-object: proved, or its first contact. What is not proved free is a hit.
    pub fn motion<S: Slots>(
        &mut self,
        cobject: &CObject,
        segments: Segments,
        options: &MotionOptions,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<MotionAnswer>) + Sync,
    ) -> Result<BatchSummary> {
        let Segments { starts, ends } = segments;
        starts.check(cobject, "q0")?;
        ends.check(cobject, "q1")?;
        if starts.count != ends.count {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!("{} starts cannot have {} ends", starts.count, ends.count),
            ));
        }
        options.check_for(cobject)?;
        let world = &World::of(cobject);
        let ask = |context: &mut QueryContext, item| {
            let ends = [starts.at(item), ends.at(item)];
            let found = context.motion_between_in(world, cobject, ends, options);
            let answer = MotionAnswer::or_undecided(found, || ends[0].to_vec())?;
            let is_hit = answer.outcome != MotionOutcome::Free;
            Ok((answer, is_hit))
        };
        let done = self.answer_each(job, starts.count, PER_THREAD, ask, put)?;
        Ok(done.in_world(world))
    }
}
