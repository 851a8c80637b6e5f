//! How far a link can move between two configurations: the constants of Quinlan's bubbles (1994).

use super::{JointKind, Robot};

impl Robot {
    /// No point of the link's body moves farther than this, in the world, on the straight segment from q0 to q1.
    pub fn motion_bound(&self, link: usize, q0: &[f64], q1: &[f64]) -> f64 {
        let links = self.links();
        let Some(body) = &links[link].body else {
            return 0.0;
        };
        // The reach is the largest distance from the current joint's origin to a point of the body.
        let mut reach = body.center().norm() + body.radius();
        let mut bound = 0.0;
        let mut next = Some(link);
        while let Some(index) = next {
            let here = &links[index];
            let c = here.joint.coordinate;
            match here.joint.kind {
                JointKind::Fixed => {}
                JointKind::Revolute => bound += (q1[c] - q0[c]).abs() * reach,
                JointKind::Prismatic => {
                    bound += (q1[c] - q0[c]).abs();
                    reach += q0[c].abs().max(q1[c].abs());
                }
            }
            reach += here.at.translation.norm();
            next = here.parent;
        }
        bound
    }
}
