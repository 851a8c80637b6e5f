//! The boxes of nodes after what is below them changed.

use super::box_split::FULL;
use super::box_tree::{BOX, BoxFrame, BoxNode, BoxTree, Boxes, NOWHERE, OrientedBox};
use super::box_tree_changes::{BoxTreeChanges, Child};
use crate::index_set::IndexSet;
use crate::lanes::{Instructions, Work, with_widest};

impl<B: Boxes> BoxTreeChanges<'_, B> {
    /// Goes after boxes of the tree that changed, and leaves the tree's shape as it is: each node above them is looked at
    /// once, from the leaves up.
    pub fn refit(&mut self, changed: &IndexSet) {
        let tree = &*self.tree;
        let mut touched = IndexSet::new(tree.nodes.len());
        for place in changed.iter() {
            let mut name = tree.above[place];
            while name != NOWHERE && touched.insert(name as usize) {
                name = tree.parents[name as usize];
            }
        }
        let tree = &mut *self.tree;
        let Settled { mut moved, inner } = with_widest(Settling {
            tree,
            boxes: self.boxes,
            changed,
            touched: &touched,
        });
        for name in self.bottom_up(&inner) {
            let node = self.tree.node(name);
            let children = node.wide.children().iter().enumerate();
            let lanes = children.fold(0, |lanes, (lane, &child)| {
                let has_changed = match child & BOX {
                    0 => moved.contains(child as usize),
                    _ => changed.contains((child & !BOX) as usize),
                };
                lanes | u8::from(has_changed) << lane
            });
            if lanes != 0 && self.settle(name, lanes) {
                moved.insert(name as usize);
            }
        }
    }

    /// Nodes of a set that holds what is above each, those below others first.
    fn bottom_up(&self, nodes: &IndexSet) -> Vec<u32> {
        let is_member = |&name: &u32| nodes.contains(name as usize);
        let mut found: Vec<u32> = self.tree.root.filter(is_member).into_iter().collect();
        let mut next = 0;
        while let Some(&name) = found.get(next) {
            let children = self.tree.node(name).wide.children().iter();
            let below = children.copied().filter(|child| child & BOX == 0);
            found.extend(below.filter(is_member));
            next += 1;
        }
        found.reverse();
        found
    }

    /// Makes a node hold its children, of which those of some lanes have changed. Returns whether its own box changed.
    pub(super) fn settle(&mut self, name: u32, lanes: u8) -> bool {
        let mut children = [Child::default(); FULL];
        let node = self.tree.node(name);
        let before = node.extent;
        for (lane, &child) in node.wide.children().iter().enumerate() {
            children[lane] = self.child(child);
        }
        let node = self.tree.nodes.get_mut(name as usize);
        node.settle(&children, lanes, &self.tree.frame, self.boxes);
        self.tree.surface += node.extent.half_surface() - before.half_surface();
        node.extent != before
    }

    pub(super) fn child(&self, name: u32) -> Child {
        let extent = match name & BOX {
            0 => self.tree.node(name).extent,
            _ => self.boxes.extent((name & !BOX) as usize),
        };
        Child { name, extent }
    }

    pub(super) fn box_of(&self, child: &Child) -> OrientedBox {
        child.oriented(self.boxes)
    }
}

/// The nodes above changed boxes, of which those that only hold boxes are brought up to date.
struct Settling<'a, B> {
    tree: &'a mut BoxTree,
    boxes: &'a B,
    changed: &'a IndexSet,
    touched: &'a IndexSet,
}

struct Settled {
    /// The nodes whose own box changed.
    moved: IndexSet,
    /// Those that hold nodes, and are left.
    inner: IndexSet,
}

impl<B: Boxes> Work for Settling<'_, B> {
    type Output = Settled;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> Settled {
        let Self {
            tree,
            boxes,
            changed,
            touched,
        } = self;
        let mut moved = IndexSet::new(tree.nodes.len());
        let mut inner = IndexSet::new(tree.nodes.len());
        let (frame, surface) = (tree.frame, &mut tree.surface);
        tree.nodes.update(touched.iter(), |name, node| {
            let mut children = [Child::default(); FULL];
            let mut lanes = 0;
            for lane in 0..node.wide.count as usize & 15 {
                let child = node.wide.children[lane & 7];
                if child & BOX == 0 {
                    inner.insert(name);
                    return;
                }
                let place = (child & !BOX) as usize;
                lanes |= u8::from(changed.contains(place)) << lane;
                children[lane & 7] = Child {
                    name: child,
                    extent: boxes.extent(place),
                };
            }
            let before = node.extent;
            node.settle(&children, lanes, &frame, boxes);
            if node.extent != before {
                *surface += node.extent.half_surface() - before.half_surface();
                moved.insert(name);
            }
        });
        Settled { moved, inner }
    }
}

impl Child {
    #[inline(always)]
    fn oriented(&self, boxes: &impl Boxes) -> OrientedBox {
        match self.name & BOX {
            0 => OrientedBox::from(&self.extent),
            _ => boxes.oriented((self.name & !BOX) as usize),
        }
    }
}

impl BoxNode {
    /// Sets the box of all, and those of some lanes.
    #[inline(always)]
    fn settle(
        &mut self,
        children: &[Child; FULL],
        lanes: u8,
        frame: &BoxFrame,
        boxes: &impl Boxes,
    ) {
        let children = &children[..self.wide.count as usize];
        let mut whole = children[0].extent;
        for child in &children[1..] {
            whole = whole.union(&child.extent);
        }
        self.extent = whole;
        for (lane, child) in children.iter().enumerate() {
            let is_changed = lanes >> lane & 1 == 1;
            if is_changed && !frame.put(&mut self.wide, lane, &child.oriented(boxes)) {
                // One that does not fit: all are given room.
                let names = self.wide.children;
                let names = &names[..children.len()];
                let given = |lane: usize| children[lane].oriented(boxes);
                self.wide = frame.packed(names, &self.extent, given);
                return;
            }
        }
    }
}
