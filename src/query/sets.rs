//! Classes and distances of sets made of others: by their trees, each part once.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use super::answer::Distance;
use super::candidates::CandidateFilter;
use super::context::QueryContext;
use super::pure_answer::PureAt;
use super::scene::{Group, Scene};
use super::target::Target;
use crate::cobject::{CObject, Class, Set};
use crate::error::Result;

/// What parts have answered: by their serials, and whether the complement was asked.
type Known<T> = HashMap<(u64, bool), T, RandomState>;

/// Memory for what the parts of a set answer, used again by the next call.
#[derive(Default)]
pub(super) struct Answers {
    classes: Known<Class>,
    within: Known<bool>,
    distances: Known<Distance>,
}

/// Memory is used again for so many parts: more would be swept by each call.
const MAX_KEPT: usize = 1024;

fn emptied<T>(mut known: Known<T>) -> Known<T> {
    if known.capacity() > MAX_KEPT {
        return Known::default();
    }
    known.clear();
    known
}

/// How a set is made of its parts, or of their complements.
enum Composition<'a> {
    /// A union: of what is induced, and of parts.
    Any(Option<&'a Group>, &'a [std::sync::Arc<CObject>]),
    /// An intersection.
    All(Option<&'a Group>, &'a [std::sync::Arc<CObject>]),
}

/// A set, or its complement by De Morgan's laws: complements stand at leaves only.
fn made(set: &Set, complement: bool) -> Composition<'_> {
    match set {
        Set::Union { induced, others } => {
            let group = (!induced.is_empty()).then_some(&induced[..]);
            if complement {
                Composition::All(group, others)
            } else {
                Composition::Any(group, others)
            }
        }
        _ if complement => Composition::Any(None, set.parts()),
        _ => Composition::All(None, set.parts()),
    }
}

/// The parts with the cheap ones first.
fn cheap_first(parts: &[std::sync::Arc<CObject>]) -> impl Iterator<Item = &CObject> + Clone {
    let all = || parts.iter().map(|part| &**part);
    all()
        .filter(is_pure)
        .chain(all().filter(|part| !is_pure(part)))
}

fn is_pure(part: &&CObject) -> bool {
    matches!(part.set(), Set::Pure(_))
}

impl QueryContext {
    pub(super) fn class_of(&mut self, cobject: &CObject, scene: &Scene) -> Result<Class> {
        let mut known = emptied(std::mem::take(&mut self.answers.classes));
        let class = self.class_among(cobject, scene, &mut known);
        self.answers.classes = known;
        class
    }

    fn class_among(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        known: &mut Known<Class>,
    ) -> Result<Class> {
        match cobject.set() {
            Set::Pure(set) => {
                let complement = false;
                return PureAt {
                    set,
                    complement,
                    scene,
                }
                .class();
            }
            Set::Union { induced, others } if others.is_empty() => {
                return self.class_of_group(induced, scene);
            }
            _ => {}
        }
        if let Some(class) = known.get(&(cobject.serial(), false)) {
            return Ok(*class);
        }
        let parts = cheap_first(cobject.set().parts());
        let class = match cobject.set() {
            Set::Intersection(_) => {
                let mut least = Class::Inside;
                for part in parts {
                    least = least.min(self.class_among(part, scene, known)?);
                    if least == Class::Outside {
                        break;
                    }
                }
                least
            }
            Set::Complement(part) => self.class_among(part, scene, known)?.reversed(),
            Set::Union { induced, .. } => {
                let mut most = Class::Outside;
                for part in parts.clone().filter(is_pure) {
                    most = most.max(self.class_among(part, scene, known)?);
                }
                if most < Class::Inside && !induced.is_empty() {
                    most = most.max(self.class_of_group(induced, scene)?);
                }
                for part in parts.filter(|part| !is_pure(part)) {
                    if most == Class::Inside {
                        break;
                    }
                    most = most.max(self.class_among(part, scene, known)?);
                }
                most
            }
            Set::Pure(_) => Class::Outside,
        };
        known.insert((cobject.serial(), false), class);
        Ok(class)
    }

    /// Operation 4 for a union of induced sets.
    pub(super) fn class_of_group(&mut self, group: &Group, scene: &Scene) -> Result<Class> {
        if self.recent_is_within(scene, group, 0.0)? {
            return Ok(Class::Inside);
        }
        let wanted = CandidateFilter {
            in_contact: true,
            ..CandidateFilter::within(0.0)
        };
        let candidates = self.candidates(scene, group, wanted)?;
        let class = if self.any_within(&candidates, |_| 0.0)? {
            Class::Inside
        } else if self.any_in_contact(&candidates, 0.0)? {
            Class::Contact
        } else {
            Class::Outside
        };
        self.keep_memory(candidates);
        Ok(class)
    }

