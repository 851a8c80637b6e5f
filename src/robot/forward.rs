//! Forward kinematics by compounding, eq. (12)–(19): a link's pose is its parent's, times the joint's frame, times the
//! joint's motion. (Eq. (14) is printed with p in frame i - 1; the point is given in the last frame.)

use super::{JointKind, Robot};
use crate::error::{Error, Result};
use crate::pose::Pose;

impl Robot {
    /// Appends the pose of every link at configuration q, in the world. `q` has `nq()` entries. Fails only in a custom
    /// joint.
    pub fn link_poses(&self, q: &[f64], poses: &mut Vec<Pose>) -> Result<()> {
        let first = poses.len();
        poses.reserve(self.links().len());
        for (index, link) in self.links().iter().enumerate() {
            let at = match link.parent {
                None => link.at,
                Some(parent) => poses[first + parent].compose(&link.at),
            };
            let joint = &link.joint;
            poses.push(match joint.kind {
                JointKind::Fixed => at,
                JointKind::Revolute => at.turned_about(&joint.axis, joint.position(q)),
                JointKind::Prismatic => at.shifted_along(&joint.axis, joint.position(q)),
                _ => {
                    let motion = joint.motion(q).and_then(|motion| {
                        self.check_motion(&motion)?;
                        Ok(motion)
                    });
                    let at_link =
                        |e: Error| e.within(format_args!("link {index} (\"{}\")", link.name));
                    at.compose(&motion.map_err(at_link)?)
                }
            });
        }
        Ok(())
    }
}
