//! Two bodies at poses as a caller gave them. Bodies of one primitive each are answered for in one piece of code for each
//! instruction set, from the check of the poses to the answer: for two spheres the steps between take longer than their distance.

use super::answer::Distance;
use super::context::{QueryContext, check_threshold};
use super::pairs::are_singles;
use super::target::{Parties, Placement};
use crate::body::Body;
use crate::error::Result;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::Pairing;
use crate::pose::{Pose, is_pose};
use crate::primitive::Round;

/// Two bodies at poses as a caller gave them, not checked yet.
#[derive(Clone, Copy)]
pub struct GivenPair<'a> {
    /// The two bodies.
    pub bodies: [&'a Body; 2],
    /// The pose of each in the world: 12 numbers, row-major `[R | t]`.
    pub poses: [&'a [f64; 12]; 2],
}

impl<'a> GivenPair<'a> {
    /// The poses, replaced by the nearest ones where they are off by rounding. Errors name `pose_a` or `pose_b`.
    pub fn read_poses(&self) -> Result<[Pose; 2]> {
        let [a, b] = self.poses.map(Pose::from_row_major);
        let named = |pose: Result<Pose>, name| pose.map_err(|e| e.within(name));
        Ok([named(a, "pose_a")?, named(b, "pose_b")?])
    }

    /// The bodies at poses read from these.
    pub fn at<'b>(&self, [a, b]: &'b [Pose; 2]) -> [Placement<'b>; 2]
    where
        'a: 'b,
    {
        [(self.bodies[0], a), (self.bodies[1], b)]
    }

    /// Whether the bodies are spatial and the poses need no correction.
    #[inline(always)]
    fn is_plain<I: Instructions>(&self, lanes: I) -> bool {
        let ([a, b], [p, q]) = (self.bodies, self.poses);
        a.dimension() == 3 && b.dimension() == 3 && is_pose(lanes, p) & is_pose(lanes, q)
    }

    /// The spheres or capsules that the bodies are, if they are nothing else.
    #[inline(always)]
    fn rounds(&self) -> Option<[&'a Round; 2]> {
        let [a, b] = self.bodies;
        Some([a.only_round()?, b.only_round()?])
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
        take: impl FnOnce(Distance) -> T,
    ) -> Result<T> {
        check_threshold(max_distance, "max_distance")?;
        self.scratch.meter_mut().start_call();
        with_widest(DistanceOf {
            context: self,
            pair,
            max_distance,
            take,
        })
    }

    /// Whether the distance of two bodies may be at most `threshold`: doubt within rounding counts as within.
    #[inline(always)]
    pub fn given_within(&mut self, pair: &GivenPair, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        self.scratch.meter_mut().start_call();
        with_widest(WithinOf {
            context: self,
            pair,
            threshold,
        })
    }

    /// The distance within a call, from poses that are read first.
    #[inline(never)]
    fn read_distance(&mut self, pair: &GivenPair, max_distance: f64) -> Result<Distance> {
        let poses = pair.read_poses()?;
        let [a, b] = pair.at(&poses);
        self.refining(|context| context.bodies_distance(a, b, max_distance))
    }

    /// The same for a threshold.
    #[inline(never)]
    fn read_within(&mut self, pair: &GivenPair, threshold: f64) -> Result<bool> {
        let poses = pair.read_poses()?;
        let [a, b] = pair.at(&poses);
        self.refining(|context| context.bodies_within(a, b, threshold))
    }
}

struct DistanceOf<'a, F> {
    context: &'a mut QueryContext,
    pair: &'a GivenPair<'a>,
    max_distance: f64,
    take: F,
}

impl<T, F: FnOnce(Distance) -> T> Work for DistanceOf<'_, F> {
    type Output = Result<T>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<T> {
        let (context, pair, most, take) = (self.context, self.pair, self.max_distance, self.take);
        if pair.is_plain(lanes) {
            let parties = Parties::of_bodies(pair.bodies);
            // A pairing for each way: only that of the spheres and capsules stays in registers.
            if let Some(rounds) = pair.rounds() {
                let pairing = pair.pairing(lanes);
                return context.rounds_distance(&pairing, rounds, &parties, most, take);
            }
            if are_singles(pair.bodies[0], pair.bodies[1]) {
                let pairing = pair.pairing(lanes);
                return context.measured_distance(&pairing, &parties, most, take);
            }
        }
        Ok(take(context.read_distance(pair, most)?))
    }
}

struct WithinOf<'a> {
    context: &'a mut QueryContext,
    pair: &'a GivenPair<'a>,
    threshold: f64,
}

impl Work for WithinOf<'_> {
    type Output = Result<bool>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Result<bool> {
        let (context, pair, threshold) = (self.context, self.pair, self.threshold);
        if pair.is_plain(lanes) {
            if let Some(rounds) = pair.rounds() {
                let pairing = pair.pairing(lanes);
                return context.rounds_within(&pairing, rounds, threshold);
            }
            if are_singles(pair.bodies[0], pair.bodies[1]) {
                let pairing = pair.pairing(lanes);
                return context.measured_within(&pairing, threshold);
            }
        }
        context.read_within(pair, threshold)
    }
}
