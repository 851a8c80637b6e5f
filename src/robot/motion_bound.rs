//! Motion bounds: how far a link can move between two configurations. They are the constants of Quinlan's bubbles (1994),
//! and the same along one direction.

use super::to_carrier::ToCarrier;
use super::{JointKind, Link, Robot, RobotState};
use crate::nonzero::{length, product};
use crate::pose::{Mat3, Vec3};

/// What one joint contributes to the motion of a point set that it carries.
struct JointMotion {
    link: usize,
    /// How far the joint translates its link's origin (a length), and how far it turns the link (radians).
    shift: f64,
    turn: f64,
    /// The largest distance of the carried points from the link's origin during the motion.
    extent: f64,
}

/// What is known of the velocities of a motion, one entry per velocity.
#[derive(Clone, Copy, Debug)]
pub enum Velocity<'a> {
    /// They stay these.
    Constant(&'a [f64]),
    /// They may be of any sign, and change, but are no larger. Only of joints each of whose coordinates turns about an axis of its own: what
    /// turns about several axes at once may turn about others.
    AtMost(&'a [f64]),
}

impl<'a> Velocity<'a> {
    fn entries(self) -> &'a [f64] {
        let (Self::Constant(v) | Self::AtMost(v)) = self;
        v
    }

    /// Those of some of the coordinates.
    pub fn of(self, entries: std::ops::Range<usize>) -> Self {
        match self {
            Self::Constant(v) => Self::Constant(&v[entries]),
            Self::AtMost(v) => Self::AtMost(&v[entries]),
        }
    }
}

impl Robot {
    /// Bounds how far any point of the link's body moves, in the world, while the robot goes from q with constant velocity
    /// v for a unit of time. Infinite where a custom joint does not state its speeds.
    pub fn motion_bound(&self, link: usize, q: &[f64], v: &[f64]) -> f64 {
        match &self.links()[link].body {
            Some(body) => self.motion_bound_of_radius(link, body.radius_from_origin(), q, v),
            None => 0.0,
        }
    }

    /// The same for points fixed to the link within `radius` of its origin.
    pub fn motion_bound_of_radius(&self, link: usize, radius: f64, q: &[f64], v: &[f64]) -> f64 {
        self.motion_bound_in(None, link, radius, q, v)
    }

    /// The same relative to a link that carries it, or to the world: only the joints in between count.
    pub fn motion_bound_in(
        &self,
        frame: Option<usize>,
        link: usize,
        radius: f64,
        q: &[f64],
        v: &[f64],
    ) -> f64 {
        let mut bound = 0.0;
        self.visit_motions(frame, link, radius, q, v, |joint| {
            bound += joint.shift + times(joint.turn, joint.extent);
        });
        bound
    }

    /// Bounds how far a link turns, in radians, relative to a link that carries it, or to the world.
    pub fn turn_bound_in(&self, frame: Option<usize>, link: usize, q: &[f64], v: &[f64]) -> f64 {
        let mut bound = 0.0;
        self.visit_motions(frame, link, 0.0, q, v, |joint| bound += joint.turn);
        bound
    }

    /// The same along a unit direction n of the world; `state` holds the link poses at the start. For a base that drives on a
    /// floor, the bound along the floor's normal is 0.
    ///
    /// A joint that turns with w moves a point at r from its axis along n at n . (w x r) = r . (n x w), at most |r| |w| times the sine of
    /// the angle between n and its axis. Seen from the joint's frame n drifts by the turns of all joints before it, and by its own turn,
    /// and a sine grows by no more than the drift. A shift along s is n . s at the start, and changes by at most |s| times the drift.
    pub fn directed_motion_bound(
        &self,
        link: usize,
        radius: f64,
        direction: &Vec3,
        state: RobotState,
        velocity: Velocity,
    ) -> f64 {
        let mut joints: Vec<JointMotion> = Vec::new();
        let v = velocity.entries();
        self.visit_motions(None, link, radius, state.q, v, |joint| joints.push(joint));
        let mut bound = 0.0;
        // How far the direction, in the frame of the current joint, drifts from its value at the start.
        let mut drift = 0.0;
        for joint in joints.iter().rev() {
            let [shift, turn] = self.directed_velocity(joint, direction, state, velocity);
            let turned = times(joint.turn, (turn + drift).min(1.0));
            drift += turned;
            let shift = (shift + times(joint.shift, drift)).min(joint.shift);
            bound += shift + times(turned, joint.extent);
        }
        bound
    }

