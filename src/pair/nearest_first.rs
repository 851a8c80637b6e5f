//! The node pairs that wait to be visited: a stack. Of the pairs pushed together the nearest is on top; on request the nearest
//! of all is moved there.

use crate::hierarchy::packed::{Children, NodeRef};
use crate::lanes::{Instructions, Lanes8};

/// A pair of nodes or leaves, with the lower bound of its distance in units of the pair.
#[derive(Clone, Copy)]
pub struct Entry {
    pub bound: f32,
    pub a: NodeRef,
    pub b: NodeRef,
}

impl Entry {
    #[inline(always)]
    pub fn is_of_leaves(&self) -> bool {
        self.a.is_leaf() && self.b.is_leaf()
    }
}

/// The stack of node pairs.
#[derive(Default)]
pub struct PendingPairs {
    bounds: Vec<f32>,
    units: [Vec<NodeRef>; 2],
    count: usize,
}

impl PendingPairs {
    pub fn clear(&mut self) {
        self.count = 0;
    }

    pub fn push(&mut self, entry: &Entry) {
        if self.count == self.bounds.len() {
            self.grow();
        }
        self.bounds[self.count] = entry.bound;
        self.units[0][self.count] = entry.a;
        self.units[1][self.count] = entry.b;
        self.count += 1;
    }

    #[inline(always)]
    pub fn top(&self) -> Option<Entry> {
        let top = self.count.checked_sub(1)?;
        Some(Entry {
            bound: self.bounds[top],
            a: self.units[0][top],
            b: self.units[1][top],
        })
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<Entry> {
        let top = self.top()?;
        self.count -= 1;
        Some(top)
    }

    /// Moves the nearest of all pairs to the top.
    #[inline(always)]
    pub fn raise_nearest<I: Instructions>(&mut self, lanes: I) {
        let Some(top) = self.count.checked_sub(1) else {
            return;
        };
        if self.count + 8 >= self.bounds.len() {
            self.grow();
        }
        // Eight at a time; the last block is padded with infinity.
        self.bounds[self.count..self.count + 8].fill(f32::INFINITY);
        let (eights, _) = self.bounds[..self.count + 7].as_chunks::<8>();
        let mut least = lanes.splat(f32::INFINITY);
        for eight in eights {
            least = lanes.min(lanes.load(eight), least);
        }
        let least = lanes.least(least);
        let mut place = top;
        for (eight, first) in eights.iter().zip((0..).step_by(8)) {
            let found = lanes.at_most(lanes.load(eight), least);
            if found != 0 {
                place = first + found.trailing_zeros() as usize;
                break;
            }
        }
        self.bounds.swap(place, top);
        self.units[0].swap(place, top);
        self.units[1].swap(place, top);
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self) {
        let size = (2 * self.bounds.len()).max(256);
        self.bounds.resize(size, 0.0);
        for units in &mut self.units {
            units.resize(size, NodeRef::from_number(0));
        }
    }

    /// Pushes those of up to eight pairs whose bound is at most the cutoff: the children of a node of body `opened`, each
    /// paired with `other`. They are moved together, without a loop whose exit would be mispredicted.
    #[inline(always)]
    pub fn push_nearest_last<I: Instructions>(
        &mut self,
        lanes: I,
        bounds: Lanes8<I>,
        cutoff: f32,
        opened: usize,
        children: &Children,
        other: NodeRef,
    ) {
        let kept = lanes.at_most(bounds, cutoff) & ((1 << children.count) - 1);
        if kept == 0 {
            return;
        }
        if self.count + 8 >= self.bounds.len() {
            self.grow();
        }
        let place = self.count;
        let [units_a, units_b] = &mut self.units;
        let (with_child, with_other) = if opened == 0 {
            (units_a, units_b)
        } else {
            (units_b, units_a)
        };
        let array = lanes.array(bounds);
        let mut nearest = kept.trailing_zeros() as usize & 7;
        let mut last = place;
        if kept & (kept - 1) != 0 {
            let near = lanes.only(bounds, kept);
            let least = lanes.least(near);
            nearest = lanes.at_most(near, least).trailing_zeros() as usize & 7;
            let others = kept & !(1 << nearest);
            last += others.count_ones() as usize;
            let bounds = lanes.gathered(&array.map(f32::to_bits), others);
            let numbers = lanes.gathered(&children.units.map(NodeRef::number), others);
            self.bounds[place..place + 8].copy_from_slice(&bounds.map(f32::from_bits));
            with_child[place..place + 8].copy_from_slice(&numbers.map(NodeRef::from_number));
            with_other[place..place + 8].fill(other);
        }
        self.bounds[last] = array[nearest];
        with_child[last] = children.units[nearest];
        with_other[last] = other;
        self.count = last + 1;
    }
}
