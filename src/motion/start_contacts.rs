//! What touches at the start of a slide, or is nearer than rounding. There no bound over an interval parts a pair, so that the interval
//! proof follows it from a later time on. Up to there the contacts of what touches must not come nearer, to first order, and those of
//! what is apart stay so, to second order. Where a plane that nothing crosses separates the two for the whole motion, it need not follow
//! them at all.

use std::cell::RefCell;

use super::half_spaces::dot;
use super::linear_motion::{LinearMotion, STEP_FRACTION, extent};
use super::pair_rates::PairRates;
use super::set_tree::{LeafContent, SetTree};
use super::slide_step::Approach;
use super::way::Way;
use crate::cobject::{Induced, PureSet, PureShape};
use crate::error::Result;
use crate::query::{
    CacheKey, CandidateFilter, Configuration, Group, PureAt, QueryContext, Scene, Target,
    WitnessList, WitnessRequest, pure_witnesses,
};

/// How far a pair that touches at the start may move before the interval proof follows it.
#[derive(Clone, Copy)]
pub(super) struct TouchAllowance {
    pub distance: f64,
    /// A pair with more witnesses than this within the distance counts as not free.
    pub max_count: usize,
}

/// A motion towards a plane of at most this fraction of [`TouchAllowance::distance`] is taken for rounding of a motion
/// along it.
const LEVEL: f64 = 1e-9;

/// Bodies touch up to this distance, relative to their size and to where they are, or up to what the interval proof takes off a gap for
/// rounding, if that is more.
const TOUCHING: f64 = 1e-11;

impl TouchAllowance {
    /// How far below 0 the clearance of a contact may fall.
    fn allowed(&self) -> f64 {
        1e-3 * self.distance
    }
}

/// The times, from 0 to 1, from which the interval proof follows what is near at the start. It does not follow what has time 1.
#[derive(Default)]
pub(super) struct StartContacts {
    /// Of body pairs, each with the serial of its induced set.
    pairs: Vec<(u64, CacheKey, f64)>,
    /// Of the parts of pure sets, each with the serial of the set and its number in it.
    parts: Vec<(u64, usize, f64)>,
}

impl StartContacts {
    /// The time of a body pair of an induced set.
    pub fn pair_followed_from(&self, term: &Induced, target: &Target) -> f64 {
        let is_it = |(serial, key, _): &&_| (*serial, *key) == (term.leaf.serial, target.key);
        self.pairs.iter().find(is_it).map_or(0.0, |found| found.2)
    }

    /// The time of a pure set's part: see [`PureSet::parts_on_way`].
    pub fn part_followed_from(&self, set: &PureSet, part: usize) -> f64 {
        let is_it = |(serial, number, _): &&_| (*serial, *number) == (set.leaf.serial, part);
        self.parts.iter().find(is_it).map_or(0.0, |found| found.2)
    }
}

/// What the robot must keep clear of: a body pair, or a pure set.
trait Obstacle {
    /// A safe lower bound of the distance at the start, and where that is below `limit` a plane fixed in the world that separates the robot
    /// from the obstacle, if one is known.
    fn at_start(
        &self,
        context: &mut QueryContext,
        places: &Places,
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
    fn rounding(&self, places: &Places) -> f64;

    /// Up to which distance the two count as touching, whatever rounding does on this way.
    fn touching(&self) -> f64;

    /// Bounds how far the one turns as the other sees it, in the whole motion.
    fn turn(&self, motion: &LinearMotion) -> f64;
}

/// What rounding may do to the places of links on a motion.
struct Places<'a> {
    motion: &'a LinearMotion<'a>,
    start: &'a Scene<'a>,
    rates: RefCell<PairRates<'a>>,
    /// See [`Way::rounding`].
    of_coordinates: &'a [f64],
}

impl Places<'_> {
    /// How far rounding may move what a link carries within a radius of its origin.
    fn rounding(&self, link: usize, radius: f64) -> f64 {
        let LinearMotion { cobject, q, .. } = *self.motion;
        let mut rates = self.rates.borrow_mut();
        let rounding = rates.rounding_of_link(link, self.start.poses());
        let v = self.of_coordinates;
        let of_coordinates = cobject.space().motion_bound_of_radius(link, radius, q, v);
        rounding.of_places(radius, 1.0) + of_coordinates
    }
}

/// A plane between a moving link and something at rest.
struct Separation {
    /// The gap between the two along the plane's normal.
    gap: f64,
    /// Bounds the link's motion along the normal over the whole motion.
    rate: f64,
}

