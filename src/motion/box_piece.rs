//! Body pairs over a box of configurations: to first order every coordinate moves them on its own, and what is left is bounded by the
//! second derivative on the straight way from the middle of the box to any other configuration of it.

use std::cell::OnceCell;

use super::carried::Carried;
use super::moving_pair::{MAX_TURN, MovingPair};
use super::over_piece::{ManyTwists, Moved, OverPiece, PairOver};
use super::pair_rates::{PairRates, PairRatesMemory};
use super::way::Way;
use crate::body::Body;
use crate::convex::Extension;
use crate::pose::{Pose, Vec3};
use crate::robot::{LinkMotions, LinkTwists, MotionRates, RatesFrom, RelativeTwists};
use crate::space::Space;
use crate::tolerance::SUM_SLACK;

/// A box of configurations, which a [`Way`] goes through from its middle.
pub(super) struct BoxPiece<'a> {
    way: &'a Way<'a>,
    motions: &'a LinkMotions,
    twists: LinkTwists<'a>,
    rates: PairRates<'a>,
    /// The bounds of all links' derivatives in the world, once they are asked for.
    in_world: OnceCell<Vec<MotionRates>>,
}

/// How a pair moves through the box.
struct PairInBox {
    poses: [Pose; 2],
    twists: RelativeTwists,
    second_order: SecondOrder,
    kinematics_error: f64,
}

/// What bounds a pair's motion behind its twists.
enum SecondOrder {
    /// The derivatives of A's centre as B sees it.
    Rates(MotionRates),
    /// No twists are known: no point of A moves farther than this.
    Farthest(f64),
}

impl<'a> BoxPiece<'a> {
    /// `motions` are those of the way, `poses` those of all links at its middle. The memory is that of the last box.
    pub fn new(
        way: &'a Way<'a>,
        motions: &'a LinkMotions,
        poses: &'a [Pose],
        memory: PairRatesMemory,
    ) -> Self {
        Self {
            way,
            motions,
            twists: LinkTwists::new(motions, poses),
            rates: PairRates::in_memory(motions, memory),
            in_world: OnceCell::new(),
        }
    }

    pub fn into_memory(self) -> PairRatesMemory {
        self.rates.into_memory()
    }

    fn space(&self) -> &Space {
        self.way.line.cobject.space()
    }

    /// Where all joints that are not known rest.
    fn in_world(&self) -> &[MotionRates] {
        self.in_world.get_or_init(|| {
            let mut rates = RatesFrom::new(self.motions, None);
            let links = 0..self.motions.len();
            links
                .map(|link| rates.of_known_joints(link).rates)
                .collect()
        })
    }

    fn in_box(&mut self, pair: &MovingPair) -> PairInBox {
        let (a, b) = pair.carried();
        let poses = [
            self.twists.pose(a.link).compose(a.pose_in_carrier()),
            b.link.map_or(*b.pose_in_carrier(), |link| {
                self.twists.pose(link).compose(b.pose_in_carrier())
            }),
        ];
        let known = self.rates.between(a, b);
        let Some(rates) = known else {
            let rates = pair.rates_at(self.motions, |link| self.twists.pose(link));
            return PairInBox {
                poses,
                twists: RelativeTwists::new(),
                second_order: SecondOrder::Farthest(self.farthest(a, b, self.way.line.v)),
                kinematics_error: pair.kinematics_error(&rates, 1.0),
            };
        };
        let center = poses[0].transform_point(a.body.center());
        PairInBox {
            twists: self.twists.between(a.link, b.link, &center),
            poses,
            kinematics_error: pair.kinematics_error(&rates, 1.0),
            second_order: SecondOrder::Rates(rates),
        }
    }

    /// Bounds how far a point of A moves as B sees it, from the middle on with velocity v for a unit of time.
    fn farthest(&self, a: &Carried<usize>, b: &Carried<Option<usize>>, v: &[f64]) -> f64 {
        let extent = |body: &Body, pose: &Pose| pose.translation.norm() + body.radius_from_origin();
        let (space, q) = (self.space(), self.way.line.q);
        let of_a = (a.link, extent(a.body, a.pose_in_carrier()));
        match b.link {
            Some(link) => {
                let of_b = (link, extent(b.body, b.pose_in_carrier()));
                space.relative_motion_bound([of_a, of_b], q, v)
            }
            None => space.motion_bound_of_radius(of_a.0, of_a.1, q, v),
        }
    }

