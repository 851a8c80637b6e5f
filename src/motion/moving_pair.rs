//! Two bodies, one of which moves as the other sees it, and what is known of them over an interval of the motion.

use super::balls::Balls;
use super::carried::Carried;
use super::kinematics::{CenterMotion, Kinematics, Relative};
use super::over_piece::{Moved, OneTwist, OverPiece, PairOver, TwistLists};
use super::pair_rates::PairRates;
use super::span::Span;
use crate::body::Body;
use crate::convex::Extension;
use crate::hierarchy::packed::power_of_two_above;
use crate::pair::{
    Motion32, Pairing, PrimitiveScratch, ROUNDING, SingleUnits, SweptLimits, sum_factor,
};
use crate::pose::{Displacement, Pose};
use crate::robot::{ChainRounding, LinkMotions, MotionRates};
use crate::tolerance::SUM_SLACK;

/// A body pair on a motion, from t = 0 to 1.
pub(super) struct MovingPair<'a> {
    a: Carried<'a, usize>,
    b: Carried<'a, Option<usize>>,
    bounds: RelativeRates,
    /// The two count as meeting up to this distance: the threshold with the margin of the pair's set and the deviations that
    /// the bodies state.
    pub threshold: f64,
    /// The leaf of the set tree that the pair belongs to.
    pub leaf: u32,
    /// Intervals before this time need no proof.
    pub followed_from: f64,
}

/// What is known of a pair's relative motion.
#[derive(Clone, Copy, Debug)]
enum RelativeRates {
    /// The derivatives of A's centre as B sees it.
    Derivatives(MotionRates),
    /// No velocities are known.
    Speed {
        /// No point of A moves faster than this as B sees it.
        speed: f64,
        /// What the rounding of coordinates may move it.
        rounding: f64,
        /// What the rounding of places comes from, but for the joints whose motion is not known.
        chain: ChainRounding,
    },
}

/// Intervals through which bodies may turn by more than this, in radians to either side, are halved before boxes are looked at.
pub(super) const MAX_TURN: f64 = 1.0;

impl<'a> MovingPair<'a> {
    /// `threshold` comes with the margin of the pair's set. `speed` gives the largest speed of A's points as B sees it where the
    /// derivatives are unknown, and how far the rounding of coordinates moves them; the pair is `None` where these are infinite.
    pub fn new(
        a: Carried<'a, usize>,
        b: Carried<'a, Option<usize>>,
        threshold: f64,
        leaf: u32,
        rates: &mut PairRates,
        speed: impl FnOnce() -> [f64; 2],
    ) -> Option<Self> {
        let bounds = match rates.between(&a, &b) {
            Some(rates) => RelativeRates::Derivatives(rates),
            None => {
                let [speed, rounding] = speed();
                if !(speed + rounding).is_finite() {
                    return None;
                }
                RelativeRates::Speed {
                    speed,
                    rounding,
                    chain: rates.rounding_of_known_joints(&a, &b),
                }
            }
        };
        let stated_deviation = a.body.stated_deviation() + b.body.stated_deviation();
        Some(Self {
            a,
            b,
            bounds,
            threshold: threshold + stated_deviation,
            leaf,
            followed_from: 0.0,
        })
    }

    /// Whether the convex hulls of the bodies stay apart through a piece, and so all that these are made of. `direction`, from B to A in
    /// B's frame or zero, is tried first; it becomes one that parts them where they are compared, or zero where none was found.
    pub fn hulls_stay_apart<L: TwistLists>(
        &self,
        moved: Moved<L>,
        direction: &mut [f32; 3],
        scratch: &mut PrimitiveScratch,
    ) -> bool {
        let [Some((a, outside_a)), Some((b, outside_b))] = self.bodies().map(Body::hull) else {
            *direction = [0.0; 3];
            return false;
        };
        let moved = moved.seen_from(&(a.center() - self.a.body.center()));
        let mut over = self.placed_as([a, b], moved);
        let Some(places) = over.pairing.only_places() else {
            *direction = [0.0; 3];
            return false;
        };
        let deviation: f64 = self.bodies().map(Body::deviation).iter().sum();
        over.limits.slack += 2.0 * (outside_a + outside_b + deviation);
        let (sweep, limits) = (over.sweep(), &over.limits);
        over.pairing
            .parted_by_one(places, direction, &sweep, limits, scratch)
    }

    pub fn carried(&self) -> (&Carried<'a, usize>, &Carried<'a, Option<usize>>) {
        (&self.a, &self.b)
    }

