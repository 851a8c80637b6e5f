//! The proof that a motion keeps out of a set: intervals of time are halved until bounds over the interval part all boxes and
//! primitives, and all pure sets.

use super::crowd::Crowd;
use super::front::{Front, LeafLook, Look, OverPairs, Part};
use super::moving_pair::{Kinematics, MovingPair};
use super::moving_pure::{Moment, MovingPure};
use super::set_tree::{Known, SetTree};
use super::way::Way;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::query::QueryContext;

/// Intervals no longer than this, a part of the motion, are not halved: over them hardly anything moves by more than rounding.
const SHORTEST_INTERVAL: f64 = 1.0 / (1u64 << 40) as f64;

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

/// A leaf of the set tree on the motion.
pub(super) enum MovingLeaf {
    /// An induced set, whose pairs have the leaf's number.
    Pairs {
        /// The leaf stands for the complement.
        complement: bool,
    },
    Pure(MovingPure),
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

/// An interval of time, with what is undecided in it.
struct Interval {
    times: [f64; 2],
    part: Part,
}

/// Asked for a time: whether the set is certainly met there.
pub(super) type Confirm<'c> = dyn FnMut(&mut QueryContext, f64) -> Result<bool> + 'c;

/// Looks for the first contact, or proves that there is none at any time from 0 to 1. `confirm` is asked for the start, unless the
/// whole motion is proved at once, and for contacts of sets that are no plain unions.
pub(super) fn prove(
    set: &MovingSet,
    kinematics: &mut Kinematics,
    limits: ProofLimits,
    context: &mut QueryContext,
    confirm: &mut Confirm,
) -> Result<Proof> {
    with_widest(Prover {
        set,
        kinematics,
        limits,
        context,
        confirm,
    })
}

struct Prover<'a, 'k, 'c, 'd> {
    set: &'a MovingSet<'a>,
    kinematics: &'a mut Kinematics<'k>,
    limits: ProofLimits,
    context: &'a mut QueryContext,
    confirm: &'c mut Confirm<'d>,
}

impl Work for Prover<'_, '_, '_, '_> {
    type Output = Result<Proof>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<Proof> {
        let Self {
            set,
            kinematics,
            limits,
            context,
            confirm,
        } = self;
        let front = &mut Front::default();
        let over = &mut OverPairs::new(set.pairs.len());
        let memory = &mut Vec::new();
        let is_plain = set.tree.is_plain_union();
        let mut known = vec![Known::Nothing; set.leaves.len()];
        let mut todo = vec![Interval {
            times: [0.0, 1.0],
            part: front.start(&set.pairs, &set.crowds, !is_plain),
        }];
        let mut contact: Option<f64> = None;
        while let Some(Interval { times, part }) = todo.pop() {
            let [start, end] = times;
            if contact.is_some_and(|contact| start >= contact) {
                continue;
            }
            if context.scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
            known.fill(Known::Nothing);
            kinematics.start(middle)?;
            let mut look = Look {
                pairs: &set.pairs,
                crowds: &set.crowds,
                over,
                kinematics,
                half,
                front,
                scratch: &mut context.scratch,
                known: &mut known,
                leaf: LeafLook::default(),
            };
            look.start(&part);
            set.look_at_pure(&mut look, middle)?;
            let mut whole = set.tree.known(look.known, memory);
            let mut cursor = part;
            for (number, leaf) in set.leaves.iter().enumerate() {
                let MovingLeaf::Pairs { complement } = leaf else {
                    continue;
                };
                if whole == Known::Free {
                    break;
                }
                let is_passed = whole == Known::Meets && is_plain;
                look.look_at(lanes, number, [*complement, is_passed], &part, &mut cursor);
                whole = set.tree.known(look.known, memory);
            }
            let left = look.left(&part);
            if context.scratch.meter().is_exceeded() {
                return Ok(Proof::Exceeded(start));
            }
            if whole == Known::Free {
                continue;
            }
            if half == 0.5 && confirm(context, 0.0)? {
                return Ok(Proof::Contact([0.0, 0.0]));
            }
            let meets = whole == Known::Meets && (is_plain || confirm(context, middle)?);
            if meets {
                contact = Some(middle);
                if limits.any_contact {
                    return Ok(Proof::Contact([start, middle]));
                }
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
                    part: left,
                });
            }
            todo.push(Interval {
                times: [start, middle],
                part: left,
            });
        }
        Ok(match contact {
            Some(contact) => Proof::Contact([contact, contact]),
            None => Proof::Free,
        })
    }
}

impl MovingSet<'_> {
    /// Asks the pure leaves of which nothing is known from a longer interval.
    fn look_at_pure(&self, look: &mut Look, middle: f64) -> Result<()> {
        let mut is_asked = false;
        for (leaf, known) in self.leaves.iter().zip(look.known.iter_mut()) {
            match leaf {
                MovingLeaf::Pairs { .. } => {}
                MovingLeaf::Everything => *known = Known::Meets,
                MovingLeaf::Pure(_) => is_asked |= *known == Known::Nothing,
            }
        }
        let (true, Some(way)) = (is_asked, self.way) else {
            return Ok(());
        };
        let q = way.at(middle);
        let scene = &way.scene(&q)?;
        let moment = &Moment {
            way,
            scene,
            half: look.half,
        };
        for (number, leaf) in self.leaves.iter().enumerate() {
            if let MovingLeaf::Pure(pure) = leaf
                && look.known[number] == Known::Nothing
            {
                match pure.over(moment)? {
                    Known::Free => look.settle(number, Known::Free),
                    known => look.known[number] = known,
                }
            }
        }
        Ok(())
    }
}
