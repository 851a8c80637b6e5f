//! Memory that proofs of motions use again.

use super::interval_proof::SearchMemory;
use super::kinematics::KinematicsMemory;
use super::moving_pair::MovingPair;
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
