//! A link on a segment of C-space: while all velocities stay as they are, its pose is a chain of turns and shifts, each at a
//! constant rate about or along an axis that is fixed in the frame before it. So its velocity and acceleration are known at
//! any time, and bounds of its derivatives for the whole segment.

use smallvec::SmallVec;

use super::{JointKind, Link, Robot};
use crate::pose::{Pose, Vec3};

/// One step of a chain, at time t of the segment.
#[derive(Clone, Copy, Debug)]
enum Element {
    /// A pose that stays.
    Fixed(Pose),
    /// A turn by `start + rate t` radians about a unit axis.
    Turn { axis: Vec3, start: f64, rate: f64 },
    /// A shift by `start + rate t` along a unit axis.
    Shift { axis: Vec3, start: f64, rate: f64 },
}

/// The pose of one frame in another as a function of time, from 0 to 1.
#[derive(Clone, Debug, Default)]
pub struct MotionChain {
    elements: SmallVec<[Element; 24]>,
}

/// Where a frame is at one time, and how it moves, as the chain's first frame sees it.
#[derive(Clone, Copy, Debug)]
pub struct MotionState {
    /// From the moving frame to the first.
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

/// Bounds for the whole segment: the k-th derivative of a point's position is at most `origin[k - 1] + turn^k r`, for points no
/// farther than r from the moving frame's origin.
///
/// A vector of length d behind turns of rates w_1 to w_j has derivatives of at most (sum |w_i|)^k d, by the product rule; what
/// lies along the axis of turn j is not moved by it. The origin is the sum of such vectors.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotionRates {
    /// The sum of the rates of all turns, in radians per unit of time.
    pub turn: f64,
    /// The first three derivatives of the origin.
    pub origin: [f64; 3],
    /// The sum of the lengths of all that the origin's place is a sum of: what its rounding is relative to.
    pub size: f64,
    /// The largest angle of a turn, in radians: an angle is rounded relative to itself.
    pub angle: f64,
}

impl MotionState {
    const REST: Self = Self {
        pose: Pose {
            rotation: crate::pose::Mat3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
            translation: Vec3::new(0.0, 0.0, 0.0),
        },
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
        linear_acceleration: Vec3::new(0.0, 0.0, 0.0),
        angular_acceleration: Vec3::new(0.0, 0.0, 0.0),
    };

    /// The velocity of a point that moves with the frame, `arm` from its origin.
    pub fn velocity(&self, arm: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(arm)
    }

    /// The acceleration of such a point.
    pub fn acceleration(&self, arm: &Vec3) -> Vec3 {
        let swing = self.angular.cross(&self.angular.cross(arm));
        self.linear_acceleration + self.angular_acceleration.cross(arm) + swing
    }

    /// Puts the origin `arm` away, where it moves with the frame.
    fn carry(&mut self, arm: &Vec3) {
        (self.linear, self.linear_acceleration) = (self.velocity(arm), self.acceleration(arm));
        self.pose.translation += arm;
    }
}

impl MotionChain {
    /// Whether nothing moves.
    pub fn rests(&self) -> bool {
        self.elements.iter().all(|element| match element {
            Element::Fixed(_) => true,
            Element::Turn { rate, .. } | Element::Shift { rate, .. } => *rate == 0.0,
        })
    }

    /// Adds a frame that is fixed to the last one.
    pub fn push_fixed(&mut self, pose: Pose) {
        self.elements.push(Element::Fixed(pose));
    }

    fn push_turn(&mut self, axis: Vec3, start: f64, rate: f64) {
        self.elements.push(Element::Turn { axis, start, rate });
    }

    fn push_shift(&mut self, axis: Vec3, start: f64, rate: f64) {
        self.elements.push(Element::Shift { axis, start, rate });
    }

    /// Adds a shift from `start` on at a constant velocity.
    fn push_velocity(&mut self, start: Vec3, velocity: Vec3) {
        self.push_fixed(Pose::from_translation(start));
        let speed = velocity.norm();
        if speed > 0.0 {
            self.push_shift(velocity / speed, 0.0, speed);
        }
    }

    /// Adds what a twist makes of the last frame, linear and angular velocity in the frame that it moves: a screw.
    pub fn push_screw(&mut self, linear: &Vec3, angular: &Vec3) {
        let rate = angular.norm();
        if rate == 0.0 {
            self.push_velocity(Vec3::zeros(), *linear);
            return;
        }
        let axis = angular / rate;
        // The screw's axis passes through this point.
        let center = axis.cross(linear) / rate;
        self.push_fixed(Pose::from_translation(center));
        self.push_turn(axis, 0.0, rate);
        self.push_shift(axis, 0.0, axis.dot(linear));
        self.push_fixed(Pose::from_translation(-center));
    }

    /// The chain that leads the other way.
    pub fn inverse(&self) -> Self {
        let turned = self.elements.iter().rev().map(|element| match *element {
            Element::Fixed(pose) => Element::Fixed(pose.inverse()),
            Element::Turn { axis, start, rate } => Element::Turn {
                axis,
                start: -start,
                rate: -rate,
            },
            Element::Shift { axis, start, rate } => Element::Shift {
                axis,
                start: -start,
                rate: -rate,
            },
        });
        Self {
            elements: turned.collect(),
        }
    }

    /// This chain, and then another one that begins in its last frame.
    pub fn followed_by(mut self, other: &Self) -> Self {
        self.elements.extend_from_slice(&other.elements);
        self
    }

