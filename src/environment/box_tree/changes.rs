//! Inserts and removes boxes, in time proportional to the levels of the tree. As in an R-tree (Guttman 1984), a box is
//! inserted where boxes grow least, and a full node is split.

use super::box_split::{FULL, split};
use super::box_tree::{BOX, BoxNode, BoxTree, Boxes, NOWHERE};
use crate::boxes::Extent;

/// A tree being changed, with the boxes as they are after the change.
pub struct BoxTreeChanges<'a, B> {
    /// The tree.
    pub tree: &'a mut BoxTree,
    /// All boxes, by their places.
    pub boxes: &'a B,
}

/// A child of a node: another node, or a box.
#[derive(Clone, Copy, Default)]
pub(crate) struct Child {
    pub name: u32,
    pub extent: Extent,
}

impl<B: Boxes> BoxTreeChanges<'_, B> {
    /// Inserts a box into the tree.
    pub fn insert(&mut self, place: usize) {
        while self.tree.box_parents.len() <= place {
            self.tree.box_parents.push(NOWHERE);
        }
        let child = Child {
            name: place as u32 | BOX,
            extent: self.boxes.extent(place),
        };
        match self.tree.root {
            None => self.set_root(&[child]),
            Some(root) => {
                if let Some(sibling) = self.insert_below(root, child) {
                    self.set_root(&[self.child(root), self.child(sibling)]);
                }
            }
        }
    }

    /// Removes a box from the tree.
    pub fn remove(&mut self, place: usize) {
        let mut name = self.tree.box_parents[place];
        *self.tree.box_parents.get_mut(place) = NOWHERE;
        let node = self.tree.nodes.get_mut(name as usize);
        node.wide.take_out(node.lane_of(place as u32 | BOX));
        let mut lanes = 0;
        loop {
            let parent = self.tree.parents[name as usize];
            let node = self.tree.node(name);
            if parent == NOWHERE {
                if node.wide.count > 0 {
                    self.settle(name, lanes);
                } else {
                    (self.tree.root, self.tree.surface) = (None, 0.0);
                }
                return;
            }
            let lane = self.tree.node(parent).lane_of(name);
            if let [left] = *node.wide.children() {
                // The only child left replaces the node.
                self.tree.surface -= node.extent.half_surface();
                self.set_child(parent, lane, left);
            } else if !self.settle(name, lanes) {
                return;
            }
            (name, lanes) = (parent, 1 << lane);
        }
    }

    /// Inserts a child where boxes grow least. If the node was full, returns its new sibling.
    fn insert_below(&mut self, name: u32, child: Child) -> Option<u32> {
        let Some(lane) = self.best_lane(name, &child.extent) else {
            return self.add(name, child);
        };
        let below = self.tree.node(name).wide.children[lane];
        if below & BOX != 0 {
            return self.add(name, child);
        }
        let sibling = self.insert_below(below, child);
        self.settle(name, 1 << lane);
        self.add(name, self.child(sibling?))
    }

    /// The child whose box grows least to hold another; `None` if all children are boxes.
    fn best_lane(&self, name: u32, given: &Extent) -> Option<usize> {
        let wide = &self.tree.node(name).wide;
        wide.children().iter().find(|&&child| child & BOX == 0)?;
        let local = self.tree.frame.local(given);
        let mut best = (f64::INFINITY, f64::INFINITY, 0);
        for lane in 0..wide.count as usize {
            let own = wide.extent(lane);
            let size = own.half_surface();
            let growth = own.union(&local).half_surface() - size;
            if (growth, size) < (best.0, best.1) {
                best = (growth, size, lane);
            }
        }
        Some(best.2)
    }

    /// Adds a child to a node. If the node was full, returns its new sibling.
    fn add(&mut self, name: u32, child: Child) -> Option<u32> {
        let node = self.tree.nodes.get_mut(name as usize);
        let count = node.wide.count as usize;
        if count == FULL {
            return Some(self.split(name, child));
        }
        node.wide.count += 1;
        self.set_child(name, count, child.name);
        self.settle(name, 1 << count);
        None
    }

    /// Splits the children of a full node and one more between the node and a new one.
    fn split(&mut self, name: u32, child: Child) -> u32 {
        let node = *self.tree.node(name);
        let mut children: Vec<Child> = node
            .wide
            .children()
            .iter()
            .map(|&c| self.child(c))
            .collect();
        children.push(child);
        let extents: Vec<Extent> = children.iter().map(|child| child.extent).collect();
        let goes = split(&extents);
        let mut goes = goes.iter();
        let (go, stay): (Vec<Child>, Vec<Child>) = children
            .into_iter()
            .partition(|_| goes.next() == Some(&true));
        self.tree.surface -= node.extent.half_surface();
        self.fill_node(name, &stay);
        let sibling = self.new_name();
        self.fill_node(sibling, &go);
        sibling
    }

    fn set_root(&mut self, children: &[Child]) {
        let name = self.new_name();
        self.fill_node(name, children);
        self.tree.root = Some(name);
    }

    fn new_name(&mut self) -> u32 {
        self.tree.nodes.push(BoxNode::default());
        self.tree.parents.push(NOWHERE);
        self.tree.parents.len() as u32 - 1
    }

    /// Refills a node with some children.
    fn fill_node(&mut self, name: u32, children: &[Child]) {
        let extents = children.iter().map(|child| child.extent);
        let whole = extents.reduce(|all, own| all.union(&own));
        let extent = whole.unwrap_or_default();
        self.tree.surface += extent.half_surface();
        let names: Vec<u32> = children.iter().map(|child| child.name).collect();
        let given = |lane: usize| self.box_of(&children[lane]);
        let wide = self.tree.frame.packed(&names, &extent, given);
        *self.tree.nodes.get_mut(name as usize) = BoxNode { wide, extent };
        for child in names {
            self.set_parent(child, name);
        }
    }

    fn set_child(&mut self, name: u32, lane: usize, child: u32) {
        self.tree.nodes.get_mut(name as usize).wide.children[lane] = child;
        self.set_parent(child, name);
    }

    fn set_parent(&mut self, child: u32, name: u32) {
        match child & BOX {
            0 => *self.tree.parents.get_mut(child as usize) = name,
            _ => *self.tree.box_parents.get_mut((child & !BOX) as usize) = name,
        }
    }
}

impl BoxNode {
    fn lane_of(&self, child: u32) -> usize {
        let children = self.wide.children();
        let lane = children.iter().position(|&other| other == child);
        lane.expect("a node holds its children")
    }
}
