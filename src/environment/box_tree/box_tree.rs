//! A tree over oriented boxes with up to eight children per node, which finds the near ones among many bodies. Nodes are
//! stored in chunks; clones of the tree share the chunks that neither has changed.

use super::four_boxes::FourBoxes;
use super::oriented_box::OrientedBox;
use crate::body_bounds::SMALLEST_UNIT;
use crate::boxes::{Extent, WideNode};
use crate::cow_vec::CowVec;
use crate::hierarchy::grouping::{Forest, levels_for, split_within};
use crate::hierarchy::packed::power_of_two_above;
use crate::hierarchy::{Node, SubsetTree};
use crate::lanes::F64x4;
use crate::pose::Vec3;

/// The boxes that a tree is built over, each with a place as its index.
pub trait Boxes {
    /// The axis-aligned box around a box.
    fn extent(&self, place: usize) -> Extent;
    /// The oriented box itself.
    fn oriented(&self, place: usize) -> OrientedBox;
}

/// The bit of a child that is a box and not a node.
pub const BOX: u32 = 1 << 31;

/// The parent of the root, and of boxes that are not in the tree.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// The name of a node is its index in `nodes`. The box of a child in a node bounds everything below the child.
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    pub(crate) nodes: CowVec<BoxNode, 8>,
    pub(crate) root: Option<u32>,
    /// The parent of each node.
    pub(crate) parents: CowVec<u32, 128>,
    /// The node of each box, indexed by place.
    pub(crate) box_parents: CowVec<u32, 128>,
    pub(crate) frame: TreeFrame,
    /// The sum of half the surfaces of all nodes' boxes.
    pub(crate) surface: f64,
}

/// A node. It has at least two children, unless it is the root.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct BoxNode {
    /// In the units of the tree's frame. A child is the name of another node, or [`BOX`] + the place of a box.
    pub wide: WideNode,
    /// The axis-aligned box of everything below, in the world.
    pub(crate) extent: Extent,
}

/// Lengths in nodes are in units of `scale`, a power of two, from `center`.
#[derive(Clone, Copy, Debug)]
pub struct TreeFrame {
    pub center: Vec3,
    pub scale: f64,
}

impl Default for TreeFrame {
    fn default() -> Self {
        Self {
            center: Vec3::zeros(),
            scale: 1.0,
        }
    }
}

impl BoxTree {
    /// Builds the tree over the boxes `taken`; places are below `places`.
    pub fn new(taken: &[u32], places: usize, boxes: &impl Boxes) -> Self {
        let mut box_parents = vec![NOWHERE; places];
        let mut built = Self::default();
        if !taken.is_empty() {
            let extents = taken.iter().map(|&place| boxes.extent(place as usize));
            let mut forest = Forest::new(extents.collect());
            let count = taken.len();
            let root = split_within(&mut forest, (0..count as u32).collect(), levels_for(count));
            let all = forest.extents.clone();
            let (tree, at) = forest.into_tree(root);
            let whole = all[root as usize];
            // Boxes that are tiny relative to their coordinates may have an extent of 0, but their sides have a length.
            let sides = taken.iter().map(|&place| boxes.oriented(place as usize));
            let largest = sides.map(|side| side.half.amax()).fold(0.0, f64::max);
            built.frame = TreeFrame::new(whole.center(), largest.max(whole.size().amax()));
            let mut builder = Builder {
                extents: at.iter().map(|&body| all[body as usize]).collect(),
                tree,
                taken,
                plans: Vec::new(),
            };
            builder.plan();
            built.fill(&builder.plans, &mut box_parents, boxes);
        }
        built.box_parents = box_parents.into_iter().collect();
        built
    }

    /// Builds the nodes; the name of a node is the index of its plan.
    fn fill(&mut self, plans: &[Plan], box_parents: &mut [u32], boxes: &impl Boxes) {
        let nodes = plans.iter().enumerate().map(|(name, plan)| {
            let given = |lane: usize| match plan.children[lane] {
                child if child & BOX == 0 => OrientedBox::from(&plans[child as usize].extent),
                child => boxes.oriented((child & !BOX) as usize),
            };
            for &child in plan.children.iter().filter(|&&child| child & BOX != 0) {
                box_parents[(child & !BOX) as usize] = name as u32;
            }
            self.surface += plan.extent.half_surface();
            BoxNode {
                wide: self.frame.packed(&plan.children, &plan.extent, given),
                extent: plan.extent,
            }
        });
        self.nodes = nodes.collect();
        self.root = Some(0);
        self.parents = plans.iter().map(|plan| plan.parent).collect();
    }

