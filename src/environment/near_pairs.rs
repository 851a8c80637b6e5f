//! The traversal to the pairs of objects that are near each other, within an environment or between two.

use super::object_tree::ObjectTree;
use super::snapshot::Snapshot;
use super::visit_near::NearScratch;
use crate::body_bounds::{BoundsByEight, BoxFrame, FrameLimits};
use crate::boxes::{EightBoxes, Extent, PackedBox};
use crate::environment::box_tree::{BOX, BoxTree};
use crate::index_set::IndexSet;
use crate::lanes::{Instructions, Work, each3, with_widest};
use crate::pair::bounds;
use crate::pose::Vec3;

/// Memory of a traversal, reused from one to the next.
#[derive(Debug, Default)]
pub struct NearPairScratch {
    near: NearScratch,
    open: Vec<NodePair>,
    strays: Strays,
}

/// The objects of a state that are not in its tree, as bodies that look for others; their numbers are the places in the list of them.
#[derive(Debug, Default)]
struct Strays {
    bounds: BoundsByEight,
    all: IndexSet,
}

/// A node of each tree, or a box; of a tree with itself, a node twice stands for the pairs within it.
#[derive(Clone, Copy, Debug)]
struct NodePair {
    bound: f32,
    /// The index of a node, or [`BOX`] + 8 times the index of a box's node + its lane.
    names: [u32; 2],
}

impl Snapshot {
    /// Visits the pairs of an object of this state and one of `other` that may be within `limit` of each other; without `other`,
    /// the pairs within this state, the lower place first. Each is visited once, in an order that depends on the trees. `visit`
    /// gets the places and a safe lower bound of the distance; it returns the limit from then on. Attached objects are passed over.
    pub fn visit_near_pairs(
        &self,
        other: Option<&Self>,
        limit: f64,
        scratch: &mut NearPairScratch,
        mut visit: impl FnMut([usize; 2], f64) -> f64,
    ) {
        let mut limit = limit;
        let NearPairScratch { near, open, strays } = scratch;
        let trees = [self.tree(), other.unwrap_or(self).tree()];
        let is_stray =
            |tree: &ObjectTree, place: usize| tree.strays.binary_search(&(place as u32)).is_ok();
        // The strays of this state against all objects of the other, or of its own.
        strays.list(self);
        let Strays { bounds, all } = &*strays;
        trees[1].visit_near(bounds, all, limit, near, |number, place, lower| {
            let is_within = other.is_none();
            let stray = trees[0].strays[number] as usize;
            if !(is_within && place <= stray && is_stray(trees[1], place)) {
                let [low, high] = [stray.min(place), stray.max(place)];
                let places = if is_within {
                    [low, high]
                } else {
                    [stray, place]
                };
                limit = visit(places, lower);
            }
            limit
        });
        if let Some(other) = other {
            // The strays of the other against what is in this state's tree.
            strays.list(other);
            let Strays { bounds, all } = &*strays;
            trees[0].visit_near(bounds, all, limit, near, |number, place, lower| {
                if !is_stray(trees[0], place) {
                    limit = visit([place, trees[1].strays[number] as usize], lower);
                }
                limit
            });
        }
        let is_self = other.is_none();
        let Some(descent) = PairDescent::new(trees, is_self, limit) else {
            return;
        };
        with_widest(PairVisit {
            descent,
            open,
            visit: |[a, b]: [usize; 2], lower| {
                visit(
                    if is_self {
                        [a.min(b), a.max(b)]
                    } else {
                        [a, b]
                    },
                    lower,
                )
            },
        });
    }
}

impl Strays {
    fn list(&mut self, state: &Snapshot) {
        let strays = &state.tree().strays;
        self.bounds.clear();
        self.all.clear(strays.len());
        for (number, &place) in strays.iter().enumerate() {
            self.bounds.push(state.bounds(place as usize));
            self.all.insert(number);
        }
    }
}

