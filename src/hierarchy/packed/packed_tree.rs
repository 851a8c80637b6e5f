//! The tree that the kernel traverses: up to eight children per node, quantized oriented boxes, and the primitives in leaf
//! order.

use super::packed_primitives::PackedPrimitives;
use crate::boxes::{ChildPoints, PackedBox, WideNode, fitted_axes};
use crate::hierarchy::{Ball, Node, SubsetTree, gap_to_center};
use crate::lanes::{F64x4, Instructions, Lanes8, Points64, each3};
use crate::pose::Vec3;
use crate::primitive::{Primitive, Primitives};

/// Refers to a node or a leaf (one packed primitive): the index of its parent node, its lane there, and the leaf bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub struct NodeRef(u32);

/// The leaf bit of a [`NodeRef`] and of an entry of `WideNode::children`.
const LEAF: u32 = 1 << 31;

impl NodeRef {
    /// The raw bits, for SIMD lanes of node refs.
    #[inline(always)]
    pub fn number(self) -> u32 {
        self.0
    }

    #[inline(always)]
    pub fn from_number(number: u32) -> Self {
        Self(number)
    }

    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }

    /// Its lane in the parent node.
    #[inline(always)]
    fn lane(self) -> usize {
        (self.0 & 7) as usize
    }

    /// The index of the parent node.
    #[inline(always)]
    fn parent(self) -> usize {
        ((self.0 & !LEAF) >> 3) as usize
    }
}

/// The node refs of a node's children.
#[derive(Clone, Copy, Debug)]
pub struct Children {
    pub units: [NodeRef; 8],
    pub count: usize,
}

/// Lengths are in units of `scale`, a power of two about as large as the body, so that they fit single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedTree {
    /// Parents before children; the first has one child, the root.
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) primitives: PackedPrimitives,
    scale: f64,
    whole: Whole,
    /// The core of a tree's only primitive, if that is round.
    core: Option<Box<RoundCore>>,
}

/// The core of a round primitive, whose points are within a radius of the core. A box fits the core much tighter than the
/// whole primitive.
#[derive(Clone, Debug, PartialEq)]
struct RoundCore {
    /// Its only box is that of the core.
    node: WideNode,
    radius: f64,
}

impl RoundCore {
    /// The core of a spatial primitive, if it is round, in a tree whose unit is `scale`.
    fn of(only: &Primitive, scale: f64) -> Option<Self> {
        let curve = only.shape.curve.as_deref()?;
        if curve.smooth.is_some() || curve.planar {
            return None;
        }
        let points: Vec<Vec3> = only.vertices.iter().map(|v| v / scale).collect();
        let core = ChildPoints {
            axes: fitted_axes(&points, None),
            excess: only.shape.deviation / scale,
            points: points.into(),
        };
        Some(Self {
            node: WideNode::new(&[core]),
            radius: curve.radius,
        })
    }
}

/// The root's box and bounding ball in double precision and the body's units. The box bounds in both senses of [`PackedBox`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whole {
    /// In four lanes: the first two axes of the box, its centre, and the ball's centre. The third axis is the cross product
    /// of the first two.
    pub frame: Points64,
    pub half: Vec3,
    /// An upper bound of the corners' distance from the box's centre.
    pub radius: f64,
    pub ball_radius: f64,
    /// How near the body comes to the ball's centre: see [`gap_to_center`].
    pub gap_to_center: f64,
}

impl Whole {
    pub fn ball(&self) -> Ball {
        Ball {
            center: Vec3::from(each3(|k| self.frame[k].0[3])),
            radius: self.ball_radius,
        }
    }
}

impl PackedTree {
    /// Adds the primitives of a tree's leaves, in leaf order.
    pub(crate) fn push_leaves(&mut self, subsets: &SubsetTree, primitives: &Primitives) {
        self.primitives.reserve(subsets.nodes.len().div_ceil(2));
        for node in &subsets.nodes {
            if let Node::Leaf { primitive } = *node {
                let shape = primitives.get(primitive as usize).shape;
                self.primitives.push(primitive, shape);
            }
        }
    }