    /// The name of the root.
    pub fn root(&self) -> Option<u32> {
        self.root
    }

    /// The node with a name.
    #[inline(always)]
    pub fn node(&self, name: u32) -> &BoxNode {
        &self.nodes[name as usize]
    }

    /// Copies what changed in a tree that was cloned from this one, or followed it.
    pub fn follow(&mut self, other: &Self) {
        self.nodes.follow(&other.nodes);
        self.parents.follow(&other.parents);
        self.box_parents.follow(&other.box_parents);
        (self.root, self.frame, self.surface) = (other.root, other.frame, other.surface);
    }

    /// The unit and the origin of lengths in the nodes.
    pub fn frame(&self) -> &TreeFrame {
        &self.frame
    }

    /// The axis-aligned box of everything.
    pub fn extent(&self) -> Option<&Extent> {
        self.root.map(|root| &self.node(root).extent)
    }

    /// The sum of half the surfaces of all nodes below the root; a traversal opens a number of nodes about proportional to it.
    pub fn surface(&self) -> f64 {
        let root = self.extent().map_or(0.0, Extent::half_surface);
        (self.surface - root).max(0.0)
    }

    /// Places from this on were never in the tree.
    pub fn places(&self) -> usize {
        self.box_parents.len()
    }

    /// The factor by which the surface of a box's node grows to hold the box as it is now; above 1 if the box leaves the node.
    /// Always 1 in the root, as there is no better node.
    pub fn growth(&self, place: usize, now: &Extent) -> f64 {
        let name = self.box_parents[place];
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
        self.box_parents
            .get(place)
            .is_some_and(|&node| node != NOWHERE)
    }
}

impl TreeFrame {
    /// A frame for boxes within `size` of a centre.
    pub(crate) fn new(center: Vec3, size: f64) -> Self {
        // The squares of smaller lengths round to 0, which would make far boxes seem near.
        let scale = power_of_two_above(size.max(SMALLEST_UNIT));
        Self { center, scale }
    }

    pub(crate) fn local(&self, extent: &Extent) -> Extent {
        Extent {
            low: (extent.low - self.center) / self.scale,
            high: (extent.high - self.center) / self.scale,
        }
    }

    /// Packs a node from its children, the box of each and the extent of all.
    #[inline(always)]
    pub(crate) fn packed(
        &self,
        children: &[u32],
        extent: &Extent,
        given: impl Fn(usize) -> OrientedBox,
    ) -> WideNode {
        // Room for boxes that grow a little in later refits. More room makes the steps of the 16-bit numbers larger; with less,
        // more refits must pack the node anew.
        const ROOM: f64 = 1.25;
        let center = (extent.center() - self.center) / self.scale;
        let largest = (0..children.len())
            .map(|lane| given(lane).half.amax())
            .fold(0.0, f64::max);
        // Half sides may be nearly twice as large as the range of the centres.
        let mut half = 0.5 * largest.max(ROOM * extent.size().amax()) / self.scale;
        loop {
            let mut wide = WideNode::around(&center, half);
            wide.children[..children.len()].copy_from_slice(children);
            wide.count = children.len() as u32;
            let all = ((1u16 << children.len()) - 1) as u8;
            if self.put(&mut wide, all, &given) {
                return wide;
            }
            // The boxes are tiny relative to their coordinates: the room for rounding was too small.
            half = (2.0 * half).max(1e-30);
            assert!(half < 1e30, "boxes lie within reach of the tree's frame");
        }
    }

    /// Sets the boxes of the children whose bits are set in `lanes` to hold the given ones; false if one does not fit.
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

struct Builder<'a> {
    /// The binary tree over the boxes taken.
    tree: SubsetTree,
    taken: &'a [u32],
    /// The box of each node of the tree.
    extents: Vec<Extent>,
    plans: Vec<Plan>,
}

/// A node to be built. A child that is a node is named by the index of its plan, which comes later.
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

    /// Up to eight nodes that cover a subtree; the largest is opened first.
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
