//! A tree over oriented boxes, eight children a node: which of many bodies are near.

use super::binned_split::{levels_for, split_within};
use super::packed_tree::power_of_two;
use super::wide_node::{Held, WideNode};
use super::{Extent, Forest, Node, SubsetTree};
use crate::pose::{Mat3, Vec3};

/// A box around a body.
#[derive(Clone, Copy, Debug)]
pub struct OrientedBox {
    pub corners: [Vec3; 8],
    /// Orthonormal columns, that of the shortest side last.
    pub axes: Mat3,
}

/// A child that is one of the given boxes.
pub const BOX: u32 = 1 << 31;

/// Lengths are in units of `scale`, a power of two, from `center`. The children of a node are other nodes, or
/// [`BOX`] + the place of a box.
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    /// The first is the root.
    pub nodes: Vec<WideNode>,
    pub center: Vec3,
    pub scale: f64,
}

impl BoxTree {
    pub fn new(boxes: &[OrientedBox]) -> Self {
        if boxes.is_empty() {
            return Self::default();
        }
        let extents: Vec<Extent> = boxes.iter().map(|b| Extent::of(&b.corners)).collect();
        let mut forest = Forest::new(extents);
        let count = boxes.len();
        let root = split_within(&mut forest, (0..count as u32).collect(), levels_for(count));
        let all = forest.extents.clone();
        let (tree, at) = forest.into_tree(root);
        let whole = all[root as usize];
        let mut builder = Builder {
            extents: at.iter().map(|&body| all[body as usize]).collect(),
            tree,
            boxes,
            packed: Self {
                nodes: Vec::new(),
                center: whole.center(),
                scale: power_of_two(0.5 * whole.diameter()),
            },
        };
        builder.build();
        builder.packed
    }
}

struct Builder<'a> {
    tree: SubsetTree,
    /// The box of each node of the tree.
    extents: Vec<Extent>,
    boxes: &'a [OrientedBox],
    packed: BoxTree,
}

impl Builder<'_> {
    fn build(&mut self) {
        let first = match self.tree.nodes[0] {
            Node::Leaf { .. } => vec![0],
            Node::Interior { .. } => self.eight_below(0),
        };
        let mut open = vec![(0, self.add(&first), first)];
        while let Some((_, index, below)) = open.pop() {
            for (lane, &child) in below.iter().enumerate() {
                self.packed.nodes[index].children[lane] = match self.tree.nodes[child as usize] {
                    Node::Leaf { primitive } => primitive | BOX,
                    Node::Interior { .. } => {
                        let next = self.eight_below(child);
                        let place = self.add(&next);
                        open.push((child, place, next));
                        place as u32
                    }
                };
            }
        }
    }

    fn add(&mut self, below: &[u32]) -> usize {
        let held: Vec<Held> = below.iter().map(|&node| self.held(node)).collect();
        self.packed.nodes.push(WideNode::new(&held));
        self.packed.nodes.len() - 1
    }

    /// Up to eight nodes that stand for one, the largest opened first.
    fn eight_below(&self, node: u32) -> Vec<u32> {
        let mut below = vec![node];
        while below.len() < 8 {
            let size = |node: u32| match self.tree.nodes[node as usize] {
                Node::Leaf { .. } => -1.0,
                Node::Interior { .. } => self.extents[node as usize].half_surface(),
            };
            let largest = (0..below.len())
                .max_by(|&i, &j| size(below[i]).total_cmp(&size(below[j])))
                .unwrap_or(0);
            let Node::Interior { children } = self.tree.nodes[below[largest] as usize] else {
                break;
            };
            below.splice(largest..=largest, children);
        }
        below
    }

    fn held(&self, node: u32) -> Held {
        let (corners, axes) = match self.tree.nodes[node as usize] {
            Node::Leaf { primitive } => {
                let given = &self.boxes[primitive as usize];
                (given.corners, given.axes)
            }
            Node::Interior { .. } => (self.extents[node as usize].corners(), Mat3::identity()),
        };
        let local = corners.map(|corner| (corner - self.packed.center) / self.packed.scale);
        Held {
            points: local.to_vec(),
            excess: 0.0,
            axes,
        }
    }
}
