//! What a robot must keep clear of from the start of a slide: a body pair, or a pure set. How near it is, where a plane separates the two,
//! and what rounding may do to its place.

use super::linear_motion::{LinearMotion, STEP_FRACTION, extent};
use super::link_rounding::LinkRounding;
use crate::cobject::{PureSet, PureShape};
use crate::error::Result;
use crate::query::{
    Group, PureAt, QueryContext, Scene, Target, WitnessList, WitnessRequest, pure_witnesses,
};

/// Bodies touch up to this distance, relative to their size and to where they are, or up to what the interval proof takes off a gap for
/// rounding, if that is more.
const TOUCHING: f64 = 1e-11;

/// What the robot must keep clear of: a body pair, or a pure set.
pub(super) trait Obstacle {
    /// A safe lower bound of the distance at the start, and where that is below `limit` a plane fixed in the world that separates the robot
    /// from the obstacle, if one is known.
    fn at_start(
        &self,
        context: &mut QueryContext,
        start: &Start,
        limit: f64,
    ) -> Result<(f64, Option<Separation>)>;

    /// A safe lower bound of the distance in a scene; a distance above `limit` may be given as the limit.
    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64>;

    /// The witnesses at the start within a distance, with gradients.
    fn witnesses(
        &self,
        context: &mut QueryContext,
        start: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList>;

    /// How far rounding may move the robot's links on the way, where they are placed.
    fn rounding(&self, start: &Start) -> f64;

    /// Up to which distance the two count as touching, whatever rounding does on this way.
    fn touching(&self) -> f64;

    /// Bounds how far the one turns as the other sees it, in the whole motion.
    fn turn(&self, motion: &LinearMotion) -> f64;
}

/// A motion at its start.
pub(super) struct Start<'a> {
    pub motion: &'a LinearMotion<'a>,
    pub scene: &'a Scene<'a>,
    pub rounding: LinkRounding<'a>,
}

/// A plane between a moving link and something at rest.
pub(super) struct Separation {
    /// The gap between the two along the plane's normal.
    pub gap: f64,
    /// Bounds the link's motion along the normal over the whole motion.
    pub rate: f64,
}

impl Separation {
    /// Whether the plane separates the two during the whole motion, by more than rounding.
    pub fn lasts(&self, rounding: f64) -> bool {
        let gap = self.gap - rounding;
        gap > 0.0 && STEP_FRACTION * gap >= self.rate
    }
}

/// A body pair of an induced set, at the start.
pub(super) struct PairAtStart<'a> {
    pub term: &'a Group,
    pub target: Target<'a>,
}

impl Obstacle for PairAtStart<'_> {
    fn at_start(
        &self,
        context: &mut QueryContext,
        start: &Start,
        limit: f64,
    ) -> Result<(f64, Option<Separation>)> {
        let target = &self.target;
        let found = context.nearest(std::slice::from_ref(target), limit)?;
        let lower = found.lower.min(limit);
        let hit = found.hit.map(|(hit, _)| hit);
        let hit = hit.filter(|hit| lower < limit && hit.contained.is_none());
        let (Some(hit), (link, None)) = (hit, target.links()) else {
            return Ok((lower, None));
        };
        let pairing = target.pairing();
        let scratch = context.scratch.for_primitives();
        let closest = pairing.closest(&hit, scratch);
        let contacts = pairing.world_contacts(hit.key.primitives, &closest, scratch);
        let along = contacts.first().and_then(|contact| {
            let normal = contact.normal;
            let &Start { motion, scene, .. } = start;
            let rate = motion.directed_rate(scene, link, target.sides[0], &normal)?;
            Some(Separation {
                gap: pairing.gap_along(&normal) - target.margin(),
                rate,
            })
        });
        Ok((lower, along))
    }

    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64> {
        let Some(sides) = scene.sides_of(&self.term[0], &self.target.key) else {
            return Ok(0.0);
        };
        let target = Target {
            sides,
            bound: f64::NEG_INFINITY,
            ..self.target
        };
        Ok(context.nearest(&[target], limit)?.lower.min(limit))
    }

    fn witnesses(
        &self,
        context: &mut QueryContext,
        start: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        context.list(self.term, start, &[self.target], request)
    }

    fn rounding(&self, start: &Start) -> f64 {
        let [a, b] = self.target.sides;
        let (link, other) = self.target.links();
        let of_link =
            |link: usize, side| start.rounding.within(link, extent(start.scene, link, side));
        of_link(link, a) + other.map_or(0.0, |other| of_link(other, b))
    }

    fn touching(&self) -> f64 {
        let [(_, a), (_, b)] = self.target.sides;
        let size = self.target.pairing().precision.size;
        TOUCHING * (size + a.translation.norm() + b.translation.norm())
    }

    fn turn(&self, motion: &LinearMotion) -> f64 {
        let (link, other) = self.target.links();
        let space = motion.cobject.space();
        space.turn_bound(link, other, motion.q, motion.v)
    }
}

impl Obstacle for PureSet {
    /// A floor is itself the plane.
    fn at_start(
        &self,
        context: &mut QueryContext,
        &Start { motion, scene, .. }: &Start,
        limit: f64,
    ) -> Result<(f64, Option<Separation>)> {
        let lower = self.lower(context, scene, limit)?;
        let PureShape::Floor { links, normal, .. } = &self.shape else {
            return Ok((lower, None));
        };
        let &[link] = &links[..] else {
            return Ok((lower, None));
        };
        let Some(measure) = self.measure(&scene.space_state())? else {
            return Ok((lower, None));
        };
        let carried = scene.link(link);
        let rate = carried.and_then(|body| motion.directed_rate(scene, link, body, normal));
        let plane = rate.map(|rate| Separation {
            gap: measure.signed - measure.error,
            rate,
        });
        Ok((lower, plane))
    }

    fn lower(&self, _: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64> {
        let at = PureAt {
            set: self,
            complement: false,
            scene,
        };
        Ok(at.bounded_distance()?.lower.min(limit))
    }

    fn witnesses(
        &self,
        _: &mut QueryContext,
        start: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        pure_witnesses(&[(self, false)], start, request)
    }

    fn rounding(&self, start: &Start) -> f64 {
        let of_link = |&link: &usize| {
            let body = start.scene.link(link);
            start.rounding.within(
                link,
                body.map_or(0.0, |(body, _)| body.radius_from_origin()),
            )
        };
        let links = self.shape.links().iter();
        links.map(of_link).fold(0.0, f64::max)
    }

    fn touching(&self) -> f64 {
        0.0
    }

    fn turn(&self, motion: &LinearMotion) -> f64 {
        let space = motion.cobject.space();
        let links = self.shape.links().iter();
        let turns = links.map(|&link| space.turn_bound(link, None, motion.q, motion.v));
        turns.fold(0.0, f64::max)
    }
}
