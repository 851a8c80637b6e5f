//! The input of pure sets: a configuration and its link poses.

use crate::pose::Pose;
use crate::space::Space;

/// A configuration: its coordinates, if known, and the poses of all links.
#[derive(Clone, Copy, Debug)]
pub struct SpaceState<'a> {
    /// The space of the configuration.
    pub space: &'a Space,
    /// The coordinates; `None` if only link poses are given.
    pub q: Option<&'a [f64]>,
    /// The pose of every link, in the world.
    pub poses: &'a [Pose],
}
