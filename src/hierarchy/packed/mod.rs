//! The packed tree that queries traverse: up to eight children per node, packed boxes, the primitives in leaf order.

mod binary_sets;
mod cloud;
mod eight_below;
mod packed_groups;
mod packed_parts;
mod packed_primitives;
mod packed_refit;
mod packed_tree;
mod packed_wrappers;
mod wide_plans;

pub use cloud::{build_cloud, is_cloud, regroup};
pub use packed_groups::pack_groups;
pub use packed_parts::{PackedPart, TopLeaf, pack_parts};
pub use packed_primitives::PackedPrimitives;
pub use packed_refit::refit;
pub use packed_tree::{Children, NodeRef, PackedTree, power_of_two_above};
pub use packed_wrappers::pack_wrappers;
