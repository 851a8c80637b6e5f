//! Queries on two bodies at two poses: the level of FCL and Coal.

use super::answer::{ContactRecord, Distance, WitnessList};
use super::cache_key::CacheKey;
use super::context::{QueryContext, check_threshold};
use super::distance_answer::NearestPair;
use super::target::{Parties, Placement, Target};
use crate::body::Body;
use crate::cobject::{InducedOptions, Leaf};
use crate::error::{Error, Result};
use crate::pair::{
    BallAndSolid, OnlyBall, Pairing, Rounds, Singles, SinglesNearest, are_spheres, only_rounds,
};
use crate::primitive::Round;

/// Refuses bodies of different dimension, and planar bodies that leave the plane.
#[inline(always)]
pub(crate) fn check_dimensions(a: Placement, b: Placement) -> Result<()> {
    if a.0.dimension() == 3 && b.0.dimension() == 3 {
        return Ok(());
    }
    check_planar(a, b)
}

/// The same where not both are spatial.
#[inline(never)]
fn check_planar(a: Placement, b: Placement) -> Result<()> {
    if a.0.dimension() != b.0.dimension() {
        return Err(Error::invalid(format!(
            "the bodies differ in dimension: {} and {}",
            a.0.dimension(),
            b.0.dimension()
        )));
    }
    for ((_, pose), name) in [(a, "pose_a"), (b, "pose_b")] {
        if !pose.is_planar() {
            return Err(Error::invalid(format!(
                "{name} leaves the plane z = 0 of its body"
            )));
        }
    }
    Ok(())
}

/// Two bodies as the target of a search.
#[inline(always)]
pub(super) fn target<'a>(a: Placement<'a>, b: Placement<'a>) -> Result<Target<'a>> {
    check_dimensions(a, b)?;
    Ok(Target {
        sides: [a, b],
        key: CacheKey::Bodies(a.0.serial(), b.0.serial()),
        options: InducedOptions::default(),
        data: [a.0.data(), b.0.data()],
        s_carrier: None,
        term: 0,
        rank: 0,
        bound: f64::NEG_INFINITY,
    })
}

