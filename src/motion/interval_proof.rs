//! The proof that a motion keeps out of a set: intervals of time are halved until bounds over the interval part all boxes and
//! primitives, and all pure sets.

use std::sync::Arc;

use super::crowd::Crowd;
use super::first_contact::MeetingLeaves;
use super::front::{Front, FrontPart};
use super::kinematics::Kinematics;
use super::look::{LeafLook, Look};
use super::moving_pair::{Interval, MovingPair};
use super::moving_pure::{Extent, Moment, MovingPure};
use super::over_pairs::{OverPairs, OverPairsMemory};
use super::over_piece::OneTwist;
use super::pair_look::PairLook;
use super::piece::Piece;
use super::set_tree::{SetTree, SetVerdict, verdict_over};
use super::span::Span;
use super::way::Way;
use crate::cobject::ConvexSets;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::query::QueryContext;

/// Intervals no longer than this, a part of the motion, are not halved: it is below the least tolerance, 1e-12, so that what is near is
/// told over no longer time than was asked for.
const SHORTEST_INTERVAL: f64 = 1.0 / (1u64 << 40) as f64;

/// The work on a pair that goes on in the halves of an interval, times the interval's length: see `PairLook`. By the motion benchmark
/// from .5 to 16 within a tenth of each other on arms; without a limit hits of the UR10 take three times as long.
const WORK_PER_LENGTH: f64 = 1.0;

/// The start is asked for by itself where an interval from it on, no longer than this, is undecided: most motions that planners ask for
/// begin where they have been, and are proved free there at once.
const START_ASKED_BELOW: f64 = 0.125;

/// How an interval proof is to end.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProofLimits {
    /// The time of contact is to be known to this.
    pub tolerance: f64,
    /// Any contact ends the proof; else the first is looked for.
    pub any_contact: bool,
    /// How many intervals may be looked at; where more are needed, the rest is undecided. The proof counts down.
    pub intervals: usize,
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

/// A leaf of the set tree on the motion.
pub(super) enum MovingLeaf {
    /// An induced set, whose pairs have the leaf's number.
    Pairs {
        /// The leaf stands for the complement.
        complement: bool,
    },
    Pure(MovingPure),
    /// Where the caller knows the class of another part.
    Known {
        sets: Arc<ConvexSets>,
        /// The leaf stands for the complement.
        complement: bool,
    },
    /// Every configuration counts as in it.
    Everything,
}

/// A set on a motion.
pub(super) struct MovingSet<'a> {
    /// `None` for two bodies without a robot.
    pub way: Option<&'a Way<'a>>,
    pub tree: &'a SetTree<'a>,
    /// In the order of the tree's leaves.
    pub leaves: Vec<MovingLeaf>,
    /// In the order of their leaves.
    pub pairs: Vec<MovingPair<'a>>,
    /// In the order of their pairs.
    pub crowds: Vec<Crowd>,
}

/// The middle of a piece.
#[derive(Clone, Copy)]
pub(super) struct Middle<'a> {
    /// `None` for two bodies without a robot.
    pub way: Option<&'a Way<'a>>,
    /// Its time, 0 in boxes of configurations.
    pub time: f64,
}

/// An interval of time, with what is undecided in it.
struct Undecided {
    times: [f64; 2],
    part: FrontPart,
    /// Primitives nearly meet at its end.
    ends_near_contact: bool,
}

/// Asked for a time: whether the set is certainly met there.
pub(super) type Confirm<'c> = dyn FnMut(&mut QueryContext, f64) -> Result<bool> + 'c;

/// Looks for the first contact, or proves that there is none at any time from 0 to 1. `confirm` is asked for the start, unless an
/// interval from it on is soon proved free, and for contacts of sets that are no plain unions.
pub(super) fn prove(
    set: &MovingSet,
    kinematics: &mut Kinematics,
    limits: &mut ProofLimits,
    context: &mut QueryContext,
    confirm: &mut Confirm,
    memory: &mut SearchMemory,
) -> Result<Proof> {
    with_widest(Prover {
        set,
        kinematics,
        limits,
        context,
        confirm,
        memory,
    })
}

