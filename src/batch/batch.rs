//! A batch: what its threads keep from one call to the next.

use super::worker::Worker;
use crate::work_meter::Statistics;

/// The caches and the scratch memory of a batch's threads, kept from one call to the next: a call that is like the last allocates
/// nothing for its items. They change how long answers take, never the answers.
#[derive(Default)]
pub struct Batch {
    pub(super) workers: Vec<Worker>,
}

impl Batch {
    /// A batch that remembers nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The work of all threads since the batch was made or last reset.
    pub fn statistics(&self) -> Statistics {
        let all = self
            .workers
            .iter()
            .map(|worker| worker.context.statistics());
        all.fold(Statistics::default(), |sum, one| Statistics {
            node_pairs: sum.node_pairs + one.node_pairs,
            primitive_pairs: sum.primitive_pairs + one.primitive_pairs,
            primitive_distances: sum.primitive_distances + one.primitive_distances,
            cache_hits: sum.cache_hits + one.cache_hits,
        })
    }

    /// Sets the statistics to 0.
    pub fn reset_statistics(&mut self) {
        let contexts = self.workers.iter_mut();
        contexts.for_each(|worker| worker.context.reset_statistics());
    }
}