    pub fn bodies(&self) -> [&'a Body; 2] {
        [self.a.body, self.b.body]
    }

    /// Whether one of the bodies is a solid, so that the other could be inside.
    pub fn has_solid(&self) -> bool {
        self.bodies().iter().any(|body| body.solid().is_some())
    }

    /// Whether neither moves as the other sees it.
    pub fn rests(&self) -> bool {
        match &self.bounds {
            RelativeRates::Derivatives(rates) => rates.turn[0] == 0.0 && rates.origin[0] == 0.0,
            RelativeRates::Speed { speed, .. } => *speed == 0.0,
        }
    }

    /// Bounds the speed of A's points as B sees it, and so of the distance.
    pub fn speed(&self) -> f64 {
        match &self.bounds {
            RelativeRates::Derivatives(rates) => {
                rates.turn[0] * self.a.body.radius() + rates.origin[0]
            }
            RelativeRates::Speed { speed, .. } => *speed,
        }
    }

    /// What rounding may take off the gap of the two on the whole way, but for that of joints whose motion is not known.
    pub fn rounding_all_the_while(&self) -> f64 {
        let radius = self.a.body.radius();
        match &self.bounds {
            RelativeRates::Derivatives(rates) => rates.rounding.of_places(radius, 1.0),
            RelativeRates::Speed {
                rounding, chain, ..
            } => rounding + chain.of_places(radius, 0.0),
        }
    }

