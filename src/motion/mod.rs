//! Motions: segments of C-space that are proved free, and the step that slides (Appendix A).

mod half_spaces;
mod segment;
mod slide;
mod slide_contacts;
mod slide_step;
mod step_limits;

pub use half_spaces::HalfSpace;
pub use slide::{SlideOptions, SlideOutcome, SlideStep};
pub use slide_step::{Approach, slide_step, spring_step};