struct Prover<'a, 'k, 'c, 'd> {
    set: &'a MovingSet<'a>,
    kinematics: &'a mut Kinematics<'k>,
    limits: &'a mut ProofLimits,
    context: &'a mut QueryContext,
    confirm: &'c mut Confirm<'d>,
    memory: &'a mut SearchMemory,
}

/// What is known of an interval.
struct Outcome {
    whole: SetVerdict,
    left: FrontPart,
    /// Primitives that meet where it was looked at.
    met: Option<MeetingLeaves>,
}

/// Memory of a proof, used again by the next.
#[derive(Default)]
pub(super) struct SearchMemory {
    front: Front,
    over: OverPairsMemory<OneTwist>,
    verdicts: Vec<SetVerdict>,
    nodes: Vec<SetVerdict>,
    todo: Vec<Undecided>,
}

/// Lists of the proof.
struct Lists<'a, 'm> {
    front: &'m mut Front,
    over: OverPairs<'a, OneTwist>,
    verdicts: &'m mut Vec<SetVerdict>,
    nodes: &'m mut Vec<SetVerdict>,
}

impl Work for Prover<'_, '_, '_, '_> {
    type Output = Result<Proof>;

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) -> Result<Proof> {
        let set = self.set;
        let SearchMemory {
            mut front,
            over,
            mut verdicts,
            mut nodes,
            mut todo,
        } = std::mem::take(self.memory);
        verdicts.clear();
        verdicts.resize(set.leaves.len(), SetVerdict::Undecided);
        let mut lists = Lists {
            front: &mut front,
            over: OverPairs::new(set.pairs.len(), over),
            verdicts: &mut verdicts,
            nodes: &mut nodes,
        };
        let proof = self.search(lanes, &mut lists, &mut todo);
        *self.memory = SearchMemory {
            over: lists.over.into_memory(),
            front,
            verdicts,
            nodes,
            todo,
        };
        proof
    }
}

impl<'a> Prover<'a, '_, '_, '_> {
    #[inline(always)]
    fn search<I: Instructions>(
        &mut self,
        lanes: I,
        lists: &mut Lists<'a, '_>,
        todo: &mut Vec<Undecided>,
    ) -> Result<Proof> {
        let set = self.set;
        let is_plain = set.tree.is_plain_union();
        todo.clear();
        todo.push(Undecided {
            times: [0.0, 1.0],
            part: lists.front.start(&set.pairs, &set.crowds, !is_plain),
            ends_near_contact: false,
        });
        let mut contact: Option<f64> = None;
        let mut is_start_asked = false;
        // Each contact is narrowed once: primitives that touch to within rounding would else be bisected down to the shortest interval.
        let mut narrowed: Option<(MeetingLeaves, f64)> = None;
        while let Some(interval) = todo.pop() {
            let [start, end] = interval.times;
            if self.limits.intervals == 0 {
                return Ok(Proof::Undecided([start, end]));
            }
            self.limits.intervals -= 1;
            if let Some(contact) = contact {
                if start >= contact {
                    continue;
                }
                if contact <= end && end - start <= self.limits.tolerance {
                    return Ok(Proof::Contact([start, contact]));
                }
            }
            if self.context.scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            let before = self.context.scratch.meter().done.node_pairs;
            let Outcome { whole, left, met } = self.look_at(lanes, &interval, is_plain, lists)?;
            // What balls or lengths decide is work too, or nothing would end the proof of a turn of many rounds.
            let meter = self.context.scratch.meter_mut();
            if meter.done.node_pairs == before {
                meter.count_nodes(1);
            }
            if self.context.scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            if whole == SetVerdict::Free {
                continue;
            }
            let is_start_wanted = whole == SetVerdict::Meets || end <= START_ASKED_BELOW;
            if start == 0.0 && is_start_wanted && !is_start_asked {
                is_start_asked = true;
                if (self.confirm)(self.context, 0.0)? {
                    return Ok(Proof::Contact([0.0, 0.0]));
                }
            }
            let time = interval.compared_at();
            let meets =
                whole == SetVerdict::Meets && (is_plain || (self.confirm)(self.context, time)?);
            if !meets {
                // The first such interval ends the proof, so that a graze costs one descent.
                if end - start <= SHORTEST_INTERVAL {
                    return Ok(Proof::Undecided([start, end]));
                }
                interval.halve(left, todo);
                continue;
            }
            if self.limits.any_contact || end - start <= self.limits.tolerance {
                return Ok(Proof::Contact([start, time]));
            }
            let (mut apart, mut meeting) = (time, time);
            if let Some(met) = met.filter(|met| narrowed != Some((*met, time))) {
                let wanted = 0.5 * self.limits.tolerance;
                let scratch = &mut self.context.scratch;
                let pairs = &set.pairs;
                [apart, meeting] =
                    met.narrowed(pairs, self.kinematics, [start, time], wanted, scratch)?;
                narrowed = Some((met, apart));
            }
            contact = Some(meeting);
            interval.before(apart, meeting, left, todo);
        }
        Ok(match contact {
            Some(contact) => Proof::Contact([contact, contact]),
            None => Proof::Free,
        })
    }
}

