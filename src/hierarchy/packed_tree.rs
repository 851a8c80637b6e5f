//! The tree as the kernel walks it: eight children a node, oriented boxes in single precision, and the primitives in the
//! order of the leaves.

use super::eight_below::Cuts;
use super::packed_box::{PackedBox, fit};
use super::packed_primitives::PackedPrimitives;
use super::{Node, WrapperTree};
use crate::lanes::{F32x8, Points32};
use crate::pose::Vec3;
use crate::primitive::Convex;

/// A node, or a leaf, which is one packed primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit(u32);

impl Unit {
    const LEAF: u32 = 1 << 31;

    fn leaf(index: usize) -> Self {
        Self(index as u32 | Self::LEAF)
    }

    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & Self::LEAF != 0
    }

    #[inline(always)]
    fn index(self) -> usize {
        (self.0 & !Self::LEAF) as usize
    }
}

/// The children of a node, their boxes side by side: a box holds the points x with |axis_i . (x - center)| <= half_i.
#[derive(Clone, Debug)]
#[repr(C)]
pub struct WideNode {
    pub axes: [Points32; 3],
    pub center: Points32,
    pub half: Points32,
    pub children: [Unit; 8],
}

/// Lengths are in units of `scale`, a power of two about as large as the body, so that they fit single precision.
#[derive(Clone, Debug)]
pub struct PackedTree {
    nodes: Vec<WideNode>,
    /// How many children each node has.
    counts: Vec<u8>,
    node_boxes: Vec<PackedBox>,
    leaf_boxes: Vec<PackedBox>,
    /// The lowest primitive under each node.
    node_lowest: Vec<u32>,
    primitives: PackedPrimitives,
    scale: f64,
}

impl PackedTree {
    pub fn new(primitives: &[Convex], tree: &WrapperTree) -> Self {
        let root = tree.wrapper(0);
        let reach = root.radius + root.center.norm();
        let mut builder = Builder {
            tree,
            shapes: primitives,
            cuts: Cuts::of(tree),
            packed: Self {
                nodes: Vec::new(),
                counts: Vec::new(),
                node_boxes: Vec::new(),
                leaf_boxes: Vec::new(),
                node_lowest: Vec::new(),
                primitives: PackedPrimitives::default(),
                scale: power_of_two(reach),
            },
        };
        builder.build();
        builder.packed
    }

    pub fn root(&self) -> Unit {
        if self.nodes.is_empty() {
            Unit::leaf(0)
        } else {
            Unit(0)
        }
    }

    pub fn scale(&self) -> f64 {
        self.scale
    }

    pub fn primitives(&self) -> &PackedPrimitives {
        &self.primitives
    }

    #[inline(always)]
    pub fn bounding_box(&self, unit: Unit) -> &PackedBox {
        if unit.is_leaf() {
            &self.leaf_boxes[unit.index()]
        } else {
            &self.node_boxes[unit.index()]
        }
    }

    /// The children of a node, side by side, and how many there are.
    #[inline(always)]
    pub fn children(&self, node: Unit) -> (&WideNode, usize) {
        let index = node.index();
        (&self.nodes[index], self.counts[index] as usize)
    }

    /// The place of a leaf's primitive among the packed ones.
    #[inline(always)]
    pub fn place(&self, leaf: Unit) -> u32 {
        leaf.index() as u32
    }

    /// The lowest primitive in a unit.
    #[inline(always)]
    pub fn lowest(&self, unit: Unit) -> u32 {
        if unit.is_leaf() {
            self.primitives.entry(unit.index()).primitive
        } else {
            self.node_lowest[unit.index()]
        }
    }

    /// Bytes of memory it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..])
            + size_of_val(&self.counts[..])
            + size_of_val(&self.node_boxes[..])
            + size_of_val(&self.leaf_boxes[..])
            + size_of_val(&self.node_lowest[..])
            + self.primitives.bytes()
    }
}

/// A power of two, at least the given length and at most twice it, but for lengths near the ends of the numbers.
pub fn power_of_two(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let below = f64::from_bits(length.to_bits() & EXPONENT);
    (2.0 * below).clamp(1e-300, 1e300)
}

struct Builder<'a> {
    tree: &'a WrapperTree,
    shapes: &'a [Convex],
    cuts: Cuts,
    packed: PackedTree,
}

impl Builder<'_> {
    fn build(&mut self) {
        if let Node::Leaf { primitive } = self.tree.node(0) {
            self.add_leaf(0, primitive);
            return;
        }
        // Nodes of the binary tree that become wide nodes, with the places of those.
        self.add_node(0);
        let mut open: Vec<(u32, usize)> = vec![(0, 0)];
        while let Some((node, index)) = open.pop() {
            let below = self.cuts.below(self.tree, node);
            for (lane, &child) in below.iter().enumerate() {
                let (unit, bounds) = if let Node::Leaf { primitive } = self.tree.node(child) {
                    let leaf = self.add_leaf(child, primitive);
                    (Unit::leaf(leaf), self.packed.leaf_boxes[leaf])
                } else {
                    let wide = self.add_node(child);
                    open.push((child, wide));
                    (Unit(wide as u32), self.packed.node_boxes[wide])
                };
                self.packed.nodes[index].set(lane, unit, &bounds);
            }
            self.packed.counts[index] = below.len() as u8;
        }
        // Children come after their parents.
        for index in (0..self.packed.nodes.len()).rev() {
            let count = self.packed.counts[index] as usize;
            let children = &self.packed.nodes[index].children[..count];
            let lowest = children.iter().map(|&child| self.packed.lowest(child));
            self.packed.node_lowest[index] = lowest.min().unwrap_or(0);
        }
    }

    fn add_node(&mut self, node: u32) -> usize {
        let wrapper = self.tree.wrapper(node);
        let points: Vec<Vec3> = wrapper
            .corners
            .iter()
            .map(|p| p / self.packed.scale)
            .collect();
        let excess = wrapper.excess / self.packed.scale;
        self.packed.node_boxes.push(fit(&points, excess, None));
        self.packed.nodes.push(WideNode::empty());
        self.packed.counts.push(0);
        self.packed.node_lowest.push(0);
        self.packed.nodes.len() - 1
    }

    fn add_leaf(&mut self, node: u32, primitive: u32) -> usize {
        let wrapper = self.tree.wrapper(node);
        let points: Vec<Vec3> = wrapper
            .corners
            .iter()
            .map(|p| p / self.packed.scale)
            .collect();
        let excess = wrapper.excess / self.packed.scale;
        let shape = &self.shapes[primitive as usize];
        let flat = Some(shape).filter(|shape| shape.faces.len() == 1);
        self.packed.leaf_boxes.push(fit(&points, excess, flat));
        self.packed.primitives.push(primitive, shape);
        self.packed.leaf_boxes.len() - 1
    }
}

impl WideNode {
    fn empty() -> Self {
        let zero = [F32x8::splat(0.0); 3];
        Self {
            axes: [zero; 3],
            center: zero,
            half: zero,
            children: [Unit(0); 8],
        }
    }

    fn set(&mut self, lane: usize, unit: Unit, bounds: &PackedBox) {
        for i in 0..3 {
            for k in 0..3 {
                self.axes[i][k].0[lane] = bounds.axes[i][k];
            }
            self.center[i].0[lane] = bounds.center[i];
            self.half[i].0[lane] = bounds.half[i];
        }
        self.children[lane] = unit;
    }
}