    /// How fast a joint translates its link along a direction at the start, and the sine of the angle between the direction
    /// and the axis of rotation. Where these are unknown, the upper bounds: the joint's shift, and 1.
    fn directed_velocity(
        &self,
        joint: &JointMotion,
        direction: &Vec3,
        state: RobotState,
        velocity: Velocity,
    ) -> [f64; 2] {
        let link = &self.links()[joint.link];
        let v = velocity.entries();
        let Some((shifts, turn)) = self.start_velocity(link, joint.link, state, v) else {
            return [joint.shift, 1.0];
        };
        let shifts = shifts.map(|shift| shift.dot(direction));
        let shift = match velocity {
            Velocity::Constant(_) => shifts.iter().sum::<f64>().abs(),
            Velocity::AtMost(_) => shifts.iter().map(|shift| shift.abs()).sum(),
        };
        let sine = turn.try_normalize(0.0);
        let sine = sine.map_or(0.0, |axis| axis.cross(direction).norm());
        let is_known = !matches!(link.joint.kind, JointKind::FreeEuler);
        [shift, if is_known { sine } else { 1.0 }]
    }

    /// The linear velocities that the coordinates of a link's own joint give it at the start of the motion, and its angular velocity, in
    /// the world; `None` for custom joints.
    fn start_velocity(
        &self,
        link: &Link,
        index: usize,
        state: RobotState,
        v: &[f64],
    ) -> Option<([Vec3; 3], Vec3)> {
        let joint = &link.joint;
        let own = &v[joint.velocity..joint.velocity + joint.kind.nv()];
        let turned = state.poses[index].rotation;
        let frame = || match link.parent {
            None => link.at.rotation,
            Some(parent) => state.poses[parent].rotation * link.at.rotation,
        };
        let vector = |at: usize| Vec3::new(own[at], own[at + 1], own[at + 2]);
        let zero = Vec3::zeros();
        let along = |axes: Mat3, count: usize| {
            [0, 1, 2].map(|k| match k < count {
                true => axes.column(k) * own[k],
                false => zero,
            })
        };
        Some(match joint.kind {
            JointKind::Fixed => ([zero; 3], zero),
            // The joint's motion leaves the axis in place.
            JointKind::Revolute => ([zero; 3], turned * joint.axis * (joint.multiplier * own[0])),
            JointKind::Prismatic => {
                let shift = turned * joint.axis * (joint.multiplier * own[0]);
                ([shift, zero, zero], zero)
            }
            JointKind::Planar => (along(frame(), 2), frame().column(2) * own[2]),
            JointKind::Spherical => ([zero; 3], turned * vector(0)),
            JointKind::Free => (along(turned, 3), turned * vector(3)),
            JointKind::FreeEuler => (along(frame(), 3), zero),
            JointKind::Custom(_) => return None,
        })
    }

    /// Visits the joints that carry points within `radius` of a link's origin, from the link to a frame.
    fn visit_motions(
        &self,
        frame: Option<usize>,
        link: usize,
        radius: f64,
        q: &[f64],
        v: &[f64],
        mut visit: impl FnMut(JointMotion),
    ) {
        let links = self.links();
        // The largest distance of a carried point from the current link's origin.
        let mut extent = radius;
        let mut next = Some(link);
        while let Some(index) = next.filter(|_| next != frame) {
            let here = &links[index];
            let joint = &here.joint;
            let own_q = &q[joint.coordinate..joint.coordinate + joint.kind.nq()];
            let own_v = &v[joint.velocity..joint.velocity + joint.kind.nv()];
            // How far the link's origin moves, how far the link turns, and how far the origin starts from the joint's
            // frame.
            let (shift, turn, away) = match &joint.kind {
                JointKind::Fixed => (0.0, 0.0, 0.0),
                JointKind::Revolute => (0.0, product(joint.multiplier, own_v[0]).abs(), 0.0),
                JointKind::Prismatic => (
                    product(joint.multiplier, own_v[0]).abs(),
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
                    // A joint at rest needs no speeds.
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
            visit(JointMotion {
                link: index,
                shift,
                turn,
                extent,
            });
            extent += away + shift + here.at.translation.norm();
            next = here.parent;
        }
    }

    /// The lowest common ancestor of two links (it may be one of them); `None` for the world.
    pub fn common_carrier(&self, links: [usize; 2]) -> Option<usize> {
        ToCarrier::new(links.map(Some), |link| self.links()[link].parent).carrier()
    }
}

/// A product in which 0 times infinity is 0.
fn times(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}
