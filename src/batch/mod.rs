//! Many questions in one call, on several threads, in one state of the world: answers in order of the items, equal to those of single
//! queries bit for bit.

#[allow(clippy::module_inception)]
mod batch;
mod configurations;
mod motions;
mod pairs;
mod slots;
mod workers;

pub use batch::{Batch, BatchJob, BatchOptions, BatchSummary, ItemAnswer};
pub use configurations::Configurations;
pub use motions::Segments;
pub use pairs::PosePairs;
pub use slots::Slots;
