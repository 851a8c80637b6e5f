//! What a call of a batch is given, and what it tells.

use super::options::BatchOptions;
use crate::error::{Error, Result};
use crate::query::World;

/// One call of a batch, whatever it asks.
pub struct BatchJob<'a, S> {
    /// How it is worked off.
    pub options: &'a BatchOptions,
    /// Where the answers go.
    pub slots: S,
    /// Called on the caller's thread with the fraction done, between items and while other threads work; an error ends the batch.
    pub progress: &'a mut dyn FnMut(f64) -> Result<()>,
}

/// How a batch ended. All items were answered or failed, but for those after the first hit if it stopped there, and those that were not
/// reached where progress ended it.
#[derive(Clone, Debug)]
pub struct BatchSummary {
    /// The first item with a hit: what is inside, within, at distance 0, or a motion not proved free. Known only where the batch was to
    /// stop there.
    pub first_hit: Option<usize>,
    /// The first item that failed, with its error.
    pub first_failure: Option<(usize, Error)>,
    /// The largest version of the environments that all items saw; 0 without an environment.
    pub version: u64,
    /// The error by which progress ended the batch; no first hit is known then.
    pub end: Option<Error>,
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
