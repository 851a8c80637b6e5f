//! The dynamic tree over the boxes of s-objects: an R-tree with up to eight children per node.

mod box_split;
#[allow(clippy::module_inception)]
mod box_tree;
mod changes;
mod four_boxes;
mod medians;
mod oriented_box;
mod refit;

pub use box_tree::{BOX, BoxTree, Boxes};
pub use changes::BoxTreeChanges;
pub use oriented_box::OrientedBox;
