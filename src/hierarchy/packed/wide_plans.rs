//! The wide nodes of a tree, planned before their boxes are fitted, so that several threads can fit them.

use super::packed_tree::PackedTree;
use crate::boxes::{ChildPoints, WideNode};
use crate::error::Result;
use crate::hierarchy::{Progress, parallel};

/// Wide nodes that a thread makes at a time.
const TASK: usize = 256;

/// A tree of sets, each of one leaf or with up to eight sets below it.
pub trait SetTree: Sync {
    type Set: Clone + Sync;

    fn whole(&self) -> Self::Set;

    fn is_leaf(&self, set: &Self::Set) -> bool;

    /// The sets below one that is no leaf, two to eight of them, in the order of the leaves.
    fn below(&self, set: &Self::Set) -> Vec<Self::Set>;

    /// What the box of a set is to hold, in units of the packed tree.
    fn held(&self, set: &Self::Set) -> ChildPoints<'_>;
}

/// A wide node to be made: its children, and what they will be called.
struct Plan<Set> {
    children: Vec<Set>,
    names: [u32; 8],
}

/// The wide nodes of a tree, each before its children; the first has one child, the root. Leaves are called by their order.
pub fn wide_nodes<T: SetTree>(
    tree: &T,
    threads: usize,
    progress: &mut Progress,
) -> Result<Vec<WideNode>> {
    let plans = plans(tree);
    progress.at(0.1)?;
    let tasks = plans.len().div_ceil(TASK);
    let made = parallel::map(threads, tasks, &mut progress.part(0.1, 1.0), |t| {
        let tasks = plans[t * TASK..].iter().take(TASK);
        tasks.map(|plan| fitted(tree, plan)).collect::<Vec<_>>()
    })?;
    let mut nodes = Vec::with_capacity(plans.len());
    nodes.extend(made.into_iter().flatten());
    Ok(nodes)
}

fn plans<T: SetTree>(tree: &T) -> Vec<Plan<T::Set>> {
    let mut plans = vec![Plan {
        children: vec![tree.whole()],
        names: [0; 8],
    }];
    let mut leaves = 0;
    let mut open = vec![(tree.whole(), 0, 0)];
    while let Some((set, above, lane)) = open.pop() {
        plans[above].names[lane] = if tree.is_leaf(&set) {
            leaves += 1;
            PackedTree::leaf(leaves - 1)
        } else {
            let index = plans.len();
            let children = tree.below(&set);
            let named = children.iter().cloned().enumerate();
            open.extend(named.rev().map(|(lane, child)| (child, index, lane)));
            plans.push(Plan {
                children,
                names: [0; 8],
            });
            index as u32
        };
    }
    plans
}

fn fitted<T: SetTree>(tree: &T, plan: &Plan<T::Set>) -> WideNode {
    let held: Vec<ChildPoints> = plan.children.iter().map(|set| tree.held(set)).collect();
    let mut node = WideNode::new(&held);
    node.children = plan.names;
    node
}
