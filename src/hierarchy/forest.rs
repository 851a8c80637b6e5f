//! The parentless bodies of the grouping phase and the trees below them.

use super::{Extent, Node, SubsetTree};
use crate::pose::Vec3;

/// Bodies as they are made: the first `leaves` are the leaves, each later one has two children made before it.
#[derive(Debug)]
pub struct Forest {
    pub leaves: usize,
    pub extents: Vec<Extent>,
    /// Diameters of the extents, at least a tiny part of the whole's so that ratios are finite.
    pub diameters: Vec<f64>,
    pub children: Vec<[u32; 2]>,
    smallest: f64,
}

impl Forest {
    pub fn new(leaves: Vec<Extent>) -> Self {
        let all = leaves
            .iter()
            .fold(leaves[0], |all, extent| all.union(extent));
        let smallest = (1e-9 * all.diameter()).max(f64::MIN_POSITIVE.sqrt());
        let mut forest = Self {
            leaves: leaves.len(),
            diameters: Vec::with_capacity(2 * leaves.len()),
            extents: leaves,
            children: Vec::new(),
            smallest,
        };
        forest.extents.reserve(forest.leaves);
        forest.children.reserve(forest.leaves);
        for i in 0..forest.leaves {
            let diameter = forest.measure(&forest.extents[i]);
            forest.diameters.push(diameter);
        }
        forest
    }

    fn measure(&self, extent: &Extent) -> f64 {
        extent.diameter().max(self.smallest)
    }

    /// Gives two bodies a parent.
    pub fn merge(&mut self, a: u32, b: u32) -> u32 {
        let extent = self.extents[a as usize].union(&self.extents[b as usize]);
        self.diameters.push(self.measure(&extent));
        self.extents.push(extent);
        self.children.push([a.min(b), a.max(b)]);
        (self.extents.len() - 1) as u32
    }

    pub fn center(&self, body: u32) -> Vec3 {
        self.extents[body as usize].center()
    }

    /// The tree under `root` in depth-first order, leaf i renamed to `names[i]`.
    pub fn into_tree(self, root: u32, names: &[u32]) -> SubsetTree {
        let mut nodes = Vec::with_capacity(2 * self.leaves - 1);
        // A body and, but for the root, its parent's place and its own among the children.
        let mut stack = vec![(root, None)];
        while let Some((body, place)) = stack.pop() {
            let index = nodes.len() as u32;
            if let Some((parent, side)) = place {
                let parent: usize = parent;
                if let Node::Interior { children } = &mut nodes[parent] {
                    let side: usize = side;
                    children[side] = index;
                }
            }
            if (body as usize) < self.leaves {
                nodes.push(Node::Leaf {
                    part: names[body as usize],
                });
            } else {
                nodes.push(Node::Interior { children: [0; 2] });
                let [first, second] = self.children[body as usize - self.leaves];
                stack.push((second, Some((index as usize, 1))));
                stack.push((first, Some((index as usize, 0))));
            }
        }
        SubsetTree { nodes }
    }
}
