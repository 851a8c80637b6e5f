//! Forward kinematics by compounding, eq. (12)–(19): a link's pose is its parent's, times the joint's frame, times the
//! joint's motion. (Eq. (14) is printed with p in frame i - 1; the point is given in the last frame.)

use super::{JointKind, Robot};
use crate::error::{Error, Result};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::{Pose, PoseColumns};
use crate::turn::Turn;

impl Robot {
    /// The pose of every link at configuration q, in the world. `q` has `nq()` entries. Fails only in a custom joint.
    pub fn link_poses(&self, q: &[f64]) -> Result<Vec<Pose>> {
        let mut poses = vec![Pose::IDENTITY; self.links().len()];
        self.write_link_poses(q, &mut poses)?;
        Ok(poses)
    }

    /// The same, into one place for each link.
    pub fn write_link_poses(&self, q: &[f64], poses: &mut [Pose]) -> Result<()> {
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
    poses: &'a mut [Pose],
}

impl Work for LinkPoses<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<()> {
        let Self { robot, q, poses } = self;
        let links = robot.links();
        let mut turns = Turns::new(robot, q);
        // The link before, which most links follow: what was just stored would have to be waited for.
        let mut before = PoseColumns::of(lanes, &Pose::IDENTITY);
        for (index, link) in links.iter().enumerate() {
            let at = match link.parent {
                None => PoseColumns::of(lanes, &link.at),
                Some(parent) if parent + 1 == index => before.compose(&link.at),
                Some(parent) => PoseColumns::of(lanes, &poses[parent]).compose(&link.at),
            };
            let joint = &link.joint;
            before = match joint.kind {
                JointKind::Fixed => at,
                JointKind::Revolute => at.turned_by(&joint.axis, turns.next(lanes)),
                JointKind::Prismatic => at.shifted_along(&joint.axis, joint.position(q)),
                _ => {
                    let motion = joint.motion(q).and_then(|motion| {
                        robot.check_motion(&motion)?;
                        Ok(motion)
                    });
                    let at_link =
                        |e: Error| e.within(format_args!("link {index} (\"{}\")", link.name));
                    at.compose(&motion.map_err(at_link)?)
                }
            };
            poses[index] = before.pose();
        }
        Ok(())
    }
}

/// The turns of a robot's revolute joints, in order, computed four at a time.
struct Turns<'a> {
    robot: &'a Robot,
    q: &'a [f64],
    /// How many were asked for.
    count: usize,
    four: [Turn; 4],
}

impl<'a> Turns<'a> {
    fn new(robot: &'a Robot, q: &'a [f64]) -> Self {
        Self {
            robot,
            q,
            count: 0,
            four: [Turn::NONE; 4],
        }
    }

    #[inline(always)]
    fn next<I: Instructions>(&mut self, lanes: I) -> Turn {
        let lane = self.count % 4;
        if lane == 0 {
            let mut angles = [0.0; 4];
            let next = self.robot.turning_links()[self.count..].iter();
            for (angle, &link) in angles.iter_mut().zip(next) {
                *angle = self.robot.links()[link].joint.position(self.q);
            }
            self.four = Turn::by_each(lanes, &angles);
        }
        self.count += 1;
        self.four[lane]
    }
}