impl Separation {
    /// Whether the plane separates the two during the whole motion, by more than rounding.
    fn lasts(&self, rounding: f64) -> bool {
        let gap = self.gap - rounding;
        gap > 0.0 && STEP_FRACTION * gap >= self.rate
    }
}

/// A body pair of an induced set, at the start.
struct PairAtStart<'a> {
    term: &'a Group,
    target: Target<'a>,
}

/// An obstacle near the start.
struct Near<'n, 'p> {
    /// Bounds how much the distance falls in the whole motion.
    rate: f64,
    places: &'n Places<'p>,
    allowance: &'n TouchAllowance,
}

impl QueryContext {
    /// From when on the interval proof of a motion is to follow what is near at its start, which is not inside. `None` where a
    /// contact comes nearer than the allowance.
    pub(super) fn start_contacts(
        &mut self,
        motion: &LinearMotion,
        allowance: &TouchAllowance,
    ) -> Result<Option<StartContacts>> {
        let start = &motion.scene(motion.q)?;
        let way = Way::straight(*motion);
        let motions = way.link_motions();
        let places = &Places {
            motion,
            start,
            rates: RefCell::new(PairRates::new(&motions)),
            of_coordinates: &way.rounding(),
        };
        let mut found = StartContacts::default();
        for leaf in &SetTree::new(motion.cobject, false).leaves {
            let goes_on = match leaf.content {
                LeafContent::Induced(group) => {
                    let mut terms = group.chunks(1);
                    terms.try_fold(true, |goes_on, term| {
                        Ok(goes_on && self.add_near_pairs(places, term, allowance, &mut found)?)
                    })?
                }
                LeafContent::Known(_) => true,
                LeafContent::Pure(set) => {
                    self.add_near_parts(places, set, allowance, &mut found)?
                }
            };
            if !goes_on {
                return Ok(None);
            }
        }
        Ok(Some(found))
    }

    fn add_near_pairs(
        &mut self,
        places: &Places,
        term: &Group,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
        let &Places { motion, start, .. } = places;
        let checked = start.checked(term)?;
        let filter = CandidateFilter::within(allowance.distance);
        let meter = self.scratch.meter_mut();
        let candidates = start.candidates(checked, filter, &mut self.candidates, meter)?;
        for &target in &candidates {
            if target.bound > allowance.distance {
                continue;
            }
            // Searched alone, so its rank is 0: hits name their pair by rank.
            let target = Target { rank: 0, ..target };
            let near = Near {
                rate: motion.rate(start, &target),
                places,
                allowance,
            };
            let Some(time) = near.followed_from(self, &PairAtStart { term, target })? else {
                return Ok(false);
            };
            if time > 0.0 {
                found.pairs.push((term[0].leaf.serial, target.key, time));
            }
        }
        Ok(true)
    }

    fn add_near_parts(
        &mut self,
        places: &Places,
        set: &PureSet,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
        let motion = places.motion;
        let space = motion.cobject.space();
        let straight = || space.straight(motion.q, motion.v).collect();
        let parts = set.parts_on_way(space, straight);
        for (number, part) in parts.iter().enumerate() {
            let near = Near {
                rate: part.motion_bound(space, motion.q, motion.v),
                places,
                allowance,
            };
            let Some(time) = near.followed_from(self, part)? else {
                return Ok(false);
            };
            if time > 0.0 {
                found.parts.push((set.leaf.serial, number, time));
            }
        }
        Ok(true)
    }
}

impl Near<'_, '_> {
    /// From when on the interval proof is to follow the obstacle; `None` where a contact comes nearer.
    fn followed_from(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
    ) -> Result<Option<f64>> {
        // What does not move relative to the robot may be arbitrarily near.
        if self.rate == 0.0 {
            return Ok(Some(1.0));
        }
        let cutoff = self.allowance.distance;
        let (lower, plane) = obstacle.at_start(context, self.places, cutoff)?;
        if lower >= cutoff {
            return Ok(Some(0.0));
        }
        let rounding = obstacle.rounding(self.places);
        if plane.as_ref().is_some_and(|plane| plane.lasts(rounding)) {
            let stays = lower <= 0.0 || self.is_apart_at(context, obstacle, 1.0)?;
            return Ok(stays.then_some(1.0));
        }
        if lower > obstacle.touching().max(rounding) {
            return Ok(Some(0.0));
        }
        match lower > 0.0 {
            true => self.followed_where_apart(context, obstacle, lower),
            false => self.followed_where_touching(context, obstacle, plane),
        }
    }

