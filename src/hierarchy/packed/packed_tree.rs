//! The tree as the kernel walks it: eight children a node, oriented boxes in few bits, and the primitives in the order of
//! the leaves.

use super::packed_primitives::PackedPrimitives;
use crate::boxes::{ChildPoints, PackedBox, WideNode, fitted_axes};
use crate::hierarchy::{Ball, Node, SubsetTree};
use crate::lanes::{F64x4, Instructions, Lanes8, Points64, each3};
use crate::pose::Vec3;
use crate::primitive::{Primitive, Primitives};

/// A node, or a leaf, which is one packed primitive: its place among the children of the node above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub struct NodeRef(u32);

/// Marks leaves, among units and children.
const LEAF: u32 = 1 << 31;

impl NodeRef {
    /// As a number, for lanes of them.
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

    /// Its lane in the node above.
    #[inline(always)]
    fn lane(self) -> usize {
        (self.0 & 7) as usize
    }

    /// The node above.
    #[inline(always)]
    fn above(self) -> usize {
        ((self.0 & !LEAF) >> 3) as usize
    }
}

/// The units below a node.
#[derive(Clone, Copy, Debug)]
pub struct Children {
    pub units: [NodeRef; 8],
    pub count: usize,
}

/// Lengths are in units of `scale`, a power of two about as large as the body, so that they fit single precision.
#[derive(Clone, Debug, PartialEq)]
pub struct PackedTree {
    /// The first has one child, the root.
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) primitives: PackedPrimitives,
    scale: f64,
    whole: Whole,
    /// Of a tree of one primitive that is round.
    core: Option<Box<RoundCore>>,
}

/// A primitive within a radius of its core, which a box holds much better than the whole.
#[derive(Clone, Debug, PartialEq)]
struct RoundCore {
    /// The only box of it.
    node: WideNode,
    radius: f64,
}

impl RoundCore {
    /// That of a primitive of space, if it is round, in a tree whose unit is `scale`.
    fn of(only: &Primitive, scale: f64) -> Option<Self> {
        let curve = only.shape.curve.as_deref()?;
        if curve.smooth.is_some() || curve.planar {
            return None;
        }
        let points: Vec<Vec3> = only.vertices.iter().map(|v| v / scale).collect();
        let held = ChildPoints {
            axes: fitted_axes(&points, None),
            excess: only.shape.deviation / scale,
            points: points.into(),
        };
        Some(Self {
            node: WideNode::new(&[held]),
            radius: curve.radius,
        })
    }
}

/// The box and the ball of all, in double precision and in the body's units: the box in both meanings of a [`PackedBox`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whole {
    /// Side by side the first two axes of the box, its centre, and that of the ball. The third axis is the cross product of
    /// the first two.
    pub frame: Points64,
    pub half: Vec3,
    /// No corner is farther from the box's centre.
    pub radius: f64,
    pub ball_radius: f64,
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
    /// Adds the primitives of a tree's leaves, in their order.
    pub(crate) fn push_leaves(&mut self, subsets: &SubsetTree, primitives: &Primitives) {
        self.primitives.reserve(subsets.nodes.len().div_ceil(2));
        for node in &subsets.nodes {
            if let Node::Leaf { primitive } = *node {
                let shape = primitives.get(primitive as usize).shape;
                self.primitives.push(primitive, shape);
            }
        }
    }

    /// The tree of given nodes, and of primitives in the order of its leaves, with a ball around all; `None` if they do not
    /// make one.
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
            packed.finish(ball, primitives.only());
            packed
        })
    }

    /// A tree without nodes, in which lengths suit a ball around all.
    pub(crate) fn empty(ball: Ball) -> Self {
        Self {
            nodes: Vec::new(),
            primitives: PackedPrimitives::default(),
            scale: power_of_two(ball.radius + ball.center.norm()),
            whole: Whole {
                frame: [F64x4::splat(0.0); 3],
                half: Vec3::zeros(),
                radius: 0.0,
                ball_radius: 0.0,
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

    /// What a node calls the leaf of a place among the packed primitives.
    pub(crate) fn leaf(place: u32) -> u32 {
        place | LEAF
    }

    /// Fills in what follows from the nodes and primitives, of which there may be but one.
    pub(crate) fn finish(&mut self, ball: Ball, only: Option<Primitive>) {
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
            // The axes are not quite upright.
            radius: half.norm() * 1.001,
            ball_radius: ball.radius,
        };
        self.core = only.and_then(|only| RoundCore::of(&only, self.scale).map(Box::new));
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

    /// The nodes, each before its children; the first has one child, the root.
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
    pub fn bounding_box(&self, unit: NodeRef) -> PackedBox {
        self.nodes[unit.above()].get(unit.lane())
    }

    /// The same in lanes (see [`WideNode::in_lanes`]).
    #[inline(always)]
    pub fn box_in_lanes<I: Instructions>(&self, lanes: I, unit: NodeRef) -> [Lanes8<I>; 2] {
        self.nodes[unit.above()].in_lanes(lanes, unit.lane())
    }

    /// That of a unit's core, where the tree has one (see [`PackedTree::core_radius`]).
    #[inline(always)]
    pub fn core_in_lanes<I: Instructions>(&self, lanes: I, unit: NodeRef) -> [Lanes8<I>; 2] {
        match &self.core {
            Some(core) => core.node.in_lanes(lanes, 0),
            None => self.box_in_lanes(lanes, unit),
        }
    }

    /// How far around its core the only primitive reaches, where the core has a box of its own; else 0.
    #[inline(always)]
    pub fn core_radius(&self) -> f64 {
        self.core.as_ref().map_or(0.0, |core| core.radius)
    }

    /// About the logarithm of a unit's size: `SIZE_STEPS` more for twice the size.
    #[inline(always)]
    pub fn size_code(&self, unit: NodeRef) -> i32 {
        self.nodes[unit.above()].size_code(unit.lane())
    }

    /// The node that a unit is.
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

    /// The children of a node, as [`PackedTree::child`].
    #[inline(always)]
    pub fn children(&self, index: usize) -> Children {
        let node = &self.nodes[index];
        let mut units = [NodeRef(0); 8];
        for ((lane, unit), child) in units.iter_mut().enumerate().zip(&node.children) {
            *unit = NodeRef((child & LEAF) | (index as u32) << 3 | lane as u32);
        }
        Children {
            units,
            count: node.count as usize,
        }
    }

    /// The place of a leaf's primitive among the packed ones.
    #[inline(always)]
    pub fn place(&self, leaf: NodeRef) -> u32 {
        self.target(leaf) & !LEAF
    }

    /// The lowest primitive in a unit.
    #[inline(always)]
    pub fn lowest(&self, unit: NodeRef) -> u32 {
        if unit.is_leaf() {
            self.primitives.entry(self.place(unit) as usize).primitive
        } else {
            self.nodes[self.index(unit)].lowest
        }
    }

    #[inline(always)]
    fn target(&self, unit: NodeRef) -> u32 {
        self.nodes[unit.above()].children[unit.lane()]
    }

    /// Bytes of memory it takes.
    pub fn bytes(&self) -> usize {
        let core = self.core.as_ref().map_or(0, |_| size_of::<RoundCore>());
        size_of_val(&self.nodes[..]) + self.primitives.bytes() + core
    }
}

/// A power of two, at least the given length and at most twice it, but for lengths near the ends of the numbers.
pub fn power_of_two(length: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    let below = f64::from_bits(length.to_bits() & EXPONENT);
    (2.0 * below).clamp(1e-300, 1e300)
}
