//! Environments: the s-objects, added, moved and deleted (§2.2.4, operation 2).

#[allow(clippy::module_inception)]
mod environment;
mod object_tree;
mod snapshot;

pub use environment::{Change, Environment};
pub use object_tree::{Bounds, Named, NearScratch, ObjectTree};
pub use snapshot::{SObject, Snapshot};
