//! Forward kinematics by compounding, eq. (12)–(19).

use super::Robot;
use crate::pose::Pose;

impl Robot {
    /// Appends the pose of every link at configuration q, in the world. `q` has `coordinates()` entries.
    pub fn link_poses(&self, q: &[f64], poses: &mut Vec<Pose>) {
        let first = poses.len();
        for link in self.links() {
            let at = match link.parent {
                None => link.at,
                Some(parent) => poses[first + parent].compose(&link.at),
            };
            poses.push(at.compose(&link.joint.motion(q)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{JointKind, LinkDefinition, RobotBuilder};
    use crate::pose::{Pose, Vec3};

    /// The two-link arm of eq. (15)-(18) and its Jacobian (37).
    #[test]
    fn the_reports_two_link_arm() {
        let (x0, x1) = (2.0, 1.5);
        let mut builder = RobotBuilder::new(3).unwrap();
        for (parent, x) in [(None, 0.0), (Some(0), x0)] {
            builder
                .add_link(LinkDefinition {
                    name: String::new(),
                    body: None,
                    parent,
                    at: Pose::from_translation(Vec3::new(x, 0.0, 0.0)),
                    kind: JointKind::Revolute,
                    axis: Vec3::z(),
                    coordinate: None,
                })
                .unwrap();
        }
        let robot = builder.build().unwrap();
        let q = [0.4, -1.1];
        let mut poses = Vec::new();
        robot.link_poses(&q, &mut poses);
        let tip = poses[1].transform_point(&Vec3::new(x1, 0.0, 0.0));
        let (t0, t01) = (q[0], q[0] + q[1]);
        let want = Vec3::new(
            x0 * t0.cos() + x1 * t01.cos(),
            x0 * t0.sin() + x1 * t01.sin(),
            0.0,
        );
        assert!((tip - want).amax() < 1e-15);

        let jacobian = robot.jacobian(&poses, 1, &tip);
        let expected = [
            [-(x0 * t0.sin() + x1 * t01.sin()), -x1 * t01.sin()],
            [x0 * t0.cos() + x1 * t01.cos(), x1 * t01.cos()],
            [0.0, 0.0],
            [0.0, 0.0],
            [0.0, 0.0],
            [1.0, 1.0],
        ];
        for (row, want) in expected.iter().enumerate() {
            for (column, want) in want.iter().enumerate() {
                assert!((jacobian[row * 2 + column] - want).abs() < 1e-15);
            }
        }
    }
}
