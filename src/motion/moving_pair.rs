//! Two bodies, one of which moves as the other sees it, and what is known of them over an interval of the motion.

use crate::body::Body;
use crate::convex::Sweep;
use crate::hierarchy::packed::power_of_two;
use crate::lanes::each3;
use crate::pair::{Motion32, Pairing, ROUNDING, SweptLimits, Twist32};
use crate::pose::Pose;
use crate::robot::{MotionChain, MotionRates};
use crate::tolerance::EPSILON;

/// The rounding of kinematics, relative to the lengths that it adds up times 1 and the largest angle, whose own rounding turns
/// them: some operations a joint, of some tens of joints.
const KINEMATICS_ERROR: f64 = 256.0 * EPSILON;

/// A body pair on a motion, from t = 0 to 1.
pub(super) struct MovingPair<'a> {
    pub a: &'a Body,
    pub b: &'a Body,
    /// A's frame in B's.
    pub chain: MotionChain,
    /// Those of A's centre.
    rates: MotionRates,
    /// The two count as meeting up to this distance: the threshold with the margin of the pair's set.
    pub threshold: f64,
}

/// A pair over an interval.
pub(super) struct OverInterval<'a> {
    pub pairing: Pairing<'a>,
    /// Into A's frame, and into B's.
    pub motions: [Motion32; 2],
    /// In A's frame, and in B's.
    pub twists: [Twist32; 2],
    /// As [`Sweep::bends`], in units of the pair.
    pub bends: [f32; 2],
    pub sweep: Sweep,
    pub limits: SweptLimits,
    /// Boxes with a larger gap do not meet, in units of the pair.
    pub cutoff: f32,
}

impl<'a> MovingPair<'a> {
    pub fn new(a: &'a Body, b: &'a Body, chain: MotionChain, threshold: f64) -> Self {
        let mut to_center = chain.clone();
        to_center.push_fixed(Pose::from_translation(*a.center()));
        Self {
            a,
            b,
            rates: to_center.rates(),
            chain,
            threshold,
        }
    }

    /// The pair over an interval of given middle and half length.
    ///
    /// Let R be A's radius, h the half length, and w, v, alpha, a the angular velocity of A and the velocity of its centre at the
    /// middle with their derivatives; S and P_k the bounds of [`MotionRates`]. A's points leave the straight lines that their
    /// velocities at the middle make by at most h^2 / 2 times the largest acceleration, which is at most S^2 R + P_2, and at
    /// most |a| + (|alpha| + |w|^2) R + h J / 3 with the third derivative J <= S^3 R + P_3. Seen from A, only points of B count
    /// that come within the threshold of A at some time; these are never farther than rho = R + threshold + h |centre's velocity|
    /// from A's centre meanwhile, and by the product rule accelerate by at most S^2 rho + 2 S P_1 + P_2, or
    /// |a - 2 w x v| + (|alpha| + |w|^2) rho + h J' / 3 with J' <= S^3 rho + 3 S^2 P_1 + 3 S P_2 + P_3.
    pub fn over(&self, middle: f64, half: f64) -> OverInterval<'a> {
        let state = self.chain.at(middle);
        let pairing = Pairing::new(self.a, &state.pose, self.b, &Pose::identity());
        let arm = state.pose.rotation * self.a.center();
        let (v, a) = (state.velocity(&arm), state.acceleration(&arm));
        let (w, alpha) = (state.angular, state.angular_acceleration);
        let MotionRates {
            turn: s,
            origin: [p1, p2, p3],
            size: length,
            angle,
        } = self.rates;
        let radius = self.a.radius();
        let rho = radius + self.threshold + half * p1.min(v.norm() + half * p2);
        let turning = alpha.norm() + w.norm_squared();
        let (square, cube) = (s * s, s * s * s);
        let jerk_of_a = cube * radius + p3;
        let jerk_of_b = cube * rho + 3.0 * square * p1 + 3.0 * s * p2 + p3;
        let of_a = a.norm() + turning * radius + half * jerk_of_a / 3.0;
        let of_b = (a - 2.0 * w.cross(&v)).norm() + turning * rho + half * jerk_of_b / 3.0;
        let accelerations = [
            of_b.min(square * rho + 2.0 * s * p1 + p2),
            of_a.min(square * radius + p2),
        ];
        // More than the rounding of these sums.
        let bends = accelerations.map(|x| 0.5 * half * half * x * (1.0 + 1e-9));

        let size = pairing.precision.size;
        let scale = power_of_two(size);
        let inverse = 1.0 / scale;
        let [tree_a, tree_b] = [self.a.packed(), self.b.packed()];
        let relative = &pairing.relative;
        let in_a = [v, w].map(|x| state.pose.rotation.tr_mul(&x) * half);
        let [linear, angular] = in_a;
        let in_b = [
            relative
                .rotation
                .tr_mul(&(linear + angular.cross(&relative.translation))),
            relative.rotation.tr_mul(&angular),
        ];
        let twist = |[linear, angular]: [crate::pose::Vec3; 2]| Twist32 {
            angular: each3(|k| angular[k] as f32),
            linear: each3(|k| (linear[k] * inverse) as f32),
        };
        // Velocities times half the interval are lengths like others: what they are rounded to, gaps lose too.
        let moved = linear.norm() + angular.norm() * size;
        let larger = 1.0 + moved / size;
        let kinematics = KINEMATICS_ERROR * (length + radius) * (1.0 + angle);
        let slack = (pairing.slack() + kinematics) * larger;
        let cores = tree_a.core_radius() + tree_b.core_radius();
        let lowered = slack + ROUNDING * (size + moved) + cores;
        OverInterval {
            motions: [
                Motion32::new(relative, tree_b.scale(), scale),
                Motion32::new(&relative.inverse(), tree_a.scale(), scale),
            ],
            twists: [twist(in_a), twist(in_b)],
            bends: bends.map(|x| ((x * inverse) as f32).next_up() * 1.001),
            cutoff: (((self.threshold + lowered) * inverse) as f32).next_up(),
            limits: SweptLimits {
                threshold: self.threshold,
                slack,
                displacement: linear.norm() + angular.norm() * radius + bends[1],
            },
            sweep: Sweep {
                linear,
                angular,
                bends,
            },
            pairing,
        }
    }
}
