//! Bodies, and what carries them.

use crate::body::Body;
use crate::pose::Pose;

/// A body, and what carries it: a link, or for `None` the world.
#[derive(Clone, Copy)]
pub(super) struct Carried<'a, Link> {
    pub body: &'a Body,
    pub link: Link,
    /// Its pose in the frame of what carries it.
    pub pose: Pose,
    /// Its number among all that links carry.
    pub number: usize,
}
