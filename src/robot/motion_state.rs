//! Where a frame is at one time of a motion, and how it moves.

use super::circular_arc::CircularArc;
use super::course::CourseState;
use crate::lanes::{Doubles, Instructions, Plain};
use crate::pose::{Pose, PoseColumns, Vec3, vector};
use crate::turn::Turn;

/// Where a frame is at one time, and how it moves in the world.
#[derive(Clone, Copy, Debug)]
pub struct MotionState {
    /// From the moving frame to the world.
    pub pose: Pose,
    /// The velocity of the moving frame's origin, a length per unit of time.
    pub linear: Vec3,
    /// The angular velocity, in radians per unit of time.
    pub angular: Vec3,
    /// The derivative of `linear`.
    pub linear_acceleration: Vec3,
    /// The derivative of `angular`.
    pub angular_acceleration: Vec3,
}

impl MotionState {
    /// What rests at the origin of the world.
    pub const REST: Self = Self {
        pose: Pose::IDENTITY,
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
        linear_acceleration: Vec3::new(0.0, 0.0, 0.0),
        angular_acceleration: Vec3::new(0.0, 0.0, 0.0),
    };

    /// What rests at a pose.
    pub fn at_rest(pose: Pose) -> Self {
        Self { pose, ..Self::REST }
    }

    /// The velocity of a point that moves with the frame, `arm` from its origin.
    #[inline]
    pub fn velocity(&self, arm: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(arm)
    }

    /// The acceleration of such a point.
    #[inline]
    pub fn acceleration(&self, arm: &Vec3) -> Vec3 {
        let swing = self.angular.cross(&self.angular.cross(arm));
        self.linear_acceleration + self.angular_acceleration.cross(arm) + swing
    }

    /// A frame that is fixed to this one.
    pub fn fixed(&self, pose: &Pose) -> Self {
        let mut frame = MotionColumns::of(Plain, self);
        frame.push_fixed(pose);
        frame.state()
    }
}

/// A motion state in registers: what was just stored would have to be waited for before the next joint. The fourth lanes mean nothing.
#[derive(Clone, Copy)]
pub(super) struct MotionColumns<I: Instructions> {
    pose: PoseColumns<I>,
    linear: Doubles<I>,
    angular: Doubles<I>,
    linear_acceleration: Doubles<I>,
    angular_acceleration: Doubles<I>,
}

impl<I: Instructions> MotionColumns<I> {
    #[inline(always)]
    pub fn of(lanes: I, state: &MotionState) -> Self {
        Self {
            pose: PoseColumns::of(lanes, &state.pose),
            linear: in_register(lanes, &state.linear),
            angular: in_register(lanes, &state.angular),
            linear_acceleration: in_register(lanes, &state.linear_acceleration),
            angular_acceleration: in_register(lanes, &state.angular_acceleration),
        }
    }

    #[inline(always)]
    pub fn state(&self) -> MotionState {
        MotionState {
            pose: self.pose.pose(),
            linear: vector(self.linear),
            angular: vector(self.angular),
            linear_acceleration: vector(self.linear_acceleration),
            angular_acceleration: vector(self.angular_acceleration),
        }
    }

    #[inline(always)]
    pub fn push_fixed(&mut self, pose: &Pose) {
        // Many joints stand where the one before them stands.
        if pose.translation != Vec3::zeros() {
            self.carry(self.pose.turned(&pose.translation));
        }
        self.pose = self.pose.turned_axes(&pose.rotation);
    }

    /// Puts the origin `arm` away, where it moves with the frame: see [`MotionState::velocity`] and [`MotionState::acceleration`].
    #[inline(always)]
    fn carry(&mut self, arm: Doubles<I>) {
        let velocity = cross(self.angular, arm);
        let swing = cross(self.angular, velocity);
        self.linear = self.linear + velocity;
        self.linear_acceleration =
            self.linear_acceleration + cross(self.angular_acceleration, arm) + swing;
        self.pose = self.pose.moved(arm);
    }

    #[inline(always)]
    pub fn turn(&mut self, axis: &Vec3, angle: &CourseState) {
        self.turn_by(axis, Turn::by(angle.value), angle.rate, angle.acceleration);
    }

    #[inline(always)]
    fn turn_by(&mut self, axis: &Vec3, turn: Turn, rate: f64, acceleration: f64) {
        let direction = self.pose.turned(axis);
        let angular = direction * rate;
        self.angular_acceleration =
            self.angular_acceleration + (cross(self.angular, angular) + direction * acceleration);
        self.angular = self.angular + angular;
        self.pose = self.pose.turned_by(axis, turn);
    }

    #[inline(always)]
    pub fn shift(&mut self, axis: &Vec3, length: &CourseState) {
        let direction = self.pose.turned(axis);
        self.carry(direction * length.value);
        self.slide(direction * length.rate, direction * length.acceleration);
    }

    /// Takes in a velocity and an acceleration of the origin within the frame.
    #[inline(always)]
    fn slide(&mut self, velocity: Doubles<I>, acceleration: Doubles<I>) {
        self.linear = self.linear + velocity;
        self.linear_acceleration =
            self.linear_acceleration + (cross(self.angular, velocity) * 2.0 + acceleration);
    }

    /// The origin's way is the integral of its velocity, `across` turned with the frame.
    #[inline(always)]
    pub fn turn_on_arc(&mut self, arc: &CircularArc, t: f64) {
        let CircularArc { axis, rate, across } = arc;
        let angle = rate * t;
        let turn = Turn::by(angle);
        let Turn { sine, cosine } = turn;
        let half = Turn::by(0.5 * angle).sine;
        let inwards = axis.cross(across);
        let way = (across * sine + inwards * (2.0 * half * half)) / *rate;
        let velocity = across * cosine + inwards * sine;
        let acceleration = (inwards * cosine - across * sine) * *rate;
        // Closures around these would be compiled without the processor's instructions.
        let (velocity, acceleration) =
            (self.pose.turned(&velocity), self.pose.turned(&acceleration));
        self.carry(self.pose.turned(&way));
        self.slide(velocity, acceleration);
        self.turn_by(axis, turn, *rate, 0.0);
    }
}

/// The cross product of the first three lanes.
#[inline(always)]
fn cross<I: Instructions>(a: Doubles<I>, b: Doubles<I>) -> Doubles<I> {
    (a * b.rolled() - a.rolled() * b).rolled()
}

#[inline(always)]
fn in_register<I: Instructions>(lanes: I, v: &Vec3) -> Doubles<I> {
    Doubles::four(lanes, &[v.x, v.y, v.z, 0.0])
}
