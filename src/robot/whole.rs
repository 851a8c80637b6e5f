//! What a robot with frozen joints knows of the one that it was made from.

use super::coordinate::Block;

/// How the configurations of a robot with frozen joints stand in those of the robot that it was made from.
#[derive(Clone, Debug)]
pub(super) struct Whole {
    /// The configuration of that robot at which joints are frozen.
    pub rest: Vec<f64>,
    /// That robot's.
    pub blocks: Vec<Block>,
    /// The place there of each coordinate that is left, ascending.
    pub kept: Vec<usize>,
}