impl Undecided {
    /// The time at which bodies are compared.
    fn compared_at(&self) -> f64 {
        let [start, end] = self.times;
        if self.ends_near_contact {
            end
        } else {
            0.5 * (start + end)
        }
    }

    fn span(&self) -> Span {
        let [start, end] = self.times;
        if self.ends_near_contact {
            Span::Before(end - start)
        } else {
            Span::Around(0.5 * (end - start))
        }
    }

    /// What is spent on a pair that goes on in the halves: the shorter the interval, the more. So long intervals are not searched in
    /// vain, and what short ones decide is not decided again in too many still shorter ones.
    fn max_work(&self) -> u32 {
        let [start, end] = self.times;
        (WORK_PER_LENGTH / (end - start)) as u32
    }

    /// Adds what comes before a contact at `meeting`; the primitives that meet there are apart up to `apart`.
    fn before(&self, apart: f64, meeting: f64, part: FrontPart, todo: &mut Vec<Self>) {
        let [start, _] = self.times;
        let with = |times: [f64; 2], ends_near_contact: bool| Self {
            times,
            part,
            ends_near_contact,
        };
        if start < apart && apart < meeting {
            todo.push(with([apart, meeting], false));
            todo.push(with([start, apart], true));
        } else {
            todo.push(with([start, meeting], false));
        }
    }

    /// Adds both halves, the first of them last: it is looked at next.
    fn halve(&self, part: FrontPart, todo: &mut Vec<Self>) {
        let [start, end] = self.times;
        let middle = 0.5 * (start + end);
        let later = Self {
            times: [middle, end],
            part,
            ends_near_contact: self.ends_near_contact,
        };
        let first = Self {
            times: [start, middle],
            part,
            ends_near_contact: false,
        };
        todo.extend([later, first]);
    }
}

impl<'a> Prover<'a, '_, '_, '_> {
    /// Looks at what an interval has left of the front.
    #[inline(always)]
    fn look_at<I: Instructions>(
        &mut self,
        lanes: I,
        interval: &Undecided,
        is_plain: bool,
        lists: &mut Lists<'a, '_>,
    ) -> Result<Outcome> {
        let time = interval.compared_at();
        let (set, part) = (self.set, &interval.part);
        lists.verdicts.fill(SetVerdict::Undecided);
        self.kinematics.start(time)?;
        let at = Middle { way: set.way, time };
        let mut look = Look {
            pairs: &set.pairs,
            crowds: &set.crowds,
            over: &mut lists.over,
            piece: &mut Interval {
                kinematics: &mut *self.kinematics,
                time,
                span: interval.span(),
            },
            front: &mut *lists.front,
            scratch: &mut self.context.scratch,
            verdicts: &mut *lists.verdicts,
            leaf: LeafLook::default(),
            pair: PairLook::new(interval.max_work()),
            met: None,
        };
        let whole = set.look_at_all(lanes, &mut look, part, at, lists.nodes)?;
        let left = look.left(part);
        // Of other sets the contact of one leaf says little.
        let met = look.met.filter(|_| is_plain);
        Ok(Outcome { whole, left, met })
    }
}

