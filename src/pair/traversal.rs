//! The report's multi-use algorithm (Figure 2): one traversal of two trees for every query. The visitor says which pairs it wants
//! and when to stop.

use std::ops::ControlFlow;

use super::box_bounds::{
    BoundRefinement, Motion32, ROUNDING, bounds, gap_of_boxes, gaps_to_point, sharper_bounds,
};
use super::nearest_first::{Entry, PendingPairs};
use super::pair_distance::PrimitiveScratch;
use super::pair_visits::{PairVisits, SinglePair, State};
use super::pairing::{EMPTY, MovedOutline, Pairing};
use super::visitor::Visitor;
use super::winding::RayScratch;
use crate::boxes::{PackedBox, SIZE_STEPS};
use crate::error::Result;
use crate::hierarchy::packed::{NodeRef, PackedTree, power_of_two_above};
use crate::lanes::{Instructions, Work, each3, with_widest};
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

/// Scratch memory of the traversal, reused from query to query.
pub struct Scratch {
    stack: PendingPairs,
    buffer: MovedOutline,
    state: State,
    pub(super) rays: RayScratch,
}

impl Default for Scratch {
    fn default() -> Self {
        Self {
            stack: PendingPairs::default(),
            buffer: EMPTY,
            state: State::default(),
            rays: RayScratch::default(),
        }
    }
}

impl Scratch {
    /// Counts the work done with this memory, against the limit of a call.
    pub fn meter(&self) -> &WorkMeter {
        &self.state.meter
    }

    pub fn meter_mut(&mut self) -> &mut WorkMeter {
        &mut self.state.meter
    }

    /// The scratch memory for primitive distances.
    pub fn for_primitives(&mut self) -> &mut PrimitiveScratch {
        &mut self.state.primitives
    }

    /// Counts a pair of primitives that is looked at.
    pub fn count_primitive_pair(&mut self) {
        let meter = &mut self.state.meter;
        meter.count_primitives(1);
        meter.done.primitive_distances += 1;
    }

    /// Counts a primitive pair whose distance is to be computed, and lends the memory for it.
    pub fn for_one_pair(&mut self) -> Result<&mut PrimitiveScratch> {
        self.count_primitive_pair();
        self.state.meter.check()?;
        Ok(&mut self.state.primitives)
    }

    /// Counts a ray with the boxes and primitives that it visited.
    pub(super) fn count_rays(&mut self) {
        let seen = std::mem::take(&mut self.rays.near.seen);
        self.state.meter.count_nodes(1 + seen.boxes);
        self.state.meter.count_primitives(seen.primitives);
    }
}

/// Visits the primitives at two places.
pub fn visit_pair(
    pairing: &Pairing,
    places: [u32; 2],
    scratch: &mut Scratch,
    visitor: &mut dyn Visitor,
) -> ControlFlow<()> {
    let visits = PairVisits::new(pairing, &mut scratch.buffer, &mut scratch.state, visitor);
    with_widest(SinglePair { visits, places })
}

/// Traverses both trees from their roots, after visiting the primitives at `first` if given. Descends nearest child first;
/// whenever a nearer pair was found, it continues with the nearest of all waiting pairs. Breaks as soon as the visitor does, or
/// when the meter's limit is exceeded: the visitor has then not seen all pairs, and the meter refuses the result.
pub fn traverse(
    pairing: &Pairing,
    first: Option<[u32; 2]>,
    scratch: &mut Scratch,
    visitor: &mut dyn Visitor,
) -> ControlFlow<()> {
    let Scratch {
        stack,
        buffer,
        state,
        ..
    } = scratch;
    let mut visits = PairVisits::new(pairing, buffer, state, visitor);
    if let Some(places) = pairing.only_places() {
        if !pairing.are_outlines(places) {
            return visits.visit_without_outlines(places);
        }
        return with_widest(SinglePair { visits, places });
    }
    with_widest(Traversal {
        visits,
        first,
        stack,
    })
}

struct Traversal<'a> {
    visits: PairVisits<'a>,
    first: Option<[u32; 2]>,
    stack: &'a mut PendingPairs,
}

impl Work for Traversal<'_> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) -> ControlFlow<()> {
        if let Some(places) = self.first {
            self.visits.state.meter.done.cache_hits += 1;
            self.visits.visit(lanes, places, true)?;
        }
        Walk {
            first: self.first,
            ..Walk::new(self.visits, self.stack)
        }
        .run(lanes)
    }
}

