//! What is known of a body pair through a piece of a motion or of a box.

use smallvec::SmallVec;

use crate::convex::{Extension, Sweep};
use crate::pair::{Motion32, Pairing, SweptLimits, Twist32};
use crate::pose::{Displacement, Pose, Vec3, turned};

/// The lists that hold one entry for each twist of a piece. An interval has one twist, and its list is an array, so that loops over it
/// cost nothing.
pub(super) trait TwistLists {
    type Of<T>: AsRef<[T]>;

    fn map<T, U>(list: &Self::Of<T>, entry: impl FnMut(&T) -> U) -> Self::Of<U>;
}

/// Of intervals.
pub(super) struct OneTwist;

/// Of boxes of configurations.
pub(super) struct ManyTwists;

impl TwistLists for OneTwist {
    type Of<T> = [T; 1];

    #[inline(always)]
    fn map<T, U>([only]: &[T; 1], mut entry: impl FnMut(&T) -> U) -> [U; 1] {
        [entry(only)]
    }
}

impl TwistLists for ManyTwists {
    type Of<T> = SmallVec<[T; 8]>;

    fn map<T, U>(list: &SmallVec<[T; 8]>, entry: impl FnMut(&T) -> U) -> SmallVec<[U; 8]> {
        list.iter().map(entry).collect()
    }
}

/// How A moves through a piece, as B sees it, with the components in the world's frame.
pub(super) struct Moved<L: TwistLists> {
    /// Of both bodies, in the world, where they are compared.
    pub poses: [Pose; 2],
    /// Of A's centre, from where boxes and primitives are compared to the sides of the piece.
    pub displacements: L::Of<Displacement>,
    pub extension: Extension,
    /// As [`Sweep::bends`].
    pub bends: [f64; 2],
    pub kinematics_error: f64,
}

impl<L: TwistLists> Moved<L> {
    /// The same with the displacements of a point that A carries, `arm` from its centre, in A's frame.
    pub fn seen_from(self, arm: &Vec3) -> Self {
        let arm = turned(&self.poses[0].rotation, arm);
        let displacements = L::map(&self.displacements, |by| by.told_of(&arm));
        Self {
            displacements,
            ..self
        }
    }
}

/// What is known of a pair at the beginning of a piece.
#[derive(Clone, Copy)]
pub(super) enum PairOver<T> {
    /// The balls around the bodies stay apart.
    Apart,
    /// The piece is too long for bounds of boxes to be of use.
    TooLong,
    /// Boxes and primitives may be looked at.
    Near(T),
}

/// A pair through a piece.
pub(super) struct OverPiece<'a, L: TwistLists> {
    pub pairing: Pairing<'a>,
    /// Into A's frame, and into B's.
    pub motions: [Motion32; 2],
    /// Of B as A sees it, in A's frame, and of A as B sees it, in B's.
    pub twists: [L::Of<Twist32>; 2],
    pub extension: Extension,
    /// As [`Sweep::bends`], in units of the pair.
    pub bends: [f32; 2],
    /// What the cores' boxes leave out around them, of A and of B, in units of the pair.
    pub core_radii: [f32; 2],
    /// Of A's centre, in A's frame.
    pub displacements: L::Of<Displacement>,
    pub sweep_bends: [f64; 2],
    pub limits: SweptLimits,
    /// Boxes with a larger gap do not meet, in units of the pair.
    pub cutoff: f32,
    /// The primitives in boxes with a larger gap, where they are compared, are not certain to stay within the threshold.
    pub within: f32,
}

impl<L: TwistLists> OverPiece<'_, L> {
    pub fn sweep(&self) -> Sweep<'_> {
        Sweep {
            displacements: self.displacements.as_ref(),
            extension: self.extension,
            bends: self.sweep_bends,
        }
    }
}
