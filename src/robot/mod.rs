//! Robots: trees of links joined by fixed, revolute and prismatic joints (§4.1–4.3).

mod builder;
mod forward;
mod jacobian;
mod joint;
mod motion_bound;
#[allow(clippy::module_inception)]
mod robot;

pub use builder::{LinkDefinition, RobotBuilder};
pub use jacobian::Ancestry;
pub use joint::{Joint, JointKind};
pub use robot::{Link, Robot, check_configuration};
