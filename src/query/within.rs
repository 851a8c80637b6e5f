//! Whether the distance may be at most a threshold: of a C-object, and of many body pairs.

use super::body_pairs::CheckedGroup;
use super::candidates::CandidateFilter;
use super::combination::{Composition, Known, cheap_first, composition, emptied};
use super::context::{QueryContext, check_threshold};
use super::pure_answer::PureAt;
use super::scene::{Configuration, Group, Scene};
use super::target::Target;
use crate::cobject::{CObject, Set};
use crate::error::Result;
use crate::pair::{Pairing, Within, traverse, visit_pair};

impl QueryContext {
    /// Whether the distance may be at most `threshold`: doubt within rounding counts as within, and so does a distance of
    /// which nothing is known.
    pub fn within(&mut self, cobject: &CObject, at: Configuration, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        cobject.require_one_metric()?;
        let world = self.look(cobject);
        self.ask(cobject, &world, at, |context, scene| {
            context.set_within(cobject, scene, threshold)
        })
    }

    pub(crate) fn set_within(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        threshold: f64,
    ) -> Result<bool> {
        let mut known = emptied(std::mem::take(&mut self.answers.within));
        let within = self.within_among(cobject, scene, threshold, false, &mut known);
        self.answers.within = known;
        within
    }

    /// Whether the lower bound of the distance, from the set or from its complement, is at most the threshold.
    fn within_among(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        threshold: f64,
        complement: bool,
        known: &mut Known<bool>,
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
            Set::Complement(part) => {
                return self.within_among(part, scene, threshold, !complement, known);
            }
            Set::Union { induced, others } if others.is_empty() && !complement => {
                return self.group_within(induced, scene, threshold);
            }
            _ => {}
        }
        let key = (cobject.serial(), complement);
        if let Some(within) = known.get(&key) {
            return Ok(*within);
        }
        let mut ask = |part: &CObject, known: &mut Known<bool>| {
            self.within_among(part, scene, threshold, complement, known)
        };
        let within = match composition(cobject.set(), complement) {
            Composition::Any(group, parts) => {
                let mut any = false;
                for part in cheap_first(parts) {
                    any = any || ask(part, known)?;
                }
                match group {
                    Some(group) if !any => self.group_within(group, scene, threshold)?,
                    _ => any,
                }
            }
            // The distance from the complement of what is induced is not known when it is not 0: no bound is above 0.
            Composition::All(_, parts) => {
                let mut all = true;
                for part in cheap_first(parts) {
                    all = all && ask(part, known)?;
                }
                all
            }
        };
        known.insert(key, within);
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
        let candidates = self.candidates(scene, group, CandidateFilter::within(threshold))?;
        let is_within = self.any_within(&candidates, |_| threshold)?;
        self.keep_memory(candidates);
        Ok(is_within)
    }

    /// Whether the primitive pair that was found within a threshold last is within one now: mostly so along a motion, and
    /// then nothing else need be asked.
    pub(super) fn recent_is_within(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        threshold: f64,
    ) -> Result<bool> {
        let mut is_within = false;
        self.visit_recent(scene, group, |pairing, places, options, scratch| {
            let mut visitor = Within::<false> {
                margin: options.margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(pairing, places, scratch, &mut visitor);
            is_within |= visitor.found.is_some();
        })?;
        Ok(is_within)
    }

    /// Whether some primitive pair is within the threshold, or a body inside another; the threshold may differ from
    /// target to target.
    pub(super) fn any_within(
        &mut self,
        targets: &[Target],
        threshold: impl Fn(&Target) -> f64,
    ) -> Result<bool> {
        // Those last found to meet first.
        let recent = self.recent;
        let is_recent = |target: &&Target| recent == Some(target.key);
        let first = targets.iter().filter(is_recent);
        for target in first.chain(targets.iter().filter(|target| !is_recent(target))) {
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
            let margin = target.options.margin;
            let found = if threshold + margin > 0.0 {
                self.first_within::<true>(&pairing, target, threshold)?
            } else {
                self.first_within::<false>(&pairing, target, threshold)?
            };
            if let Some(places) = found {
                self.remember(target.key, places);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The places of the first primitive pair that is found within a threshold.
    fn first_within<const REFINES: bool>(
        &mut self,
        pairing: &Pairing,
        target: &Target,
        threshold: f64,
    ) -> Result<Option<[u32; 2]>> {
        let mut visitor = Within::<REFINES> {
            margin: target.options.margin,
            threshold,
            found: None,
        };
        let first = self.remembered(&target.key);
        let _ = traverse(pairing, first, &mut self.scratch, &mut visitor);
        self.scratch.meter().check()?;
        Ok(visitor.found)
    }
}
