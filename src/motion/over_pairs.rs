//! What is known of body pairs: through one piece, made when it is first asked for, and through all of a proof.

use super::crowd::CrowdOver;
use super::hulls_tried::HullsTried;
use super::moving_pair::MovingPair;
use super::over_piece::{PairOver, TwistLists};
use super::piece::Piece;
use crate::reused::emptied;

/// Pairs over one piece, made when they are first asked for.
pub(super) struct OverPairs<'a, L: TwistLists> {
    made: Vec<PairOver<'a, L>>,
    /// The place of each pair in `made`, and the number of the piece for which it was made.
    places: Vec<(u32, u32)>,
    piece: u32,
    /// The hulls of each pair.
    hulls: Vec<HullsTried>,
    /// The crowd looked at last, in this piece.
    pub crowd: Option<(u32, CrowdOver<L>)>,
}

/// The memory of [`OverPairs`].
pub(super) struct OverPairsMemory<L: TwistLists + 'static> {
    made: Vec<PairOver<'static, L>>,
    places: Vec<(u32, u32)>,
    hulls: Vec<HullsTried>,
}

impl<L: TwistLists> Default for OverPairsMemory<L> {
    fn default() -> Self {
        Self {
            made: Vec::new(),
            places: Vec::new(),
            hulls: Vec::new(),
        }
    }
}

impl<'a, L: TwistLists> OverPairs<'a, L> {
    /// Of so many pairs, in memory that is used again.
    pub fn new(count: usize, memory: OverPairsMemory<L>) -> Self {
        let OverPairsMemory {
            made,
            mut places,
            mut hulls,
        } = memory;
        places.clear();
        places.resize(count, (0, 0));
        hulls.clear();
        hulls.resize(count, HullsTried::default());
        Self {
            crowd: None,
            made: emptied(made),
            places,
            piece: 0,
            hulls,
        }
    }

    pub fn into_memory(self) -> OverPairsMemory<L> {
        OverPairsMemory {
            made: emptied(self.made),
            places: self.places,
            hulls: self.hulls,
        }
    }

    pub fn start(&mut self) {
        self.piece += 1;
        self.made.clear();
        self.crowd = None;
    }

    /// The hulls of a pair.
    pub fn hulls(&mut self, number: usize) -> &mut HullsTried {
        &mut self.hulls[number]
    }

    /// Of how many pairs something was asked in this piece.
    pub fn count(&self) -> usize {
        self.made.len()
    }

    /// Notes that a pair, of which something was asked in this piece, stays apart through it.
    pub fn part(&mut self, number: usize) {
        self.made[self.places[number].0 as usize] = PairOver::Apart;
    }

    pub fn of<P: Piece<Lists = L>>(
        &mut self,
        number: usize,
        pairs: &[MovingPair<'a>],
        piece: &mut P,
    ) -> &PairOver<'a, L> {
        let (place, made_for) = &mut self.places[number];
        if *made_for != self.piece {
            (*place, *made_for) = (self.made.len() as u32, self.piece);
            self.made.push(piece.over(&pairs[number]));
        }
        &self.made[*place as usize]
    }
}
