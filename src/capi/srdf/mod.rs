//! SRDF.
//!
//! What an SRDF file says of a robot: which pairs of links not to test, joint groups, named states, end effectors. It is read
//! into the builder that holds the robot's links, after its URDF file.
//!
//! ```c
//! uint32_t arm, home;
//! cstk_joint_group group;
//! cstk_robot *arm_alone = NULL;
//! check(cstk_robot_builder_load_urdf(robot_builder, "arm.urdf", NULL, NULL, NULL, NULL));
//! check(cstk_robot_builder_load_srdf(robot_builder, "arm.srdf", NULL));
//! check(cstk_robot_build(robot_builder, &robot));
//! check(cstk_robot_find_group(robot, "arm", &arm));
//! check(cstk_robot_find_state(robot, "arm", "home", &home));
//! check(cstk_robot_apply_state(robot, home, q, nq));
//! check(cstk_robot_get_group(robot, arm, &group));
//! check(cstk_robot_create_frozen(robot, group.joints, group.joint_count, q, nq, &arm_alone));
//! ```

pub mod reading;
pub mod semantics;
