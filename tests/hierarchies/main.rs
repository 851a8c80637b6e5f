//! Hierarchies: how they are built, what they hold, that answers do not depend on them.

mod box_tree;
mod clouds;
mod gap_to_center;
#[allow(clippy::module_inception)]
mod hierarchies;
mod hierarchy_answers;
mod hierarchy_levels;
