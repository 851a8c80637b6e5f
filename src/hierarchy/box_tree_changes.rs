//! Boxes that come, move and go: each change costs the levels of the tree. As in an R-tree (Guttman 1984), a box goes where
//! boxes grow least, and a node that is full is split. The nodes on the way are copied if another tree shares them.

use std::sync::Arc;

use super::Extent;
use super::box_split::{FULL, split};
use super::box_tree::{BOX, BoxNode, BoxTree, Boxes, NOWHERE};

/// A tree under change, with the boxes as they are after it.
pub struct BoxTreeChanges<'a, B> {
    pub tree: &'a mut BoxTree,
    pub boxes: &'a B,
}

/// A node or one of the given boxes.
pub(super) struct Child {
    pub name: u32,
    pub node: Option<Arc<BoxNode>>,
    pub extent: Extent,
}

impl<B: Boxes> BoxTreeChanges<'_, B> {
    /// Puts a box into the tree.
    pub fn insert(&mut self, place: usize) {
        while self.tree.above.len() <= place {
            self.tree.above.push(NOWHERE);
        }
        let child = Child {
            name: place as u32 | BOX,
            node: None,
            extent: self.boxes.extent(place),
        };
        self.tree.root = Some(match self.tree.root.take() {
            None => self.root_over(vec![child]),
            Some(mut root) => match self.insert_below(&mut root, child) {
                None => root,
                Some(sibling) => self.root_over(vec![Child::from(root), Child::from(sibling)]),
            },
        });
    }

    /// Takes a box out, which was `from`.
    pub fn remove(&mut self, place: usize, from: &Extent) {
        self.at_node_of(place, |changes, node, lane| {
            changes.take_out(node, lane, from)
        });
        *self.tree.above.get_mut(place) = NOWHERE;
    }

    /// Goes after a box that was `from`.
    pub fn follow(&mut self, place: usize, from: &Extent) {
        let to = self.boxes.extent(place);
        let mut fits = false;
        self.at_node_of(place, |changes, node, lane| {
            fits = node.extent.contains(&to);
            if fits {
                changes.refit(node, Some(lane), Some(from), Some(&to));
            } else {
                changes.take_out(node, lane, from);
            }
        });
        if !fits {
            self.insert(place);
        }
    }

    /// Changes the node that holds a box, of which the lane is told, and what is above.
    fn at_node_of(&mut self, place: usize, change: impl FnOnce(&mut Self, &mut BoxNode, usize)) {
        let mut way = Vec::new();
        let mut node = self.tree.above[place];
        while let parent = self.tree.parents[node as usize]
            && parent != NOWHERE
        {
            way.push(node);
            node = parent;
        }
        let Some(mut root) = self.tree.root.take() else {
            return;
        };
        self.along(&mut root, &way, |changes, node| {
            change(changes, node, node.lane_of(place as u32 | BOX));
        });
        if root.wide.count > 0 {
            self.tree.root = Some(root);
        } else {
            self.tree.surface = 0.0;
        }
    }

    /// Changes the node at the end of a way down, of which the last is the first.
    fn along(
        &mut self,
        node: &mut Arc<BoxNode>,
        way: &[u32],
        change: impl FnOnce(&mut Self, &mut BoxNode),
    ) {
        let node = Arc::make_mut(node);
        let Some((&next, rest)) = way.split_last() else {
            return change(self, node);
        };
        let lane = node.lane_of(next);
        let Some(below) = &mut node.below[lane] else {
            return;
        };
        let from = below.extent;
        self.along(below, rest, change);
        let to = below.extent;
        if below.wide.count > 1 {
            if to != from {
                self.refit(node, Some(lane), Some(&from), Some(&to));
            }
            return;
        }
        // The only child left takes the place of the node.
        let below = Arc::make_mut(below);
        let left = Child {
            name: below.wide.children[0],
            node: below.below[0].take(),
            extent: to,
        };
        self.tree.surface -= to.half_surface();
        self.attach(node, lane, left, Some(&from));
    }

    /// Puts a child where it makes boxes grow least. If the node was full, returns a new one to stand beside it.
    fn insert_below(&mut self, node: &mut Arc<BoxNode>, child: Child) -> Option<Arc<BoxNode>> {
        let node = Arc::make_mut(node);
        let best = self.best_lane(node, &child.extent);
        let Some((lane, below)) = best.zip(best.and_then(|lane| node.below[lane].as_mut())) else {
            return self.add(node, child);
        };
        let from = below.extent;
        let sibling = self.insert_below(below, child);
        let to = below.extent;
        if to != from {
            self.refit(node, Some(lane), Some(&from), Some(&to));
        }
        self.add(node, Child::from(sibling?))
    }

    /// The child whose box grows least to hold another, unless all are given boxes.
    fn best_lane(&self, node: &BoxNode, given: &Extent) -> Option<usize> {
        node.below.iter().find(|below| below.is_some())?;
        let local = self.tree.frame.local(given);
        let mut best = (f64::INFINITY, f64::INFINITY, 0);
        for lane in 0..node.wide.count as usize {
            let own = node.wide.extent(lane);
            let size = own.half_surface();
            let growth = own.union(&local).half_surface() - size;
            if (growth, size) < (best.0, best.1) {
                best = (growth, size, lane);
            }
        }
        Some(best.2)
    }

    /// Gives a node one more child. If it was full, returns a new one to stand beside it.
    fn add(&mut self, node: &mut BoxNode, child: Child) -> Option<Arc<BoxNode>> {
        let count = node.wide.count as usize;
        if count == FULL {
            return Some(self.split(node, child));
        }
        node.wide.count += 1;
        self.attach(node, count, child, None);
        None
    }

    /// Sets a child, where there was none or one whose box was `from`.
    fn attach(&mut self, node: &mut BoxNode, lane: usize, child: Child, from: Option<&Extent>) {
        self.set_above(child.name, node.name);
        node.wide.children[lane] = child.name;
        node.below[lane] = child.node;
        self.refit(node, Some(lane), from, Some(&child.extent));
    }

    fn take_out(&mut self, node: &mut BoxNode, lane: usize, from: &Extent) {
        node.wide.take_out(lane);
        node.below.swap(lane, node.wide.count as usize);
        self.refit(node, None, Some(from), None);
    }

    /// Shares the children of a full node and one more between it and a new one.
    fn split(&mut self, node: &mut BoxNode, child: Child) -> Arc<BoxNode> {
        let mut children: Vec<Child> = (0..FULL)
            .map(|lane| Child {
                name: node.wide.children[lane],
                extent: self.extent_of(node, lane),
                node: node.below[lane].take(),
            })
            .collect();
        children.push(child);
        let extents: Vec<Extent> = children.iter().map(|child| child.extent).collect();
        let goes = split(&extents);
        let mut goes = goes.iter();
        let (go, stay): (Vec<Child>, Vec<Child>) = children
            .into_iter()
            .partition(|_| goes.next() == Some(&true));
        self.tree.surface -= node.extent.half_surface();
        *node = self.node_over(node.name, stay);
        let name = self.new_name();
        Arc::new(self.node_over(name, go))
    }

    fn root_over(&mut self, children: Vec<Child>) -> Arc<BoxNode> {
        let name = self.new_name();
        Arc::new(self.node_over(name, children))
    }

    fn new_name(&mut self) -> u32 {
        self.tree.parents.push(NOWHERE);
        self.tree.parents.len() as u32 - 1
    }
}

impl From<Arc<BoxNode>> for Child {
    fn from(node: Arc<BoxNode>) -> Self {
        Self {
            name: node.name,
            extent: node.extent,
            node: Some(node),
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
