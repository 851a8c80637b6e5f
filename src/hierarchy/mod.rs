//! Hierarchies: the tree of sets over a body's primitives, and the same tree with a convex wrapper at each node (§3).

mod adjacent;
mod binned_split;
mod bounding_sphere;
mod build;
mod cost;
mod cover;
mod extent;
mod extremes;
mod forest;
mod greedy_clustering;
mod grouping;
mod levels;
mod nearby;
mod options;
mod oriented_box;
mod parallel;
mod parts;
mod rebalancing;
mod statistics;
mod subset_tree;
mod wrapper;
mod wrapper_shape;
mod wrapper_tree;

pub use build::{BuildTimes, build_hierarchy};
pub use cost::Cost;
pub use extent::Extent;
use forest::Forest;
pub use options::{Grouping, HierarchyOptions, Pieces, WrapperKind};
pub use statistics::{LevelStatistics, TreeStatistics};
pub use subset_tree::{Node, SubsetTree};
pub use wrapper::Wrapper;
pub use wrapper_shape::Surface;
pub use wrapper_tree::{Frame, WrapperTree};
