//! The proof that moving pairs stay apart: intervals of the motion are halved until bounds over the interval part all boxes and
//! primitives. A pair of boxes that an interval decides is never looked at again in its halves: each interval begins with what the one
//! above it left undecided, its front.

use super::moving_pair::{MovingPair, OverInterval};
use crate::error::Result;
use crate::hierarchy::packed::{NodeRef, PackedTree};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::{Scratch, SweptLeaves, swept_gaps};

/// Boxes whose gap the motion may take off by more than this part of their sizes are left to the halves of the interval, others
/// are opened. Larger values open boxes that a shorter interval would part; smaller ones look at the same boxes again. Not tuned by
/// a benchmark yet.
const OPEN_NODES_BELOW: f32 = 0.08;
/// The same for pairs of primitives.
const MEASURE_LEAVES_BELOW: f32 = 0.04;

/// Intervals no longer than this, a part of the motion, are not halved: over them hardly anything moves by more than rounding.
const SHORTEST_INTERVAL: f64 = 1.0 / (1u64 << 40) as f64;

/// Some children of a node against a unit of the other body.
#[derive(Clone, Copy)]
struct Group {
    pair: u32,
    node: u32,
    other: NodeRef,
    /// Which body's node it is, 0 or 1.
    opened: u8,
    /// The children, as bits.
    lanes: u8,
}

/// Two primitives, and what parted them last: see [`SweptLeaves::Undecided`].
#[derive(Clone, Copy)]
struct Leaves {
    pair: u32,
    places: [u32; 2],
    direction: [f32; 3],
}

/// A part of the front: groups and leaves between two places of their lists each.
#[derive(Clone, Copy)]
struct Front {
    groups: [usize; 2],
    leaves: [usize; 2],
}

struct Interval {
    times: [f64; 2],
    front: Front,
}

/// Memory of a proof.
#[derive(Default)]
pub(super) struct ProofScratch {
    groups: Vec<Group>,
    leaves: Vec<Leaves>,
    open: Vec<Group>,
}

/// What else must hold at each time beside that pairs stay apart.
pub(super) trait Condition {
    /// What is known over an interval, of which the middle and the half length are given.
    fn over(&mut self, middle: f64, half: f64) -> Result<Verdict>;
}

/// What is known of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Free,
    /// At its middle there is contact.
    Meets,
    Undecided,
}

/// How an interval proof is to end.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProofLimits {
    /// The time of contact is to be known to this.
    pub tolerance: f64,
    /// Any contact ends the proof; else the first is looked for.
    pub any_contact: bool,
}

/// How a proof ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Proof {
    Free,
    /// All before the first time is free; at the second there is contact.
    Contact([f64; 2]),
    /// All before the interval is free; in it neither a proof nor a contact was found.
    Undecided([f64; 2]),
    /// The work ended: all before this time is free.
    Exceeded(f64),
}

/// Looks for the first contact of moving pairs, or proves that there is none at any time from 0 to 1.
pub(super) fn prove(
    pairs: &[MovingPair],
    condition: &mut impl Condition,
    limits: ProofLimits,
    memory: &mut ProofScratch,
    scratch: &mut Scratch,
) -> Result<Proof> {
    with_widest(Prover {
        pairs,
        condition,
        limits,
        memory,
        scratch,
    })
}

struct Prover<'a, C> {
    pairs: &'a [MovingPair<'a>],
    condition: &'a mut C,
    limits: ProofLimits,
    memory: &'a mut ProofScratch,
    scratch: &'a mut Scratch,
}

impl<C: Condition> Work for Prover<'_, C> {
    type Output = Result<Proof>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<Proof> {
        let Self {
            pairs,
            condition,
            limits,
            memory,
            scratch,
        } = self;
        let ProofScratch {
            groups,
            leaves,
            open,
        } = memory;
        groups.clear();
        leaves.clear();
        open.clear();
        for (number, pair) in (0..).zip(pairs) {
            groups.push(Group {
                pair: number,
                node: 0,
                other: pair.b.packed().root(),
                opened: 0,
                lanes: 1,
            });
        }
        let mut todo = vec![Interval {
            times: [0.0, 1.0],
            front: Front {
                groups: [0, groups.len()],
                leaves: [0, 0],
            },
        }];
        let mut contact: Option<f64> = None;
        let mut over: Vec<Option<OverInterval>> = Vec::new();
        while let Some(Interval { times, front }) = todo.pop() {
            let [start, end] = times;
            if contact.is_some_and(|contact| start >= contact) {
                continue;
            }
            if scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            groups.truncate(front.groups[1]);
            leaves.truncate(front.leaves[1]);
            let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
            over.clear();
            over.resize_with(pairs.len(), || None);
            let verdict = condition.over(middle, half)?;
            let mut step = Step {
                pairs,
                over: &mut over,
                times: [middle, half],
                groups,
                leaves,
                scratch,
                meets: verdict == Verdict::Meets,
                first_leaf: front.leaves[1],
            };
            // Primitives first: they decide contacts.
            for i in front.leaves[0]..front.leaves[1] {
                let pair = step.leaves[i];
                step.visit(pair);
            }
            open.extend_from_slice(&step.groups[front.groups[0]..front.groups[1]]);
            while let Some(group) = open.pop() {
                step.open(lanes, group, open);
            }
            let meets = step.meets;
            if scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            let left = Front {
                groups: [front.groups[1], groups.len()],
                leaves: [front.leaves[1], leaves.len()],
            };
            let is_left = |[first, end]: [usize; 2]| first < end;
            let is_undecided =
                is_left(left.groups) || is_left(left.leaves) || verdict != Verdict::Free;
            if meets {
                contact = Some(middle);
                if limits.any_contact {
                    return Ok(Proof::Contact([start, middle]));
                }
            } else if !is_undecided {
                continue;
            }
            if let Some(contact) = contact
                && contact <= end
                && end - start <= limits.tolerance
            {
                return Ok(Proof::Contact([start, contact]));
            }
            // The first such interval ends the proof, so that a graze costs one descent.
            if end - start <= SHORTEST_INTERVAL {
                return Ok(Proof::Undecided(times));
            }
            if !meets {
                todo.push(Interval {
                    times: [middle, end],
                    front: left,
                });
            }
            todo.push(Interval {
                times: [start, middle],
                front: left,
            });
        }
        Ok(match contact {
            Some(contact) => Proof::Contact([contact, contact]),
            None => Proof::Free,
        })
    }
}

