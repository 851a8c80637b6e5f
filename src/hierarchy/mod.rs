//! Hierarchies: the tree of sets over a body's primitives, and the same tree with a convex wrapper at each node (§3).

mod ball;
mod build;
mod composed;
mod extremes;
mod gap_to_center;
#[doc(hidden)]
pub mod grouping;
mod levels;
mod options;
#[doc(hidden)]
pub mod packed;
mod parallel;
mod refit;
mod statistics;
mod subset_tree;
#[doc(hidden)]
pub mod wrapper;

pub use ball::Ball;
pub use build::{BuildTimes, Hierarchy, build_hierarchy};
pub use composed::{PartHierarchy, compose_hierarchy};
pub use extremes::{extremes, few_extremes};
#[doc(hidden)]
pub use gap_to_center::gap_to_center;
pub use options::{Grouping, HierarchyOptions, Pieces, WrapperKind};
pub use parallel::Progress;
pub use refit::refit_hierarchy;
pub use statistics::{LevelStatistics, TreeStatistics, of_extents, require_level};
pub use subset_tree::{Node, SubsetTree};
