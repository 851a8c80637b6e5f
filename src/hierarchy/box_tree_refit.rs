//! The boxes of nodes after what is below them changed.

use super::Extent;
use super::box_tree::{BOX, BoxNode, Boxes, OrientedBox};
use super::box_tree_changes::{BoxTreeChanges, Child};

impl<B: Boxes> BoxTreeChanges<'_, B> {
    /// A node with some children, which are told.
    pub(super) fn node_over(&mut self, name: u32, children: Vec<Child>) -> BoxNode {
        let extents = children.iter().map(|child| child.extent);
        let extent = extents
            .reduce(|all, own| all.union(&own))
            .unwrap_or_default();
        self.tree.surface += extent.half_surface();
        let mut node = BoxNode {
            extent,
            name,
            ..BoxNode::default()
        };
        node.wide.count = children.len() as u32;
        for (lane, child) in children.into_iter().enumerate() {
            self.set_above(child.name, name);
            node.wide.children[lane] = child.name;
            node.below[lane] = child.node;
        }
        self.pack(&mut node);
        node
    }

    /// Makes a node hold a child that came, changed or went: its box was `from` and is `to`.
    pub(super) fn refit(
        &mut self,
        node: &mut BoxNode,
        lane: Option<usize>,
        from: Option<&Extent>,
        to: Option<&Extent>,
    ) {
        let before = node.extent.half_surface();
        if from.is_some_and(|from| from.shares_a_side(&node.extent)) {
            let lanes = 0..node.wide.count as usize;
            let extents = lanes.map(|lane| self.extent_of(node, lane));
            let all = extents.reduce(|all, own| all.union(&own));
            node.extent = all.unwrap_or(node.extent);
        } else if let Some(to) = to {
            node.extent = node.extent.union(to);
        }
        self.tree.surface += node.extent.half_surface() - before;
        if let Some(lane) = lane {
            let given = self.box_of(node, lane);
            if !self.tree.frame.put(&mut node.wide, lane, &given) {
                self.pack(node);
            }
        }
    }

    fn pack(&self, node: &mut BoxNode) {
        let children = node.wide.children();
        node.wide = self
            .tree
            .frame
            .packed(children, &node.extent, |lane| self.box_of(node, lane));
    }

    fn box_of(&self, node: &BoxNode, lane: usize) -> OrientedBox {
        match &node.below[lane] {
            Some(below) => OrientedBox::from(&below.extent),
            None => self.boxes.oriented(node.place(lane)),
        }
    }

    pub(super) fn extent_of(&self, node: &BoxNode, lane: usize) -> Extent {
        match &node.below[lane] {
            Some(below) => below.extent,
            None => self.boxes.extent(node.place(lane)),
        }
    }

    pub(super) fn set_above(&mut self, child: u32, name: u32) {
        match child & BOX {
            0 => *self.tree.parents.get_mut(child as usize) = name,
            _ => *self.tree.above.get_mut((child & !BOX) as usize) = name,
        }
    }
}

impl BoxNode {
    fn place(&self, lane: usize) -> usize {
        (self.wide.children[lane] & !BOX) as usize
    }
}