    /// Assembles a tree from its nodes, the primitives in leaf order and a bounding ball of all; `None` if they do not form
    /// one tree.
    pub fn from_parts(
        nodes: Vec<WideNode>,
        order: &[u32],
        primitives: &Primitives,
        ball: Ball,
    ) -> Option<Self> {
        let mut packed = Self::empty(ball);
        packed.primitives.reserve(order.len());
        for &primitive in order {
            let shape = primitives.try_get(primitive as usize)?.shape;
            packed.primitives.push(primitive, shape);
        }
        packed.nodes = nodes;
        packed.is_sound().then(|| {
            packed.finish(ball, primitives);
            packed
        })
    }

    /// A tree without nodes yet, with the scale for a body inside `ball`.
    pub(crate) fn empty(ball: Ball) -> Self {
        Self {
            nodes: Vec::new(),
            primitives: PackedPrimitives::default(),
            scale: power_of_two_above(ball.radius + ball.center.norm()),
            whole: Whole {
                frame: [F64x4::splat(0.0); 3],
                half: Vec3::zeros(),
                radius: 0.0,
                ball_radius: 0.0,
                gap_to_center: 0.0,
            },
            core: None,
        }
    }

    /// Whether every node and every leaf has one parent, before it in the order.
    fn is_sound(&self) -> bool {
        let mut node_seen = vec![false; self.nodes.len()];
        let mut leaf_seen = vec![false; self.primitives.len()];
        let links_are_sound = self.nodes.iter().enumerate().all(|(index, node)| {
            let children = &node.children[..node.count as usize];
            children.iter().all(|&child| {
                let (seen, place) = match child & LEAF {
                    0 if child as usize <= index => return false,
                    0 => (&mut node_seen, child),
                    _ => (&mut leaf_seen, child & !LEAF),
                };
                seen.get_mut(place as usize)
                    .is_some_and(|seen| !std::mem::replace(seen, true))
            })
        });
        links_are_sound
            && self.nodes.first().is_some_and(|top| top.count == 1)
            && node_seen.iter().skip(1).chain(&leaf_seen).all(|&seen| seen)
    }

    /// The entry in `WideNode::children` of the leaf with the packed primitive `place`.
    pub(crate) fn leaf(place: u32) -> u32 {
        place | LEAF
    }

    /// The place of an entry in `WideNode::children` that is a leaf.
    pub(crate) fn place_of(child: u32) -> Option<u32> {
        (child & LEAF != 0).then_some(child & !LEAF)
    }

    /// Derives the root's bounds, the round core and the lowest primitives.
    pub(crate) fn finish(&mut self, ball: Ball, primitives: &Primitives) {
        let root = self.bounding_box(self.root());
        let [x, y, _] = root.axes;
        let [center, half] = [root.center, root.half].map(|v| v.map(f64::from));
        let half = Vec3::from(half) * self.scale;
        self.whole = Whole {
            frame: each3(|k| {
                let [x, y] = [x[k], y[k]].map(f64::from);
                F64x4([x, y, center[k] * self.scale, ball.center[k]])
            }),
            half,
            // The axes are orthogonal only to rounding.
            radius: half.norm() * 1.001,
            ball_radius: ball.radius,
            gap_to_center: gap_to_center(primitives, &ball.center),
        };
        let core = |only: Primitive| RoundCore::of(&only, self.scale);
        self.core = primitives.only().and_then(core).map(Box::new);
        self.find_lowest();
    }

    fn find_lowest(&mut self) {
        // Children come after their parents.
        for index in (0..self.nodes.len()).rev() {
            let lanes = 0..self.nodes[index].count as usize;
            let lowest = lanes.map(|lane| self.lowest(self.child(index, lane)));
            self.nodes[index].lowest = lowest.min().unwrap_or(0);
        }
    }

    /// The nodes, parents before children; the first has one child, the root.
    pub fn nodes(&self) -> &[WideNode] {
        &self.nodes
    }

    #[inline(always)]
    pub fn root(&self) -> NodeRef {
        self.child(0, 0)
    }

    pub fn scale(&self) -> f64 {
        self.scale
    }

    pub fn whole(&self) -> &Whole {
        &self.whole
    }

    pub fn primitives(&self) -> &PackedPrimitives {
        &self.primitives
    }

    #[inline(always)]
    pub fn bounding_box(&self, node: NodeRef) -> PackedBox {
        self.nodes[node.parent()].get(node.lane())
    }

    /// The same in lanes (see [`WideNode::in_lanes`]).
    #[inline(always)]
    pub fn box_in_lanes<I: Instructions>(&self, lanes: I, node: NodeRef) -> [Lanes8<I>; 2] {
        self.nodes[node.parent()].in_lanes(lanes, node.lane())
    }