/// Bounds are sharpened only while the cutoff is above this, in units of the pair. With a cutoff near 0 the boxes that
/// matter overlap, and sharper bounds prune no more. A smaller value sharpens in vain more often, a larger one leaves boxes of
/// near bodies that sharper bounds would prune.
const SHARP_FROM: f32 = 1e-4;

/// The traversal of two trees. Lengths in single precision are in units of `scale`, the next power of two above the pair's
/// size.
struct Walk<'a> {
    visits: PairVisits<'a>,
    /// The primitives that have been visited before.
    first: Option<[u32; 2]>,
    trees: [&'a PackedTree; 2],
    /// From B's frame into A's, and from A's into B's.
    motions: [Motion32; 2],
    /// Added to the size codes of B to compare them with those of A.
    size_offset: i32,
    inverse_scale: f64,
    /// The direction at the nearest pair so far, as unit vectors or zero: from A to B in A's frame, and from B to A in B's
    /// frame.
    directions: [[f32; 3]; 2],
    /// Of a body with a single primitive, the point of its core that is nearest to the other body along its direction, in the other
    /// body's frame. The other body's number is the place.
    nearest: [Option<[f32; 3]>; 2],
    /// Bounds are lowered by this. It includes the radii around the cores, which the boxes leave out.
    slack: f64,
    /// A body has a single primitive.
    has_single: bool,
    /// That is round, and its box leaves out the radius.
    is_round: bool,
    stack: &'a mut PendingPairs,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    fn new(visits: PairVisits<'a>, stack: &'a mut PendingPairs) -> Self {
        let pairing = visits.pairing;
        let [a, b] = [pairing.a.packed(), pairing.b.packed()];
        let size = pairing.precision.size;
        let scale = power_of_two_above(size);
        let inverse_scale = 1.0 / scale;
        let exponent = |tree: &PackedTree| (tree.scale().to_bits() >> 52) as i32;
        Self {
            first: None,
            motions: [
                Motion32::new(&pairing.relative, b.scale(), scale),
                Motion32::new(&pairing.relative.inverse(), a.scale(), scale),
            ],
            size_offset: SIZE_STEPS * (exponent(b) - exponent(a)),
            inverse_scale,
            directions: [[0.0; 3]; 2],
            nearest: [None; 2],
            slack: pairing.slack() + ROUNDING * size + a.core_radius() + b.core_radius(),
            has_single: a.root().is_leaf() || b.root().is_leaf(),
            is_round: a.core_radius() + b.core_radius() > 0.0,
            visits,
            trees: [a, b],
            stack,
        }
    }

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) -> ControlFlow<()> {
        self.aim_at_centers(lanes);
        self.turn_direction();
        let [a, b] = [self.trees[0].root(), self.trees[1].root()];
        self.stack.clear();
        let bound = f32::NEG_INFINITY;
        self.stack.push(&Entry { bound, a, b });
        while let Some(entry) = self.stack.pop() {
            if self.visits.state.meter.is_exceeded() {
                return ControlFlow::Break(());
            }
            let cutoff = self.cutoff();
            if !self.matters(&entry, cutoff) {
                continue;
            }
            if entry.is_of_leaves() {
                let before = self.visits.wanted.bound;
                self.visit_leaves(lanes, entry.a, entry.b)?;
                // The neighbours of a nearer pair need not be the nearest: continue from the best waiting pair.
                if self.visits.wanted.bound < before {
                    self.stack.raise_nearest(lanes);
                }
                continue;
            }
            self.open(lanes, &entry, cutoff);
        }
        ControlFlow::Continue(())
    }

    /// The pruning cutoff in units of the pair: pairs with larger bounds are skipped.
    #[inline(always)]
    fn cutoff(&self) -> f32 {
        (((self.visits.wanted.bound + self.slack) * self.inverse_scale) as f32).next_up()
    }

    #[inline(always)]
    fn is_irrelevant(&self, a: NodeRef, b: NodeRef) -> bool {
        self.visits
            .wanted
            .irrelevant_from
            .is_some_and(|from| from <= [self.trees[0].lowest(a), self.trees[1].lowest(b)])
    }

    /// The unit of one body's tree, in units of the pair.
    #[inline(always)]
    fn unit(&self, body: usize) -> f32 {
        self.motions[1 - body].factor
    }

    /// Starts with the direction between the centres, unless the direction of the pair visited first separates the root boxes
    /// better.
    #[inline(always)]
    fn aim_at_centers<I: Instructions>(&mut self, lanes: I) {
        let centers = -self.visits.pairing.relative.translation;
        let Some(centers) = centers.try_normalize(0.0) else {
            return;
        };
        let first = self.visits.state.direction;
        if first != Vec3::zeros() {
            let a = self.trees[0].bounding_box(self.trees[0].root());
            let a = PackedBox {
                axes: a.axes,
                center: each3(|k| a.center[k] * self.unit(0)),
                half: each3(|k| a.half[k] * self.unit(0)),
            };
            let b = self.trees[1].box_in_lanes(lanes, self.trees[1].root());
            let b = self.motions[0].apply(lanes, b);
            if gap_of_boxes(&b, &a, &first) > 0.0 || gap_of_boxes(&b, &a, &centers) <= 0.0 {
                return;
            }
        }
        self.visits.state.direction = centers;
    }

    /// Rotates a new direction into both frames.
    #[inline(always)]
    fn turn_direction(&mut self) {
        let direction = each3(|k| self.visits.state.direction[k] as f32);
        self.directions = [each3(|k| -direction[k]), self.motions[1].turn(&direction)];
        if self.has_single {
            self.nearest = [0, 1].map(|body| {
                let from = self.directions[body].map(f64::from).into();
                let point = self.visits.pairing.nearest_of_only(1 - body, &from)?;
                Some(each3(|k| (point[k] * self.inverse_scale) as f32))
            });
        }
    }

    /// Opens the larger node of a pair, or the only one that is not a leaf.
    #[inline(always)]
    fn open<I: Instructions>(&mut self, lanes: I, entry: &Entry, cutoff: f32) {
        let Entry { a, b, .. } = *entry;
        let [size_a, size_b] = [
            self.trees[0].size_code(a),
            self.trees[1].size_code(b) + self.size_offset,
        ];
        let opened = if a.is_leaf() {
            1
        } else if b.is_leaf() {
            0
        } else {
            usize::from(size_b > size_a)
        };
        let (unit, other) = if opened == 0 { (a, b) } else { (b, a) };
        let tree = self.trees[opened];
        let other_tree = self.trees[1 - opened];
        let index = tree.index(unit);
        let node = tree.node(index);
        let one = self.motions[opened].apply(lanes, other_tree.core_in_lanes(lanes, other));
        let eight = node.boxes(lanes, self.unit(opened));
        let children = tree.children(lanes, index);
        let among = (1 << children.count) - 1;
        let is_aimed = self.visits.state.direction != Vec3::zeros();
        let direction = &self.directions[opened];
        let mut beyond = lanes.splat(f32::NEG_INFINITY);
        if is_aimed && let Some(point) = &self.nearest[opened] {
            beyond = gaps_to_point(lanes, &eight, point, direction);
            if lanes.at_most(beyond, cutoff) & among == 0 {
                self.visits.state.meter.count_nodes(children.count as u64);
                return;
            }
        }
        // With a cutoff near 0, sharper bounds prune no more.
        let bounds = if (self.visits.wanted.refines || self.is_round) && cutoff > SHARP_FROM {
            let wanted = BoundRefinement {
                direction: is_aimed.then_some(direction),
                cutoff,
                among,
            };
            sharper_bounds(lanes, &eight, &one, &wanted)
        } else {
            bounds(lanes, &eight, &one)
        };
        let bounds = lanes.max(bounds, beyond);
        self.visits.state.meter.count_nodes(children.count as u64);
        self.stack
            .push_nearest_last(lanes, bounds, cutoff, opened, &children, other);
    }

    #[inline(always)]
    fn matters(&self, entry: &Entry, cutoff: f32) -> bool {
        entry.bound <= cutoff && !self.is_irrelevant(entry.a, entry.b)
    }

    #[inline(always)]
    fn visit_leaves<I: Instructions>(
        &mut self,
        lanes: I,
        a: NodeRef,
        b: NodeRef,
    ) -> ControlFlow<()> {
        let places = [self.trees[0].place(a), self.trees[1].place(b)];
        if self.first == Some(places) {
            return ControlFlow::Continue(());
        }
        let nearest = self.visits.state.direction_at;
        let visited = self.visits.visit(lanes, places, true);
        if self.visits.state.direction_at < nearest {
            self.turn_direction();
        }
        visited
    }
}
