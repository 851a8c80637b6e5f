//! Builds the packed tree of a body from the packed trees of its parts: their boxes are moved, and boxes are fitted only above
//! them.

use std::ops::Range;

use super::binary_sets::{AtLeaves, BinarySets};
use super::packed_groups::{LeafPoints, radii};
use super::packed_tree::{NodeRef, PackedTree};
use super::wide_plans::wide_nodes;
use crate::boxes::{AxisSpans, BoxMotion, ChildPoints, WideNode, fitted_axes};
use crate::error::Result;
use crate::hierarchy::{Ball, Progress, SubsetTree, few_extremes};
use crate::pose::{Mat3, Pose, Vec3};
use crate::primitive::Primitives;

/// The packed tree of a part, and where the part is.
pub struct PackedPart<'a> {
    pub tree: &'a PackedTree,
    /// From the part's own frame to that of the whole.
    pub pose: Pose,
    /// The number that its first primitive has in the whole.
    pub first: u32,
}

/// A leaf of the tree over the parts.
#[derive(Clone, Copy)]
pub enum TopLeaf {
    /// A primitive of the whole, by its number.
    Primitive(u32),
    /// A part, by its index.
    Part(usize),
}

/// Packs a tree over parts and single primitives. `top` is the tree over `leaves`, which are in its order; `primitives` and
/// `ball` are those of the whole.
pub fn pack_parts(
    primitives: &Primitives,
    top: &SubsetTree,
    leaves: &[TopLeaf],
    parts: &[PackedPart],
    ball: Ball,
    progress: &mut Progress,
) -> Result<PackedTree> {
    let mut packed = PackedTree::empty(ball);
    let unit = 1.0 / packed.scale();
    let motions: Vec<BoxMotion> = parts.iter().map(|part| part.motion(unit)).collect();
    let at_leaves = TopLeaves::new(primitives, leaves, parts, &motions, unit);
    let radii = radii(top, &at_leaves.points);
    let sets = BinarySets::new(top, |node| radii[node as usize], at_leaves);
    packed.nodes = wide_nodes(&sets, 1, &mut progress.part(0.0, 0.2))?;
    let top_nodes = packed.nodes.len();
    // The leaves of the top nodes are numbered in order; now they become places and the parts' nodes.
    let mut links = Vec::with_capacity(leaves.len());
    for (i, leaf) in leaves.iter().enumerate() {
        links.push(match *leaf {
            TopLeaf::Primitive(primitive) => {
                let place = packed.primitives.len() as u32;
                let shape = primitives.get(primitive as usize).shape;
                packed.primitives.push(primitive, shape);
                PackedTree::leaf(place)
            }
            TopLeaf::Part(part) => packed.append(&parts[part], &motions[part], primitives),
        });
        progress.at(0.2 + 0.8 * (i + 1) as f64 / leaves.len() as f64)?;
    }
    for node in &mut packed.nodes[..top_nodes] {
        for child in &mut node.children[..node.count as usize] {
            if let Some(leaf) = PackedTree::place_of(*child) {
                *child = links[leaf as usize];
            }
        }
    }
    packed.finish(ball, primitives);
    Ok(packed)
}

impl PackedPart<'_> {
    /// The motion from its tree's units to those of another, given one length of the body in those.
    fn motion(&self, unit: f64) -> BoxMotion {
        BoxMotion {
            rotation: self.pose.rotation,
            translation: self.pose.translation * unit,
            factor: self.tree.scale() * unit,
        }
    }

    /// The corners of a box of its tree after the motion, and the box's axes.
    fn corners(&self, node: NodeRef, motion: &BoxMotion) -> (Mat3, [Vec3; 8]) {
        let stored = self.tree.bounding_box(node);
        let axes = stored.axes.map(|axis| Vec3::from(axis.map(f64::from)));
        let center = Vec3::from(stored.center.map(f64::from)) * motion.factor;
        let center = motion.rotation * center + motion.translation;
        let sides: [Vec3; 3] = std::array::from_fn(|i| {
            motion.rotation * axes[i] * (f64::from(stored.half[i]) * motion.factor)
        });
        let sign = |corner: usize, i: usize| if corner >> i & 1 == 0 { -1.0 } else { 1.0 };
        let corner = |k: usize| center + (0..3).map(|i| sides[i] * sign(k, i)).sum::<Vec3>();
        let first = (motion.rotation * axes[0]).normalize();
        let second = motion.rotation * axes[1];
        let second = (second - first * first.dot(&second)).normalize();
        let axes = Mat3::from_columns(&[first, second, first.cross(&second)]);
        (axes, std::array::from_fn(corner))
    }

    /// Points whose hull contains the part: the corners of the boxes below its root.
    fn hull_points(&self, motion: &BoxMotion, points: &mut Vec<Vec3>) {
        let root = self.tree.root();
        if root.is_leaf() {
            return points.extend(self.corners(root, motion).1);
        }
        let index = self.tree.index(root);
        for lane in 0..self.tree.node(index).count as usize {
            points.extend(self.corners(self.tree.child(index, lane), motion).1);
        }
    }
}