    /// The same for the round core, if the tree has one (see [`PackedTree::core_radius`]).
    #[inline(always)]
    pub fn core_in_lanes<I: Instructions>(&self, lanes: I, node: NodeRef) -> [Lanes8<I>; 2] {
        match &self.core {
            Some(core) => core.node.in_lanes(lanes, 0),
            None => self.box_in_lanes(lanes, node),
        }
    }

    /// The radius of the only primitive around its core, if the core has a box of its own; else 0.
    #[inline(always)]
    pub fn core_radius(&self) -> f64 {
        self.core.as_ref().map_or(0.0, |core| core.radius)
    }

    /// A rounded logarithm of a box's size: `SIZE_STEPS` more for twice the size.
    #[inline(always)]
    pub fn size_code(&self, node: NodeRef) -> i32 {
        self.nodes[node.parent()].size_code(node.lane())
    }

    /// The index of an interior node.
    #[inline(always)]
    pub fn index(&self, node: NodeRef) -> usize {
        self.target(node) as usize
    }

    #[inline(always)]
    pub fn node(&self, index: usize) -> &WideNode {
        &self.nodes[index]
    }

    #[inline(always)]
    pub fn child(&self, index: usize, lane: usize) -> NodeRef {
        let leaf = self.nodes[index].children[lane] & LEAF;
        NodeRef((index as u32) << 3 | lane as u32 | leaf)
    }

    /// The children of a node as node refs, as by [`PackedTree::child`].
    #[inline(always)]
    pub fn children<I: Instructions>(&self, lanes: I, index: usize) -> Children {
        let node = &self.nodes[index];
        let numbers = lanes.numbered(&node.children, LEAF, (index as u32) << 3);
        Children {
            units: numbers.map(NodeRef),
            count: node.count as usize,
        }
    }

    /// The index of a leaf's primitive among the packed ones.
    #[inline(always)]
    pub fn place(&self, leaf: NodeRef) -> u32 {
        self.target(leaf) & !LEAF
    }

    /// The lowest primitive at or below a node.
    #[inline(always)]
    pub fn lowest(&self, node: NodeRef) -> u32 {
        if node.is_leaf() {
            self.primitives.entry(self.place(node) as usize).primitive
        } else {
            self.nodes[self.index(node)].lowest
        }
    }

    #[inline(always)]
    fn target(&self, node: NodeRef) -> u32 {
        self.nodes[node.parent()].children[node.lane()]
    }

    /// The same sets as a binary tree: the children of a node are halved in their order.
    pub fn subsets(&self) -> SubsetTree {
        let mut nodes: Vec<Node> = Vec::with_capacity(2 * self.primitives.len());
        // Children of a wide node, and the binary node whose second child they are.
        let mut open = vec![(0, 0, 1, None)];
        while let Some((mut index, mut from, mut to, second_of)) = open.pop() {
            let at = nodes.len() as u32;
            if let Some(parent) = second_of {
                let children = [parent + 1, at];
                nodes[parent as usize] = Node::Interior { children };
            }
            while to - from == 1 {
                let child = self.nodes[index].children[from];
                match Self::place_of(child) {
                    Some(place) => {
                        let primitive = self.primitives.entry(place as usize).primitive;
                        nodes.push(Node::Leaf { primitive });
                        break;
                    }
                    None => {
                        index = child as usize;
                        (from, to) = (0, self.nodes[index].count as usize);
                    }
                }
            }
            if to - from > 1 {
                let middle = from + (to - from) / 2;
                let children = [at + 1, 0];
                nodes.push(Node::Interior { children });
                open.push((index, middle, to, Some(at)));
                open.push((index, from, middle, None));
            }
        }
        SubsetTree { nodes }
    }

    /// Bytes of memory of the tree.
    pub fn bytes(&self) -> usize {
        let core = self.core.as_ref().map_or(0, |_| size_of::<RoundCore>());
        size_of_val(&self.nodes[..]) + self.primitives.bytes() + core
    }
}

/// A power of two, at least the given length and at most twice it, but from 2^-996 to 2^996.
pub fn power_of_two_above(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    const LARGEST: f64 = f64::from_bits((1023 + 996) << 52);
    let below = f64::from_bits(length.to_bits() & EXPONENT);
    (2.0 * below).clamp(1.0 / LARGEST, LARGEST)
}
