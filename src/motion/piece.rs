//! A piece of what the robot does: an interval of a motion, or a box of configurations.

use super::box_piece::BoxPiece;
use super::moving_pair::{Interval, MovingPair};
use super::moving_pure::Extent;
use super::over_piece::{ManyTwists, Moved, OneTwist, OverPiece, PairOver, TwistLists};
use super::span::Followed;

/// A piece of what the robot does.
pub(super) trait Piece {
    type Lists: TwistLists;

    /// A pair through the piece.
    fn over<'a>(&mut self, pair: &MovingPair<'a>) -> PairOver<OverPiece<'a, Self::Lists>>;

    /// How A moves through the piece.
    fn moved(&mut self, pair: &MovingPair) -> Moved<Self::Lists>;

    /// How far the piece goes from its middle.
    fn extent(&self) -> Extent<'_>;
}

impl Piece for Interval<'_, '_> {
    type Lists = OneTwist;

    fn over<'a>(&mut self, pair: &MovingPair<'a>) -> PairOver<OverPiece<'a, OneTwist>> {
        match Followed::over_interval(pair.followed_from, self.time, self.span) {
            Followed::Yes => pair.over_interval(self.kinematics, self.span),
            Followed::InPart => PairOver::TooLong,
            Followed::No => PairOver::Apart,
        }
    }

    fn moved(&mut self, pair: &MovingPair) -> Moved<OneTwist> {
        pair.moved(self.kinematics, self.span)
    }

    fn extent(&self) -> Extent<'_> {
        Extent::Time {
            time: self.time,
            span: self.span,
        }
    }
}

impl Piece for BoxPiece<'_> {
    type Lists = ManyTwists;

    fn over<'p>(&mut self, pair: &MovingPair<'p>) -> PairOver<OverPiece<'p, ManyTwists>> {
        self.pair_over(pair)
    }

    fn moved(&mut self, pair: &MovingPair) -> Moved<ManyTwists> {
        self.pair_moved(pair)
    }

    fn extent(&self) -> Extent<'_> {
        Extent::Box(self)
    }
}
