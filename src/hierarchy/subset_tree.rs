//! The binary tree of sets of primitives (§3.1.3).

/// A node: a leaf holds one primitive, an interior node has two children. Slender primitives may have several leaves, each
/// of which bounds a part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    Leaf { primitive: u32 },
    Interior { children: [u32; 2] },
}

/// The tree in depth-first order: the root is node 0, a first child follows its parent, the second one all of the first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SubsetTree {
    pub nodes: Vec<Node>,
}

impl SubsetTree {
    /// The number of levels: 1 for a single leaf.
    pub fn depth(&self) -> usize {
        self.levels().into_iter().max().unwrap_or(0) as usize + 1
    }

    /// The level of each node; the root's is 0.
    pub fn levels(&self) -> Vec<u32> {
        let mut levels = vec![0; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            if let Node::Interior { children } = node {
                for &child in children {
                    levels[child as usize] = levels[i] + 1;
                }
            }
        }
        levels
    }

    /// The number of nodes of each subtree.
    pub fn sizes(&self) -> Vec<u32> {
        let mut sizes = vec![1; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate().rev() {
            if let Node::Interior { children: [a, b] } = *node {
                sizes[i] = 1 + sizes[a as usize] + sizes[b as usize];
            }
        }
        sizes
    }
}
