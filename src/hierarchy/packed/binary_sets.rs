//! The sets of a binary tree over leaves: those of its nodes that become wide ones.

use std::ops::Range;

use super::eight_below::Cuts;
use super::wide_plans::LeafSets;
use crate::boxes::ChildPoints;
use crate::hierarchy::SubsetTree;

/// What stands at the leaves.
pub trait AtLeaves: Sync {
    /// The points that the box of some leaves bounds, in units of the packed tree.
    fn child_points(&self, leaves: Range<usize>) -> ChildPoints<'_>;
}

/// The sets of a binary tree over leaves.
pub struct BinarySets<'a, L> {
    cuts: Cuts,
    /// Number of nodes of each subtree.
    sizes: Vec<u32>,
    subsets: &'a SubsetTree,
    at_leaves: L,
}

/// A node of the binary tree, and its first leaf.
#[derive(Clone, Copy)]
pub struct BinarySet {
    node: u32,
    first_leaf: usize,
}

impl<'a, L: AtLeaves> BinarySets<'a, L> {
    /// `radius` gives the radius of a node.
    pub fn new(subsets: &'a SubsetTree, radius: impl Fn(u32) -> f64, at_leaves: L) -> Self {
        Self {
            cuts: Cuts::of(subsets, radius),
            sizes: subsets.sizes(),
            subsets,
            at_leaves,
        }
    }

    fn leaves(&self, set: &BinarySet) -> Range<usize> {
        let count = (self.sizes[set.node as usize] as usize).div_ceil(2);
        set.first_leaf..set.first_leaf + count
    }
}

impl<L: AtLeaves> LeafSets for BinarySets<'_, L> {
    type Set = BinarySet;

    fn whole(&self) -> BinarySet {
        BinarySet {
            node: 0,
            first_leaf: 0,
        }
    }

    fn is_leaf(&self, set: &BinarySet) -> bool {
        self.sizes[set.node as usize] == 1
    }

    fn below(&self, set: &BinarySet) -> Vec<BinarySet> {
        let mut first_leaf = set.first_leaf;
        let nodes = self.cuts.below(self.subsets, set.node);
        let sets = nodes.into_iter().map(|node| {
            let set = BinarySet { node, first_leaf };
            first_leaf = self.leaves(&set).end;
            set
        });
        sets.collect()
    }

    fn child_points(&self, set: &BinarySet) -> ChildPoints<'_> {
        self.at_leaves.child_points(self.leaves(set))
    }
}
