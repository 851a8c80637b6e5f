//! A tree over oriented boxes, eight children a node: which of many bodies are near. The nodes lie side by side in chunks;
//! clones of the tree share the chunks that none of them has changed since.

use super::four_boxes::FourBoxes;
use crate::boxes::{Extent, WideNode};
use crate::cow_vec::CowVec;
use crate::hierarchy::grouping::{Forest, levels_for, split_within};
use crate::hierarchy::packed::power_of_two;
use crate::hierarchy::{Node, SubsetTree};
use crate::lanes::F64x4;
use crate::pose::Vec3;

/// A box around a body: of its axes the first two, orthonormal to within 2^-12 (see [`PackedBox`]); the third is their cross
/// product. The box is the points center + sum c_i axis_i with |c_i| <= half_i.
///
/// [`PackedBox`]: crate::boxes::PackedBox
#[derive(Clone, Copy, Debug)]
pub struct OrientedBox {
    pub center: Vec3,
    pub axes: [Vec3; 2],
    pub half: Vec3,
}

/// The boxes that a tree is over, by their places.
pub trait Boxes {
    /// The box along the axes of coordinates around one of them.
    fn extent(&self, place: usize) -> Extent;
    fn oriented(&self, place: usize) -> OrientedBox;
}

/// A child that is one of the given boxes.
pub const BOX: u32 = 1 << 31;

/// The node above what is in none.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// Nodes have names, which are their places among all. Each box of a node stands around all that is below.
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    pub(crate) nodes: CowVec<BoxNode, 8>,
    pub(crate) root: Option<u32>,
    /// The node above each node, by their names.
    pub(crate) parents: CowVec<u32, 128>,
    /// The node of each box, by its place.
    pub(crate) above: CowVec<u32, 128>,
    pub(crate) frame: BoxFrame,
    /// The sum of half the surfaces of all nodes' boxes.
    pub(crate) surface: f64,
}

/// It has two children at least, unless it is the root.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct BoxNode {
    /// In the units of the tree's frame. A child is the name of another node, or [`BOX`] + the place of a box.
    pub wide: WideNode,
    /// The box, along the axes of coordinates, of all that is below.
    pub(crate) extent: Extent,
}

/// Lengths in nodes are in units of `scale`, a power of two, from `center`.
#[derive(Clone, Copy, Debug)]
pub struct BoxFrame {
    pub center: Vec3,
    pub scale: f64,
}

impl Default for BoxFrame {
    fn default() -> Self {
        Self {
            center: Vec3::zeros(),
            scale: 1.0,
        }
    }
}

impl BoxTree {
    /// The tree over some of `places` boxes.
    pub fn new(taken: &[u32], places: usize, boxes: &impl Boxes) -> Self {
        let mut above = vec![NOWHERE; places];
        let mut built = Self::default();
        if !taken.is_empty() {
            let extents = taken.iter().map(|&place| boxes.extent(place as usize));
            let mut forest = Forest::new(extents.collect());
            let count = taken.len();
            let root = split_within(&mut forest, (0..count as u32).collect(), levels_for(count));
            let all = forest.extents.clone();
            let (tree, at) = forest.into_tree(root);
            let whole = all[root as usize];
            // Boxes that are small for where they stand may have no extent there, but for their sides.
            let sides = taken.iter().map(|&place| boxes.oriented(place as usize));
            let largest = sides.map(|side| side.half.amax()).fold(0.0, f64::max);
            built.frame = BoxFrame::new(whole.center(), largest.max(whole.size().amax()));
            let mut builder = Builder {
                extents: at.iter().map(|&body| all[body as usize]).collect(),
                tree,
                taken,
                plans: Vec::new(),
            };
            builder.plan();
            built.fill(&builder.plans, &mut above, boxes);
        }
        built.above = above.into_iter().collect();
        built
    }

    /// Makes the nodes: their names are the places of their plans.
    fn fill(&mut self, plans: &[Plan], above: &mut [u32], boxes: &impl Boxes) {
        let made = plans.iter().enumerate().map(|(name, plan)| {
            let given = |lane: usize| match plan.children[lane] {
                child if child & BOX == 0 => OrientedBox::from(&plans[child as usize].extent),
                child => boxes.oriented((child & !BOX) as usize),
            };
            for &child in plan.children.iter().filter(|&&child| child & BOX != 0) {
                above[(child & !BOX) as usize] = name as u32;
            }
            self.surface += plan.extent.half_surface();
            BoxNode {
                wide: self.frame.packed(&plan.children, &plan.extent, given),
                extent: plan.extent,
            }
        });
        self.nodes = made.collect();
        self.root = Some(0);
        self.parents = plans.iter().map(|plan| plan.parent).collect();
    }

    /// The name of the root.
    pub fn root(&self) -> Option<u32> {
        self.root
    }

    #[inline(always)]
    pub fn node(&self, name: u32) -> &BoxNode {
        &self.nodes[name as usize]
    }

    /// Takes over what was changed in a tree that was cloned from this one, or followed it.
    pub fn follow(&mut self, other: &Self) {
        self.nodes.follow(&other.nodes);
        self.parents.follow(&other.parents);
        self.above.follow(&other.above);
        (self.root, self.frame, self.surface) = (other.root, other.frame, other.surface);
    }

    pub fn frame(&self) -> &BoxFrame {
        &self.frame
    }

