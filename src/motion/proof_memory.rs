//! Memory that proofs of motions use again.

use super::front::Front;
use super::interval_proof::Undecided;
use super::kinematics::KinematicsMemory;
use super::moving_pair::MovingPair;
use super::over_pairs::OverPairsMemory;
use super::over_piece::OneTwist;
use super::set_tree::Known;
use crate::boxes::BoxesByEight;

/// What a query context keeps from one proof to the next.
#[derive(Default)]
pub(super) struct ProofMemory {
    pub pairs: Vec<MovingPair<'static>>,
    /// Of crowds.
    pub boxes: Vec<BoxesByEight>,
    pub kinematics: KinematicsMemory,
    pub search: SearchMemory,
}

/// Memory of [`super::interval_proof::prove`].
#[derive(Default)]
pub(super) struct SearchMemory {
    pub front: Front,
    pub over: OverPairsMemory<OneTwist>,
    pub known: Vec<Known>,
    pub nodes: Vec<Known>,
    pub todo: Vec<Undecided>,
}
