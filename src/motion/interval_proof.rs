//! The proof that a motion keeps out of a set: intervals of time are halved until bounds over the interval part all boxes and
//! primitives, and all pure sets.

use super::first_contact::MeetingLeaves;
use super::front::{Front, FrontPart};
use super::kinematics::Kinematics;
use super::look::{LeafLook, Look};
use super::moving_pair::Interval;
use super::moving_set::{Middle, MovingSet};
use super::over_pairs::{OverPairs, OverPairsMemory};
use super::over_piece::OneTwist;
use super::pair_look::PairLook;
use super::set_tree::SetVerdict;
use super::undecided::Undecided;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::query::QueryContext;

/// Intervals no longer than this, a part of the motion, are not halved: it is below the least tolerance, 1e-12, so that what is near is
/// told over no longer time than was asked for.
const SHORTEST_INTERVAL: f64 = 1.0 / (1u64 << 40) as f64;

/// Where rounding hides whether primitives are apart, halves show no more, and distances that jitter by it would let a proof creep on by
/// intervals of 1e-13: in unions such an interval is not halved once it is no longer than the tolerance, in other sets, of which another leaf
/// may still keep clear, than this.
const SHORTEST_GRAZED: f64 = 64.0 * SHORTEST_INTERVAL;

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
    /// Primitives are so near where it was looked at that rounding hides whether they are apart.
    is_grazed: bool,
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
        let mut found = Found::default();
        while let Some(interval) = todo.pop() {
            let [start, end] = interval.times;
            if self.limits.intervals == 0 {
                return Ok(Proof::Undecided([start, end]));
            }
            self.limits.intervals -= 1;
            if let Some(contact) = found.contact {
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
            let Outcome {
                whole,
                left,
                met,
                is_grazed,
            } = self.look_and_count(lanes, &interval, is_plain, lists)?;
            if self.context.scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            if whole == SetVerdict::Free {
                continue;
            }
            if found.wants_start(&interval, whole) && (self.confirm)(self.context, 0.0)? {
                return Ok(Proof::Contact([0.0, 0.0]));
            }
            let time = interval.compared_at();
            let meets =
                whole == SetVerdict::Meets && (is_plain || (self.confirm)(self.context, time)?);
            if !meets {
                // The first such interval ends the proof, so that a graze costs one descent.
                let shortest = match is_grazed {
                    true if is_plain => self.limits.tolerance,
                    true => self.limits.tolerance.min(SHORTEST_GRAZED),
                    false => SHORTEST_INTERVAL,
                };
                if end - start <= shortest {
                    return Ok(Proof::Undecided([start, end]));
                }
                interval.halve(left, todo);
                continue;
            }
            if self.limits.any_contact || end - start <= self.limits.tolerance {
                return Ok(Proof::Contact([start, time]));
            }
            let [apart, meeting] = match met {
                Some(met) => self.narrowed(met, [start, time], &mut found)?,
                None => [time; 2],
            };
            found.contact = Some(meeting);
            interval.before(apart, meeting, left, todo);
        }
        Ok(match found.contact {
            Some(contact) => Proof::Contact([contact, contact]),
            None => Proof::Free,
        })
    }

    /// Looks at an interval. What balls or lengths decide is counted as work too, or nothing would end the proof of a turn of many rounds.
    #[inline(always)]
    fn look_and_count<I: Instructions>(
        &mut self,
        lanes: I,
        interval: &Undecided,
        is_plain: bool,
        lists: &mut Lists<'a, '_>,
    ) -> Result<Outcome> {
        let before = self.context.scratch.meter().done.node_pairs;
        let outcome = self.look_at(lanes, interval, is_plain, lists)?;
        let meter = self.context.scratch.meter_mut();
        if meter.done.node_pairs == before {
            meter.count_nodes(1);
        }
        Ok(outcome)
    }

    /// A time before which primitives that meet at the second of two times are apart, and one at which they meet: from the first time on
    /// as near together as is wanted.
    fn narrowed(
        &mut self,
        met: MeetingLeaves,
        [start, time]: [f64; 2],
        found: &mut Found,
    ) -> Result<[f64; 2]> {
        if found.narrowed == Some((met, time)) {
            return Ok([time; 2]);
        }
        let wanted = 0.5 * self.limits.tolerance;
        let (pairs, scratch) = (&self.set.pairs, &mut self.context.scratch);
        let times = met.narrowed(pairs, self.kinematics, [start, time], wanted, scratch)?;
        found.narrowed = Some((met, times[0]));
        Ok(times)
    }
}

/// What a search has found so far.
#[derive(Default)]
struct Found {
    /// The earliest time at which there is contact.
    contact: Option<f64>,
    is_start_asked: bool,
    /// The primitives whose contact was narrowed last, and up to when they are apart: a contact is narrowed once. Primitives that touch to
    /// within rounding would else be bisected down to the shortest interval.
    narrowed: Option<(MeetingLeaves, f64)>,
}

impl Found {
    /// Whether the start is to be asked for by itself, now that an interval is not free; once.
    fn wants_start(&mut self, interval: &Undecided, whole: SetVerdict) -> bool {
        let [start, end] = interval.times;
        let is_near = whole == SetVerdict::Meets || end <= START_ASKED_BELOW;
        let is_wanted = start == 0.0 && is_near && !self.is_start_asked;
        self.is_start_asked |= is_wanted;
        is_wanted
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
            is_grazed: false,
        };
        let whole = set.look_at_all(lanes, &mut look, part, at, lists.nodes)?;
        let left = look.left(part);
        // Of other sets the contact of one leaf says little.
        let met = look.met.filter(|_| is_plain);
        Ok(Outcome {
            whole,
            left,
            met,
            is_grazed: look.is_grazed,
        })
    }
}
