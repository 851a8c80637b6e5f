//! Bounds of how fast links move on a motion.

use super::course::{CourseBounds, curve_rounding};
use crate::pose::{Pose, Vec3, turned_back};
use crate::tolerance::{DISTANCE_ERROR, EPSILON};

/// Bounds for a whole motion: the k-th derivative of a point's position is at most `origin[k - 1] + turn[k - 1] r`, for points no
/// farther than r from the moving frame's origin.
///
/// A vector of length d behind turns about axes of the frames before them has a k-th derivative of at most `turn[k - 1] d`, by the
/// product rule; what lies along the axis of a turn is not moved by it. The origin's place is the sum of such vectors.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotionRates {
    /// Of what turns: 1, 2 and 3 derivatives of a unit vector.
    pub turn: [f64; 3],
    /// The first three derivatives of the origin.
    pub origin: [f64; 3],
    /// What the rounding of places and velocities comes from.
    pub rounding: ChainRounding,
}

/// What the rounding of places along a chain comes from.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChainRounding {
    /// The number of its elements.
    pub elements: u32,
    /// The sum of the lengths of all that a place is a sum of.
    pub size: f64,
    /// The largest angle of a turn, in radians: an angle is rounded relative to itself.
    pub angle: f64,
    /// The sum over all turns of the bounds of their speeds.
    pub turning: f64,
    /// The highest degree of the curves along which it turns and shifts, or 0.
    pub degree: u32,
}

impl ChainRounding {
    /// Takes in another chain that a pose is computed along.
    pub fn take_in(&mut self, other: &Self) {
        self.elements += other.elements;
        self.size += other.size;
        self.angle = self.angle.max(other.angle);
        self.turning += other.turning;
        self.degree = self.degree.max(other.degree);
    }

    /// Takes in a pose that stays, whose origin is so far off.
    #[inline(always)]
    pub(super) fn take_in_arm(&mut self, length: f64) {
        self.elements += 1;
        self.size += length;
    }

    /// Takes in a turn by an angle within bounds.
    #[inline(always)]
    pub(super) fn take_in_turn(&mut self, angle: &CourseBounds) {
        self.take_in_course(angle);
        self.angle = self.angle.max(angle.summed);
        self.turning += angle.derivatives[0];
    }

    /// Takes in a shift along an axis of such a length, about 1, times a factor within bounds.
    #[inline(always)]
    pub(super) fn take_in_shift(&mut self, axis: f64, factor: &CourseBounds) {
        self.take_in_course(factor);
        self.size += axis * factor.summed;
    }

    fn take_in_course(&mut self, bounds: &CourseBounds) {
        self.elements += 1;
        self.degree = self.degree.max(bounds.degree);
    }

    /// What the rounding of a pose may move a point within `radius` of the frame's origin, and what that of velocities and accelerations
    /// may move it over a time `reach`.
    ///
    /// A pose is a product of the poses of n elements. A product of two matrices is off by at most 6 epsilon, as a matrix; a turn by an angle
    /// of at most a by 4 epsilon, and by 2 a epsilon as its angle is rounded; a sum of translations by 4 epsilon of its size. Each turns or
    /// moves all that comes after, so a point is off by at most n (10 + 2 a) epsilon times the sum s of all lengths. The relative pose of
    /// two bodies and their support points take 32 epsilon s more, what classes measure twice [`DISTANCE_ERROR`]. A velocity is a sum over the
    /// turns of their speeds times arms that are off by as much: over a time in which these turn by T together it adds T times that,
    /// and an acceleration T^2 times. Along curves angles and shifts are off by more: see [`curve_rounding`].
    pub fn of_places(&self, radius: f64, reach: f64) -> f64 {
        let turned = reach * self.turning;
        let elements = f64::from(self.elements);
        let mut relative = 32.0 + elements * (10.0 + 2.0 * self.angle);
        if self.degree > 0 {
            let on_curves = curve_rounding(f64::from(self.degree), reach);
            relative += (1.0 + elements * self.angle) * on_curves;
        }
        let relative = 2.0 * DISTANCE_ERROR + relative * EPSILON;
        let moved = relative * (self.size + radius) * (1.0 + turned * (1.0 + turned));
        // Of speeds that overflow nothing is known, and no comparison with what is no number may prune.
        if moved.is_nan() { f64::INFINITY } else { moved }
    }
}

/// The bounds along a chain of frames, up to one of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChainRates {
    /// Of the last frame as the first sees it.
    pub rates: MotionRates,
    /// The sums over all turns of the bounds of their angles' derivatives.
    angles: [f64; 3],
    last: Option<LastTurn>,
}

/// The last turn of a chain.
#[derive(Clone, Copy, Debug)]
struct LastTurn {
    /// Its axis, in the last frame.
    axis: Vec3,
    /// [`MotionRates::turn`] of the turns before it.
    before: [f64; 3],
}

