//! Lever arms: how far each coordinate moves a body, to first order exact at one configuration and safe for all others.

use super::{Joint, JointKind, Robot};
use crate::pose::{Pose, Vec3};

/// Half a turn of a unit quaternion is a chord of at most sqrt(2), up to sign: an angle of 4 asin(chord / 2) is at most this times
/// the chord, and the chord at most the sum of the changes of its four entries.
const ANGLE_OF_CHORD: f64 = 2.221_441_469_079_183_5;

/// A ball of the world that a link carries.
#[derive(Clone, Copy, Debug)]
pub struct CarriedBall {
    /// In the world, at the poses that it is asked with.
    pub center: Vec3,
    /// At least the distance of every point carried.
    pub radius: f64,
}

impl Robot {
    /// Visits the coordinates that move a link as another link sees it (the world, if `None`), each with an arm: changing the
    /// coordinates from those of `poses` to any others moves no point of the ball by more than the sum of the arms times the
    /// changes. A coordinate of several joints is visited for each. False where a custom joint is in between: then nothing holds.
    ///
    /// Let the joints change one after the other, the first of the chain first. Each turns the ball about an axis from which it is
    /// as far as it was at the start, since no joint behind has moved yet.
    pub fn visit_lever_arms(
        &self,
        poses: &[Pose],
        [frame, link]: [Option<usize>; 2],
        ball: &CarriedBall,
        mut visit: impl FnMut(usize, f64),
    ) -> bool {
        let mut next = link;
        while let Some(index) = next.filter(|_| next != frame) {
            let link = &self.links()[index];
            if matches!(link.joint.kind, JointKind::Custom(_)) {
                return false;
            }
            visit_joint(&link.joint, &poses[index], ball, &mut visit);
            next = link.parent;
        }
        true
    }
}

fn visit_joint(joint: &Joint, pose: &Pose, ball: &CarriedBall, visit: &mut impl FnMut(usize, f64)) {
    let first = joint.coordinate;
    let from_origin = ball.center - pose.translation;
    let about = |axis: &Vec3| from_origin.cross(&(pose.rotation * axis)).norm() + ball.radius;
    let about_origin = || from_origin.norm() + ball.radius;
    let shifts = 0..match joint.kind {
        JointKind::Planar => 2,
        JointKind::Free | JointKind::FreeEuler => 3,
        _ => 0,
    };
    for shift in shifts.clone() {
        visit(first + shift, 1.0);
    }
    let turns = first + shifts.end;
    match joint.kind {
        JointKind::Fixed | JointKind::Custom(_) => {}
        JointKind::Revolute => visit(first, joint.multiplier.abs() * about(&joint.axis)),
        JointKind::Prismatic => visit(first, joint.multiplier.abs()),
        JointKind::Planar => visit(turns, about(&Vec3::z())),
        JointKind::FreeEuler => (turns..turns + 3).for_each(|c| visit(c, about_origin())),
        JointKind::Spherical | JointKind::Free => {
            (turns..turns + 4).for_each(|c| visit(c, ANGLE_OF_CHORD * about_origin()));
        }
    }
}
