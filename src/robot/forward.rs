//! Forward kinematics by compounding, eq. (12)–(19): a link's pose is its parent's, times the joint's frame, times the
//! joint's motion. (Eq. (14) is printed with p in frame i - 1; the point is given in the last frame.)

use super::{JointKind, Robot};
use crate::error::{Error, Result};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::Pose;

impl Robot {
    /// Appends the pose of every link at configuration q, in the world. `q` has `nq()` entries. Fails only in a custom
    /// joint.
    pub fn link_poses(&self, q: &[f64], poses: &mut Vec<Pose>) -> Result<()> {
        with_widest(LinkPoses {
            robot: self,
            q,
            poses,
        })
    }
}

struct LinkPoses<'a> {
    robot: &'a Robot,
    q: &'a [f64],
    poses: &'a mut Vec<Pose>,
}

impl Work for LinkPoses<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<()> {
        let Self { robot, q, poses } = self;
        let first = poses.len();
        poses.reserve(robot.links().len());
        for (index, link) in robot.links().iter().enumerate() {
            let at = match link.parent {
                None => link.at,
                Some(parent) => poses[first + parent].compose_with(lanes, &link.at),
            };
            let joint = &link.joint;
            poses.push(match joint.kind {
                JointKind::Fixed => at,
                JointKind::Revolute => at.turned_about(&joint.axis, joint.position(q)),
                JointKind::Prismatic => at.shifted_along(&joint.axis, joint.position(q)),
                _ => {
                    let motion = joint.motion(q).and_then(|motion| {
                        robot.check_motion(&motion)?;
                        Ok(motion)
                    });
                    let at_link =
                        |e: Error| e.within(format_args!("link {index} (\"{}\")", link.name));
                    at.compose_with(lanes, &motion.map_err(at_link)?)
                }
            });
        }
        Ok(())
    }
}
