//! Bodies, and what carries them.

use crate::body::Body;
use crate::pose::{Pose, Vec3};

/// A body, and what carries it: a link, or for `None` the world.
#[derive(Clone, Copy)]
pub(super) struct Carried<'a, Link> {
    pub body: &'a Body,
    pub link: Link,
    /// Its pose in the frame of what carries it; `None` where that is the body's own frame.
    pub pose: Option<&'a Pose>,
    /// Its number among all that links carry.
    pub number: usize,
}

impl<'a, Link> Carried<'a, Link> {
    /// Its pose in the frame of what carries it.
    pub fn pose_in_carrier(&self) -> &'a Pose {
        self.pose.unwrap_or(&Pose::IDENTITY)
    }

    /// The body's centre in the frame of what carries it.
    pub fn center(&self) -> Vec3 {
        let center = self.body.center();
        self.pose
            .map_or(*center, |pose| pose.transform_point(center))
    }
}
