//! The grouping phase (§3.2): decides which primitives share a subtree of the subset tree.

mod adjacent;
mod binned_split;
mod clusters;
mod convex_patches;
mod convex_pieces;
mod coplanar_pieces;
mod cost;
mod forest;
mod greedy_clustering;
#[allow(clippy::module_inception)]
mod grouping;
mod nearby;
mod parts;
mod point_groups;
mod rebalancing;
mod regions;
mod shared_edges;

pub use binned_split::{levels_for, split_within};
pub use clusters::Groups;
pub use convex_pieces::convex_pieces;
pub use cost::Cost;
pub use forest::Forest;
pub use grouping::group;
pub use parts::{Part, parts};
pub use point_groups::{PointGroups, PointSet};
