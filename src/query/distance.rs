//! Operation 6: the distance from contact and the nearest primitive pair, for a C-object and for many body pairs.

use smallvec::SmallVec;

use super::answer::Distance;
use super::body_pairs::CheckedGroup;
use super::cache_key::PairIds;
use super::candidates::{CandidateFilter, ListOrder};
use super::combination::{Composition, Memo, composition, emptied};
use super::context::{QueryContext, check_threshold};
use super::pure_answer::PureAt;
use super::scene::{Configuration, Group, Scene};
use super::target::Target;
use super::world::World;
use crate::cobject::{CObject, Set};
use crate::convex::PrimitiveDistance;
use crate::error::Result;
use crate::pair::{Hit, NearestPrimitives, traverse, visit_pair};

/// The nearest primitive pair over all targets.
pub(crate) struct NearestHit<'t, 'a> {
    /// The hit and its body pair; `None` if nothing is within the limit.
    pub hit: Option<(Hit, &'t Target<'a>)>,
    /// A lower bound of the distances of all pairs seen, safe against rounding.
    pub lower: f64,
    /// The measurement of the hit, if the search kept it.
    pub measured: Option<PrimitiveDistance>,
}

/// What the primitive pair found last says of the distance of a group.
struct RecentDistance {
    /// An upper bound.
    at_most: f64,
    /// The pair as it is now, if it is within the limit.
    found: Option<Recent>,
}

impl RecentDistance {
    /// The pair, if it meets: none that comes later in order of ids is asked for.
    fn meeting(&self) -> Option<Recent> {
        self.found.filter(|recent| recent.hit.distance == 0.0)
    }
}

/// The primitive pair found last, at the configuration asked about.
#[derive(Clone, Copy)]
pub(super) struct Recent {
    ids: PairIds,
    hit: Hit,
    /// A lower bound of its distance.
    lower: f64,
    measured: Option<PrimitiveDistance>,
    /// No other term holds a pair with its ids.
    is_alone: bool,
}

impl Recent {
    /// Shows it to a visitor, as if it had been measured anew, as one of the pair of bodies with this rank.
    fn show(mut self, rank: u32, visitor: &mut NearestPrimitives) {
        self.hit.key.pair = rank;
        visitor.take(self.hit, self.lower, self.measured.as_ref());
    }

    /// Its bodies in a list in order of bounds; `None` if another term holds them too.
    fn target_among<'t, 'a>(&self, targets: &'t [Target<'a>]) -> Option<&'t Target<'a>> {
        let mut near = targets
            .iter()
            .take_while(|target| self.is_alone && target.bound <= self.hit.distance);
        near.find(|target| target.ids() == self.ids)
    }
}

impl QueryContext {
    /// Operation 6: the distance from contact, up to `max_distance`, and the nearest primitive pair.
    pub fn distance(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        max_distance: f64,
    ) -> Result<Distance> {
        let world = self.look(cobject);
        self.refining(|context| context.distance_in(&world, cobject, at, max_distance))
    }

