//! The basic Jacobian, eq. (32)–(33), column by column.

use super::{JointKind, Robot};
use crate::pose::{Pose, Vec3};

/// One joint that moves a link, in the world.
pub struct Column {
    pub coordinate: usize,
    /// Velocity of the point for a unit velocity of the coordinate.
    pub linear: Vec3,
    /// Angular velocity of the link for the same.
    pub angular: Vec3,
}

/// The joints between a link and the world, from the link downwards.
pub struct Ancestry<'a> {
    robot: &'a Robot,
    poses: &'a [Pose],
    point: Vec3,
    next: Option<usize>,
}

impl Iterator for Ancestry<'_> {
    type Item = Column;

    fn next(&mut self) -> Option<Column> {
        loop {
            let index = self.next?;
            let link = &self.robot.links()[index];
            self.next = link.parent;
            let pose = &self.poses[index];
            // The axis is its own image under the joint's motion, so the link's pose serves for the joint's frame.
            let axis = pose.rotation * link.joint.axis;
            let (linear, angular) = match link.joint.kind {
                JointKind::Fixed => continue,
                JointKind::Revolute => (axis.cross(&(self.point - pose.translation)), axis),
                JointKind::Prismatic => (axis, Vec3::zeros()),
            };
            return Some(Column {
                coordinate: link.joint.coordinate,
                linear,
                angular,
            });
        }
    }
}

impl Robot {
    /// The columns of the Jacobian of a point fixed to a link; `poses` are the robot's link poses and `point` is given,
    /// all in the world. Joints that share a coordinate give one column each, to be summed.
    pub fn ancestry<'a>(&'a self, poses: &'a [Pose], link: usize, point: &Vec3) -> Ancestry<'a> {
        Ancestry {
            robot: self,
            poses,
            point: *point,
            next: Some(link),
        }
    }

    /// The 6 x nv basic Jacobian of a point fixed to a link, row-major: three rows of linear velocity, three of angular
    /// velocity, all in the world frame.
    pub fn jacobian(&self, poses: &[Pose], link: usize, point: &Vec3) -> Vec<f64> {
        let n = self.coordinates();
        let mut matrix = vec![0.0; 6 * n];
        for column in self.ancestry(poses, link, point) {
            for row in 0..3 {
                matrix[row * n + column.coordinate] += column.linear[row];
                matrix[(row + 3) * n + column.coordinate] += column.angular[row];
            }
        }
        matrix
    }
}
