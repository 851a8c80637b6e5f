//! Whether the distance may be at most a threshold, for a C-object and for many body pairs.

use super::body_pairs::{CheckedGroup, order_of_any};
use super::candidates::CandidateFilter;
use super::combination::{Composition, Memo, cheap_first, composition, emptied};
use super::context::{QueryContext, check_threshold};
use super::pure_answer::PureAt;
use super::scene::{Configuration, Group, Scene};
use super::target::Target;
use super::world::World;
use crate::cobject::{CObject, Class, Set};
use crate::error::Result;
use crate::pair::{Pairing, Within, traverse, visit_pair};
use smallvec::SmallVec;

impl QueryContext {
    /// Whether the distance may be at most `threshold`: doubt within rounding counts as within, and so does an unknown
    /// distance.
    pub fn within(&mut self, cobject: &CObject, at: Configuration, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        cobject.require_one_metric()?;
        let world = self.look(cobject);
        self.refining(|context| context.within_in(&world, cobject, at, threshold))
    }

    /// The same in a given world, with a checked threshold and metric.
    pub(crate) fn within_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        at: Configuration,
        threshold: f64,
    ) -> Result<bool> {
        self.with_scene(cobject, world, at, |context, scene| {
            context.set_within(cobject, scene, threshold)
        })
    }

    pub(crate) fn set_within(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        threshold: f64,
    ) -> Result<bool> {
        let mut memo = emptied(std::mem::take(&mut self.answers.within));
        let within = self.within_among(cobject, scene, threshold, false, &mut memo);
        self.answers.within = memo;
        within
    }

    /// Whether the lower bound of the distance, from the set or from its complement, is at most the threshold.
    fn within_among(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        threshold: f64,
        complement: bool,
        memo: &mut Memo<bool>,
    ) -> Result<bool> {
        match cobject.set() {
            Set::Pure(set) => {
                let pure = PureAt {
                    set,
                    complement,
                    scene,
                };
                let lower = pure.bounded_distance()?.lower;
                return Ok(lower <= threshold && lower < f64::INFINITY);
            }
            Set::Known(known) => {
                let class = match threshold == 0.0 {
                    true => known.class_at(scene.space_state().q, complement),
                    false => None,
                };
                return match class {
                    Some(class) => Ok(class == Class::Inside),
                    None => self.within_among(&known.of, scene, threshold, complement, memo),
                };
            }
            Set::Complement(part) => {
                return self.within_among(part, scene, threshold, !complement, memo);
            }
            Set::Union { induced, others } if others.is_empty() && !complement => {
                return self.group_within(induced, scene, threshold);
            }
            _ => {}
        }
        let key = (cobject.serial(), complement);
        if let Some(within) = memo.get(&key) {
            return Ok(*within);
        }
        let mut part_within = |part: &CObject, memo: &mut Memo<bool>| {
            self.within_among(part, scene, threshold, complement, memo)
        };
        let within = match composition(cobject.set(), complement) {
            Composition::Any(group, parts) => {
                let mut any = false;
                for part in cheap_first(parts) {
                    any = any || part_within(part, memo)?;
                }
                match group {
                    Some(group) if !any => self.group_within(group, scene, threshold)?,
                    _ => any,
                }
            }
            // The group is skipped: the distance from its complement is 0 or unknown, so its lower bound is 0.
            Composition::All(_, parts) => {
                let mut all = true;
                for part in cheap_first(parts) {
                    all = all && part_within(part, memo)?;
                }
                all
            }
        };
        memo.insert(key, within);
        Ok(within)
    }

    pub(super) fn group_within(
        &mut self,
        group: &Group,
        scene: &Scene,
        threshold: f64,
    ) -> Result<bool> {
        let group = scene.checked(group)?;
        if self.recent_is_within(scene, group, threshold)? {
            return Ok(true);
        }
        let filter = CandidateFilter {
            order: order_of_any(&group),
            ..CandidateFilter::within(threshold)
        };
        let candidates = self.candidates(scene, group, filter)?;
        let is_within = self.any_within(&candidates, |_| threshold)?;
        self.keep_memory(candidates);
        Ok(is_within)
    }

    /// Whether the primitive pair found last is within the threshold now (temporal coherence): along a motion it mostly is,
    /// and then the query is decided. It is asked no more once it was not, until the same pair is found twice in a row: at poses that have
    /// nothing to do with each other it would be asked in vain.
    pub(super) fn recent_is_within(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        threshold: f64,
    ) -> Result<bool> {
        if !self.recent_decides {
            return Ok(false);
        }
        let mut is_within = false;
        let refines = self.gap.is_some();
        self.visit_recent(scene, group, |pairing, places, margin, scratch| {
            // The bodies may be apart though their triangles grown by the deviations are not.
            if refines && (pairing.a.curved().is_some() || pairing.b.curved().is_some()) {
                return;
            }
            let mut visitor = Within {
                margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(pairing, places, scratch, &mut visitor);
            is_within |= visitor.found.is_some();
        })?;
        self.recent_decides = is_within;
        Ok(is_within)
    }

    /// Whether some primitive pair is within the threshold, or a body inside another; the threshold may depend on the
    /// target. The pair found last is tested first, then the others by their bounds: what is likely to meet comes soon.
    pub(super) fn any_within(
        &mut self,
        targets: &[Target],
        threshold: impl Fn(&Target) -> f64,
    ) -> Result<bool> {
        let recent = self.recent;
        let mut order: SmallVec<[(f64, u32); 32]> = SmallVec::new();
        for (target, place) in targets.iter().zip(0..) {
            let bound = match recent == Some(target.key) {
                true => f64::NEG_INFINITY,
                false => target.bound,
            };
            order.push((bound, place));
        }
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for &(_, place) in &order {
            let target = &targets[place as usize];
            let threshold = threshold(target);
            self.count_body_pair()?;
            let Some(pairing) = target.pairing_within(threshold) else {
                continue;
            };
            let is_one_inside = pairing.has_solid() && pairing.is_one_inside(&mut self.scratch);
            self.scratch.meter().check()?;
            if is_one_inside {
                return Ok(true);
            }
            if let Some(places) = self.first_within(&pairing, target, threshold)? {
                if self.refines(std::slice::from_ref(target))
                    && !self.refined_within(target, threshold)?
                {
                    continue;
                }
                self.remember(target.key, places);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The places of the first primitive pair found within a threshold.
    fn first_within(
        &mut self,
        pairing: &Pairing,
        target: &Target,
        threshold: f64,
    ) -> Result<Option<[u32; 2]>> {
        let mut visitor = Within {
            margin: target.margin(),
            threshold,
            found: None,
        };
        let first = self.remembered(&target.key);
        let _ = traverse(pairing, first, &mut self.scratch, &mut visitor);
        self.scratch.meter().check()?;
        Ok(visitor.found)
    }
}
