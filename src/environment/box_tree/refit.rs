//! Refits the boxes of nodes after boxes below them changed.

use super::box_split::FULL;
use super::box_tree::{BOX, BoxNode, Boxes, NOWHERE, TreeFrame};
use super::changes::{BoxTreeChanges, Child};
use super::oriented_box::OrientedBox;
use crate::index_set::IndexSet;
use crate::lanes::{Instructions, Work, with_widest};

impl<B: Boxes> BoxTreeChanges<'_, B> {
    /// Refits the nodes that contain changed boxes, bottom-up and each once. The structure of the tree stays.
    pub fn refit(&mut self, changed: &IndexSet) {
        let tree = &*self.tree;
        let mut touched = IndexSet::new(tree.nodes.len());
        for place in changed.iter() {
            let mut name = tree.box_parents[place];
            while name != NOWHERE && touched.insert(name as usize) {
                name = tree.parents[name as usize];
            }
        }
        with_widest(TreeRefit {
            changes: self,
            changed,
            touched: &touched,
        });
    }

    /// The nodes of a set, children before parents. The set must hold the parents of its nodes.
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

    /// Refits a node whose children in `lanes` have changed. Returns whether its own extent changed.
    pub(crate) fn settle(&mut self, name: u32, lanes: u8) -> bool {
        with_widest(NodeRefit {
            changes: self,
            name,
            lanes,
        })
    }

    pub(crate) fn child(&self, name: u32) -> Child {
        let extent = match name & BOX {
            0 => self.tree.node(name).extent,
            _ => self.boxes.extent((name & !BOX) as usize),
        };
        Child { name, extent }
    }

    pub(crate) fn box_of(&self, child: &Child) -> OrientedBox {
        child.oriented(self.boxes)
    }
}

/// Refits one node, whose children in `lanes` have changed.
struct NodeRefit<'c, 'a, B> {
    changes: &'c mut BoxTreeChanges<'a, B>,
    name: u32,
    lanes: u8,
}

impl<B: Boxes> Work for NodeRefit<'_, '_, B> {
    type Output = bool;

    #[inline(always)]
    fn run<I: Instructions>(self, _: I) -> bool {
        let Self {
            changes,
            name,
            lanes,
        } = self;
        let mut children = [Child::default(); FULL];
        let node = changes.tree.node(name);
        let before = node.extent;
        for (lane, &child) in node.wide.children().iter().enumerate() {
            children[lane] = changes.child(child);
        }
        let tree = &mut *changes.tree;
        let node = tree.nodes.get_mut(name as usize);
        node.settle(&children, lanes, &tree.frame, changes.boxes);
        tree.surface += node.extent.half_surface() - before.half_surface();
        node.extent != before
    }
}

/// Refits the nodes that contain changed boxes: first those with only boxes as children, in memory order.
struct TreeRefit<'c, 'a, B> {
    changes: &'c mut BoxTreeChanges<'a, B>,
    changed: &'c IndexSet,
    touched: &'c IndexSet,
}

impl<B: Boxes> Work for TreeRefit<'_, '_, B> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) {
        let Self {
            changes,
            changed,
            touched,
        } = self;
        let boxes = changes.boxes;
        let tree = &mut *changes.tree;
        // The nodes whose own extent changed, and the nodes with nodes as children.
        let mut moved = IndexSet::new(tree.nodes.len());
        let mut inner = IndexSet::new(tree.nodes.len());
        let (frame, surface) = (tree.frame, &mut tree.surface);
        let mut names = touched.iter().peekable();
        while let Some(mut run) = tree.nodes.next_run(&mut names) {
            while let Some((name, node)) = run.next() {
                let Some((children, lanes)) = given_boxes(node, boxes, changed) else {
                    inner.insert(name);
                    continue;
                };
                let before = node.extent;
                node.settle(&children, lanes, &frame, boxes);
                if node.extent != before {
                    *surface += node.extent.half_surface() - before.half_surface();
                    moved.insert(name);
                }
            }
        }
        for name in changes.bottom_up(&inner) {
            let node = changes.tree.node(name);
            let children = node.wide.children().iter().enumerate();
            let lanes = children.fold(0, |lanes, (lane, &child)| {
                let has_changed = match child & BOX {
                    0 => moved.contains(child as usize),
                    _ => changed.contains((child & !BOX) as usize),
                };
                lanes | u8::from(has_changed) << lane
            });
            let one = NodeRefit {
                changes: &mut *changes,
                name,
                lanes,
            };
            if lanes != 0 && one.run(instructions) {
                moved.insert(name as usize);
            }
        }
    }
}

/// The children of a node with only boxes, and the lanes of those that changed; `None` for other nodes.
#[inline(always)]
fn given_boxes(
    node: &BoxNode,
    boxes: &impl Boxes,
    changed: &IndexSet,
) -> Option<([Child; FULL], u8)> {
    let mut children = [Child::default(); FULL];
    let mut lanes = 0;
    for lane in 0..node.wide.count as usize & 15 {
        let name = node.wide.children[lane & 7];
        if name & BOX == 0 {
            return None;
        }
        let place = (name & !BOX) as usize;
        lanes |= u8::from(changed.contains(place)) << lane;
        let extent = boxes.extent(place);
        children[lane & 7] = Child { name, extent };
    }
    Some((children, lanes))
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
    /// Refits the node's extent, and the boxes of the children in `lanes`.
    #[inline(always)]
    fn settle(
        &mut self,
        children: &[Child; FULL],
        lanes: u8,
        frame: &TreeFrame,
        boxes: &impl Boxes,
    ) {
        let children = &children[..self.wide.count as usize];
        let mut whole = children[0].extent;
        for child in &children[1..] {
            whole = whole.union(&child.extent);
        }
        self.extent = whole;
        let given = |lane: usize| children[lane].oriented(boxes);
        if !frame.put(&mut self.wide, lanes, given) {
            // A box does not fit: the whole node is packed again with room.
            let names = self.wide.children;
            self.wide = frame.packed(&names[..children.len()], &self.extent, given);
        }
    }
}
