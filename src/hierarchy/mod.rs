//! Hierarchies: the tree of sets over a body's primitives, and the same tree with a convex wrapper at each node (§3).

mod median_split;
mod oriented_box;
mod subset_tree;
mod wrapper;
mod wrapper_tree;

pub use median_split::split_by_median;
pub use subset_tree::{Node, SubsetTree};
pub use wrapper::{Wrapper, cover};
pub use wrapper_tree::WrapperTree;