/// A vector in the last frame of a chain.
///
/// The last turn moves only what of it is across its axis; the turns before move all of it. By the product rule, with T_k for the turns
/// before, U_k for the last one and V_k for all, V_k is the sum over i of (k over i) T_i U_(k-i): so the k-th derivative of an arm a, across
/// the axis c, is at most T_k a + (V_k - T_k) c.
struct Arm {
    length: f64,
    across: f64,
    /// [`MotionRates::turn`] of the turns that move all of it.
    before: [f64; 3],
}

impl Arm {
    #[inline(always)]
    fn new(arm: &Vec3, last: Option<&LastTurn>) -> Self {
        let length = arm.norm();
        match last {
            Some(LastTurn { axis, before }) => Self {
                length,
                across: axis.cross(arm).norm().min(length),
                before: *before,
            },
            None => Self {
                length,
                across: length,
                before: [0.0; 3],
            },
        }
    }

    /// A derivative of the arm, given what bounds that of a unit vector behind the turns before the last, and behind all.
    #[inline(always)]
    fn derivative(&self, before: f64, all: f64) -> f64 {
        let last = if before < f64::INFINITY {
            all - before
        } else {
            all
        };
        // Of what is not there no bound counts, not even an infinite one.
        let times = |bound: f64, part: f64| if part > 0.0 { bound * part } else { 0.0 };
        times(before, self.length) + times(last, self.across)
    }
}

impl MotionRates {
    /// Moves the origin along an arm of the last frame; returns its length.
    #[inline(always)]
    fn carry(&mut self, arm: &Vec3, last: Option<&LastTurn>) -> f64 {
        let arm = Arm::new(arm, last);
        for k in 0..3 {
            self.origin[k] += arm.derivative(arm.before[k], self.turn[k]);
        }
        arm.length
    }
}

impl ChainRates {
    /// Goes on to a frame that is fixed to the last one.
    pub fn push_fixed(&mut self, pose: &Pose) {
        let length = self.rates.carry(&pose.translation, self.last.as_ref());
        self.rates.rounding.take_in_arm(length);
        if let Some(last) = &mut self.last {
            last.axis = turned_back(&pose.rotation, &last.axis);
        }
    }

    /// The bounds at a point that is fixed to the last frame, instead of its origin.
    pub fn at(&self, point: &Vec3) -> MotionRates {
        let mut rates = self.rates;
        rates.rounding.size += rates.carry(point, self.last.as_ref());
        rates
    }

    /// Goes on behind a turn about a unit axis.
    pub(super) fn push_turn(&mut self, axis: &Vec3, bounds: &CourseBounds) {
        if bounds.derivatives == [0.0; 3] {
            // Where it always points is of no use: it may be turned away from the axis before it.
            self.last = None;
        } else {
            self.last = Some(LastTurn {
                axis: *axis,
                before: self.rates.turn,
            });
        }
        for (sum, bound) in self.angles.iter_mut().zip(bounds.derivatives) {
            *sum += bound;
        }
        let [s1, s2, s3] = self.angles;
        self.rates.turn = [s1, s1 * s1 + s2, s1 * s1 * s1 + 3.0 * s1 * s2 + s3];
        self.rates.rounding.take_in_turn(bounds);
    }

    /// Goes on behind a shift along a unit axis.
    pub(super) fn push_shift(&mut self, axis: &Vec3, bounds: &CourseBounds) {
        self.carry(axis, bounds);
    }

    /// Goes on behind a turn about a unit axis in which the frame's origin moves too, by a way with bounds of its own in whatever
    /// direction. What undoes the two is of the same kind and has the same bounds.
    pub(super) fn push_arc(&mut self, axis: &Vec3, way: &CourseBounds, angle: &CourseBounds) {
        self.last = None;
        // Where no axis is known the arm counts by its length alone, which is 1.
        self.carry(axis, way);
        self.push_turn(axis, angle);
    }

    /// Moves the origin along `axis`, times a factor within bounds.
    fn carry(&mut self, axis: &Vec3, factor: &CourseBounds) {
        let arm = Arm::new(axis, self.last.as_ref());
        let rates = &mut self.rates;
        rates.rounding.take_in_shift(arm.length, factor);
        let [before, all] = [arm.before, rates.turn].map(|turn| behind(turn, factor));
        for k in 0..3 {
            rates.origin[k] += arm.derivative(before[k], all[k]);
        }
    }
}

/// Bounds of the derivatives of a unit vector behind turns, times a factor within bounds.
fn behind([t1, t2, t3]: [f64; 3], factor: &CourseBounds) -> [f64; 3] {
    let length = factor.farthest;
    let [l1, l2, l3] = factor.derivatives;
    [
        t1 * length + l1,
        t2 * length + 2.0 * t1 * l1 + l2,
        t3 * length + 3.0 * t2 * l1 + 3.0 * t1 * l2 + l3,
    ]
}
