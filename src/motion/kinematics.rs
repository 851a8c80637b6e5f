//! Where bodies are at one time of a motion, and how they move.

use super::carried::Carried;
use super::span::Span;
use super::way::{Way, WayKind};
use crate::error::Result;
use crate::pose::{Pose, Vec3, turned};
use crate::robot::{LinkMotions, LinkStates, MotionRates, MotionState};
use crate::tolerance::SUM_SLACK;

/// Memory of [`Kinematics`].
#[derive(Default)]
pub(super) struct KinematicsMemory {
    states: LinkStates,
    bodies: Vec<(u64, BodyState)>,
}

/// Where the links and the bodies that they carry are at one time, and how they move.
pub(super) struct Kinematics<'a> {
    motions: &'a LinkMotions,
    states: LinkStates,
    /// By the bodies' numbers, each with the number of the time at which it was asked for.
    bodies: Vec<(u64, BodyState)>,
    /// The number of the time.
    moment: u64,
    /// The time that began last.
    time: Option<f64>,
    /// `None` for bodies without a robot.
    way: Option<&'a Way<'a>>,
    /// Poses alone are needed too, since not all velocities are known.
    needs_poses: bool,
    poses: Option<Vec<Pose>>,
}

/// A body at one time.
#[derive(Clone, Copy)]
struct BodyState {
    /// Of its frame.
    frame: MotionState,
    /// Its centre in the world, with its velocity and acceleration.
    center: Vec3,
    velocity: Vec3,
    acceleration: Vec3,
}

/// How A moves as B sees it, with the components in the world's frame.
pub(super) struct Relative {
    /// Of both bodies, in the world.
    pub poses: [Pose; 2],
    pub center: CenterMotion,
    pub angular: Vec3,
    pub angular_acceleration: Vec3,
}

/// How A's centre moves as B sees it, with the components in the world's frame.
pub(super) struct CenterMotion {
    /// From B's centre to A's.
    pub apart: Vec3,
    /// The velocity of A's centre, and its derivative.
    pub velocity: Vec3,
    pub acceleration: Vec3,
}

impl CenterMotion {
    /// Of two centres that one sees: how the first moves as something sees it that goes with the second and does not turn.
    #[inline]
    pub fn seen_from(&self, other: &Self) -> Self {
        Self {
            apart: self.apart - other.apart,
            velocity: self.velocity - other.velocity,
            acceleration: self.acceleration - other.acceleration,
        }
    }
}

impl<'a> Kinematics<'a> {
    /// Of velocities that are known; `memory` is used again.
    pub fn new(
        motions: &'a LinkMotions,
        way: Option<&'a Way<'a>>,
        memory: KinematicsMemory,
    ) -> Self {
        let KinematicsMemory { states, mut bodies } = memory;
        bodies.clear();
        Self {
            motions,
            states,
            bodies,
            moment: 0,
            time: None,
            way,
            needs_poses: false,
            poses: None,
        }
    }

    /// From now on poses are known too where velocities are not.
    pub fn need_poses(&mut self) {
        self.needs_poses = true;
        self.time = None;
    }

    pub fn into_memory(self) -> KinematicsMemory {
        KinematicsMemory {
            states: self.states,
            bodies: self.bodies,
        }
    }

    /// Begins a time, unless it is the one that began last.
    pub fn start(&mut self, time: f64) -> Result<()> {
        if self.time == Some(time) {
            return Ok(());
        }
        self.time = None;
        self.states.start(self.motions, time);
        self.moment += 1;
        if let Some(way) = self.way {
            if let WayKind::Stated(motion) = way.kind {
                let given = self.states.given_mut();
                given.clear();
                given.extend(motion.at(time)?.coordinates());
            }
            if self.needs_poses {
                self.poses = Some(way.link_poses(time)?);
            }
        }
        self.time = Some(time);
        Ok(())
    }

    /// How A moves as B sees it, where the motion of both is known.
    pub fn relative(&mut self, a: &Carried<usize>, b: &Carried<Option<usize>>) -> Relative {
        let center = self.center(a, b);
        self.relative_with(a, b, center)
    }

    /// The same, where the centre's motion was asked for at this time.
    pub fn relative_with(
        &self,
        a: &Carried<usize>,
        b: &Carried<Option<usize>>,
        center: CenterMotion,
    ) -> Relative {
        let of_a = &self.bodies[a.number].1;
        match b.link {
            None => of_a.seen_at_rest(b.pose_in_carrier(), center),
            Some(_) => of_a.seen_from(&self.bodies[b.number].1, center),
        }
    }

    /// How A's centre moves as B sees it, where the motion of both is known.
    pub fn center(&mut self, a: &Carried<usize>, b: &Carried<Option<usize>>) -> CenterMotion {
        self.place(a.number, a.link, a);
        let Some(link) = b.link else {
            return self.bodies[a.number].1.center_seen_at_rest(&b.center());
        };
        self.place(b.number, link, b);
        let [a, b] = [a.number, b.number].map(|number| &self.bodies[number].1);
        a.center_seen_from(b)
    }

