//! The report on an SRDF file.

/// What was read from an SRDF file, and what was skipped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SrdfReport {
    /// The number of `<group>` elements directly in the robot.
    pub groups: usize,
    /// The number of `<group_state>` elements.
    pub states: usize,
    /// The number of `<end_effector>` elements.
    pub end_effectors: usize,
    /// The number of `<virtual_joint>` elements.
    pub virtual_joints: usize,
    /// The number of `<passive_joint>` elements.
    pub passive_joints: usize,
    /// The number of pairs that `<disable_collisions>` names, each counted once.
    pub disabled_pairs: usize,
    /// Elements of kinds that are not read.
    pub skipped_elements: usize,
    /// Elements that name links, joints or groups that are not there; only where the options let them be skipped.
    pub unknown_names: usize,
    /// Values of states for joints that are not in the state's group, have no coordinate, or one that another joint sets.
    pub unused_values: usize,
}
