//! Memory that proofs of motions use again.

use super::crowd::CrowdMemory;
use super::interval_proof::SearchMemory;
use super::kinematics::KinematicsMemory;
use super::moving_pair::MovingPair;
use super::pair_rates::PairRatesMemory;

/// What a query context keeps from one proof to the next.
#[derive(Default)]
pub(super) struct ProofMemory {
    pub pairs: Vec<MovingPair<'static>>,
    pub crowds: CrowdMemory,
    pub kinematics: KinematicsMemory,
    pub rates: PairRatesMemory,
    pub search: SearchMemory,
}