/// One interval's share of the proof.
struct Step<'s, 'p> {
    pairs: &'p [MovingPair<'p>],
    /// The pairs over the interval, made when they are first asked for.
    over: &'s mut Vec<Option<OverInterval<'p>>>,
    /// The interval's middle and half its length.
    times: [f64; 2],
    groups: &'s mut Vec<Group>,
    leaves: &'s mut Vec<Leaves>,
    scratch: &'s mut Scratch,
    /// Something meets at the middle: all else is left to the half before it.
    meets: bool,
    /// Where the leaves that the interval leaves undecided begin.
    first_leaf: usize,
}

impl Step<'_, '_> {
    /// Decides a pair of primitives, or leaves it to the halves.
    fn visit(&mut self, mut pair: Leaves) {
        if self.meets {
            self.leaves.push(pair);
            return;
        }
        let number = pair.pair as usize;
        let [middle, half] = self.times;
        let over = self.over[number].get_or_insert_with(|| self.pairs[number].over(middle, half));
        self.scratch.count_primitive_pair();
        let found = over.pairing.swept_leaves(
            pair.places,
            &pair.direction,
            &over.sweep,
            &over.limits,
            self.scratch.for_primitives(),
        );
        match found {
            SweptLeaves::Free => return,
            SweptLeaves::Undecided(direction) => pair.direction = direction,
            SweptLeaves::Meet => self.meets = true,
        }
        self.leaves.push(pair);
        if self.meets {
            // The half before it asks first what met.
            let last = self.leaves.len() - 1;
            self.leaves.swap(self.first_leaf, last);
        }
    }

    /// Looks at the children of a group: decided ones fall away, others are opened, visited, or left to the halves.
    #[inline(always)]
    fn open<I: Instructions>(&mut self, lanes: I, mut group: Group, open: &mut Vec<Group>) {
        if self.meets || self.scratch.meter().is_exceeded() {
            self.groups.push(group);
            return;
        }
        let number = group.pair as usize;
        let pair = &self.pairs[number];
        let [middle, half] = self.times;
        let over = self.over[number].get_or_insert_with(|| pair.over(middle, half));
        let trees: [&PackedTree; 2] = [pair.a.packed(), pair.b.packed()];
        let opened = usize::from(group.opened);
        let (tree, other_tree) = (trees[opened], trees[1 - opened]);
        let index = group.node as usize;
        let node = tree.node(index);
        let unit = over.motions[1 - opened].factor;
        let one = over.motions[opened].apply(lanes, other_tree.core_in_lanes(lanes, group.other));
        let eight = node.boxes(lanes, unit);
        let bends = [over.bends[opened], over.bends[1 - opened]];
        let gaps = swept_gaps(lanes, &eight, &one, &over.twists[opened], bends);
        self.scratch
            .meter_mut()
            .count_nodes(u64::from(group.lanes.count_ones()));
        let mut near = lanes.at_most(gaps.swept, over.cutoff) & u32::from(group.lanes);
        if near == 0 {
            return;
        }
        let taken_off = lanes.array(lanes.sub(gaps.still, gaps.swept));
        let halves = lanes.array(lanes.sqrt(lanes.dot(&eight.half, &eight.half)));
        let [x, y, z] = one.half;
        let other_size = (x * x + y * y + z * z).sqrt();
        let children = tree.children(index);
        let mut left = 0u8;
        while near != 0 {
            let lane = near.trailing_zeros() as usize & 7;
            near &= near - 1;
            let child = children.units[lane];
            let are_leaves = child.is_leaf() && group.other.is_leaf();
            let limit = if are_leaves {
                MEASURE_LEAVES_BELOW
            } else {
                OPEN_NODES_BELOW
            };
            let size = halves[lane];
            if taken_off[lane] > limit * (size + other_size) {
                left |= 1 << lane;
                continue;
            }
            let units = if opened == 0 {
                [child, group.other]
            } else {
                [group.other, child]
            };
            if are_leaves {
                self.visit(Leaves {
                    pair: group.pair,
                    places: [trees[0].place(units[0]), trees[1].place(units[1])],
                    direction: [0.0; 3],
                });
                continue;
            }
            let opens_b = if units[0].is_leaf() || units[1].is_leaf() {
                units[0].is_leaf()
            } else {
                (opened == 0) == (other_size > size)
            };
            let side = usize::from(opens_b);
            let node = trees[side].index(units[side]);
            open.push(Group {
                pair: group.pair,
                node: node as u32,
                other: units[1 - side],
                opened: side as u8,
                lanes: ((1u32 << trees[side].node(node).count) - 1) as u8,
            });
        }
        if left != 0 {
            group.lanes = left;
            self.groups.push(group);
        }
    }
}