    /// The box, along the axes of coordinates, of all.
    pub fn extent(&self) -> Option<&Extent> {
        self.root.map(|root| &self.node(root).extent)
    }

    /// Half the surfaces of the boxes of all nodes below the root: a descent opens about as many nodes as it is large.
    pub fn surface(&self) -> f64 {
        let root = self.extent().map_or(0.0, Extent::half_surface);
        (self.surface - root).max(0.0)
    }

    /// No box with this place or a higher one was ever in the tree.
    pub fn places(&self) -> usize {
        self.above.len()
    }

    /// How much larger the surface of a box's node becomes to hold the box as it is now: more than 1 where it leaves its
    /// neighbours. That of the root counts for nothing: there is no better place.
    pub fn growth(&self, place: usize, now: &Extent) -> f64 {
        let name = self.above[place];
        let own = &self.node(name).extent;
        let grown = own.union(now).half_surface();
        if grown > 0.0 && self.root != Some(name) {
            grown / own.half_surface()
        } else {
            1.0
        }
    }

    /// Whether a box is in the tree.
    pub fn holds(&self, place: usize) -> bool {
        self.above.get(place).is_some_and(|&node| node != NOWHERE)
    }
}

impl BoxFrame {
    /// For boxes about a centre, within some size of it.
    pub(crate) fn new(center: Vec3, size: f64) -> Self {
        // The squares of smaller lengths are 0, by which what is far would be taken for near.
        const SMALLEST: f64 = 1e-150;
        let scale = power_of_two(size.max(SMALLEST));
        Self { center, scale }
    }

    pub(crate) fn local(&self, extent: &Extent) -> Extent {
        Extent {
            low: (extent.low - self.center) / self.scale,
            high: (extent.high - self.center) / self.scale,
        }
    }

    /// A node with some children, given the box of each and that of all.
    #[inline(always)]
    pub(crate) fn packed(
        &self,
        children: &[u32],
        extent: &Extent,
        given: impl Fn(usize) -> OrientedBox,
    ) -> WideNode {
        // Boxes that grow a little are to fit too.
        const ROOM: f64 = 1.25;
        let center = (extent.center() - self.center) / self.scale;
        let largest = (0..children.len())
            .map(|lane| given(lane).half.amax())
            .fold(0.0, f64::max);
        // Sides may be nearly twice as large as what centres are within.
        let mut half = 0.5 * largest.max(ROOM * extent.size().amax()) / self.scale;
        loop {
            let mut wide = WideNode::around(&center, half);
            wide.children[..children.len()].copy_from_slice(children);
            wide.count = children.len() as u32;
            let all = ((1u16 << children.len()) - 1) as u8;
            if self.put(&mut wide, all, &given) {
                return wide;
            }
            // Boxes that are tiny for where they stand: rounding of the centres outgrew what was left for it.
            half = (2.0 * half).max(1e-30);
            assert!(half < 1e30, "boxes lie within reach of the tree's frame");
        }
    }

    /// Sets the boxes of some children, a bit each, to hold those given; false if one does not fit.
    #[inline(always)]
    pub(crate) fn put(
        &self,
        wide: &mut WideNode,
        lanes: u8,
        given: impl Fn(usize) -> OrientedBox,
    ) -> bool {
        // A power of two: exact.
        let inverse_scale = 1.0 / self.scale;
        for first in [0, 4] {
            let some = lanes >> first & 15;
            if some == 0 {
                continue;
            }
            let mut four = FourBoxes::of(some, |lane| given(first + lane));
            for k in 0..3 {
                let from_center = four.center[k] - F64x4::splat(self.center[k]);
                four.center[k] = from_center * inverse_scale;
                four.half[k] = four.half[k] * inverse_scale;
            }
            if !wide.put(first, some, &four) {
                return false;
            }
        }
        true
    }
}

impl From<&Extent> for OrientedBox {
    fn from(extent: &Extent) -> Self {
        Self {
            center: extent.center(),
            axes: [Vec3::x(), Vec3::y()],
            half: extent.size() * 0.5,
        }
    }
}

struct Builder<'a> {
    /// Over the boxes taken.
    tree: SubsetTree,
    taken: &'a [u32],
    /// The box of each node of the tree.
    extents: Vec<Extent>,
    plans: Vec<Plan>,
}

/// A node to be made. Children that are nodes have later plans, by whose places they are named.
struct Plan {
    children: Vec<u32>,
    extent: Extent,
    parent: u32,
}

impl Builder<'_> {
    fn plan(&mut self) {
        let first = match self.tree.nodes[0] {
            Node::Leaf { .. } => vec![0],
            Node::Interior { .. } => self.eight_below(0),
        };
        let mut open = vec![(self.add(0, NOWHERE), first)];
        while let Some((plan, below)) = open.pop() {
            for node in below {
                let child = match self.tree.nodes[node as usize] {
                    Node::Leaf { primitive } => self.taken[primitive as usize] | BOX,
                    Node::Interior { .. } => {
                        let child = self.add(node, plan);
                        open.push((child, self.eight_below(node)));
                        child
                    }
                };
                self.plans[plan as usize].children.push(child);
            }
        }
    }

    fn add(&mut self, node: u32, parent: u32) -> u32 {
        self.plans.push(Plan {
            children: Vec::new(),
            extent: self.extents[node as usize],
            parent,
        });
        self.plans.len() as u32 - 1
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
}
