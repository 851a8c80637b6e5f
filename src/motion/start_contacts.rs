//! What touches at the start of a slide. There no bound over an interval parts a pair, so that the interval proof follows it from
//! a later time on; up to there its contacts must not come nearer, to first order. Where a plane that nothing crosses separates
//! the two for the whole motion, it need not follow them at all.

use super::half_spaces::dot;
use super::linear_motion::{LinearMotion, STEP_FRACTION};
use super::set_tree::{LeafContent, SetTree};
use super::slide_step::Approach;
use crate::cobject::{Induced, PureSet, PureShape};
use crate::error::Result;
use crate::pair::PrimitiveScratch;
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

/// Bodies touch up to this distance, relative to their size and to where they are: more than what the interval proof takes off a gap
/// for rounding.
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
    /// A safe lower bound of the distance in a scene; a distance above `limit` may be given as the limit.
    fn lower(&self, context: &mut QueryContext, scene: &Scene, limit: f64) -> Result<f64>;

    /// The witnesses at the start within a distance, with gradients.
    fn witnesses(
        &self,
        context: &mut QueryContext,
        start: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList>;

    /// A plane fixed in the world that separates the robot from the obstacle, if one is known.
    fn separation(
        &self,
        context: &mut QueryContext,
        motion: &LinearMotion,
        start: &Scene,
    ) -> Result<Option<Separation>>;

    /// Up to which distance the two touch.
    fn touching(&self) -> f64;
}

/// A plane between a moving link and something at rest.
struct Separation {
    /// The gap between the two along the plane's normal.
    gap: f64,
    /// Bounds the link's motion along the normal over the whole motion.
    rate: f64,
}

impl Separation {
    /// Whether the plane separates the two during the whole motion, by more than where they count as touching: the gap has no rounding of
    /// where links are on the way.
    fn lasts(&self, touching: f64) -> bool {
        self.gap > touching && STEP_FRACTION * self.gap >= self.rate
    }
}

/// A body pair of an induced set, at the start.
struct PairAtStart<'a> {
    term: &'a Group,
    target: Target<'a>,
}