    /// The same of what is apart, but nearer than rounding: it stays apart to second order. By which it may bend is a product of how
    /// far it moves and turns: a quarter of the distance at most.
    fn followed_where_apart(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
        lower: f64,
    ) -> Result<Option<f64>> {
        let bend = 2.0 * self.rate * obstacle.turn(self.places.motion);
        let mut share = self.allowed_share(self.rate);
        if bend > 0.25 * lower {
            share = share.min((0.25 * lower / bend).sqrt());
        }
        let stays = share > 0.0
            && self.keeps_off(context, obstacle, share, 0.5 * lower)?
            && self.is_apart_at(context, obstacle, share)?;
        Ok(stays.then_some(share))
    }

    /// The same of what touches: it may go on touching, and must be apart from where it is followed on.
    fn followed_where_touching(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
        plane: Option<Separation>,
    ) -> Result<Option<f64>> {
        let lowest = -self.allowance.allowed();
        // A link that does not move towards a separating plane cannot come nearer, however far it slides.
        let level = LEVEL * self.allowance.distance;
        let is_level = |plane: &Separation| plane.gap >= lowest && plane.rate <= level;
        let nearer = plane.filter(is_level).map_or(self.rate, |plane| plane.rate);
        let share = self.allowed_share(nearer);
        let stays = self.keeps_off(context, obstacle, share, lowest)?
            && (share == 1.0 || self.is_apart_at(context, obstacle, share)?);
        Ok(stays.then_some(share))
    }

    /// The part of the motion in which what moves by this in all of it moves no farther than is allowed.
    fn allowed_share(&self, moved: f64) -> f64 {
        match moved > self.allowance.distance {
            true => self.allowance.distance / moved,
            false => 1.0,
        }
    }

    /// Whether the obstacle is apart from the robot at a time, by more than rounding: what begins apart ends so.
    fn is_apart_at(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
        time: f64,
    ) -> Result<bool> {
        let LinearMotion { world, cobject, .. } = *self.places.motion;
        let q = self.places.motion.at(time);
        let at = Configuration::Coordinates(&q);
        context.with_scene(cobject, world, at, |context, scene| {
            Ok(obstacle.lower(context, scene, self.allowance.distance)? > 0.0)
        })
    }

    /// Whether, to first order, no clearance falls below a lowest one up to a time.
    fn keeps_off(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
        time: f64,
        lowest: f64,
    ) -> Result<bool> {
        let allowance = self.allowance;
        let request = WitnessRequest {
            // Witnesses farther away cannot come to touch.
            with_gradients: true,
            counts_doubt: true,
            ..WitnessRequest::within(allowance.distance / STEP_FRACTION, allowance.max_count)
        };
        let list = obstacle.witnesses(context, self.places.start, request)?;
        let keeps_off =
            |a: &Approach| a.clearance + time * dot(a.gradient, self.places.motion.v) >= lowest;
        let is_known = !list.truncated && list.witnesses.iter().all(|w| w.contact_count > 0);
        Ok(is_known && list.approaches().iter().all(keeps_off))
    }
}

impl Obstacle for PairAtStart<'_> {
    fn at_start(
        &self,
        context: &mut QueryContext,
        places: &Places,
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
            let &Places { motion, start, .. } = places;
            let rate = motion.directed_rate(start, link, target.sides[0], &normal)?;
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

    fn rounding(&self, places: &Places) -> f64 {
        let [a, b] = self.target.sides;
        let (link, other) = self.target.links();
        let of_link = |link: usize, side| places.rounding(link, extent(places.start, link, side));
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
        &Places { motion, start, .. }: &Places,
        limit: f64,
    ) -> Result<(f64, Option<Separation>)> {
        let lower = self.lower(context, start, limit)?;
        let PureShape::Floor { links, normal, .. } = &self.shape else {
            return Ok((lower, None));
        };
        let &[link] = &links[..] else {
            return Ok((lower, None));
        };
        let Some(measure) = self.measure(&start.space_state())? else {
            return Ok((lower, None));
        };
        let carried = start.link(link);
        let rate = carried.and_then(|body| motion.directed_rate(start, link, body, normal));
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

    fn rounding(&self, places: &Places) -> f64 {
        let of_link = |&link: &usize| {
            let body = places.start.link(link);
            places.rounding(
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
