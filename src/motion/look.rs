//! One piece's look at its part of the front: bounds through the piece decide pairs of boxes and primitives, or leave them to the halves.

use super::crowd::Crowd;
use super::first_contact::MeetingLeaves;
use super::front::{Bundle, Front, FrontPart, Leaves};
use super::moving_pair::MovingPair;
use super::over_pairs::OverPairs;
use super::over_piece::PairOver;
use super::pair_look::PairLook;
use super::piece::Piece;
use super::set_tree::SetVerdict;
use crate::lanes::Instructions;
use crate::pair::{Scratch, SweptLeaves};

/// What a primitive pair costs, in groups of boxes.
const MEASURE_COST: u32 = 4;

/// How many primitive pairs of a complement are asked in one piece whether they stay within each other: of those that larger pieces left,
/// and of new ones.
const MAX_DEPTHS: u32 = 8;

/// One piece's look at its part of the front.
pub(super) struct Look<'l, 'p, P: Piece> {
    pub pairs: &'p [MovingPair<'p>],
    pub crowds: &'p [Crowd],
    pub over: &'l mut OverPairs<'p, P::Lists>,
    pub piece: &'l mut P,
    pub front: &'l mut Front,
    pub scratch: &'l mut Scratch,
    /// What is known of the set tree's leaves.
    pub verdicts: &'l mut [SetVerdict],
    /// The leaf that is looked at.
    pub leaf: LeafLook,
    /// The pair that is looked at.
    pub pair: PairLook,
    /// Primitives that meet where it is looked at.
    pub met: Option<MeetingLeaves>,
    /// Rounding hides whether primitives are apart where it is looked at.
    pub is_grazed: bool,
}

/// A leaf that is looked at.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LeafLook {
    pub(super) complement: bool,
    /// It meets, or its complement is proved: what is left of it is not looked at.
    is_decided: bool,
    meets: bool,
    /// How many primitive pairs of a complement may still be asked whether they stay within each other.
    depths: u32,
    /// Where its undecided bundles, groups and leaves begin.
    first: [usize; 3],
}

impl<P: Piece> Look<'_, '_, P> {
    /// Prepares for a part of the front; fills in what was known before.
    pub fn start(&mut self, part: &FrontPart) {
        self.front.truncate(part);
        self.over.start();
        for i in part.settled[0]..part.settled[1] {
            let (leaf, verdict) = self.front.settled[i];
            self.verdicts[leaf as usize] = verdict;
            self.front.settled.push((leaf, verdict));
        }
    }

    /// Notes what holds of a leaf through the whole piece.
    pub fn settle(&mut self, leaf: usize, verdict: SetVerdict) {
        self.verdicts[leaf] = verdict;
        self.front.settled.push((leaf as u32, verdict));
    }

    /// What is left for the halves.
    pub fn left(&self, part: &FrontPart) -> FrontPart {
        self.front.part_after(part)
    }

    /// Looks at one leaf's share of a part, which begins at `cursor`; moves the cursor behind it. A leaf that is passed is left to
    /// the halves as it is.
    #[inline(always)]
    pub fn look_at<I: Instructions>(
        &mut self,
        lanes: I,
        leaf: usize,
        complement: bool,
        is_passed: bool,
        part: &FrontPart,
        cursor: &mut FrontPart,
    ) {
        let is_settled = self.verdicts[leaf] != SetVerdict::Undecided;
        self.leaf = LeafLook {
            complement,
            is_decided: is_passed,
            depths: MAX_DEPTHS,
            first: [
                self.front.bundles.len(),
                self.front.groups.len(),
                self.front.leaves.len(),
            ],
            ..LeafLook::default()
        };
        let (pairs, crowds) = (self.pairs, self.crowds);
        let is_of = |pair: u32| pairs[pair as usize].leaf as usize == leaf;
        let share = self.front.share(part, cursor, crowds, is_of);
        if is_settled {
            return;
        }
        // Primitives first: they decide contacts. What was found last was nearest at the middle of a smaller piece.
        for i in share.leaves[0]..share.leaves[1] {
            let from_start = if complement {
                share.leaves[0] + share.leaves[1] - 1 - i
            } else {
                i
            };
            self.visit(self.front.leaves[from_start]);
        }
        self.leaf.depths += MAX_DEPTHS;
        let Front { groups, open, .. } = &mut *self.front;
        open.extend_from_slice(&groups[share.groups[0]..share.groups[1]]);
        self.open_all(lanes);
        for i in share.bundles[0]..share.bundles[1] {
            self.open_bundle(lanes, self.front.bundles[i]);
            self.open_all(lanes);
        }
        self.look_at_solids(share.solids);
        if !is_passed {
            self.conclude(leaf);
        }
    }

    /// Notes what the look has shown of the leaf.
    fn conclude(&mut self, leaf: usize) {
        let LeafLook {
            complement,
            is_decided,
            meets,
            first,
            ..
        } = self.leaf;
        let front = &mut *self.front;
        let is_left = front.bundles.len() > first[0]
            || front.groups.len() > first[1]
            || front.leaves.len() > first[2];
        self.verdicts[leaf] = if complement {
            if is_decided {
                // It stays in the set: nothing of the leaf is looked at again.
                front.bundles.truncate(first[0]);
                front.groups.truncate(first[1]);
                front.leaves.truncate(first[2]);
                front.settled.push((leaf as u32, SetVerdict::Free));
                SetVerdict::Free
            } else if is_left || meets {
                SetVerdict::Undecided
            } else {
                SetVerdict::Meets
            }
        } else if meets {
            SetVerdict::Meets
        } else if is_left {
            SetVerdict::Undecided
        } else {
            SetVerdict::Free
        };
    }