    /// Raises the entry of each velocity to how far it alone moves A's points as B sees them: what a box is halved by.
    pub fn raise_shares(&mut self, pair: &MovingPair, shares: &mut [f64]) {
        let radius = pair.bodies()[0].radius();
        let found = self.in_box(pair);
        if let SecondOrder::Farthest(_) = found.second_order {
            let (a, b) = pair.carried();
            let mut alone = vec![0.0; shares.len()];
            for (k, share) in shares.iter_mut().enumerate() {
                alone[k] = self.way.line.v[k];
                *share = share.max(self.farthest(a, b, &alone));
                alone[k] = 0.0;
            }
        }
        for twist in &found.twists {
            let share = &mut shares[twist.velocity as usize];
            *share = share.max(twist.by.linear.norm() + twist.by.angular.norm() * radius);
        }
    }

    /// Bounds how far a link's body moves along a direction of the world; `None` where a custom joint moves.
    pub fn change_along(&self, link: usize, body: &Body, direction: &Vec3) -> Option<f64> {
        if !self.motions.is_known(link) {
            return None;
        }
        let radius = body.radius_from_origin();
        let origin = self.twists.pose(link).translation;
        let twists = self.twists.between(link, None, &origin);
        let along = twists.iter().map(|twist| {
            let by = &twist.by;
            direction.dot(&by.linear).abs() + direction.cross(&by.angular).norm() * radius
        });
        let rates = &self.in_world()[link];
        let bend = 0.5 * (rates.turn[1] * radius + rates.origin[1]);
        let farthest = self.twists.farthest_along(link, radius, direction);
        Some(farthest.min(along.sum::<f64>() + bend) * SUM_SLACK)
    }
}

impl PairInBox {
    /// Bounds how far A's centre moves along the line to B's.
    fn center_moves(&self, apart: &Vec3, distance: f64) -> f64 {
        match &self.second_order {
            SecondOrder::Farthest(distance) => *distance,
            SecondOrder::Rates(rates) => {
                let along = self
                    .twists
                    .iter()
                    .map(|twist| twist.by.linear.dot(apart).abs());
                along.sum::<f64>() / distance.max(f64::MIN_POSITIVE) + 0.5 * rates.origin[1]
            }
        }
    }

    /// What the second derivative may take off a gap, with the letters of [`MovingPair`]'s intervals: the way to any configuration of
    /// the box takes a unit of time, and [`MotionRates`] bound the derivatives on all of them. Along directions that rest with B,
    /// A's points leave their first order by at most (T_2 R + P_2) / 2. Seen from A, only points of B count that end within the
    /// threshold of A; on the way there they are never farther than rho = R + threshold + P_1 from A's centre, and leave their
    /// first order by at most (T_2 rho + 2 T_1 P_1 + P_2) / 2.
    fn moved(self, radius: f64, threshold: f64) -> Moved<ManyTwists> {
        let bends = match &self.second_order {
            SecondOrder::Farthest(distance) => [distance * SUM_SLACK; 2],
            SecondOrder::Rates(rates) => {
                let [t1, t2, _] = rates.turn;
                let [p1, p2, _] = rates.origin;
                let rho = radius + threshold + p1;
                [t2 * rho + 2.0 * t1 * p1 + p2, t2 * radius + p2].map(|x| 0.5 * x * SUM_SLACK)
            }
        };
        Moved {
            poses: self.poses,
            displacements: self.twists.iter().map(|twist| twist.by).collect(),
            extension: Extension::BothWays,
            bends,
            kinematics_error: self.kinematics_error,
        }
    }
}

impl BoxPiece<'_> {
    /// A pair through the box.
    pub fn pair_over<'p>(&mut self, pair: &MovingPair<'p>) -> PairOver<OverPiece<'p, ManyTwists>> {
        let found = self.in_box(pair);
        let center_moves = |apart: &Vec3, distance: f64| found.center_moves(apart, distance);
        let [a, b] = pair.bodies();
        let [at_a, at_b] = &found.poses;
        let apart = at_a.transform_point(a.center()) - at_b.transform_point(b.center());
        let error = found.kinematics_error;
        if pair.balls().stay_apart(&apart, center_moves, error) {
            return PairOver::Apart;
        }
        if let SecondOrder::Rates(rates) = &found.second_order
            && rates.turn[0] > MAX_TURN
        {
            return PairOver::TooLong;
        }
        let radius = pair.bodies()[0].radius();
        PairOver::Near(pair.placed(found.moved(radius, pair.threshold)))
    }

    /// How A moves through the box.
    pub fn pair_moved(&mut self, pair: &MovingPair) -> Moved<ManyTwists> {
        let radius = pair.bodies()[0].radius();
        self.in_box(pair).moved(radius, pair.threshold)
    }
}
