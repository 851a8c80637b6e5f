//! What is known of body pairs: through one piece, made when it is first asked for, and through all of a proof.

use super::crowd::CrowdOver;
use super::hulls_tried::HullsTried;
use super::moving_pair::MovingPair;
use super::over_piece::{OverPiece, PairOver, TwistLists};
use super::piece::Piece;
use crate::reused::emptied;

/// Pairs over one piece, made when they are first asked for.
pub(super) struct OverPairs<'a, L: TwistLists> {
    made: Vec<OverPiece<'a, L>>,
    /// What is known of each pair, with its place in `made`, and the number of the piece for which that holds.
    known: Vec<(PairOver<u32>, u64)>,
    piece: u64,
    /// Of how many pairs something was asked in this piece.
    asked: u64,
    /// The hulls of each pair.
    hulls: Vec<HullsTried>,
    /// The crowd looked at last, in this piece.
    pub crowd: Option<(u32, CrowdOver<L>)>,
}

/// The memory of [`OverPairs`].
pub(super) struct OverPairsMemory<L: TwistLists + 'static> {
    made: Vec<OverPiece<'static, L>>,
    known: Vec<(PairOver<u32>, u64)>,
    hulls: Vec<HullsTried>,
}

impl<L: TwistLists> Default for OverPairsMemory<L> {
    fn default() -> Self {
        Self {
            made: Vec::new(),
            known: Vec::new(),
            hulls: Vec::new(),
        }
    }
}

impl<'a, L: TwistLists> OverPairs<'a, L> {
    /// Of so many pairs, in memory that is used again.
    pub fn new(count: usize, memory: OverPairsMemory<L>) -> Self {
        let OverPairsMemory {
            made,
            mut known,
            mut hulls,
        } = memory;
        known.clear();
        known.resize(count, (PairOver::Apart, 0));
        hulls.clear();
        hulls.resize(count, HullsTried::default());
        Self {
            crowd: None,
            made: emptied(made),
            known,
            piece: 0,
            asked: 0,
            hulls,
        }
    }

    pub fn into_memory(self) -> OverPairsMemory<L> {
        OverPairsMemory {
            made: emptied(self.made),
            known: self.known,
            hulls: self.hulls,
        }
    }

    pub fn start(&mut self) {
        self.piece += 1;
        self.asked = 0;
        self.made.clear();
        self.crowd = None;
    }

    /// The hulls of a pair.
    pub fn hulls(&mut self, number: usize) -> &mut HullsTried {
        &mut self.hulls[number]
    }

    /// Of how many pairs something was asked in this piece.
    pub fn asked(&self) -> u64 {
        self.asked
    }

    /// Notes that a pair, of which something was asked in this piece, stays apart through it.
    pub fn part(&mut self, number: usize) {
        self.known[number].0 = PairOver::Apart;
    }

    pub fn of<P: Piece<Lists = L>>(
        &mut self,
        number: usize,
        pairs: &[MovingPair<'a>],
        piece: &mut P,
    ) -> PairOver<&OverPiece<'a, L>> {
        let (known, holds_for) = &mut self.known[number];
        if *holds_for != self.piece {
            *holds_for = self.piece;
            self.asked += 1;
            *known = match piece.over(&pairs[number]) {
                PairOver::Apart => PairOver::Apart,
                PairOver::TooLong => PairOver::TooLong,
                PairOver::Near(over) => {
                    self.made.push(over);
                    PairOver::Near(self.made.len() as u32 - 1)
                }
            };
        }
        match *known {
            PairOver::Apart => PairOver::Apart,
            PairOver::TooLong => PairOver::TooLong,
            PairOver::Near(place) => PairOver::Near(&self.made[place as usize]),
        }
    }
}
