//! A batch: what its threads keep from one call to the next, and what each call is given and tells.

use super::workers::Worker;
use crate::error::{Error, Result};
use crate::query::World;
use crate::work_meter::Statistics;

/// How a batch is worked off. Answers depend on `limit` alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct BatchOptions {
    /// The number of threads, that of the caller among them, at most 1024; 0 for the machine's available parallelism.
    pub threads: u32,
    /// Ends the batch at its first hit: all items before it are answered, none after it is.
    pub stop_at_hit: bool,
    /// The most node pairs and primitive pairs that an item may test. With a limit, each item is asked as by a new context: its
    /// work, and whether it reaches the limit, does not depend on other items.
    pub limit: Option<u64>,
}

impl BatchOptions {
    /// How many threads work on so many items, of which each is to have a few.
    pub(super) fn thread_count(&self, items: usize, items_per_thread: usize) -> Result<usize> {
        if self.threads > 1024 {
            return Err(Error::invalid(format!(
                "threads must be at most 1024, not {}",
                self.threads
            )));
        }
        let threads = match self.threads {
            0 => std::thread::available_parallelism().map_or(1, |count| count.get()),
            count => count as usize,
        };
        Ok(threads.min(items.div_ceil(items_per_thread)).max(1))
    }
}

/// One call of a batch, whatever it asks.
pub struct BatchJob<'a, S> {
    /// How it is worked off.
    pub options: &'a BatchOptions,
    /// Where the answers go.
    pub slots: S,
    /// Called on the caller's thread with the fraction done; an error ends the batch and is its answer.
    pub progress: &'a mut dyn FnMut(f64) -> Result<()>,
}

/// How a batch ended. All items were answered or failed, but for those after the first hit if it stopped there.
#[derive(Clone, Debug)]
pub struct BatchSummary {
    /// The first item with a hit: what is inside, within, at distance 0, or a motion not proved free. Known only where the batch was to
    /// stop there.
    pub first_hit: Option<usize>,
    /// The first item that failed, with its error.
    pub first_failure: Option<(usize, Error)>,
    /// The largest version of the environments that all items saw; 0 without an environment.
    pub version: u64,
}

impl BatchSummary {
    pub(super) fn in_world(self, world: &World) -> Self {
        Self {
            version: world.version(),
            ..self
        }
    }
}

/// What became of an item: its answer, or why it has none.
pub type ItemAnswer<'e, T> = std::result::Result<T, &'e Error>;

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