    /// Where B rests in the world, unless a link carries it.
    pub fn pose_of_b(&self) -> &'a Pose {
        self.b.pose_in_carrier()
    }

    /// Whether both pairs are of the same body A, with Bs that rest in the world.
    pub fn is_in_crowd_of(&self, other: &Self) -> bool {
        let key = |pair: &Self| (pair.a.number, pair.leaf);
        let is_one_of_many = |pair: &Self| {
            pair.b.link.is_none() && matches!(pair.bounds, RelativeRates::Derivatives(_))
        };
        key(self) == key(other)
            && self.threshold == other.threshold
            && is_one_of_many(self)
            && is_one_of_many(other)
    }

    /// The link that carries A.
    pub fn link(&self) -> usize {
        self.a.link
    }

    pub fn needs_poses(&self) -> bool {
        matches!(self.bounds, RelativeRates::Speed { .. })
    }

    /// The pair over an interval.
    ///
    /// Let R be A's radius, h the span's reach, and w, v, alpha, a the angular velocity of A and the velocity of its centre at the
    /// kinematics' time with their derivatives; T_k and P_k the bounds of [`MotionRates`] for a turned unit vector and for A's centre.
    /// A's points leave the straight lines that their velocities at that time make by at most h^2 / 2 times the largest
    /// acceleration, which is at most T_2 R + P_2, and at most |a| + (|alpha| + |w|^2) R + h J / 3 with the third derivative
    /// J <= T_3 R + P_3. Seen from A, only points of B count that come within the threshold of A at some time; these are never
    /// farther than rho = R + threshold + h |centre's velocity| from A's centre meanwhile, and by the product rule accelerate by
    /// at most T_2 rho + 2 T_1 P_1 + P_2, or |a - 2 w x v| + (|alpha| + |w|^2) rho + h J' / 3 with
    /// J' <= T_3 rho + 3 T_2 P_1 + 3 T_1 P_2 + P_3.
    pub fn over_interval(
        &self,
        kinematics: &mut Kinematics,
        span: Span,
    ) -> PairOver<OverPiece<'a, OneTwist>> {
        let reach = span.reach();
        let (relative, rates, error) = match self.bounds {
            // Most pairs are done with here: of them no more is computed than how the centres move.
            RelativeRates::Derivatives(rates) => {
                let center = kinematics.center(&self.a, &self.b);
                let [_, p2, p3] = rates.origin;
                let error = self.kinematics_error(&rates, reach);
                if self.balls().stay_apart_over(&center, [p2, p3], span, error) {
                    return PairOver::Apart;
                }
                if reach * rates.turn[0] > MAX_TURN {
                    return PairOver::TooLong;
                }
                let relative = kinematics.relative_with(&self.a, &self.b, center);
                (relative, rates, error)
            }
            RelativeRates::Speed { speed, .. } => {
                let (relative, rates) = self.relative(kinematics);
                let error = self.kinematics_error(&rates, reach);
                let apart = &relative.center.apart;
                if self.balls().stay_apart(apart, |_, _| reach * speed, error) {
                    return PairOver::Apart;
                }
                (relative, rates, error)
            }
        };
        let moved = self.moved_over_interval(&relative, &rates, span, error);
        // Nothing is farther than what overflows.
        if moved.bends.iter().any(|bend| !bend.is_finite()) {
            return PairOver::TooLong;
        }
        PairOver::Near(self.placed(moved))
    }

    /// How A moves over an interval.
    pub fn moved(&self, kinematics: &mut Kinematics, span: Span) -> Moved<OneTwist> {
        let (relative, rates) = self.relative(kinematics);
        let error = self.kinematics_error(&rates, span.reach());
        self.moved_over_interval(&relative, &rates, span, error)
    }

    fn moved_over_interval(
        &self,
        relative: &Relative,
        rates: &MotionRates,
        span: Span,
        kinematics_error: f64,
    ) -> Moved<OneTwist> {
        let (time, extension) = match span {
            Span::Around(half) => (half, Extension::BothWays),
            Span::Before(length) => (-length, Extension::OneWay),
        };
        Moved {
            poses: relative.poses,
            displacements: [Displacement {
                linear: relative.center.velocity * time,
                angular: relative.angular * time,
            }],
            extension,
            bends: self.bends(relative, rates, span.reach()),
            kinematics_error,
        }
    }

    /// The pair in one frame, with all that boxes and primitives are compared by.
    #[inline]
    pub fn placed<L: TwistLists>(&self, moved: Moved<L>) -> OverPiece<'a, L> {
        self.placed_as(self.bodies(), moved)
    }

    /// The same for bodies that stand for the two; `moved` is of the centre of the first.
    #[inline]
    fn placed_as<'b, L: TwistLists>(
        &self,
        [a, b]: [&'b Body; 2],
        moved: Moved<L>,
    ) -> OverPiece<'b, L> {
        let radius = a.radius();
        let [pose_a, pose_b] = &moved.poses;
        let bends = moved.bends;
        let pairing = Pairing::new(a, pose_a, b, pose_b);
        let size = pairing.precision.size;
        let scale = power_of_two_above(size);
        let units = SingleUnits {
            inverse: 1.0 / scale,
        };
        let [tree_a, tree_b] = [a.packed(), b.packed()];
        let to_b = &pairing.relative;
        let displacements = L::map(&moved.displacements, |by| by.turned_back(&pose_a.rotation));
        // As A sees it, B moves the other way: what one box makes of its own motion has to be the motion of that box.
        let in_a = L::map(&displacements, |by| units.twist(&-by.linear, &-by.angular));
        let in_b = L::map(&displacements, |by| {
            let in_b = by.told_of(&to_b.translation).turned_back(&to_b.rotation);
            units.twist(&in_b.linear, &in_b.angular)
        });
        // Displacements are lengths like others: what they are rounded to, gaps lose too.
        let (mut moved_at_size, mut displacement, mut turn) = (0.0, bends[1], 0.0);
        for by in displacements.as_ref() {
            let (linear, angular) = (by.linear.norm(), by.angular.norm());
            moved_at_size += linear + angular * size;
            displacement += linear + angular * radius;
            turn += angular;
        }
        // Boxes hold the cores of B, the ball around a point of which grows to first order as A sees it: along a unit direction n it
        // reaches |n + n x w| times its radius, at most the square root of 1 + |w|^2 times. The core itself is too far away for the
        // bend, which holds of the points near A.
        let growth = turn * turn / (1.0 + turn.hypot(1.0)) * SUM_SLACK;
        let box_bends = [bends[0] + growth * tree_b.core_radius(), bends[1]];
        moved_at_size *= sum_factor(displacements.as_ref().len());
        let larger = 1.0 + moved_at_size / size;
        let slack = (pairing.slack() + moved.kinematics_error) * larger;
        let cores = tree_a.core_radius() + tree_b.core_radius();
        let lowered = slack + ROUNDING * (size + moved_at_size) + cores;
        let gap_above = |gap: f64| units.above(gap + lowered);
        OverPiece {
            motions: [
                Motion32::new(to_b, tree_b.scale(), scale),
                Motion32::new(&to_b.inverse(), tree_a.scale(), scale),
            ],
            twists: [in_a, in_b],
            bends: units.bends(box_bends),
            cutoff: gap_above(self.threshold),
            within: gap_above((self.threshold - displacement).max(0.0)),
            limits: SweptLimits {
                threshold: self.threshold,
                slack,
                displacement,
            },
            core_radii: [tree_a, tree_b].map(|tree| (tree.core_radius() * units.inverse) as f32),
            displacements,
            extension: moved.extension,
            sweep_bends: bends,
            pairing,
        }
    }

    /// The pair at the kinematics' time.
    pub fn pairing(&self, kinematics: &mut Kinematics) -> Pairing<'a> {
        let (relative, _) = self.relative(kinematics);
        let ([a, b], [pose_a, pose_b]) = (self.bodies(), &relative.poses);
        Pairing::new(a, pose_a, b, pose_b)
    }

    /// What rounding may take off the gap of the two in a time `reach` from where they are compared.
    pub fn kinematics_error(&self, rates: &MotionRates, reach: f64) -> f64 {
        let of_coordinates = match self.bounds {
            RelativeRates::Derivatives(_) => 0.0,
            RelativeRates::Speed { rounding, .. } => rounding,
        };
        rates.rounding.of_places(self.a.body.radius(), reach) + of_coordinates
    }

    /// The rates of a pair of whose motion no more than a speed is known: none, and what rounding comes from at these poses of links.
    pub fn rates_at<'p>(
        &self,
        motions: &LinkMotions,
        pose: impl Fn(usize) -> &'p Pose + Copy,
    ) -> MotionRates {
        let mut rates = MotionRates::default();
        if let RelativeRates::Speed { chain, .. } = &self.bounds {
            rates.rounding = *chain;
            for link in std::iter::once(self.a.link).chain(self.b.link) {
                rates.rounding.size += motions.lengths_of_unknown_joints(link, pose);
            }
        }
        rates
    }

    /// As [`Sweep::bends`], with more than the rounding of their sums.
    fn bends(&self, relative: &Relative, rates: &MotionRates, reach: f64) -> [f64; 2] {
        match self.bounds {
            RelativeRates::Derivatives(_) => self
                .accelerations(relative, rates, reach)
                .map(|x| 0.5 * reach * reach * x * SUM_SLACK),
            RelativeRates::Speed { speed, .. } => [reach * speed * SUM_SLACK; 2],
        }
    }

    /// How A moves as B sees it at the kinematics' time, with the bounds of derivatives that are known.
    fn relative(&self, kinematics: &mut Kinematics) -> (Relative, MotionRates) {
        match self.bounds {
            RelativeRates::Derivatives(rates) => (kinematics.relative(&self.a, &self.b), rates),
            RelativeRates::Speed { .. } => {
                let relative = kinematics.still(&self.a, &self.b);
                let pose = |link: usize| kinematics.pose_of_link(link);
                (relative, self.rates_at(kinematics.motions(), pose))
            }
        }
    }

    pub fn balls(&self) -> Balls<'a> {
        Balls {
            bodies: self.bodies(),
            threshold: self.threshold,
        }
    }

    /// Bounds of the accelerations through an interval: of B's points as A sees them, and of A's as B sees them.
    fn accelerations(&self, relative: &Relative, rates: &MotionRates, reach: f64) -> [f64; 2] {
        let Relative {
            center:
                CenterMotion {
                    velocity: v,
                    acceleration: a,
                    ..
                },
            angular: w,
            ..
        } = relative;
        let MotionRates {
            turn: [t1, t2, t3],
            origin: [p1, p2, p3],
            ..
        } = *rates;
        let radius = self.a.body.radius();
        let rho = radius + self.threshold + reach * p1.min(v.norm() + reach * p2);
        let turning = relative.angular_acceleration.norm() + w.norm_squared();
        let jerk_of_a = t3 * radius + p3;
        let jerk_of_b = t3 * rho + 3.0 * t2 * p1 + 3.0 * t1 * p2 + p3;
        let of_a = a.norm() + turning * radius + reach * jerk_of_a / 3.0;
        let of_b = (a - 2.0 * w.cross(v)).norm() + turning * rho + reach * jerk_of_b / 3.0;
        [
            of_b.min(t2 * rho + 2.0 * t1 * p1 + p2),
            of_a.min(t2 * radius + p2),
        ]
    }
}

/// An interval of a motion.
pub(super) struct Interval<'k, 'a> {
    pub kinematics: &'k mut Kinematics<'a>,
    /// The time at which bodies are compared, which the kinematics are at.
    pub time: f64,
    pub span: Span,
}
