//! The parentless bodies of the grouping phase and the trees below them.

use crate::boxes::Extent;
use crate::hierarchy::{Node, SubsetTree};
use crate::pose::Vec3;

/// Bodies in order of creation: the first `leaves` are the leaves, each later one has two children created before it.
#[derive(Debug)]
pub struct Forest {
    pub leaves: usize,
    pub extents: Vec<Extent>,
    /// Diameters of the extents, at least `smallest` so that ratios are finite.
    pub diameters: Vec<f64>,
    pub children: Vec<[u32; 2]>,
    /// The floor of the diameters: 1e-9 of the whole diameter.
    pub smallest: f64,
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

    /// Gives two bodies a parent, and returns it.
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

    /// The tree under `root` in depth-first order, and the body at each of its nodes.
    pub fn into_tree(self, root: u32) -> (SubsetTree, Vec<u32>) {
        let count = 2 * self.leaves - 1;
        let (mut nodes, mut bodies) = (Vec::with_capacity(count), Vec::with_capacity(count));
        // A body and, for second children, their parent.
        let mut stack: Vec<(u32, Option<usize>)> = vec![(root, None)];
        while let Some((body, parent)) = stack.pop() {
            let index = nodes.len();
            if let Some(Node::Interior { children }) = parent.map(|parent| &mut nodes[parent]) {
                children[1] = index as u32;
            }
            bodies.push(body);
            if (body as usize) < self.leaves {
                nodes.push(Node::Leaf { primitive: body });
            } else {
                let [first, second] = self.children[body as usize - self.leaves];
                let next = index as u32 + 1;
                nodes.push(Node::Interior {
                    children: [next, next],
                });
                stack.push((second, Some(index)));
                stack.push((first, None));
            }
        }
        (SubsetTree { nodes }, bodies)
    }
}
