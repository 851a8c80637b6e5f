//! Where a frame is at one time of a motion, and how it moves.

use super::circular_arc::CircularArc;
use super::course::CourseState;
use crate::pose::{Pose, Vec3, turned, turned_axes};

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
    #[inline]
    pub fn fixed(mut self, pose: &Pose) -> Self {
        self.push_fixed(pose);
        self
    }

    pub(super) fn push_fixed(&mut self, pose: &Pose) {
        // Many joints stand where the one before them stands.
        if pose.translation != Vec3::zeros() {
            let arm = turned(&self.pose.rotation, &pose.translation);
            self.carry(&arm);
        }
        self.pose.rotation = turned_axes(&self.pose.rotation, &pose.rotation);
    }

    /// Puts the origin `arm` away, where it moves with the frame.
    #[inline]
    fn carry(&mut self, arm: &Vec3) {
        (self.linear, self.linear_acceleration) = (self.velocity(arm), self.acceleration(arm));
        self.pose.translation += arm;
    }

    pub(super) fn turn(&mut self, axis: &Vec3, angle: &CourseState) {
        let direction = turned(&self.pose.rotation, axis);
        let turn = direction * angle.rate;
        self.angular_acceleration += self.angular.cross(&turn) + direction * angle.acceleration;
        self.angular += turn;
        self.pose = self.pose.turned_about(axis, angle.value);
    }

    pub(super) fn shift(&mut self, axis: &Vec3, length: &CourseState) {
        let direction = turned(&self.pose.rotation, axis);
        self.carry(&(direction * length.value));
        let velocity = direction * length.rate;
        self.linear += velocity;
        self.linear_acceleration +=
            2.0 * self.angular.cross(&velocity) + direction * length.acceleration;
    }

    /// The origin's way is the integral of its velocity, `across` turned with the frame.
    pub(super) fn turn_on_arc(&mut self, arc: &CircularArc, t: f64) {
        let CircularArc { axis, rate, across } = arc;
        let angle = rate * t;
        let (sin, cos) = angle.sin_cos();
        let half = (0.5 * angle).sin();
        let inwards = axis.cross(across);
        let in_world = |v: Vec3| turned(&self.pose.rotation, &v);
        let way = in_world((across * sin + inwards * (2.0 * half * half)) / *rate);
        let velocity = in_world(across * cos + inwards * sin);
        let acceleration = in_world((inwards * cos - across * sin) * *rate);
        self.carry(&way);
        self.linear += velocity;
        self.linear_acceleration += 2.0 * self.angular.cross(&velocity) + acceleration;
        self.turn(
            axis,
            &CourseState {
                value: angle,
                rate: *rate,
                acceleration: 0.0,
            },
        );
    }
}
