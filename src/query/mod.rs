//! Queries: class, distance, witnesses and gradients of a C-object at a configuration (§2.2.4, operations 4–8), the same
//! for two bodies.

mod answer;
mod at_configuration;
mod at_poses;
mod body_pairs;
mod candidates;
mod context;
mod distance;
mod explain;
mod link_pairs;
mod pair_penetration;
mod pure_answer;
mod scene;
mod search;
mod set_witnesses;
mod sets;
mod target;
mod world;

pub use answer::{
    ContactRecord, ContactsListed, Distance, DistanceKind, PenetrationList, PrimitivePenetration,
    PurePlace, SSide, Witness, WitnessList,
};
pub(crate) use at_configuration::check_threshold;
pub use at_configuration::{PseudoNormal, Shell};
pub(crate) use candidates::CandidateFilter;
pub use context::QueryContext;
pub use explain::{Explanation, Verdict};
pub use link_pairs::{LinkPair, LinkPairOptions, PairVerdict};
pub(crate) use pure_answer::PureAt;
pub use scene::Configuration;
pub(crate) use scene::{Group, Scene, SceneMemory};
pub(crate) use set_witnesses::{WitnessRequest, pure_witnesses};
pub(crate) use target::{Placement, Target};
pub use world::World;