/// Two trees in a common unit.
struct PairDescent<'t> {
    trees: [&'t BoxTree; 2],
    is_self: bool,
    /// The unit, and the slack of the bounds.
    frame: BoxFrame,
    /// The unit of each tree in units of the frame.
    units: [f32; 2],
    /// The centre of each tree in the frame of the other.
    offsets: [[f32; 3]; 2],
    limit: f64,
}

impl<'t> PairDescent<'t> {
    /// `None` if a tree is empty.
    fn new(objects: [&'t ObjectTree; 2], is_self: bool, limit: f64) -> Option<Self> {
        let [a, b] = objects;
        a.tree.root().and(b.tree.root())?;
        let frames = [a.tree.frame(), b.tree.frame()];
        let apart = frames[1].center - frames[0].center;
        let limits = FrameLimits {
            size: a.radius.max(b.radius) + apart.norm(),
            largest_coordinate: a.largest_coordinate.max(b.largest_coordinate),
            ..FrameLimits::default()
        };
        let frame = BoxFrame::new(frames[0].center, &limits, a.deviation + b.deviation);
        let offset = apart * frame.inverse_scale;
        Some(Self {
            trees: [&a.tree, &b.tree],
            is_self,
            frame,
            units: frames.map(|tree| (tree.scale * frame.inverse_scale) as f32),
            offsets: [each3(|k| -offset[k] as f32), each3(|k| offset[k] as f32)],
            limit,
        })
    }

    /// A single-precision bound above this proves that the distance is above the limit.
    #[inline(always)]
    fn cutoff(&self) -> f32 {
        self.frame.cutoff(self.limit)
    }

    /// The safe lower bound of the distance that follows from a single-precision bound.
    #[inline(always)]
    fn lower(&self, bound: f32) -> f64 {
        self.frame.lower(bound)
    }

    /// All children of a node, in its own tree's frame.
    #[inline(always)]
    fn eight<I: Instructions>(&self, lanes: I, side: usize, node: u32) -> EightBoxes<I> {
        self.trees[side]
            .node(node)
            .wide
            .boxes(lanes, self.units[side])
    }

    /// The box of a child in the frame of the other tree.
    #[inline(always)]
    fn one(&self, side: usize, node: u32, lane: usize) -> PackedBox {
        let own = self.trees[side].node(node).wide.get(lane & 7);
        let (unit, offset) = (self.units[side], &self.offsets[side]);
        PackedBox {
            axes: own.axes,
            center: each3(|k| own.center[k] * unit + offset[k]),
            half: own.half.map(|half| half * unit),
        }
    }

    /// The box around a node in the frame of the other tree.
    #[inline(always)]
    fn whole(&self, side: usize, node: u32) -> PackedBox {
        let Extent { low, high } = &self.trees[side].node(node).extent;
        let center = 0.5 * (low + high) - self.trees[1 - side].frame().center;
        let half = 0.5 * (high - low);
        self.frame.pack_box(&[Vec3::x(), Vec3::y()], &center, &half)
    }

    /// What a child of a node is called in a [`NodePair`].
    #[inline(always)]
    fn name(&self, side: usize, node: u32, lane: usize) -> u32 {
        let child = self.trees[side].node(node).wide.children[lane & 7];
        if child & BOX == 0 {
            child
        } else {
            BOX | node << 3 | lane as u32
        }
    }

    /// The place of a box by its name.
    #[inline(always)]
    fn place(&self, side: usize, name: u32) -> usize {
        let (node, lane) = ((name & !BOX) >> 3, name & 7);
        (self.trees[side].node(node).wide.children[lane as usize] & !BOX) as usize
    }
}

struct PairVisit<'t, 'o, V> {
    descent: PairDescent<'t>,
    open: &'o mut Vec<NodePair>,
    visit: V,
}

impl<V: FnMut([usize; 2], f64) -> f64> Work for PairVisit<'_, '_, V> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        self.open.clear();
        if let [Some(a), Some(b)] = self.descent.trees.map(BoxTree::root) {
            self.open.push(NodePair {
                bound: f32::NEG_INFINITY,
                names: [a, b],
            });
        }
        while let Some(NodePair { bound, names }) = self.open.pop() {
            if bound > self.descent.cutoff() {
                continue;
            }
            let first = self.open.len();
            match names.map(|name| name & BOX != 0) {
                [false, false] if self.descent.is_self && names[0] == names[1] => {
                    self.open_node(lanes, names[0]);
                }
                [false, false] => self.open_both(lanes, names),
                [true, _] => self.open_side(lanes, 1, names[1], 0, names[0]),
                [_, true] => self.open_side(lanes, 0, names[0], 1, names[1]),
            }
            // The nearest on top.
            self.open[first..].sort_unstable_by(|a, b| b.bound.total_cmp(&a.bound));
        }
    }
}