impl PackedTree {
    /// Appends the nodes and primitives of a part, but for the node above its root. Returns the link to its root.
    fn append(&mut self, part: &PackedPart, motion: &BoxMotion, primitives: &Primitives) -> u32 {
        let first_place = self.primitives.len() as u32;
        // The part's node 0 is left out.
        let first_node = self.nodes.len() as u32 - 1;
        for entry in part.tree.primitives().entries() {
            let primitive = part.first + entry.primitive;
            let shape = primitives.get(primitive as usize).shape;
            self.primitives.push(primitive, shape);
        }
        let link = |child: u32| match Self::place_of(child) {
            Some(place) => Self::leaf(first_place + place),
            None => first_node + child,
        };
        let nodes = part.tree.nodes();
        let mut boxes = Vec::with_capacity(8);
        for node in &nodes[1..] {
            boxes.clear();
            let lanes = 0..node.count as usize;
            boxes.extend(lanes.map(|lane| AxisSpans::moved(node, lane, motion)));
            let mut moved = WideNode::of_spans(&boxes);
            for (link_to, &child) in moved.children.iter_mut().zip(node.children()) {
                *link_to = link(child);
            }
            self.nodes.push(moved);
        }
        link(nodes[0].children[0])
    }
}

/// Parts and single primitives, leaf by leaf.
struct TopLeaves<'a> {
    leaves: &'a [TopLeaf],
    primitives: &'a Primitives,
    points: LeafPoints,
    /// Of each part, the axes and corners of its root's box.
    boxes: Vec<(Mat3, [Vec3; 8])>,
}

impl<'a> TopLeaves<'a> {
    fn new(
        primitives: &'a Primitives,
        leaves: &'a [TopLeaf],
        parts: &[PackedPart],
        motions: &[BoxMotion],
        unit: f64,
    ) -> Self {
        let points = LeafPoints::of_each(leaves.iter(), |leaf, points| match *leaf {
            TopLeaf::Part(part) => parts[part].hull_points(&motions[part], points),
            TopLeaf::Primitive(primitive) => {
                let primitive = primitives.get(primitive as usize);
                points.extend(primitive.bounding_points().map(|point| point * unit));
            }
        });
        let boxes = parts.iter().zip(motions);
        Self {
            leaves,
            primitives,
            points,
            boxes: boxes
                .map(|(part, motion)| part.corners(part.tree.root(), motion))
                .collect(),
        }
    }
}

impl AtLeaves for TopLeaves<'_> {
    fn child_points(&self, leaves: Range<usize>) -> ChildPoints<'_> {
        let points = self.points.of(leaves.clone());
        let (axes, points) = match self.leaves[leaves.start] {
            _ if leaves.len() > 1 => (fitted_axes(&few_extremes(points), None), points),
            TopLeaf::Part(part) => {
                let (axes, corners) = &self.boxes[part];
                (*axes, &corners[..])
            }
            TopLeaf::Primitive(primitive) => {
                let shape = self.primitives.get(primitive as usize).shape;
                let flat = Some(shape).filter(|shape| shape.is_flat());
                (fitted_axes(points, flat), points)
            }
        };
        ChildPoints {
            axes,
            excess: 0.0,
            points: points.into(),
        }
    }
}
