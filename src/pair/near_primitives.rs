//! The primitives of one body that may meet a box.

use super::box_bounds::bounds;
use crate::boxes::PackedBox;
use crate::hierarchy::packed::{NodeRef, PackedTree};
use crate::lanes::{Instructions, Work, with_widest};

/// Scratch memory of descents, reused from one to the next.
#[derive(Default)]
pub struct NearPrimitives {
    open: Vec<NodeRef>,
    found: Vec<u32>,
    /// Boxes and primitives visited since this was last counted.
    pub seen: Seen,
}

/// The boxes and primitives that descents visited.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    pub boxes: u64,
    pub primitives: u64,
}

impl NearPrimitives {
    /// The primitives whose boxes are within `error` of a box, in ascending order, each once; everything in units of the tree.
    pub fn find(&mut self, tree: &PackedTree, one: PackedBox, error: f64) -> &[u32] {
        self.found.clear();
        with_widest(Descent {
            tree,
            one,
            cutoff: (error as f32).next_up(),
            near: &mut *self,
        });
        self.seen.primitives += self.found.len() as u64;
        // A primitive with several leaves is found more than once.
        self.found.sort_unstable();
        self.found.dedup();
        &self.found
    }
}

struct Descent<'a> {
    tree: &'a PackedTree,
    one: PackedBox,
    cutoff: f32,
    near: &'a mut NearPrimitives,
}

impl Work for Descent<'_> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) {
        let NearPrimitives { open, found, seen } = self.near;
        open.clear();
        open.push(self.tree.root());
        while let Some(unit) = open.pop() {
            if unit.is_leaf() {
                let place = self.tree.place(unit) as usize;
                found.push(self.tree.primitives().entry(place).primitive);
                continue;
            }
            let index = self.tree.index(unit);
            let eight = self.tree.node(index).boxes(lanes, 1.0);
            let bounds = bounds(lanes, &eight, &self.one);
            let children = self.tree.children(lanes, index);
            seen.boxes += children.count as u64;
            let mut near = lanes.at_most(bounds, self.cutoff) & ((1 << children.count) - 1);
            while near != 0 {
                let lane = near.trailing_zeros() as usize & 7;
                near &= near - 1;
                open.push(children.units[lane]);
            }
        }
    }
}