    /// Where the last frame is at time t, and how it moves.
    pub fn at(&self, t: f64) -> MotionState {
        let mut state = MotionState::REST;
        for element in &self.elements {
            match element {
                Element::Fixed(pose) => {
                    let arm = state.pose.rotation * pose.translation;
                    state.carry(&arm);
                    state.pose.rotation *= pose.rotation;
                }
                Element::Turn { axis, start, rate } => {
                    let turn = state.pose.rotation * axis * *rate;
                    state.angular_acceleration += state.angular.cross(&turn);
                    state.angular += turn;
                    state.pose = state.pose.turned_about(axis, start + rate * t);
                }
                Element::Shift { axis, start, rate } => {
                    let along = state.pose.rotation * axis;
                    state.carry(&(along * (start + rate * t)));
                    let velocity = along * *rate;
                    state.linear += velocity;
                    state.linear_acceleration += 2.0 * state.angular.cross(&velocity);
                }
            }
        }
        state
    }

    /// Bounds for the whole segment.
    pub fn rates(&self) -> MotionRates {
        let mut rates = MotionRates::default();
        // The axis of the last turn, in the last frame, and the rates of all before it.
        let mut last: Option<(Vec3, f64)> = None;
        for element in &self.elements {
            match element {
                Element::Fixed(pose) => {
                    rates.carry(&pose.translation, 0.0, last);
                    last = last.map(|(axis, before)| (pose.rotation.tr_mul(&axis), before));
                }
                Element::Turn { axis, start, rate } => {
                    last = Some((*axis, rates.turn));
                    rates.turn += rate.abs();
                    rates.angle = rates.angle.max(start.abs() + rate.abs());
                }
                Element::Shift { axis, start, rate } => {
                    let farthest = start.abs().max((start + rate).abs());
                    rates.carry(&(axis * farthest), rate.abs(), last);
                }
            }
        }
        rates
    }
}

impl MotionRates {
    /// The same with the origin `arm` away, which grows by `rate` on the way; `last` is the last turn's axis and the rates before
    /// it.
    fn carry(&mut self, arm: &Vec3, rate: f64, last: Option<(Vec3, f64)>) {
        let length = arm.norm();
        self.size += length;
        let (along, before) = match last {
            Some((axis, before)) => (axis.dot(arm).abs().min(length), before),
            None => (0.0, self.turn),
        };
        let across = match last {
            Some((axis, _)) => axis.cross(arm).norm().min(length),
            None => length,
        };
        // Of a shift's rate the same parts; where the length is 0, so is the rate.
        let parts = [along, across].map(|part| if length > 0.0 { part / length } else { 1.0 });
        for (k, origin) in self.origin.iter_mut().enumerate() {
            let order = k as i32 + 1;
            let of = |turn: f64, length: f64, rate: f64| {
                turn.powi(order) * length + f64::from(order) * turn.powi(order - 1) * rate
            };
            *origin += of(before, along, rate * parts[0]) + of(self.turn, across, rate * parts[1]);
        }
    }
}

impl Link {
    /// Adds what the link's joint does while its coordinates start at q and go with velocities v, those of the whole robot.
    /// `false` for custom joints that move, of which no more than a speed is known.
    fn push_motion(&self, chain: &mut MotionChain, q: &[f64], v: &[f64]) -> bool {
        let joint = &self.joint;
        let own_q = &q[joint.coordinate..joint.coordinate + joint.kind.nq()];
        let own_v = &v[joint.velocity..joint.velocity + joint.kind.nv()];
        let vector = |from: &[f64], at: usize| Vec3::new(from[at], from[at + 1], from[at + 2]);
        chain.push_fixed(self.at);
        match &joint.kind {
            JointKind::Fixed => {}
            JointKind::Revolute => {
                let rate = joint.multiplier * own_v[0];
                chain.push_turn(joint.axis, joint.position(q), rate);
            }
            JointKind::Prismatic => {
                let rate = joint.multiplier * own_v[0];
                chain.push_shift(joint.axis, joint.position(q), rate);
            }
            JointKind::Planar => {
                let [start, velocity] = [own_q, own_v].map(|x| Vec3::new(x[0], x[1], 0.0));
                chain.push_velocity(start, velocity);
                chain.push_turn(Vec3::z(), own_q[2], own_v[2]);
            }
            JointKind::FreeEuler => {
                chain.push_velocity(vector(own_q, 0), vector(own_v, 0));
                for (axis, k) in [(Vec3::y(), 3), (Vec3::z(), 4), (Vec3::x(), 5)] {
                    chain.push_turn(axis, own_q[k], own_v[k]);
                }
            }
            JointKind::Spherical | JointKind::Free => {
                let Ok(start) = joint.motion(q) else {
                    return false;
                };
                chain.push_fixed(start);
                let still = Vec3::zeros();
                match joint.kind {
                    JointKind::Free => chain.push_screw(&vector(own_v, 0), &vector(own_v, 3)),
                    _ => chain.push_screw(&still, &vector(own_v, 0)),
                }
            }
            JointKind::Custom(_) => {
                let Ok(start) = joint.motion(q) else {
                    return false;
                };
                if own_v.iter().any(|rate| *rate != 0.0) {
                    return false;
                }
                chain.push_fixed(start);
            }
        }
        true
    }
}

impl Robot {
    /// The motion of a link, as the world or a link that carries it sees it, while the robot goes from q with constant velocity v
    /// for a unit of time. `None` where a custom joint in between moves.
    pub fn motion_chain(
        &self,
        frame: Option<usize>,
        link: usize,
        q: &[f64],
        v: &[f64],
    ) -> Option<MotionChain> {
        let mut path: SmallVec<[usize; 16]> = SmallVec::new();
        let mut next = Some(link);
        while let Some(index) = next.filter(|_| next != frame) {
            path.push(index);
            next = self.links()[index].parent;
        }
        let mut chain = MotionChain::default();
        let is_known = |index: &usize| self.links()[*index].push_motion(&mut chain, q, v);
        path.iter().rev().all(is_known).then_some(chain)
    }
}
