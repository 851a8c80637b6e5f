//! A set on a motion or over a box of configurations, and one look at all its leaves.

use std::sync::Arc;

use super::crowd::Crowd;
use super::front::FrontPart;
use super::look::Look;
use super::moving_pair::MovingPair;
use super::moving_pure::{Extent, Moment, MovingPure};
use super::piece::Piece;
use super::set_tree::{SetTree, SetVerdict, verdict_over};
use super::way::Way;
use crate::cobject::ConvexSets;
use crate::error::Result;
use crate::lanes::Instructions;

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
                // Without parts it needs no place to be asked at.
                MovingLeaf::Pure(pure) if pure.is_free() => *verdict = SetVerdict::Free,
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
