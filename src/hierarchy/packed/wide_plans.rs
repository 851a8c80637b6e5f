//! Plans the wide nodes of a tree before their boxes are fitted, so that several threads can fit the boxes.

use super::packed_tree::PackedTree;
use crate::boxes::{ChildPoints, WideNode};
use crate::error::Result;
use crate::hierarchy::{Progress, parallel};

/// Number of wide nodes that are one task of a thread.
const TASK: usize = 256;

/// A tree of sets of leaves: a set is one leaf, or has up to eight child sets.
pub trait LeafSets: Sync {
    type Set: Clone + Sync;

    fn whole(&self) -> Self::Set;

    fn is_leaf(&self, set: &Self::Set) -> bool;

    /// The child sets of a set that is no leaf, two to eight of them, in leaf order.
    fn below(&self, set: &Self::Set) -> Vec<Self::Set>;

    /// The points that the box of a set bounds, in units of the packed tree.
    fn child_points(&self, set: &Self::Set) -> ChildPoints<'_>;
}

/// A wide node whose boxes are still to be fitted.
struct Plan<Set> {
    children: Vec<Set>,
    /// The entries of `WideNode::children`.
    links: [u32; 8],
}

/// The wide nodes of a tree, each before its children; the first has one child, the root. Leaves are numbered in order.
pub fn wide_nodes<T: LeafSets>(
    tree: &T,
    threads: usize,
    progress: &mut Progress,
) -> Result<Vec<WideNode>> {
    let plans = plans(tree);
    progress.at(0.1)?;
    let tasks = plans.len().div_ceil(TASK);
    let fitted = parallel::map(threads, tasks, &mut progress.part(0.1, 1.0), |t| {
        let tasks = plans[t * TASK..].iter().take(TASK);
        tasks.map(|plan| fit(tree, plan)).collect::<Vec<_>>()
    })?;
    let mut nodes = Vec::with_capacity(plans.len());
    nodes.extend(fitted.into_iter().flatten());
    Ok(nodes)
}

fn plans<T: LeafSets>(tree: &T) -> Vec<Plan<T::Set>> {
    let mut plans = vec![Plan {
        children: vec![tree.whole()],
        links: [0; 8],
    }];
    let mut leaves = 0;
    let mut open = vec![(tree.whole(), 0, 0)];
    while let Some((set, parent, lane)) = open.pop() {
        plans[parent].links[lane] = if tree.is_leaf(&set) {
            leaves += 1;
            PackedTree::leaf(leaves - 1)
        } else {
            let index = plans.len();
            let children = tree.below(&set);
            let lanes = children.iter().cloned().enumerate();
            open.extend(lanes.rev().map(|(lane, child)| (child, index, lane)));
            plans.push(Plan {
                children,
                links: [0; 8],
            });
            index as u32
        };
    }
    plans
}

fn fit<T: LeafSets>(tree: &T, plan: &Plan<T::Set>) -> WideNode {
    let points: Vec<ChildPoints> = plan
        .children
        .iter()
        .map(|set| tree.child_points(set))
        .collect();
    let mut node = WideNode::new(&points);
    node.children = plan.links;
    node
}