/// Two bodies of one primitive each, which need no traversal: how these are measured.
#[derive(Clone, Copy)]
pub(super) enum OnePrimitive<'a> {
    /// A sphere or capsule each.
    Rounds([&'a Round; 2]),
    /// A sphere and a box, a cylinder or a cone.
    BallAndSolid(OnlyBall<'a>),
    /// One primitive each, of any kind.
    Any,
}

impl<'a> OnePrimitive<'a> {
    /// `None` for bodies that are more. Two polygons in space are excluded: only the traversal compares their outlines.
    #[inline(always)]
    pub(super) fn of(bodies: [&'a Body; 2]) -> Option<Self> {
        if let Some(rounds) = only_rounds(bodies) {
            return Some(Self::Rounds(rounds));
        }
        if let Some(ball) = OnlyBall::beside_plain_solid(bodies) {
            return Some(Self::BallAndSolid(ball));
        }
        let [a, b] = bodies;
        let has_outline = |body: &Body| body.packed().primitives().entry(0).corners > 0;
        let are_planar = a.dimension() == 2;
        let are_single = a.is_single() && b.is_single();
        let are_outlines = || has_outline(a) && has_outline(b);
        (are_single && (are_planar || !are_outlines())).then_some(Self::Any)
    }
}

/// What becomes of a distance. Closures will do, but they may be compiled by themselves: an answer of this size then goes through memory,
/// which takes as long as measuring two spheres.
pub trait TakeDistance: Sized {
    /// What it becomes.
    type Taken;

    /// Takes it.
    fn take(self, distance: Distance) -> Self::Taken;

    /// The same for answers that are seldom given: compiled once.
    #[cold]
    #[inline(never)]
    fn rarely(self, distance: Distance) -> Self::Taken {
        self.take(distance)
    }
}

impl<T, F: FnOnce(Distance) -> T> TakeDistance for F {
    type Taken = T;

    #[inline(always)]
    fn take(self, distance: Distance) -> T {
        self(distance)
    }
}

/// The answer for bodies of one primitive each.
#[inline(always)]
fn singles_answer(
    nearest: SinglesNearest,
    parties: &Parties,
    error: f64,
    max_distance: f64,
) -> Distance {
    let SinglesNearest {
        hit,
        lower,
        points,
        contact,
    } = nearest;
    if hit.distance > max_distance {
        return Distance::beyond(max_distance, lower);
    }
    let found = NearestPair {
        hit: &hit,
        points,
        contact: contact.map(|contact| ContactRecord::new(contact, 0.0)),
        margin: 0.0,
        stated_deviation: 0.0,
    };
    Distance::of_pair(&found, lower, parties, error, Leaf::default())
}

impl QueryContext {
    /// The distance of two bodies, up to `max_distance`, and the nearest primitive pair.
    pub fn pair_distance(
        &mut self,
        a: Placement,
        b: Placement,
        max_distance: f64,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        self.scratch.meter_mut().start_call();
        self.refining(|context| context.bodies_distance(a, b, max_distance))
    }

    /// The same within a call, with a checked maximum.
    pub(crate) fn bodies_distance(
        &mut self,
        a: Placement,
        b: Placement,
        max_distance: f64,
    ) -> Result<Distance> {
        self.target_distance(&target(a, b)?, max_distance)
    }

    /// The same of a target.
    #[inline(always)]
    pub(super) fn target_distance(
        &mut self,
        target: &Target,
        max_distance: f64,
    ) -> Result<Distance> {
        let [(a, _), (b, _)] = target.sides;
        if let Some(only) = OnePrimitive::of([a, b]) {
            return self.only_distance(only, target, max_distance);
        }
        self.searched_distance(std::slice::from_ref(target), max_distance)
    }

    #[inline(never)]
    fn searched_distance(&mut self, targets: &[Target], max_distance: f64) -> Result<Distance> {
        let leaf = |_| Leaf::default();
        if self.refines(targets) {
            return self.refined_distance(targets, max_distance, leaf);
        }
        let found = self.nearest(targets, max_distance)?;
        let scratch = self.scratch.for_primitives();
        Ok(Distance::from_found(&found, max_distance, leaf, scratch))
    }

    /// The same of bodies of one primitive each, which need no search.
    pub(super) fn only_distance(
        &mut self,
        only: OnePrimitive,
        target: &Target,
        max_distance: f64,
    ) -> Result<Distance> {
        let (pairing, parties) = (&target.pairing(), &target.parties());
        let whole = |found: Distance| found;
        match only {
            OnePrimitive::Rounds(rounds) => {
                self.rounds_distance(pairing, rounds, parties, max_distance, whole)
            }
            OnePrimitive::BallAndSolid(ball) => {
                self.ball_distance(pairing, ball, parties, max_distance, whole)
            }
            OnePrimitive::Any => self.measured_distance(pairing, parties, max_distance, whole),
        }
    }

    /// The same of a sphere or capsule each.
    #[inline(always)]
    pub(super) fn rounds_distance<T>(
        &mut self,
        pairing: &Pairing,
        rounds: [&Round; 2],
        parties: &Parties,
        max_distance: f64,
        take: impl TakeDistance<Taken = T>,
    ) -> Result<T> {
        self.count_body_pair()?;
        if !are_spheres(rounds) && pairing.sphere_bound() > max_distance {
            return Ok(take.rarely(Distance::beyond(max_distance, f64::INFINITY)));
        }
        self.scratch.for_one_pair()?;
        let error = pairing.precision.error;
        // Not one branch's result or the other's: choosing would copy it.
        if let Some(nearest) = Rounds::new(pairing, rounds).nearest() {
            return Ok(take.take(singles_answer(nearest, parties, error, max_distance)));
        }
        Ok(take.rarely(self.close_distance(*pairing, *parties, max_distance)))
    }

    /// The same of a sphere and a box, a cylinder or a cone.
    #[inline(always)]
    pub(super) fn ball_distance<T>(
        &mut self,
        pairing: &Pairing,
        ball: OnlyBall,
        parties: &Parties,
        max_distance: f64,
        take: impl TakeDistance<Taken = T>,
    ) -> Result<T> {
        self.count_body_pair()?;
        if pairing.sphere_bound() > max_distance {
            return Ok(take.rarely(Distance::beyond(max_distance, f64::INFINITY)));
        }
        let scratch = self.scratch.for_one_pair()?;
        let error = pairing.precision.error;
        let Some(beside) = BallAndSolid::new(pairing, ball, scratch) else {
            return Ok(take.rarely(self.close_distance(*pairing, *parties, max_distance)));
        };
        if let Some(nearest) = beside.nearest() {
            return Ok(take.take(singles_answer(nearest, parties, error, max_distance)));
        }
        Ok(take.rarely(self.close_distance(*pairing, *parties, max_distance)))
    }

    /// The same where their cores are too close together for closed forms. Given copies, so that callers may keep theirs in registers.
    #[cold]
    #[inline(never)]
    fn close_distance(
        &mut self,
        pairing: Pairing,
        parties: Parties,
        max_distance: f64,
    ) -> Distance {
        let error = pairing.precision.error;
        match Singles::new(&pairing, self.scratch.for_primitives()).nearest(max_distance) {
            Some(nearest) => singles_answer(nearest, &parties, error, max_distance),
            None => Distance::beyond(max_distance, f64::INFINITY),
        }
    }

    /// The same of one primitive each, of any kind.
    #[inline(always)]
    pub(super) fn measured_distance<T>(
        &mut self,
        pairing: &Pairing,
        parties: &Parties,
        max_distance: f64,
        take: impl TakeDistance<Taken = T>,
    ) -> Result<T> {
        self.count_body_pair()?;
        if pairing.sphere_bound() > max_distance {
            return Ok(take.rarely(Distance::beyond(max_distance, f64::INFINITY)));
        }
        let scratch = self.scratch.for_one_pair()?;
        let error = pairing.precision.error;
        Ok(match Singles::new(pairing, scratch).nearest(max_distance) {
            Some(nearest) => take.take(singles_answer(nearest, parties, error, max_distance)),
            None => take.rarely(Distance::beyond(max_distance, f64::INFINITY)),
        })
    }

    /// Whether the distance of two bodies may be at most `threshold`: doubt within rounding counts as within.
    #[inline(always)]
    pub fn pair_within(&mut self, a: Placement, b: Placement, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        self.scratch.meter_mut().start_call();
        self.refining(|context| context.bodies_within(a, b, threshold))
    }

    /// The same within a call, with a checked threshold.
    #[inline(always)]
    pub(crate) fn bodies_within(
        &mut self,
        a: Placement,
        b: Placement,
        threshold: f64,
    ) -> Result<bool> {
        if let Some(only) = OnePrimitive::of([a.0, b.0]) {
            check_dimensions(a, b)?;
            return self.only_within(only, &Pairing::new(a.0, a.1, b.0, b.1), threshold);
        }
        self.any_within(&[target(a, b)?], |_| threshold)
    }

    /// The same of bodies of one primitive each, which need no search.
    #[inline(always)]
    pub(super) fn only_within(
        &mut self,
        only: OnePrimitive,
        pairing: &Pairing,
        threshold: f64,
    ) -> Result<bool> {
        match only {
            OnePrimitive::Rounds(rounds) => self.rounds_within(pairing, rounds, threshold),
            OnePrimitive::BallAndSolid(ball) => self.ball_within(pairing, ball, threshold),
            OnePrimitive::Any => self.measured_within(pairing, threshold),
        }
    }

    /// The same of a sphere or capsule each.
    #[inline(always)]
    pub(super) fn rounds_within(
        &mut self,
        pairing: &Pairing,
        rounds: [&Round; 2],
        threshold: f64,
    ) -> Result<bool> {
        self.count_body_pair()?;
        if !are_spheres(rounds) && pairing.sphere_bound() > threshold {
            return Ok(false);
        }
        self.scratch.for_one_pair()?;
        Ok(Rounds::new(pairing, rounds).are_within(threshold))
    }

    /// The same of a sphere and a box, a cylinder or a cone.
    #[inline(always)]
    pub(super) fn ball_within(
        &mut self,
        pairing: &Pairing,
        ball: OnlyBall,
        threshold: f64,
    ) -> Result<bool> {
        self.count_body_pair()?;
        if pairing.sphere_bound() > threshold {
            return Ok(false);
        }
        let scratch = self.scratch.for_one_pair()?;
        if let Some(beside) = BallAndSolid::new(pairing, ball, scratch) {
            return Ok(beside.are_within(threshold));
        }
        Ok(self.close_within(*pairing, threshold))
    }

    /// The same where the sphere's centre is in the solid, or about there. Given a copy, so that callers may keep theirs in registers.
    #[cold]
    #[inline(never)]
    fn close_within(&mut self, pairing: Pairing, threshold: f64) -> bool {
        Singles::new(&pairing, self.scratch.for_primitives()).are_within(threshold)
    }

    /// The same of one primitive each, of any kind.
    #[inline(always)]
    pub(super) fn measured_within(&mut self, pairing: &Pairing, threshold: f64) -> Result<bool> {
        self.count_body_pair()?;
        if pairing.sphere_bound() > threshold {
            return Ok(false);
        }
        let scratch = self.scratch.for_one_pair()?;
        Ok(Singles::new(pairing, scratch).are_within(threshold))
    }

    /// All primitive pairs at most `epsilon` apart, nearest first, at most `max_count` of them.
    pub fn pair_witnesses(
        &mut self,
        a: Placement,
        b: Placement,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        check_threshold(epsilon, "epsilon")?;
        let target = target(a, b)?;
        self.scratch.meter_mut().start_call();
        self.list_of_bodies(std::slice::from_ref(&target), epsilon, max_count)
    }
}
