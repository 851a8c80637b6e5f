//! Robots: trees of links and the joints that move them (§4.1–4.3).

mod builder;
mod coordinate;
mod custom_joint;
mod forward;
mod jacobian;
mod joint;
mod motion_bound;
mod motion_chain;
mod names;
#[allow(clippy::module_inception)]
mod robot;

pub use builder::{LinkDefinition, RobotBuilder};
pub use coordinate::{Block, BlockKind, Coordinate};
pub use custom_joint::{CustomJoint, MAX_COORDINATES, Speeds, Twist};
pub use jacobian::{Column, RobotState};
pub use joint::{Joint, JointKind};
pub use motion_chain::{MotionChain, MotionRates, MotionState};
pub use robot::{Link, Robot, check_configuration};