    /// How a body's centre moves as the origin of the world sees it, where the body's motion is known.
    pub fn center_in_world(&mut self, body: &Carried<usize>) -> CenterMotion {
        self.place(body.number, body.link, body);
        self.bodies[body.number]
            .1
            .center_seen_at_rest(&Vec3::zeros())
    }

    /// Bounds how far a body's points go in the world over an interval, of whose derivatives these bounds are known.
    ///
    /// A point moves on at the velocity that it has, and leaves this line by at most the square of time over 2 times the largest
    /// acceleration on the way: see [`super::moving_pair::MovingPair::over_interval`].
    pub fn shift(&mut self, body: &Carried<usize>, rates: &MotionRates, span: Span) -> f64 {
        self.place(body.number, body.link, body);
        let state = &self.bodies[body.number].1;
        let (reach, radius) = (span.reach(), body.body.radius());
        let turning = state.frame.angular.norm_squared() + state.frame.angular_acceleration.norm();
        let jerk = rates.turn[2] * radius + rates.origin[2];
        let acceleration = (state.acceleration.norm() + turning * radius + reach * jerk / 3.0)
            .min(rates.turn[1] * radius + rates.origin[1]);
        let velocity = state.velocity.norm() + state.frame.angular.norm() * radius;
        reach * (velocity + 0.5 * reach * acceleration) * SUM_SLACK
    }

    /// How A moves as B sees it where only poses are known: nothing seems to.
    pub fn still(&self, a: &Carried<usize>, b: &Carried<Option<usize>>) -> Relative {
        let pose = |link: Option<usize>, pose: &Pose| {
            let carrier = link.and_then(|link| Some(self.poses.as_ref()?[link]));
            carrier.map_or(*pose, |carrier| carrier.compose(pose))
        };
        let frame = MotionState::at_rest(pose(Some(a.link), a.pose_in_carrier()));
        let pose_of_b = &pose(b.link, b.pose_in_carrier());
        let state = BodyState::new(frame, a.body.center());
        let center = state.center_seen_at_rest(&pose_of_b.transform_point(b.body.center()));
        state.seen_at_rest(pose_of_b, center)
    }

    /// How all links move.
    pub fn motions(&self) -> &'a LinkMotions {
        self.motions
    }

    /// A link's pose, once poses are needed.
    pub fn pose_of_link(&self, link: usize) -> &Pose {
        self.poses
            .as_ref()
            .map_or(&Pose::IDENTITY, |poses| &poses[link])
    }

    /// Computes a body's state, unless that is done.
    fn place<L>(&mut self, number: usize, link: usize, carried: &Carried<L>) {
        if self.bodies.len() <= number {
            let none = BodyState::new(MotionState::REST, &Vec3::zeros());
            self.bodies.resize(number + 1, (0, none));
        }
        let (moment, body) = &mut self.bodies[number];
        if *moment != self.moment {
            let of_link = self.states.of(self.motions, link);
            let frame = carried.pose.map_or(*of_link, |pose| of_link.fixed(pose));
            *body = BodyState::new(frame, carried.body.center());
            *moment = self.moment;
        }
    }
}

impl BodyState {
    fn new(frame: MotionState, center: &Vec3) -> Self {
        let arm = turned(&frame.pose.rotation, center);
        Self {
            center: frame.pose.translation + arm,
            velocity: frame.velocity(&arm),
            acceleration: frame.acceleration(&arm),
            frame,
        }
    }

    /// As something sees it that rests in the world at a pose.
    fn seen_at_rest(&self, pose: &Pose, center: CenterMotion) -> Relative {
        Relative {
            poses: [self.frame.pose, *pose],
            center,
            angular: self.frame.angular,
            angular_acceleration: self.frame.angular_acceleration,
        }
    }

    /// The centre, as something sees it that rests and has its own centre there.
    fn center_seen_at_rest(&self, center: &Vec3) -> CenterMotion {
        CenterMotion {
            apart: self.center - center,
            velocity: self.velocity,
            acceleration: self.acceleration,
        }
    }

    fn center_seen_from(&self, other: &Self) -> CenterMotion {
        let b = &other.frame;
        let from_b = self.center - b.pose.translation;
        let velocity = self.velocity - b.velocity(&from_b);
        CenterMotion {
            apart: self.center - other.center,
            velocity,
            // B's frame turns, so the derivatives of components in it differ from those in the world.
            acceleration: self.acceleration
                - b.acceleration(&from_b)
                - 2.0 * b.angular.cross(&velocity),
        }
    }

    fn seen_from(&self, other: &Self, center: CenterMotion) -> Relative {
        let (a, b) = (&self.frame, &other.frame);
        let angular = a.angular - b.angular;
        Relative {
            poses: [a.pose, b.pose],
            center,
            angular,
            angular_acceleration: a.angular_acceleration
                - b.angular_acceleration
                - b.angular.cross(&angular),
        }
    }
}
