//! Operation 4: whether a configuration is inside, in contact or outside.

use std::sync::Arc;

use super::body_pairs::order_of_any;
use super::candidates::CandidateFilter;
use super::combination::{Memo, cheap_first, emptied, is_pure};
use super::context::QueryContext;
use super::scene::{Configuration, Group, Scene};
use super::target::Target;
use super::world::World;
use crate::cobject::{CObject, Class, Set};
use crate::error::Result;

impl QueryContext {
    /// Operation 4: whether the configuration is inside, in contact or outside.
    pub fn classify(&mut self, cobject: &CObject, at: Configuration) -> Result<Class> {
        let world = self.look(cobject);
        self.refining(|context| {
            context.with_scene(cobject, &world, at, |context, scene| {
                context.class_of(cobject, scene)
            })
        })
    }

    /// The same in a given world.
    pub fn classify_in(&mut self, world: &World, cobject: &CObject, q: &[f64]) -> Result<Class> {
        let at = Configuration::Coordinates(q);
        self.with_scene(cobject, world, at, |context, scene| {
            context.class_of(cobject, scene)
        })
    }

    pub(super) fn class_of(&mut self, cobject: &CObject, scene: &Scene) -> Result<Class> {
        let mut memo = emptied(std::mem::take(&mut self.answers.classes));
        let class = self.class_among(cobject, scene, false, &mut memo);
        self.answers.classes = memo;
        class
    }

    /// The class in the sense of [`QueryContext::class_of_group`].
    fn class_among(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        is_proved: bool,
        memo: &mut Memo<Class>,
    ) -> Result<Class> {
        if let Set::Union { induced, others } = cobject.set()
            && others.is_empty()
        {
            return self.class_of_group(induced, scene, is_proved);
        }
        let key = (cobject.serial(), is_proved);
        if let Some(class) = memo.get(&key) {
            return Ok(*class);
        }
        let class = match cobject.set() {
            Set::Pure(set) => return set.classify(&scene.space_state(), is_proved),
            Set::Complement(part) => {
                let class = self.class_among(part, scene, !is_proved, memo)?;
                class.reversed()
            }
            Set::Intersection(parts) => {
                self.class_of_intersection(parts, scene, is_proved, memo)?
            }
            Set::Union { induced, others } => {
                self.class_of_union((induced, others), scene, is_proved, memo)?
            }
            Set::Known(known) => match known.class_at(scene.space_state().q, false) {
                Some(class) => class,
                None => self.class_among(&known.of, scene, is_proved, memo)?,
            },
        };
        memo.insert(key, class);
        Ok(class)
    }

    fn class_of_intersection(
        &mut self,
        parts: &[Arc<CObject>],
        scene: &Scene,
        is_proved: bool,
        memo: &mut Memo<Class>,
    ) -> Result<Class> {
        let mut least = Class::Inside;
        for part in cheap_first(parts) {
            least = least.min(self.class_among(part, scene, is_proved, memo)?);
            if least == Class::Outside {
                break;
            }
        }
        Ok(least)
    }

    /// Asks in order of cost: pure parts, then the induced sets, then all other parts.
    fn class_of_union(
        &mut self,
        (induced, others): (&Group, &[Arc<CObject>]),
        scene: &Scene,
        is_proved: bool,
        memo: &mut Memo<Class>,
    ) -> Result<Class> {
        let parts = cheap_first(others);
        let mut most = Class::Outside;
        for part in parts.clone().filter(is_pure) {
            most = most.max(self.class_among(part, scene, is_proved, memo)?);
            if most == Class::Inside {
                return Ok(most);
            }
        }
        if !induced.is_empty() {
            most = most.max(self.class_of_group(induced, scene, is_proved)?);
        }
        for part in parts.filter(|part| !is_pure(part)) {
            if most == Class::Inside {
                break;
            }
            most = most.max(self.class_among(part, scene, is_proved, memo)?);
        }
        Ok(most)
    }

    /// Operation 4 for a union of induced sets. Where bodies may differ from what they stand for, that they meet is never proved:
    /// if it is to be, as for the complement, such pairs count as apart.
    pub(super) fn class_of_group(
        &mut self,
        group: &Group,
        scene: &Scene,
        is_proved: bool,
    ) -> Result<Class> {
        let group = scene.checked(group)?;
        if !is_proved && self.recent_is_within(scene, group, 0.0)? {
            return Ok(Class::Inside);
        }
        let filter = CandidateFilter {
            in_contact: true,
            is_proved,
            order: order_of_any(&group),
            ..CandidateFilter::within(0.0)
        };
        let candidates = self.candidates(scene, group, filter)?;
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

    /// Whether some pair is within its contact epsilon, given that no distance is below `lower`.
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
}
