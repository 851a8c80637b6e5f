//! Robots: trees of links and the joints that move them (§4.1–4.3).

mod builder;
mod circular_arc;
mod coordinate;
mod course;
mod custom_joint;
mod forward;
mod frozen;
mod jacobian;
mod joint;
mod link_motions;
mod link_speeds;
mod link_states;
mod link_twists;
mod motion_bound;
mod motion_rates;
mod motion_state;
mod names;
mod rates_from;
#[allow(clippy::module_inception)]
mod robot;
mod semantics;
mod to_carrier;
mod whole;

pub use builder::{LinkDefinition, RobotBuilder};
pub use coordinate::{Block, BlockKind, Coordinate};
pub use course::CourseState;
pub use course::{MAX_DEGREE, between, bezier, bezier_speed};
pub use custom_joint::{CustomJoint, MAX_COORDINATES, Speeds, Twist};
pub use jacobian::{Column, RobotState};
pub use joint::{Joint, JointKind};
pub use link_motions::{CoordinateCourses, LinkMotions};
pub use link_speeds::{LinkSpeed, LinkSpeeds};
pub use link_states::LinkStates;
pub use link_twists::{LinkTwists, RelativeTwist, RelativeTwists};
pub use motion_bound::Velocity;
pub use motion_rates::{ChainRates, ChainRounding, MotionRates};
pub use motion_state::MotionState;
pub use rates_from::{RatesFrom, RatesMemory};
pub use robot::{Link, Robot, check_configuration};
pub use semantics::{
    EndEffector, JointGroup, NamedState, PairRules, SemanticName, Semantics, VirtualJoint,
    VirtualJointKind,
};
pub use to_carrier::ToCarrier;
