//! Queries: class, distance, witnesses and gradients of a C-object at a configuration (§2.2.4, operations 4–8), the same
//! for two bodies, and the step that slides (Appendix A).

mod answer;
mod at_configuration;
mod at_poses;
mod body_pairs;
mod candidates;
mod context;
mod distance;
mod explain;
mod half_spaces;
mod link_pairs;
mod pair_penetration;
mod pure_answer;
mod scene;
mod search;
mod segment;
mod set_witnesses;
mod sets;
mod slide;
mod slide_contacts;
mod slide_step;
mod step_limits;
mod target;
mod world;

pub use answer::{
    ContactRecord, ContactsListed, Distance, DistanceKind, PenetrationList, PrimitivePenetration,
    PurePlace, SSide, Witness, WitnessList,
};
pub use at_configuration::{PseudoNormal, Shell};
pub use context::QueryContext;
pub use explain::{Explanation, Verdict};
pub use half_spaces::HalfSpace;
pub use link_pairs::{LinkPair, LinkPairOptions, PairVerdict};
pub use scene::Configuration;
pub use slide::{SlideOptions, SlideOutcome, SlideStep};
pub use slide_step::{Approach, slide_step, spring_step};
pub use world::World;
