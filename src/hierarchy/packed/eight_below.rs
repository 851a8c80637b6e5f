//! Which nodes of a binary tree become the nodes of a tree with eight children a node: those of least expected cost, by
//! dynamic programming over how many nodes may stand for a subtree.

use crate::hierarchy::{Node, SubsetTree};

const MAX_BELOW: usize = 8;

/// For each node and each count up to eight, how the subtree is best cut into at most so many wide nodes and leaves.
pub struct Cuts {
    /// How many of them the first child gets; 0 where the subtree stands whole, as one wide node.
    first: Vec<[u8; MAX_BELOW + 1]>,
}

impl Cuts {
    /// Of a tree whose nodes' radii are given.
    pub fn of(tree: &SubsetTree, radius: impl Fn(u32) -> f64) -> Self {
        let count = tree.nodes.len();
        let whole_radius = radius(0).max(f64::MIN_POSITIVE);
        let mut first = vec![[0; MAX_BELOW + 1]; count];
        let mut costs = vec![[0.0f32; MAX_BELOW + 1]; count];
        for node in (0..count).rev() {
            let Node::Interior { children: [a, b] } = tree.nodes[node] else {
                continue;
            };
            let (a, b) = (costs[a as usize], costs[b as usize]);
            let mut own = [f32::INFINITY; MAX_BELOW + 1];
            for total in 2..=MAX_BELOW {
                for part in 1..total {
                    let cost = a[part] + b[total - part];
                    if cost < own[total] {
                        own[total] = cost;
                        first[node][total] = part as u8;
                    }
                }
            }
            // A wide node is visited about as often as its surface is large, and takes memory at any size.
            let radius = (radius(node as u32) / whole_radius) as f32;
            let whole = radius * radius + 1e-6 + own[MAX_BELOW];
            costs[node] = own.map(|cost| cost.min(whole));
            costs[node][0] = f32::INFINITY;
            for total in 1..MAX_BELOW {
                if own[total] >= whole {
                    first[node][total] = 0;
                }
            }
        }
        Self { first }
    }

    /// The nodes that become the children of a wide node, in the order of the tree.
    pub fn below(&self, tree: &SubsetTree, node: u32) -> Vec<u32> {
        let mut below = Vec::with_capacity(MAX_BELOW);
        let mut open = Vec::with_capacity(MAX_BELOW);
        if let Node::Interior { children: [a, b] } = tree.nodes[node as usize] {
            let part = self.first[node as usize][MAX_BELOW];
            open.extend([(b, MAX_BELOW as u8 - part), (a, part)]);
        }
        while let Some((node, total)) = open.pop() {
            match (
                tree.nodes[node as usize],
                self.first[node as usize][total as usize],
            ) {
                (Node::Interior { children: [a, b] }, part) if part > 0 => {
                    open.extend([(b, total - part), (a, part)]);
                }
                _ => below.push(node),
            }
        }
        below
    }
}
