//! Builds the packed tree with boxes fitted to the primitives' own points, without wrappers.

use std::ops::Range;

use super::binary_sets::{AtLeaves, BinarySets};
use super::packed_tree::PackedTree;
use super::wide_plans::wide_nodes;
use crate::boxes::{ChildPoints, Extent, fitted_axes};
use crate::error::Result;
use crate::hierarchy::{Ball, Node, Progress, SubsetTree, few_extremes};
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// Above this many points the axes of a box are fitted to the extreme points only. A larger value makes boxes a little tighter
/// and takes longer to build.
const MAX_FITTED: usize = 48;

/// Packs a subset tree over the primitives; `ball` bounds them all.
pub fn pack_groups(
    primitives: &Primitives,
    subsets: &SubsetTree,
    ball: Ball,
    threads: usize,
    progress: &mut Progress,
) -> Result<PackedTree> {
    let mut packed = PackedTree::empty(ball);
    packed.push_leaves(subsets, primitives);
    let points = LeafPoints::new(primitives, &packed);
    progress.at(0.1)?;
    let radii = radii(subsets, &points);
    let at_leaves = GroupedPrimitives {
        packed: &packed,
        primitives,
        points,
    };
    let grouped = BinarySets::new(subsets, |node| radii[node as usize], at_leaves);
    drop(radii);
    progress.at(0.2)?;
    let nodes = wide_nodes(&grouped, threads, &mut progress.part(0.2, 1.0))?;
    packed.nodes = nodes;
    packed.finish(ball, primitives);
    Ok(packed)
}

/// The bounding points of leaves, leaf after leaf, in units of the packed tree.
pub struct LeafPoints {
    points: Vec<Vec3>,
    /// Index of each leaf's first point, then the number of all points.
    first: Vec<usize>,
}

impl LeafPoints {
    fn new(primitives: &Primitives, packed: &PackedTree) -> Self {
        let unit = 1.0 / packed.scale();
        Self::of_each(packed.primitives().entries().iter(), |leaf, points| {
            let primitive = primitives.get(leaf.primitive as usize);
            points.extend(primitive.bounding_points().map(|point| point * unit));
        })
    }

    /// The points that `append` adds for each leaf.
    pub fn of_each<T>(
        leaves: impl ExactSizeIterator<Item = T>,
        append: impl Fn(T, &mut Vec<Vec3>),
    ) -> Self {
        let mut of_leaves = Self {
            points: Vec::with_capacity(3 * leaves.len()),
            first: Vec::with_capacity(leaves.len() + 1),
        };
        of_leaves.first.push(0);
        for leaf in leaves {
            append(leaf, &mut of_leaves.points);
            of_leaves.first.push(of_leaves.points.len());
        }
        of_leaves
    }

    pub fn of(&self, leaves: Range<usize>) -> &[Vec3] {
        &self.points[self.first[leaves.start]..self.first[leaves.end]]
    }
}

/// Half the diameter of each node's axis-aligned box.
pub fn radii(subsets: &SubsetTree, points: &LeafPoints) -> Vec<f64> {
    let mut radii = vec![0.0; subsets.nodes.len()];
    let mut leaf = points.first.len() - 1;
    let mut open: Vec<Extent> = Vec::new();
    // In reverse order children come before their parents, the first child last.
    for (node, radius) in subsets.nodes.iter().zip(&mut radii).rev() {
        let below = match node {
            Node::Leaf { .. } => None,
            Node::Interior { .. } => open.pop().zip(open.pop()),
        };
        let extent = match below {
            Some((a, b)) => a.union(&b),
            None => {
                leaf -= 1;
                Extent::of(points.of(leaf..leaf + 1))
            }
        };
        *radius = 0.5 * extent.diameter();
        open.push(extent);
    }
    radii
}

/// Primitives, leaf by leaf.
struct GroupedPrimitives<'a> {
    packed: &'a PackedTree,
    primitives: &'a Primitives,
    points: LeafPoints,
}

impl AtLeaves for GroupedPrimitives<'_> {
    fn child_points(&self, leaves: Range<usize>) -> ChildPoints<'_> {
        let points = self.points.of(leaves.clone());
        let axes = if points.len() > MAX_FITTED {
            fitted_axes(&few_extremes(points), None)
        } else if leaves.len() == 1 {
            let leaf = self.packed.primitives().entry(leaves.start);
            let shape = self.primitives.get(leaf.primitive as usize).shape;
            fitted_axes(points, Some(shape).filter(|shape| shape.is_flat()))
        } else {
            fitted_axes(&distinct(points), None)
        };
        ChildPoints {
            axes,
            excess: 0.0,
            points: points.into(),
        }
    }
}

/// The points without duplicates; quadratic, for few points.
fn distinct(points: &[Vec3]) -> Vec<Vec3> {
    let mut kept: Vec<Vec3> = Vec::with_capacity(points.len());
    for point in points {
        if !kept.contains(point) {
            kept.push(*point);
        }
    }
    kept
}
