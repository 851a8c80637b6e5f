//! The binary tree of sets of primitives (§3.1.3).

/// A node: a leaf holds one primitive, an interior node has two children. Slender primitives may have several leaves, each
/// of which bounds a part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// A leaf.
    Leaf {
        /// Index of the primitive that it bounds, whole or in part.
        primitive: u32,
    },
    /// An interior node.
    Interior {
        /// Indices of the two children.
        children: [u32; 2],
    },
}

/// The tree in depth-first order: the root is node 0, a first child follows its parent, a second child follows the subtree
/// of the first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SubsetTree {
    /// The nodes in depth-first order.
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

    /// Whether the nodes are one tree in depth-first order over the given number of primitives, each in at least one leaf.
    pub fn is_sound(&self, primitives: usize) -> bool {
        let count = self.nodes.len();
        let mut sizes = vec![1usize; count];
        let mut seen = vec![false; primitives];
        for (i, node) in self.nodes.iter().enumerate().rev() {
            match *node {
                Node::Leaf { primitive } => match seen.get_mut(primitive as usize) {
                    Some(seen) => *seen = true,
                    None => return false,
                },
                Node::Interior { children: [a, b] } => {
                    let (a, b) = (a as usize, b as usize);
                    if a != i + 1 || b >= count || a >= count || b != a + sizes[a] {
                        return false;
                    }
                    sizes[i] = 1 + sizes[a] + sizes[b];
                }
            }
        }
        sizes.first() == Some(&count) && seen.iter().all(|&seen| seen)
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
