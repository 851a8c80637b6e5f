//! Robots.
//!
//! A robot is a tree of links, each with a joint to its parent and perhaps a body (§4.2). A builder collects the links. The
//! robot computes forward kinematics and Jacobians.
//!
//! ```c
//! cstk_link_def upper_arm;
//! uint32_t link;
//! check(cstk_link_def_default(&upper_arm, sizeof upper_arm));
//! upper_arm.joint = CSTK_JOINT_REVOLUTE;
//! upper_arm.body = body;
//! check(cstk_robot_builder_add_link(robot_builder, &upper_arm, &link));
//! check(cstk_robot_build(robot_builder, &robot));
//! ```

pub mod joint;

pub mod custom_joint;

pub mod builder;

#[allow(clippy::module_inception)]
pub mod robot;

pub mod frozen;
