//! Two bodies at poses as a caller gave them. Bodies of one primitive each are answered for in one piece of code for each
//! instruction set, from the check of the poses to the answer: for two spheres the steps between take longer than their distance.

use super::answer::Distance;
use super::context::{QueryContext, check_threshold};
use super::pairs::{OnePrimitive, TakeDistance};
use super::target::{Parties, Placement};
use crate::body::Body;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::Pairing;
use crate::pose::{Pose, is_pose};

/// Two bodies at poses as a caller gave them, not checked yet.
#[derive(Clone, Copy)]
pub struct GivenPair<'a> {
    /// The two bodies.
    pub bodies: [&'a Body; 2],
    /// The pose of each in the world: 12 numbers, row-major `[R | t]`.
    pub poses: [&'a [f64; 12]; 2],
}

impl<'a> GivenPair<'a> {
    /// Calls with the bodies at their poses, replaced by the nearest ones where they are off by rounding. Errors name `pose_a` or
    /// `pose_b`.
    #[inline(always)]
    pub fn read<T>(&self, call: impl FnOnce(Placement, Placement) -> Result<T>) -> Result<T> {
        // In place: a result of this size would be copied on its way out.
        let mut poses = [Pose::as_given(self.poses[0]), Pose::as_given(self.poses[1])];
        if !with_widest(ArePlain(self)) {
            self.correct(&mut poses)?;
        }
        call((self.bodies[0], &poses[0]), (self.bodies[1], &poses[1]))
    }

    #[cold]
    #[inline(never)]
    fn correct(&self, poses: &mut [Pose; 2]) -> Result<()> {
        for (side, name) in ["pose_a", "pose_b"].into_iter().enumerate() {
            let corrected = Pose::from_row_major(self.poses[side]);
            poses[side] = corrected.map_err(|e| e.within(name))?;
        }
        Ok(())
    }

    /// Whether the poses need no correction.
    #[inline(always)]
    fn are_plain<I: Instructions>(&self, lanes: I) -> bool {
        let [p, q] = self.poses;
        is_pose(lanes, p) & is_pose(lanes, q)
    }

    /// How the bodies are measured without a search; `None` where they are not, or not in space.
    #[inline(always)]
    fn of_one_primitive(&self) -> Option<OnePrimitive<'a>> {
        let [a, b] = self.bodies;
        let are_spatial = a.dimension() == 3 && b.dimension() == 3;
        are_spatial.then(|| OnePrimitive::of(self.bodies)).flatten()
    }

    /// Both in one frame, at poses that need no correction.
    #[inline(always)]
    fn pairing<I: Instructions>(&self, lanes: I) -> Pairing<'a> {
        Pairing::of(lanes, self.bodies, self.poses)
    }
}

impl QueryContext {
    /// The distance of two bodies, up to `max_distance`, and the nearest primitive pair; handed to `take`.
    #[inline(always)]
    pub fn take_given_distance<T>(
        &mut self,
        pair: &GivenPair,
        max_distance: f64,
        take: impl TakeDistance<Taken = T>,
    ) -> Result<T> {
        check_threshold(max_distance, "max_distance")?;
        self.scratch.meter_mut().start_call();
        let Some(only) = pair.of_one_primitive() else {
            return Ok(take.rarely(self.read_distance(pair, max_distance)?));
        };
        with_widest(DistanceOf {
            context: self,
            pair,
            only,
            max_distance,
            take,
        })
    }

    /// Whether the distance of two bodies may be at most `threshold`: doubt within rounding counts as within.
    #[inline(always)]
    pub fn given_within(&mut self, pair: &GivenPair, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        self.scratch.meter_mut().start_call();
        let Some(only) = pair.of_one_primitive() else {
            return self.read_within(pair, threshold);
        };
        with_widest(WithinOf {
            context: self,
            pair,
            only,
            threshold,
        })
    }

    /// The distance within a call, from poses that are read first.
    #[inline(never)]
    fn read_distance(&mut self, pair: &GivenPair, max_distance: f64) -> Result<Distance> {
        pair.read(|a, b| self.refining(|context| context.bodies_distance(a, b, max_distance)))
    }

    /// The same for a threshold.
    #[inline(never)]
    fn read_within(&mut self, pair: &GivenPair, threshold: f64) -> Result<bool> {
        pair.read(|a, b| self.refining(|context| context.bodies_within(a, b, threshold)))
    }
}

struct ArePlain<'a>(&'a GivenPair<'a>);

impl Work for ArePlain<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> bool {
        self.0.are_plain(lanes)
    }
}

/// The distance of single primitives.
struct DistanceOf<'a, F> {
    context: &'a mut QueryContext,
    pair: &'a GivenPair<'a>,
    only: OnePrimitive<'a>,
    max_distance: f64,
    take: F,
}

impl<F: TakeDistance> Work for DistanceOf<'_, F> {
    type Output = Result<F::Taken>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<F::Taken> {
        let (context, pair, most, take) = (self.context, self.pair, self.max_distance, self.take);
        if !pair.are_plain(lanes) {
            return Ok(take.rarely(context.read_distance(pair, most)?));
        }
        let parties = Parties::of_bodies(pair.bodies);
        // A pairing for each way: that of the spheres and capsules stays in registers.
        match self.only {
            OnePrimitive::Rounds(rounds) => {
                let pairing = pair.pairing(lanes);
                context.rounds_distance(&pairing, rounds, &parties, most, take)
            }
            OnePrimitive::BallAndSolid(ball) => {
                let pairing = pair.pairing(lanes);
                context.ball_distance(&pairing, ball, &parties, most, take)
            }
            OnePrimitive::Any => {
                let pairing = pair.pairing(lanes);
                context.measured_distance(&pairing, &parties, most, take)
            }
        }
    }
}

/// The same for a threshold.
struct WithinOf<'a> {
    context: &'a mut QueryContext,
    pair: &'a GivenPair<'a>,
    only: OnePrimitive<'a>,
    threshold: f64,
}

impl Work for WithinOf<'_> {
    type Output = Result<bool>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<bool> {
        let (context, pair, threshold) = (self.context, self.pair, self.threshold);
        if !pair.are_plain(lanes) {
            return context.read_within(pair, threshold);
        }
        match self.only {
            OnePrimitive::Rounds(rounds) => {
                let pairing = pair.pairing(lanes);
                context.rounds_within(&pairing, rounds, threshold)
            }
            OnePrimitive::BallAndSolid(ball) => {
                let pairing = pair.pairing(lanes);
                context.ball_within(&pairing, ball, threshold)
            }
            OnePrimitive::Any => {
                let pairing = pair.pairing(lanes);
                context.measured_within(&pairing, threshold)
            }
        }
    }
}
