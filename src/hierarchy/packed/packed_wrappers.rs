//! Builds the packed tree with boxes fitted to wrappers, so that queries traverse the kind of wrapper that was asked for.

use super::eight_below::Cuts;
use super::packed_tree::PackedTree;
use super::wide_plans::{LeafSets, wide_nodes};
use crate::boxes::{ChildPoints, fitted_axes};
use crate::error::Result;
use crate::hierarchy::wrapper::WrapperTree;
use crate::hierarchy::{Node, Progress};
use crate::pose::Vec3;
use crate::primitive::Primitives;

/// Packs a wrapper tree over the primitives.
pub fn pack_wrappers(
    primitives: &Primitives,
    tree: &WrapperTree,
    threads: usize,
    progress: &mut Progress,
) -> Result<PackedTree> {
    let mut packed = PackedTree::empty(tree.ball());
    packed.push_leaves(tree.subsets(), primitives);
    let wrapped = WrapperSets {
        cuts: Cuts::of(tree.subsets(), |node| tree.radius(node)),
        primitives,
        tree,
        unit: 1.0 / packed.scale(),
    };
    packed.nodes = wide_nodes(&wrapped, threads, progress)?;
    packed.finish(tree.ball(), primitives);
    Ok(packed)
}

/// The set tree of wrappers.
struct WrapperSets<'a> {
    cuts: Cuts,
    primitives: &'a Primitives,
    tree: &'a WrapperTree,
    unit: f64,
}

impl LeafSets for WrapperSets<'_> {
    type Set = u32;

    fn whole(&self) -> u32 {
        0
    }

    fn is_leaf(&self, node: &u32) -> bool {
        matches!(self.tree.node(*node), Node::Leaf { .. })
    }

    fn below(&self, node: &u32) -> Vec<u32> {
        self.cuts.below(self.tree.subsets(), *node)
    }

    fn child_points(&self, node: &u32) -> ChildPoints<'_> {
        let wrapper = self.tree.wrapper(*node);
        let points: Vec<Vec3> = wrapper.corners.iter().map(|p| p * self.unit).collect();
        let polygon = match self.tree.node(*node) {
            Node::Leaf { primitive } => Some(self.primitives.get(primitive as usize).shape),
            Node::Interior { .. } => None,
        };
        ChildPoints {
            axes: fitted_axes(&points, polygon.filter(|shape| shape.is_flat())),
            excess: wrapper.excess * self.unit,
            points: points.into(),
        }
    }
}
