//! How far a link can move between two configurations: the constants of Quinlan's bubbles (1994).

use super::{JointKind, Robot};

impl Robot {
    /// No point of the link's body moves farther than this, in the world, while the robot goes from q with constant velocity
    /// v for a unit of time. Infinite where a custom joint does not state its speeds.
    pub fn motion_bound(&self, link: usize, q: &[f64], v: &[f64]) -> f64 {
        match &self.links()[link].body {
            Some(body) => self.reach_motion_bound(link, body.reach(), q, v),
            None => 0.0,
        }
    }

    /// The same for whatever is fixed to the link, no farther than `reach` from its origin.
    pub fn reach_motion_bound(&self, link: usize, reach: f64, q: &[f64], v: &[f64]) -> f64 {
        let links = self.links();
        // The reach is the largest distance from the current joint's origin to a point of the body.
        let mut reach = reach;
        let mut bound = 0.0;
        let mut next = Some(link);
        while let Some(index) = next {
            let here = &links[index];
            let joint = &here.joint;
            let own_q = &q[joint.coordinate..joint.coordinate + joint.kind.nq()];
            let own_v = &v[joint.velocity..joint.velocity + joint.kind.nv()];
            let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
            // How far the link's origin goes, how far it turns, and how far from the joint's frame it begins.
            let (shift, turn, away) = match &joint.kind {
                JointKind::Fixed => (0.0, 0.0, 0.0),
                JointKind::Revolute => (0.0, (joint.multiplier * own_v[0]).abs(), 0.0),
                JointKind::Prismatic => (
                    (joint.multiplier * own_v[0]).abs(),
                    0.0,
                    (joint.multiplier * own_q[0] + joint.offset).abs(),
                ),
                JointKind::Planar => (length(&own_v[..2]), own_v[2].abs(), length(&own_q[..2])),
                JointKind::Spherical => (0.0, length(own_v), 0.0),
                JointKind::Free => (
                    length(&own_v[..3]),
                    length(&own_v[3..]),
                    length(&own_q[..3]),
                ),
                JointKind::FreeEuler => (
                    length(&own_v[..3]),
                    own_v[3..].iter().map(|x| x.abs()).sum(),
                    length(&own_q[..3]),
                ),
                JointKind::Custom(custom) => {
                    let sum: f64 = own_v.iter().map(|x| x.abs()).sum();
                    // A joint that rests needs no speeds.
                    let speeds = custom
                        .speeds()
                        .map_or([f64::INFINITY; 2], |s| [s.linear, s.angular]);
                    let [shift, turn] =
                        speeds.map(|speed| if sum == 0.0 { 0.0 } else { speed * sum });
                    let away = joint
                        .motion(q)
                        .map_or(f64::INFINITY, |pose| pose.translation.norm());
                    (shift, turn, away)
                }
            };
            bound += shift + if turn == 0.0 { 0.0 } else { turn * reach };
            reach += away + shift + here.at.translation.norm();
            next = here.parent;
        }
        bound
    }
}
