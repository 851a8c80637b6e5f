//! Many questions in one call, on several threads, in one state of the world: answers in order of the items, equal to those of single
//! queries bit for bit.

#[allow(clippy::module_inception)]
mod batch;
mod configurations;
mod job;
mod motions;
mod options;
mod pairs;
mod run;
mod slots;
mod worker;

pub use batch::Batch;
pub use configurations::Configurations;
pub use job::{BatchJob, BatchSummary, ItemAnswer};
pub use motions::Segments;
pub use options::BatchOptions;
pub use pairs::PosePairs;
pub use slots::Slots;
