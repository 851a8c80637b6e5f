//! Environments: the s-objects, added, moved and deleted (§2.2.4, operation 2).

mod attachment;
pub mod box_tree;
#[allow(clippy::module_inception)]
mod environment;
mod near_pairs;
mod object_tree;
mod places;
mod snapshot;
mod tree_limits;
mod visit_near;

pub use attachment::Attachment;
pub use environment::{Addition, Change, Environment};
pub use near_pairs::NearPairScratch;
pub use object_tree::ObjectTree;
pub use places::SObject;
pub use snapshot::Snapshot;
pub use visit_near::NearScratch;
