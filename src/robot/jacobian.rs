//! The basic Jacobian, eq. (32)–(33), column by column. (Eq. (32) is printed with its columns out of order: they run from
//! 0.)

use smallvec::SmallVec;

use super::{JointKind, Robot, Twist};
use crate::error::Result;
use crate::pose::{Pose, Vec3, turned_axes};

/// A configuration and the link poses at it.
#[derive(Clone, Copy, Debug)]
pub struct RobotState<'a> {
    /// The coordinates, `nq` of them.
    pub q: &'a [f64],
    /// The pose of every link, in the world.
    pub poses: &'a [Pose],
}

/// A column of the Jacobian of a point of a link: what one velocity does, in the world frame.
pub struct Column {
    /// The index of the robot's velocity.
    pub velocity: usize,
    /// Velocity of the point.
    pub linear: Vec3,
    /// Angular velocity of the link.
    pub angular: Vec3,
}

impl Column {
    /// Adds the column to a row-major 6 x `nv` matrix, linear velocity above angular.
    pub fn add_to(&self, matrix: &mut [f64], nv: usize) {
        for row in 0..3 {
            matrix[row * nv + self.velocity] += self.linear[row];
            matrix[(row + 3) * nv + self.velocity] += self.angular[row];
        }
    }
}

impl Robot {
    /// Visits the columns of the Jacobian of a point fixed to a link, from the link to the root; `point` is given in the
    /// world. Joints that share a coordinate give one column each, to be summed.
    pub fn visit_columns(
        &self,
        RobotState { q, poses }: RobotState,
        link: usize,
        point: &Vec3,
        mut visit: impl FnMut(Column),
    ) -> Result<()> {
        let mut twists: SmallVec<[Twist; 6]> = SmallVec::new();
        let mut next = Some(link);
        while let Some(index) = next {
            let link = &self.links()[index];
            next = link.parent;
            let pose = &poses[index];
            let arm = point - pose.translation;
            let frame = match &link.joint.kind {
                JointKind::Fixed => continue,
                // A rotation about the axis leaves the axis in place, so the link's frame serves as well as the joint's.
                kind if kind.has_axis() => pose.rotation,
                _ => match link.parent {
                    None => link.at.rotation,
                    Some(parent) => turned_axes(&poses[parent].rotation, &link.at.rotation),
                },
            };
            twists.clear();
            link.joint
                .columns(q, &frame, pose, &mut twists)
                .map_err(|e| e.within(format_args!("link {index} (\"{}\")", link.name)))?;
            for (k, twist) in twists.iter().enumerate() {
                visit(Column {
                    velocity: link.joint.velocity + k,
                    linear: twist.linear + twist.angular.cross(&arm),
                    angular: twist.angular,
                });
            }
        }
        Ok(())
    }

    /// The 6 x nv basic Jacobian of a point fixed to a link, row-major: three rows of linear velocity, three of angular
    /// velocity, all in the world frame.
    pub fn jacobian(&self, state: RobotState, link: usize, point: &Vec3) -> Result<Vec<f64>> {
        let nv = self.nv();
        let mut matrix = vec![0.0; 6 * nv];
        self.visit_columns(state, link, point, |c| c.add_to(&mut matrix, nv))?;
        Ok(matrix)
    }
}
