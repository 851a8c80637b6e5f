//! Collapses a binary tree into a tree with up to eight children per node, at the least expected cost: dynamic programming
//! over the number of nodes that represent a subtree.

use crate::hierarchy::{Node, SubsetTree};

/// The fan-out of a wide node.
const MAX_BELOW: usize = 8;

/// For each node and each count up to eight, how the subtree is best cut into at most that many wide nodes and leaves.
pub struct Cuts {
    /// How many of them the first child gets; 0 if the whole subtree becomes one wide node.
    first: Vec<[u8; MAX_BELOW + 1]>,
}

impl Cuts {
    /// Computes the cuts of a tree; `radius` gives the radius of a node.
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
            // A wide node is visited about in proportion to its surface; the constant charges for its memory.
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

    /// The nodes that become the children of the wide node at `node`, in tree order.
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
