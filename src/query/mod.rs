//! Queries: class, distance, witnesses and gradients of a C-object at a configuration (§2.2.4, operations 4–8), the same
//! for two bodies, and the step that slides (Appendix A).

mod answer;
mod at_configuration;
mod at_poses;
mod candidates;
mod context;
mod half_spaces;
mod scene;
mod search;
mod segment;
mod slide;
mod slide_step;
mod step_limits;
mod target;

pub use answer::{
    ContactRecord, Distance, DistanceKind, PenetrationList, PrimitivePenetration, SSide, Witness,
    WitnessList,
};
pub use at_configuration::PseudoNormal;
pub use context::QueryContext;
pub use half_spaces::HalfSpace;
pub use scene::Configuration;
pub use slide::{SlideOptions, SlideOutcome, SlideStep};
pub use slide_step::{Approach, slide_step, spring_step};
