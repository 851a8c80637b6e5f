//! Forward kinematics by compounding, eq. (12)–(19): a link's pose is its parent's, then the joint's frame, then the joint's
//! motion. (In print (14) ends with p of frame i - 1; the point it carries is given in the last frame.)

use super::{JointKind, Robot};
use crate::error::Result;
use crate::pose::Pose;

impl Robot {
    /// Appends the pose of every link at configuration q, in the world. `q` has `nq()` entries. Only maps of the caller can
    /// fail.
    pub fn link_poses(&self, q: &[f64], poses: &mut Vec<Pose>) -> Result<()> {
        let first = poses.len();
        for (index, link) in self.links().iter().enumerate() {
            let at = match link.parent {
                None => link.at,
                Some(parent) => poses[first + parent].compose(&link.at),
            };
            if matches!(link.joint.kind, JointKind::Fixed) {
                poses.push(at);
                continue;
            }
            let motion = link.joint.motion(q).and_then(|motion| {
                self.check_motion(&motion)?;
                Ok(motion)
            });
            let motion =
                motion.map_err(|e| e.within(format_args!("link {index} (\"{}\")", link.name)))?;
            poses.push(at.compose(&motion));
        }
        Ok(())
    }
}
