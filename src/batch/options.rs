//! How a batch is worked off.

use crate::error::{Error, Result};

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
