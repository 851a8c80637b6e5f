//! Queries: class, distance, witnesses and gradients of a C-object at a configuration (§2.2.4, operations 4–8), the same
//! for two bodies, and the step that slides (Appendix A).

mod answer;
mod candidates;
mod context;
mod enumerate;
mod half_spaces;
mod pair;
mod segment;
mod slide;
mod strategies;

pub use answer::{ContactRecord, Distance, DistanceKind, SSide, Witness, WitnessList};
pub use candidates::Configuration;
pub use context::QueryContext;
pub use enumerate::PseudoNormal;
pub use slide::{SlideOptions, SlideOutcome, SlideStep};
