//! What touches at the start of a slide, or is nearer than rounding. There no bound over an interval parts a pair, so that the interval
//! proof follows it from a later time on. Up to there the contacts of what touches must not come nearer, to first order, and those of
//! what is apart stay so, to second order. Where a plane that nothing crosses separates the two for the whole motion, it need not follow
//! them at all.

use super::half_spaces::dot;
use super::linear_motion::{LinearMotion, STEP_FRACTION};
use super::link_rounding::LinkRounding;
use super::set_tree::{LeafContent, SetTree};
use super::slide_step::Approach;
use super::start_obstacle::{Obstacle, PairAtStart, Separation, Start};
use super::way::Way;
use crate::cobject::{Induced, PureSet};
use crate::error::Result;
use crate::query::{
    CacheKey, CandidateFilter, Configuration, Group, QueryContext, Target, WitnessRequest,
};
use crate::robot::LinkSpeeds;

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

/// An obstacle near the start.
struct Near<'n, 'p> {
    /// Bounds how much the distance falls in the whole motion.
    rate: f64,
    start: &'n Start<'p>,
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
        let scene = &motion.scene(motion.q)?;
        let way = Way::straight(*motion);
        let motions = way.link_motions();
        let start = &Start {
            motion,
            scene,
            rounding: LinkRounding {
                motion,
                speeds: &LinkSpeeds::new(&motions),
                poses: scene.poses(),
                of_coordinates: &way.rounding(),
                share: 1.0,
            },
        };
        let mut found = StartContacts::default();
        for leaf in &SetTree::new(motion.cobject, false).leaves {
            let goes_on = match leaf.content {
                LeafContent::Induced(group) => {
                    let mut terms = group.chunks(1);
                    terms.try_fold(true, |goes_on, term| {
                        Ok(goes_on && self.add_near_pairs(start, term, allowance, &mut found)?)
                    })?
                }
                LeafContent::Known(_) => true,
                LeafContent::Pure(set) => self.add_near_parts(start, set, allowance, &mut found)?,
            };
            if !goes_on {
                return Ok(None);
            }
        }
        Ok(Some(found))
    }

    fn add_near_pairs(
        &mut self,
        start: &Start,
        term: &Group,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
        let &Start { motion, scene, .. } = start;
        let checked = scene.checked(term)?;
        let filter = CandidateFilter::within(allowance.distance);
        let meter = self.scratch.meter_mut();
        let candidates = scene.candidates(checked, filter, &mut self.candidates, meter)?;
        for &target in &candidates {
            if target.bound > allowance.distance {
                continue;
            }
            // Searched alone, so its rank is 0: hits name their pair by rank.
            let target = Target { rank: 0, ..target };
            let near = Near {
                rate: motion.rate(scene, &target),
                start,
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
        start: &Start,
        set: &PureSet,
        allowance: &TouchAllowance,
        found: &mut StartContacts,
    ) -> Result<bool> {
        let motion = start.motion;
        let space = motion.cobject.space();
        let straight = || space.straight(motion.q, motion.v).collect();
        let parts = set.parts_on_way(space, straight);
        for (number, part) in parts.iter().enumerate() {
            let near = Near {
                rate: part.motion_bound(space, motion.q, motion.v),
                start,
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
        let (lower, plane) = obstacle.at_start(context, self.start, cutoff)?;
        if lower >= cutoff {
            return Ok(Some(0.0));
        }
        let rounding = obstacle.rounding(self.start);
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
        let bend = 2.0 * self.rate * obstacle.turn(self.start.motion);
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
        let LinearMotion { world, cobject, .. } = *self.start.motion;
        let q = self.start.motion.at(time);
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
        let list = obstacle.witnesses(context, self.start.scene, request)?;
        let keeps_off =
            |a: &Approach| a.clearance + time * dot(a.gradient, self.start.motion.v) >= lowest;
        let is_known = !list.truncated && list.witnesses.iter().all(|w| w.contact_count > 0);
        Ok(is_known && list.approaches().iter().all(keeps_off))
    }
}