/// An obstacle near the start.
struct Near<'a> {
    motion: &'a LinearMotion<'a>,
    start: &'a Scene<'a>,
    /// Bounds how much the distance falls in the whole motion.
    rate: f64,
    allowance: &'a TouchAllowance,
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
        let mut found = StartContacts::default();
        for leaf in &SetTree::new(motion.cobject, false).leaves {
            let goes_on = match leaf.content {
                LeafContent::Induced(group) => {
                    let mut terms = group.chunks(1);
                    terms.try_fold(true, |goes_on, term| {
                        Ok(goes_on
                            && self.add_near_pairs(motion, start, term, allowance, &mut found)?)
                    })?
                }
                LeafContent::Known(_) => true,
                LeafContent::Pure(set) => {
                    self.add_near_parts(motion, start, set, allowance, &mut found)?
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
        motion: &LinearMotion,
        start: &Scene,
        term: &Group,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
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
                motion,
                start,
                rate: motion.rate(start, &target),
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
        motion: &LinearMotion,
        start: &Scene,
        set: &PureSet,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
        let space = motion.cobject.space();
        let straight = || space.straight(motion.q, motion.v).collect();
        let parts = set.parts_on_way(space, straight);
        for (number, part) in parts.iter().enumerate() {
            let near = Near {
                motion,
                start,
                rate: part.motion_bound(space, motion.q, motion.v),
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

impl Near<'_> {
    /// From when on the interval proof is to follow the obstacle; `None` where a contact comes nearer.
    fn followed_from(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
    ) -> Result<Option<f64>> {
        let &Self {
            motion,
            start,
            rate,
            allowance,
        } = self;
        // What does not move relative to the robot may be arbitrarily near.
        if rate == 0.0 {
            return Ok(Some(1.0));
        }
        let lower = obstacle.lower(context, start, allowance.distance)?;
        if lower >= allowance.distance {
            return Ok(Some(0.0));
        }
        let plane = obstacle.separation(context, motion, start)?;
        let touching = obstacle.touching();
        if plane.as_ref().is_some_and(|plane| plane.lasts(touching)) {
            let stays = lower <= 0.0 || self.is_apart_at(context, obstacle, 1.0)?;
            return Ok(stays.then_some(1.0));
        }
        if lower > touching {
            return Ok(Some(0.0));
        }
        // How far clearances may fall: what is apart stays so, on the side where it is.
        let lowest = if lower > 0.0 {
            0.0
        } else {
            -allowance.allowed()
        };
        // A link that does not move towards a separating plane cannot come nearer, however far it slides.
        let is_level = |plane: &Separation| match lower > 0.0 {
            true => plane.gap > plane.rate,
            false => plane.gap >= lowest && plane.rate <= LEVEL * allowance.distance,
        };
        let nearer = plane.filter(is_level).map_or(rate, |plane| plane.rate);
        let share = if nearer > allowance.distance {
            allowance.distance / nearer
        } else {
            1.0
        };
        if !self.keeps_off(context, obstacle, share, lowest)? {
            return Ok(None);
        }
        // What touches may go on touching, from where it is followed on alone it must be apart.
        let may_touch = lower <= 0.0 && share == 1.0;
        let stays = may_touch || self.is_apart_at(context, obstacle, share)?;
        Ok(stays.then_some(share))
    }

    /// Whether the obstacle is apart from the robot at a time, by more than rounding: what begins apart ends so.
    fn is_apart_at(
        &self,
        context: &mut QueryContext,
        obstacle: &impl Obstacle,
        time: f64,
    ) -> Result<bool> {
        let LinearMotion { world, cobject, .. } = *self.motion;
        let q = self.motion.at(time);
        let at = Configuration::Coordinates(&q);
        context.with_scene(cobject, world, at, |context, scene| {
            Ok(obstacle.lower(context, scene, self.allowance.distance)? > 0.0)
        })
    }

    /// Whether, to first order, no clearance falls below a lowest one up to a time. Where that is 0, and what is apart is so at the time,
    /// it is in between to second order too: a clearance that bends upwards lies above its first order, one that bends downwards is
    /// least at an end.
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
        let list = obstacle.witnesses(context, self.start, request)?;
        let keeps_off =
            |a: &Approach| a.clearance + time * dot(a.gradient, self.motion.v) >= lowest;
        let is_known = !list.truncated && list.witnesses.iter().all(|w| w.contact_count > 0);
        Ok(is_known && list.approaches().iter().all(keeps_off))
    }
}

impl Obstacle for PairAtStart<'_> {
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

    fn separation(
        &self,
        context: &mut QueryContext,
        motion: &LinearMotion,
        start: &Scene,
    ) -> Result<Option<Separation>> {
        let target = self.target;
        let (link, None) = target.links() else {
            return Ok(None);
        };
        let Some((hit, _)) = context.nearest(&[target], f64::INFINITY)?.hit else {
            return Ok(None);
        };
        if hit.contained.is_some() {
            return Ok(None);
        }
        let pairing = target.pairing();
        let scratch = &mut PrimitiveScratch::default();
        let closest = pairing.closest(&hit, scratch);
        let contacts = pairing.world_contacts(hit.key.primitives, &closest, scratch);
        let along = contacts.first().and_then(|contact| {
            let normal = contact.normal;
            let rate = motion.directed_rate(start, link, target.sides[0], &normal)?;
            Some((normal, rate))
        });
        Ok(along.map(|(normal, rate)| Separation {
            gap: pairing.gap_along(&normal) - target.margin(),
            rate,
        }))
    }

    fn touching(&self) -> f64 {
        let [(_, a), (_, b)] = self.target.sides;
        let size = self.target.pairing().precision.size;
        TOUCHING * (size + a.translation.norm() + b.translation.norm())
    }
}

impl Obstacle for PureSet {
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

    /// A floor is itself the plane.
    fn separation(
        &self,
        _: &mut QueryContext,
        motion: &LinearMotion,
        start: &Scene,
    ) -> Result<Option<Separation>> {
        let PureShape::Floor { links, normal, .. } = &self.shape else {
            return Ok(None);
        };
        let &[link] = &links[..] else {
            return Ok(None);
        };
        let Some(measure) = self.measure(&start.space_state())? else {
            return Ok(None);
        };
        let carried = start.link(link);
        let rate = carried.and_then(|body| motion.directed_rate(start, link, body, normal));
        Ok(rate.map(|rate| Separation {
            gap: measure.signed - measure.error,
            rate,
        }))
    }

    /// Its lower bound has the rounding.
    fn touching(&self) -> f64 {
        0.0
    }
}
