//! Bounds of how far links move and turn while the space goes from q with constant velocity v for a unit of time: those of the robots that
//! have them (see [`Robot::motion_bound`]).

use super::space::Space;
use crate::pose::Vec3;
use crate::robot::{Robot, RobotState, Velocity};

/// A link of one of the space's robots, with its number there, and what the robot has of q and v.
struct Own<'a> {
    robot: &'a Robot,
    link: usize,
    q: &'a [f64],
    v: &'a [f64],
}

impl Space {
    fn own<'a>(&'a self, link: usize, q: &'a [f64], v: &'a [f64]) -> Own<'a> {
        let index = self.robot_of(link);
        let (robot, offset) = (&self.robots[index], self.offsets()[index]);
        Own {
            robot,
            link: link - offset.link,
            q: &q[self.coordinates_of(index)],
            v: &v[offset.velocity..offset.velocity + robot.nv()],
        }
    }

    /// The last link that carries both, as their robot numbers it; `None` for the world.
    fn shared_carrier(&self, links: [usize; 2]) -> Option<usize> {
        let [a, b] = links.map(|link| self.robot_of(link));
        let first = self.offsets()[a].link;
        let robot = &self.robots[a];
        (a == b).then(|| robot.common_carrier(links.map(|link| link - first)))?
    }

    /// Bounds how far any point of the link's body moves, in the world. Infinite where a moving custom joint does not state its speeds.
    pub fn motion_bound(&self, link: usize, q: &[f64], v: &[f64]) -> f64 {
        let own = self.own(link, q, v);
        own.robot.motion_bound(own.link, own.q, own.v)
    }

    /// The same for points fixed to the link within `radius` of its origin.
    pub fn motion_bound_of_radius(&self, link: usize, radius: f64, q: &[f64], v: &[f64]) -> f64 {
        let own = self.own(link, q, v);
        own.robot
            .motion_bound_of_radius(own.link, radius, own.q, own.v)
    }

    /// The same along a unit direction of the world; see [`Robot::directed_motion_bound`].
    pub fn directed_motion_bound(
        &self,
        link: usize,
        radius: f64,
        direction: &Vec3,
        state: RobotState,
        velocity: Velocity,
    ) -> f64 {
        let index = self.robot_of(link);
        let (robot, offset) = (&self.robots[index], self.offsets()[index]);
        let own_velocity = velocity.of(offset.velocity..offset.velocity + robot.nv());
        let own = RobotState {
            q: &state.q[self.coordinates_of(index)],
            poses: &state.poses[offset.link..],
        };
        robot.directed_motion_bound(link - offset.link, radius, direction, own, own_velocity)
    }

    /// Bounds the change of the distance between point sets fixed to two links, each within its extent of its link's
    /// origin. 0 for links that no joint moves relative to each other.
    pub fn relative_motion_bound(&self, sides: [(usize, f64); 2], q: &[f64], v: &[f64]) -> f64 {
        let shared = self.shared_carrier(sides.map(|(link, _)| link));
        let bounds = sides.map(|(link, extent)| {
            let own = self.own(link, q, v);
            own.robot
                .motion_bound_in(shared, own.link, extent, own.q, own.v)
        });
        bounds.iter().sum()
    }

    /// Bounds how far a link turns, in radians, as the world or another link sees it.
    pub fn turn_bound(&self, link: usize, from: Option<usize>, q: &[f64], v: &[f64]) -> f64 {
        let shared = from.and_then(|from| self.shared_carrier([link, from]));
        let turn = |link: usize| {
            let own = self.own(link, q, v);
            own.robot.turn_bound_in(shared, own.link, own.q, own.v)
        };
        turn(link) + from.map_or(0.0, turn)
    }
}