impl<V: FnMut([usize; 2], f64) -> f64> PairVisit<'_, '_, V> {
    /// The pairs of children of one node, of a tree with itself.
    #[inline(always)]
    fn open_node<I: Instructions>(&mut self, lanes: I, node: u32) {
        let count = self.descent.trees[0].node(node).wide.count as usize & 15;
        let eight = self.descent.eight(lanes, 0, node);
        for lane in 0..count {
            let name = self.descent.name(0, node, lane);
            if name & BOX == 0 {
                self.open.push(NodePair {
                    bound: f32::NEG_INFINITY,
                    names: [name, name],
                });
            }
            let one = self.descent.one(1, node, lane);
            let later = ((1u32 << count) - 1) & !((2u32 << lane) - 1);
            self.test(lanes, (0, node, &eight), later, (&one, name));
        }
    }

    /// The pairs of children of two nodes.
    #[inline(always)]
    fn open_both<I: Instructions>(&mut self, lanes: I, [a, b]: [u32; 2]) {
        let descent = &self.descent;
        let wide = &descent.trees[1].node(b).wide;
        let all = (1u32 << wide.count) - 1;
        let bounds = bounds(lanes, &descent.eight(lanes, 1, b), &descent.whole(0, a));
        let mut near = lanes.at_most(bounds, descent.cutoff()) & all;
        let eight = descent.eight(lanes, 0, a);
        let all = (1u32 << descent.trees[0].node(a).wide.count) - 1;
        while near != 0 {
            let lane = near.trailing_zeros() as usize;
            near &= near - 1;
            let one = self.descent.one(1, b, lane);
            let name = self.descent.name(1, b, lane);
            self.test(lanes, (0, a, &eight), all, (&one, name));
        }
    }

    /// The children of a node of one tree with a box of the other.
    #[inline(always)]
    fn open_side<I: Instructions>(
        &mut self,
        lanes: I,
        side: usize,
        node: u32,
        box_side: usize,
        name: u32,
    ) {
        let descent = &self.descent;
        let one = descent.one(box_side, (name & !BOX) >> 3, name as usize & 7);
        let eight = descent.eight(lanes, side, node);
        let all = (1u32 << descent.trees[side].node(node).wide.count) - 1;
        self.test(lanes, (side, node, &eight), all, (&one, name));
    }

    /// Tests some children of a node against one box of the other tree: two boxes that are near are visited, other pairs are put
    /// on the stack.
    #[inline(always)]
    fn test<I: Instructions>(
        &mut self,
        lanes: I,
        (side, node, eight): (usize, u32, &EightBoxes<I>),
        among: u32,
        (one, other): (&PackedBox, u32),
    ) {
        let bounds = bounds(lanes, eight, one);
        let mut near = lanes.at_most(bounds, self.descent.cutoff()) & among;
        let bounds = lanes.array(bounds);
        while near != 0 {
            let lane = near.trailing_zeros() as usize & 7;
            near &= near - 1;
            let own = self.descent.name(side, node, lane);
            let names = if side == 0 {
                [own, other]
            } else {
                [other, own]
            };
            let bound = bounds[lane];
            if own & other & BOX == 0 {
                self.open.push(NodePair { bound, names });
            } else if bound <= self.descent.cutoff() {
                let places = [
                    self.descent.place(0, names[0]),
                    self.descent.place(1, names[1]),
                ];
                self.descent.limit = (self.visit)(places, self.descent.lower(bound));
            }
        }
    }
}