    /// Where the surfaces of a pair stay apart, a body that is inside the other at the middle is so through the piece.
    fn look_at_solids(&mut self, solids: [usize; 2]) {
        for i in solids[0]..solids[1] {
            let number = self.front.solids[i];
            let is_left = self.is_left(number);
            if is_left || self.leaf.is_decided {
                self.front.solids.push(number);
                continue;
            }
            let over = match self.over.of(number as usize, self.pairs, self.piece) {
                PairOver::Near(over) => over,
                // Balls that stay apart hold nothing of each other.
                PairOver::Apart => continue,
                PairOver::TooLong => {
                    self.front.solids.push(number);
                    continue;
                }
            };
            if over.pairing.is_one_inside(self.scratch) {
                self.leaf.meets = true;
                self.leaf.is_decided = true;
                self.front.solids.push(number);
            }
        }
    }

    /// Whether something of a pair is left to the halves.
    fn is_left(&self, number: u32) -> bool {
        let first = self.leaf.first;
        let is_bundled = |bundle: &Bundle| {
            let start = self.crowds[bundle.crowd as usize].first_pair + 8 * bundle.eight;
            let lane = number.wrapping_sub(start);
            lane < 8 && bundle.lanes >> lane & 1 == 1
        };
        let front = &*self.front;
        front.bundles[first[0]..].iter().any(is_bundled)
            || front.groups[first[1]..].iter().any(|g| g.pair == number)
            || front.leaves[first[2]..].iter().any(|l| l.pair == number)
    }

    /// Whether nothing more is to be looked at of the leaf.
    pub(super) fn is_over(&self) -> bool {
        self.leaf.is_decided
            || self.leaf.complement && self.leaf.depths == 0
            || self.scratch.meter().is_exceeded()
    }

    /// Decides a pair of primitives, or leaves it to the halves.
    pub(super) fn visit(&mut self, mut pair: Leaves) {
        if self.is_over() {
            self.front.leaves.push(pair);
            return;
        }
        let number = pair.pair as usize;
        if self.parts_hulls(pair.pair, MEASURE_COST) {
            return;
        }
        let over = self.over.of(number, self.pairs, self.piece);
        let over = match over {
            PairOver::Near(over) => over,
            PairOver::Apart => return,
            PairOver::TooLong => {
                self.front.leaves.push(pair);
                return;
            }
        };
        if self.pair.is_left_to_halves(pair.pair) {
            self.front.leaves.push(pair);
            return;
        }
        self.pair.count(pair.pair, MEASURE_COST);
        self.scratch.count_primitive_pair();
        let found = over.pairing.swept_leaves(
            pair.places,
            &pair.direction,
            &over.sweep(),
            &over.limits,
            self.scratch.for_primitives(),
        );
        if self.leaf.complement && found != SweptLeaves::Free {
            self.leaf.depths -= 1;
            if over
                .pairing
                .stays_within(pair.places, &over.limits, self.scratch)
            {
                self.leaf.is_decided = true;
                return;
            }
        }
        match found {
            SweptLeaves::Free => return,
            SweptLeaves::Undecided(direction) | SweptLeaves::Grazed(direction) => {
                self.is_grazed |= !self.leaf.complement && matches!(found, SweptLeaves::Grazed(_));
                pair.direction = direction;
                self.pair.leave(number as u32);
            }
            SweptLeaves::Meet => self.leaf.meets = true,
        }
        let meets = found == SweptLeaves::Meet;
        self.front.leaves.push(pair);
        if meets && !self.leaf.complement {
            self.leaf.is_decided = true;
            self.met = Some(MeetingLeaves {
                pair: pair.pair,
                places: pair.places,
            });
            // The half before it asks first what met.
            let last = self.front.leaves.len() - 1;
            self.front.leaves.swap(self.leaf.first[2], last);
        }
    }

    /// Whether the hulls of a pair stay apart through the piece. Tried once a piece, of pairs for which many boxes were opened.
    pub(super) fn parts_hulls(&mut self, number: u32, work: u32) -> bool {
        let place = number as usize;
        if self.leaf.complement
            || !self.over.hulls(place).count(work)
            || !self.pair.tries_hulls(number)
        {
            return false;
        }
        let over = self.over.of(place, self.pairs, self.piece);
        let PairOver::Near(_) = over else {
            return false;
        };
        let pair = &self.pairs[place];
        let moved = self.piece.moved(pair);
        self.scratch.count_primitive_pair();
        let scratch = self.scratch.for_primitives();
        let hulls = self.over.hulls(place);
        let are_parted =
            hulls.are_parted(|direction| pair.hulls_stay_apart(moved, direction, scratch));
        if are_parted {
            self.over.part(place);
        }
        are_parted
    }
}
