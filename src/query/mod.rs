//! Queries: class, distance, witnesses and gradients of a C-object at a configuration (§2.2.4, operations 4–8), and the
//! same for two bodies.

mod answer;
mod body_pairs;
mod cache_key;
mod candidates;
mod classify;
mod combination;
mod context;
mod curve_refinement;
mod distance;
mod distance_answer;
mod every_pair;
mod explain;
mod find_link_pairs;
mod given_pair;
mod leaves;
mod link_boxes;
mod nearest_gradient;
mod object_offers;
mod object_pairs;
mod object_sets;
mod pair_depth;
mod pair_order;
mod pair_penetration;
mod pairs;
mod part_search;
mod pseudo_normal;
mod pure_answer;
mod recall;
mod scene;
mod signed_derivative;
mod signed_distances;
mod target;
mod within;
mod witnesses;
mod world;

pub use crate::depth::DepthOptions;
pub use answer::{
    ContactRecord, ContactsListed, Distance, DistanceKind, PenetrationList, PrimitivePenetration,
    PurePlace, SSide, Witness, WitnessList,
};
pub(crate) use cache_key::CacheKey;
pub(crate) use candidates::{CandidateFilter, ListOrder};
pub(crate) use combination::{Composition, composition};
pub use context::QueryContext;
pub(crate) use context::check_threshold;
pub use explain::{Explanation, Verdict};
pub use find_link_pairs::{LinkPair, LinkPairOptions, PairVerdict};
pub use given_pair::GivenPair;
pub use object_pairs::{ObjectPair, ObjectPairList};
pub use object_sets::{ObjectFilter, ObjectSets};
pub use pair_depth::PairDepth;
pub use pairs::TakeDistance;
pub(crate) use pairs::check_dimensions;
pub use pseudo_normal::{PseudoNormal, Shell};
pub(crate) use pure_answer::PureAt;
pub use scene::Configuration;
pub(crate) use scene::{Group, Scene, SceneMemory};
pub use signed_derivative::GradientKind;
pub use signed_distances::{SignedDistance, SignedDistanceList};
pub(crate) use target::{Placement, Target};
pub(crate) use witnesses::{WitnessRequest, pure_witnesses};
pub use world::World;
