//! The binary tree of sets of primitives (§3.1.3).

/// A node: a leaf holds one primitive, an interior node has two children.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    Leaf { primitive: u32 },
    Interior { children: [u32; 2] },
}

/// The tree in depth-first order: the root is node 0, children follow their parents.
#[derive(Clone, Debug, Default)]
pub struct SubsetTree {
    pub nodes: Vec<Node>,
}

impl SubsetTree {
    /// The number of levels: 1 for a single leaf.
    pub fn depth(&self) -> usize {
        let mut depths = vec![1usize; self.nodes.len()];
        let mut deepest = 0;
        for (i, node) in self.nodes.iter().enumerate() {
            deepest = deepest.max(depths[i]);
            if let Node::Interior { children } = node {
                for &child in children {
                    depths[child as usize] = depths[i] + 1;
                }
            }
        }
        deepest
    }
}
