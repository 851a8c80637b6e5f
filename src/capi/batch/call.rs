//! What all batches have in common, whatever they ask.

use super::arrays::{Outcome, Outputs, Place, Statuses};
use super::batch::{Report, cstk_batch_result};
use crate::batch::{Batch, BatchJob, BatchOptions, BatchSummary, ItemAnswer};
use crate::capi::boundary::Failure;
use crate::capi::status::status::cstk_status;
use crate::error::Error;

/// A call whose batch nobody else uses.
pub struct Call<'a> {
    pub batch: &'a mut Batch,
    pub options: &'a BatchOptions,
    pub progress: &'a mut Report,
}

impl Call<'_> {
    /// Asks about `count` items, which are read from the inputs. What is written overlaps neither them nor itself.
    pub unsafe fn ask<O: Outputs>(
        self,
        count: usize,
        inputs: &[Place],
        outputs: O,
        (statuses, out): (*mut cstk_status, *mut cstk_batch_result),
        ask: impl FnOnce(&mut Batch, BatchJob<(O, Statuses)>) -> Result<BatchSummary, Error>,
    ) -> Result<(), Failure> {
        // SAFETY: as the caller states.
        let (outcome, statuses) = unsafe { Outcome::checked(statuses, count, out)? };
        outcome.require_apart(inputs, &outputs)?;
        let job = BatchJob {
            options: self.options,
            slots: (outputs, statuses),
            progress: self.progress,
        };
        outcome.write(ask(self.batch, job)?)
    }
}

/// Writes an answer and its status, or the status of what failed.
pub fn put<O, A>(
    (outputs, statuses): &mut (O, Statuses),
    item: usize,
    answer: ItemAnswer<A>,
    write: impl FnOnce(&mut O, A),
) {
    match answer {
        Ok(answer) => {
            write(outputs, answer);
            statuses.write(item, cstk_status::CSTK_OK);
        }
        Err(error) => statuses.refuse(item, error),
    }
}