    /// Whether some pair is within its contact epsilon, if no distance is below `lower`.
    pub(super) fn any_in_contact(&mut self, candidates: &[Target], lower: f64) -> Result<bool> {
        let contact_epsilon = |c: &Target| {
            let epsilon = c.options.contact_epsilon;
            if epsilon > 0.0 && epsilon >= lower {
                epsilon
            } else {
                f64::NEG_INFINITY
            }
        };
        if candidates.iter().any(|c| contact_epsilon(c) >= 0.0) {
            self.any_within(candidates, contact_epsilon)
        } else {
            Ok(false)
        }
    }

    pub(super) fn set_within(
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
        let within = match made(cobject.set(), complement) {
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

    fn group_within(&mut self, group: &Group, scene: &Scene, threshold: f64) -> Result<bool> {
        if self.recent_is_within(scene, group, threshold)? {
            return Ok(true);
        }
        let candidates = self.candidates(scene, group, CandidateFilter::within(threshold))?;
        let is_within = self.any_within(&candidates, |_| threshold)?;
        self.keep_memory(candidates);
        Ok(is_within)
    }

    pub(super) fn set_distance(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        max_distance: f64,
    ) -> Result<Distance> {
        let mut known = emptied(std::mem::take(&mut self.answers.distances));
        let found = self.distance_from(cobject, scene, max_distance, false, &mut known);
        self.answers.distances = known;
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
        known: &mut Known<Distance>,
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
            Set::Complement(part) => {
                return self.distance_from(part, scene, max_distance, !complement, known);
            }
            Set::Union { induced, others } if others.is_empty() && !complement => {
                return self.distance_of_group(induced, scene, max_distance);
            }
            _ => {}
        }
        let key = (cobject.serial(), complement);
        if let Some(distance) = known.get(&key) {
            return Ok(distance.clone());
        }
        let (is_union, group, parts) = match made(cobject.set(), complement) {
            Composition::Any(group, parts) => (true, group, parts),
            Composition::All(group, parts) => (false, group, parts),
        };
        let mut found = match group {
            Some(group) if is_union => Some(self.distance_of_group(group, scene, max_distance)?),
            Some(group) => Some(self.distance_from_outside(group, scene)?),
            None => None,
        };
        for part in parts {
            let next = self.distance_from(part, scene, max_distance, complement, known)?;
            found = Some(match found {
                None => next,
                Some(found) if is_union => found.least(next),
                Some(found) => found.most(next),
            });
        }
        let found = found.unwrap_or_else(|| Distance::empty(0));
        known.insert(key, found.clone());
        Ok(found)
    }

    /// Operation 6 for a union of induced sets.
    pub(super) fn distance_of_group(
        &mut self,
        group: &Group,
        scene: &Scene,
        max_distance: f64,
    ) -> Result<Distance> {
        let nearest = self.recent_distance(scene, group, max_distance)?;
        let wanted = CandidateFilter {
            nearest: Some(nearest),
            ..CandidateFilter::within(0.0)
        };
        let candidates = self.candidates(scene, group, wanted)?;
        let distance = self.distance_among(group, scene, &candidates, max_distance)?;
        self.keep_memory(candidates);
        Ok(distance)
    }

    pub(super) fn distance_among(
        &mut self,
        group: &Group,
        scene: &Scene,
        candidates: &[Target],
        max_distance: f64,
    ) -> Result<Distance> {
        let is_all_asked = max_distance == f64::INFINITY;
        if scene.is_empty(group) || (candidates.is_empty() && is_all_asked) {
            return Ok(Distance::empty(scene.version()));
        }
        let found = self.nearest(candidates, max_distance)?;
        let leaf = |term: u32| group[term as usize].leaf;
        Ok(Distance {
            version: scene.version(),
            ..Distance::from_found(&found, max_distance, leaf, self.scratch.for_primitives())
        })
    }

    /// The distance from the complement of a union of induced sets: 0 where nothing meets; else not known.
    fn distance_from_outside(&mut self, group: &Group, scene: &Scene) -> Result<Distance> {
        let meets = self.group_within(group, scene, 0.0)?;
        Ok(Distance::of_place(!meets))
    }
}
