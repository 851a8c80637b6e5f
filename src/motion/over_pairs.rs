//! What is known of body pairs through one piece, made when it is first asked for.

use super::crowd::CrowdOver;
use super::moving_pair::MovingPair;
use super::over_piece::{PairOver, TwistLists};
use super::piece::Piece;

/// Room for so many pairs is taken at once: seldom are more near in a piece.
const MADE_AT_ONCE: usize = 64;

/// Pairs over one piece, made when they are first asked for.
pub(super) struct OverPairs<'a, L: TwistLists> {
    made: Vec<PairOver<'a, L>>,
    /// The place of each pair in `made`, and the number of the piece for which it was made.
    places: Vec<(u32, u32)>,
    piece: u32,
    /// The crowd looked at last, in this piece.
    pub crowd: Option<(u32, CrowdOver<L>)>,
}

impl<'a, L: TwistLists> OverPairs<'a, L> {
    pub fn new(count: usize) -> Self {
        Self {
            crowd: None,
            made: Vec::with_capacity(count.min(MADE_AT_ONCE)),
            places: vec![(0, 0); count],
            piece: 0,
        }
    }

    pub fn start(&mut self) {
        self.piece += 1;
        self.made.clear();
        self.crowd = None;
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