impl MovingSet<'_> {
    /// Looks at all leaves of which nothing is known from a larger piece; says what is known of the set.
    #[inline(always)]
    pub fn look_at_all<I: Instructions, P: Piece>(
        &self,
        lanes: I,
        look: &mut Look<P>,
        part: &FrontPart,
        middle: Middle,
        memory: &mut Vec<SetVerdict>,
    ) -> Result<SetVerdict> {
        look.start(part);
        self.look_at_known(look, middle)?;
        self.look_at_pure(look, middle)?;
        let is_plain = self.tree.is_plain_union();
        let mut whole = self.tree.verdict(look.verdicts, memory);
        let mut cursor = *part;
        for (number, leaf) in self.leaves.iter().enumerate() {
            let MovingLeaf::Pairs { complement } = leaf else {
                continue;
            };
            if whole == SetVerdict::Free {
                break;
            }
            let is_passed = whole == SetVerdict::Meets && is_plain;
            look.look_at(lanes, number, *complement, is_passed, part, &mut cursor);
            whole = self.tree.verdict(look.verdicts, memory);
        }
        Ok(whole)
    }

    /// Asks where the classes of parts are known.
    fn look_at_known<P: Piece>(&self, look: &mut Look<P>, middle: Middle) -> Result<()> {
        let Some(way) = middle.way else {
            return Ok(());
        };
        for (number, leaf) in self.leaves.iter().enumerate() {
            if let MovingLeaf::Known { sets, complement } = leaf
                && look.verdicts[number] == SetVerdict::Undecided
            {
                let interval = match look.piece.extent() {
                    Extent::Time { time, span } => Some((time, span)),
                    Extent::Box(_) => None,
                };
                let space = way.line.cobject.space();
                let at = way.at(middle.time)?;
                let over = way.with_around(interval, |around| {
                    verdict_over(sets, *complement, space, around, &at)
                })?;
                match over {
                    SetVerdict::Free => look.settle(number, SetVerdict::Free),
                    verdict => look.verdicts[number] = verdict,
                }
            }
        }
        Ok(())
    }

    /// Asks the pure leaves.
    fn look_at_pure<P: Piece>(&self, look: &mut Look<P>, middle: Middle) -> Result<()> {
        let mut is_asked = false;
        for (leaf, verdict) in self.leaves.iter().zip(look.verdicts.iter_mut()) {
            match leaf {
                MovingLeaf::Pairs { .. } | MovingLeaf::Known { .. } => {}
                MovingLeaf::Everything => *verdict = SetVerdict::Meets,
                MovingLeaf::Pure(_) => is_asked |= *verdict == SetVerdict::Undecided,
            }
        }
        let (true, Some(way)) = (is_asked, middle.way) else {
            return Ok(());
        };
        let q = way.at(middle.time)?;
        let scene = &way.scene(&q)?;
        for (number, leaf) in self.leaves.iter().enumerate() {
            if let MovingLeaf::Pure(pure) = leaf
                && look.verdicts[number] == SetVerdict::Undecided
            {
                // A look at no geometry is work too, or nothing would end a proof beside a pure set.
                look.scratch.meter_mut().count_nodes(1);
                let moment = Moment {
                    way,
                    scene,
                    extent: look.piece.extent(),
                };
                match pure.over(&moment)? {
                    SetVerdict::Free => look.settle(number, SetVerdict::Free),
                    verdict => look.verdicts[number] = verdict,
                }
            }
        }
        Ok(())
    }
}
