//! Where the robot is, as pure sets see it.

use crate::pose::Pose;
use crate::space::Space;

/// A configuration: its coordinates, where they are known, and the poses of all links at it.
#[derive(Clone, Copy, Debug)]
pub struct SpaceState<'a> {
    pub space: &'a Space,
    pub q: Option<&'a [f64]>,
    pub poses: &'a [Pose],
}