    /// The same in a given world.
    pub fn distance_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        at: Configuration,
        max_distance: f64,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        cobject.require_one_metric()?;
        self.with_scene(cobject, world, at, |context, scene| {
            context.set_distance(cobject, scene, max_distance)
        })
    }

    pub(super) fn set_distance(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        max_distance: f64,
    ) -> Result<Distance> {
        let mut memo = emptied(std::mem::take(&mut self.answers.distances));
        let found = self.distance_from(cobject, scene, max_distance, false, &mut memo);
        self.answers.distances = memo;
        Ok(Distance {
            version: scene.version(),
            ..found?
        })
    }

    /// The distance from the set, or from its complement.
    fn distance_from(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        max_distance: f64,
        complement: bool,
        memo: &mut Memo<Distance>,
    ) -> Result<Distance> {
        match cobject.set() {
            Set::Pure(set) => {
                let pure = PureAt {
                    set,
                    complement,
                    scene,
                };
                return pure.distance(max_distance);
            }
            Set::Known(known) => {
                return self.distance_from(&known.of, scene, max_distance, complement, memo);
            }
            Set::Complement(part) => {
                return self.distance_from(part, scene, max_distance, !complement, memo);
            }
            Set::Union { induced, others } if others.is_empty() && !complement => {
                return self.distance_of_group(induced, scene, max_distance);
            }
            _ => {}
        }
        let key = (cobject.serial(), complement);
        if let Some(distance) = memo.get(&key) {
            return Ok(distance.clone());
        }
        let (is_union, group, parts) = match composition(cobject.set(), complement) {
            Composition::Any(group, parts) => (true, group, parts),
            Composition::All(group, parts) => (false, group, parts),
        };
        let mut found = match group {
            Some(group) if is_union => Some(self.distance_of_group(group, scene, max_distance)?),
            Some(group) => Some(self.distance_from_outside(group, scene)?),
            None => None,
        };
        for part in parts {
            let next = self.distance_from(part, scene, max_distance, complement, memo)?;
            found = Some(match found {
                None => next,
                Some(found) if is_union => found.least(next),
                Some(found) => found.most(next),
            });
        }
        let found = found.unwrap_or_else(|| Distance::empty(0));
        memo.insert(key, found.clone());
        Ok(found)
    }

    /// Operation 6 for a union of induced sets.
    pub(super) fn distance_of_group(
        &mut self,
        group: &Group,
        scene: &Scene,
        max_distance: f64,
    ) -> Result<Distance> {
        let checked = scene.checked(group)?;
        let recent = self.recent_distance(scene, checked, max_distance)?;
        let mut distance = Distance::unknown();
        let meeting = recent.meeting();
        if meeting.is_some() || self.met_last {
            distance = self.distance_if_meeting(checked, scene, meeting)?;
        }
        if meeting.is_none() && !distance.is_zero() {
            let filter = CandidateFilter {
                nearest: Some(recent.at_most),
                ..CandidateFilter::within(0.0)
            };
            let candidates = self.candidates(scene, checked, filter)?;
            distance =
                self.distance_among(group, scene, &candidates, max_distance, recent.found)?;
            self.keep_memory(candidates);
        }
        self.met_last = distance.is_zero();
        if self.gap.is_some() && distance.excess > 0.0 {
            // What is nearest once surfaces are refined need not be so before: all pairs that may be.
            let filter = CandidateFilter::within(distance.upper.min(max_distance));
            let candidates = self.candidates(scene, checked, filter)?;
            if self.refines(&candidates) {
                let leaf = |term: u32| group[term as usize].leaf;
                distance = Distance {
                    version: scene.version(),
                    ..self.refined_distance(&candidates, max_distance, leaf)?
                };
            }
            self.keep_memory(candidates);
        }
        Ok(distance)
    }

    /// The distance of the first pair that meets, in order of ids; of no pairs behind `last`, which is known to. Something else where none
    /// meets.
    fn distance_if_meeting(
        &mut self,
        group: CheckedGroup,
        scene: &Scene,
        last: Option<Recent>,
    ) -> Result<Distance> {
        let filter = CandidateFilter {
            order: ListOrder::Ids,
            last: last.map(|last| last.ids),
            ..CandidateFilter::within(0.0)
        };
        let candidates = self.candidates(scene, group, filter)?;
        // The last of the list is this pair, if it is there.
        let at_end = candidates.last();
        let is_known =
            |last: &Recent| last.is_alone && at_end.is_some_and(|target| target.ids() == last.ids);
        let mut visitor = NearestPrimitives::up_to(0.0);
        if let Some(known) = last.filter(is_known) {
            known.show(candidates.len() as u32 - 1, &mut visitor);
            visitor.measured = known.measured;
        }
        let found = self.nearest_from(&candidates, visitor, None)?;
        let distance = self.distance_of_found(&group, scene, &found, 0.0);
        self.keep_memory(candidates);
        Ok(distance)
    }

    pub(super) fn distance_among(
        &mut self,
        group: &Group,
        scene: &Scene,
        candidates: &[Target],
        max_distance: f64,
        recent: Option<Recent>,
    ) -> Result<Distance> {
        let is_all_asked = max_distance == f64::INFINITY;
        if scene.is_empty(group) || (candidates.is_empty() && is_all_asked) {
            return Ok(Distance::empty(scene.version()));
        }
        let visitor = NearestPrimitives::up_to(max_distance);
        let found = self.nearest_from(candidates, visitor, recent)?;
        Ok(self.distance_of_found(group, scene, &found, max_distance))
    }

    fn distance_of_found(
        &mut self,
        group: &Group,
        scene: &Scene,
        found: &NearestHit,
        max_distance: f64,
    ) -> Distance {
        let leaf = |term: u32| group[term as usize].leaf;
        Distance {
            version: scene.version(),
            ..Distance::from_found(found, max_distance, leaf, self.scratch.for_primitives())
        }
    }

    /// The distance from the complement of a union of induced sets: 0 where no bodies meet; else unknown.
    fn distance_from_outside(&mut self, group: &Group, scene: &Scene) -> Result<Distance> {
        let meets = self.group_within(group, scene, 0.0)?;
        Ok(Distance::of_place(!meets))
    }

    /// What the primitive pair found last says of the distance, up to `limit`.
    fn recent_distance(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        limit: f64,
    ) -> Result<RecentDistance> {
        let ids = self.recent.map(|key| key.ids());
        let (mut at_most, mut found) = (limit, None);
        let mut terms = 0;
        self.visit_recent(scene, group, |pairing, places, margin, scratch| {
            let mut visitor = NearestPrimitives::up_to(at_most);
            visitor.margin = margin;
            let _ = visit_pair(pairing, places, scratch, &mut visitor);
            (at_most, terms) = (visitor.limit(), terms + 1);
            if let Some((ids, hit)) = ids.zip(visitor.best) {
                found = Some(Recent {
                    ids,
                    hit,
                    lower: visitor.lower,
                    measured: visitor.measured,
                    is_alone: true,
                });
            }
        })?;
        if let Some(found) = &mut found {
            found.is_alone = terms == 1;
        }
        Ok(RecentDistance { at_most, found })
    }

    /// The nearest primitive pair, or piece of a body inside another, over all targets, if within `limit`. Targets must be
    /// sorted by bound.
    pub(crate) fn nearest<'t, 'a>(
        &mut self,
        targets: &'t [Target<'a>],
        limit: f64,
    ) -> Result<NearestHit<'t, 'a>> {
        self.nearest_from(targets, NearestPrimitives::up_to(limit), None)
    }

    /// The same, if nearer than what the visitor has found. What `recent` holds is not measured again.
    fn nearest_from<'t, 'a>(
        &mut self,
        targets: &'t [Target<'a>],
        mut visitor: NearestPrimitives,
        recent: Option<Recent>,
    ) -> Result<NearestHit<'t, 'a>> {
        // Warm start: the last nearest primitive pair of each two bodies bounds the distance before any tree is traversed. Where only what
        // meets is asked for, no bound is needed; nor where all walks are short, which find what is nearest as soon.
        let are_walks_short = targets.iter().all(Target::is_walked_at_once);
        let starts_warm = targets.len() > 1 && visitor.limit() > 0.0 && !are_walks_short;
        let recent_rank = recent.and_then(|recent| {
            let target = recent.target_among(targets)?;
            recent.show(target.rank, &mut visitor);
            Some(target.rank)
        });
        // The ranks of the pairs whose remembered primitives are measured.
        let mut shown: SmallVec<[u32; 16]> = recent_rank.into_iter().collect();
        for target in targets.iter().filter(|_| starts_warm) {
            visitor.margin = target.margin();
            visitor.body_pair = target.rank;
            if target.bound > visitor.limit() {
                break;
            }
            if visitor.is_outranked() {
                continue;
            }
            self.count_body_pair()?;
            if recent_rank != Some(target.rank)
                && let Some(places) = self.remembered(&target.key)
            {
                let _ = visit_pair(&target.pairing(), places, &mut self.scratch, &mut visitor);
                shown.push(target.rank);
            }
        }
        for target in targets {
            visitor.margin = target.margin();
            visitor.body_pair = target.rank;
            if target.bound > visitor.limit() || visitor.is_outranked() {
                continue;
            }
            self.count_body_pair()?;
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                if pairing.has_solid() {
                    let contained = pairing.contained(target.rank, &mut self.scratch);
                    contained
                        .iter()
                        .for_each(|&hit| visitor.take(hit, 0.0, None));
                }
                if pairing.only_places().is_some() && shown.contains(&target.rank) {
                    continue;
                }
                let first = match are_walks_short {
                    true => None,
                    false => self.remembered(&target.key),
                };
                let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        self.scratch.meter().check()?;
        let lower = visitor.lower;
        let hit = visitor.best.and_then(|hit| {
            let target = targets.iter().find(|target| target.rank == hit.key.pair)?;
            if hit.contained.is_none() {
                self.remember(target.key, hit.places);
            }
            Some((hit, target))
        });
        Ok(NearestHit {
            hit,
            lower,
            measured: visitor.measured,
        })
    }
}
