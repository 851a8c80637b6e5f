//! Motions: proofs that motions and paths are free, their clearance, and the sliding step (Appendix A).

mod box_piece;
mod clearance;
mod crowd;
mod curve;
mod first_contact;
mod front;
mod gathering;
mod half_spaces;
mod interval_proof;
mod linear_motion;
mod look;
#[allow(clippy::module_inception)]
mod motion;
mod moving_pair;
mod moving_pure;
mod over_pairs;
mod over_piece;
mod pair_motion;
mod path;
mod piece;
mod region;
mod region_growth;
mod region_proof;
mod set_tree;
mod slide;
mod slide_contacts;
mod slide_options;
mod slide_step;
mod span;
mod start_contacts;
mod step_limits;
mod way;

pub use clearance::{ClearanceOptions, ClearanceOutcome, MotionClearance};
pub use curve::{Spline, SplinePiece};
pub use half_spaces::HalfSpace;
pub(crate) use motion::checked_difference;
pub use motion::{MotionAnswer, MotionOptions, MotionOutcome};
pub use pair_motion::{PairMotion, PairMotionAnswer};
pub use path::PathAnswer;
pub use region::{RegionAnswer, RegionOptions, RegionOutcome};
pub use region_growth::{GrownRegion, GrowthOptions, RegionSide, SideStop};
pub use slide::{SlideOutcome, SlideStep};
pub use slide_options::SlideOptions;
pub use slide_step::{Approach, slide_step, spring_step};
