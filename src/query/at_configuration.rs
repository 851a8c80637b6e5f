//! Queries at a configuration: operations 4 to 8 of §2.2.4 and `cstk-pseudo-normal` of Appendix A.

use super::answer::{Distance, WitnessList};
use super::candidates::CandidateFilter;
use super::context::QueryContext;
use super::scene::{Configuration, Group, Scene, SceneMemory};
use super::set_witnesses::WitnessRequest;
use super::world::World;
use crate::cobject::{CObject, Class, Set};
use crate::error::{Error, ErrorKind, Result};

/// Class, distance, witnesses and gradients at one configuration.
#[derive(Clone, Debug)]
pub struct PseudoNormal {
    pub class: Class,
    pub distance: Distance,
    pub list: WitnessList,
}

/// What of a configuration is wanted besides its class and its distance.
#[derive(Clone, Copy, Debug)]
pub struct Shell {
    /// Witnesses and gradients up to this distance.
    pub max_shell: f64,
    /// At most so many witnesses, the nearest.
    pub max_count: usize,
    /// Gradients are scaled to length 1, but for those of length 0.
    pub normalize: bool,
}

/// Refuses thresholds that are NaN or negative; infinity is welcome.
pub(crate) fn check_threshold(value: f64, name: &str) -> Result<()> {
    if value.is_nan() {
        return Err(Error::new(ErrorKind::NotFinite, format!("{name} is NaN")));
    }
    if value < 0.0 {
        return Err(Error::invalid(format!("{name} is negative: {value}")));
    }
    Ok(())
}

/// A union of induced sets alone, as most C-objects are.
fn only_group(cobject: &CObject) -> Option<&Group> {
    match cobject.set() {
        Set::Union { induced, others } if others.is_empty() => Some(induced),
        _ => None,
    }
}

/// The scene of a query. Whether coordinates are needed does not depend on which parts come to be asked.
pub(super) fn scene<'a>(
    cobject: &'a CObject,
    world: &'a World,
    at: Configuration<'a>,
    memory: SceneMemory,
) -> Result<Scene<'a>> {
    if let Configuration::LinkPoses(_) = at {
        cobject.require_no_coordinates()?;
    }
    Scene::new(cobject.space(), world, at, memory)
}

impl QueryContext {
    /// Asks about the scene of a query, in memory that the context keeps.
    pub(super) fn ask<T>(
        &mut self,
        cobject: &CObject,
        world: &World,
        at: Configuration,
        question: impl FnOnce(&mut Self, &Scene) -> Result<T>,
    ) -> Result<T> {
        let memory = std::mem::take(&mut self.scene_memory);
        let scene = scene(cobject, world, at, memory)?;
        let answer = question(self, &scene);
        self.scene_memory = scene.into_memory();
        answer
    }

    /// Operation 4: whether the configuration is inside, in contact or outside.
    pub fn classify(&mut self, cobject: &CObject, at: Configuration) -> Result<Class> {
        let world = self.look(cobject);
        self.ask(cobject, &world, at, |context, scene| {
            context.class_of(cobject, scene)
        })
    }

    /// The same in a given world, at a configuration.
    pub fn classify_in(&mut self, world: &World, cobject: &CObject, q: &[f64]) -> Result<Class> {
        let at = Configuration::Coordinates(q);
        self.ask(cobject, world, at, |context, scene| {
            context.class_of(cobject, scene)
        })
    }

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

    /// Operation 6: the distance from contact, up to `max_distance`, and the nearest primitive pair.
    pub fn distance(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        max_distance: f64,
    ) -> Result<Distance> {
        let world = self.look(cobject);
        self.distance_in(&world, cobject, at, max_distance)
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
        self.ask(cobject, world, at, |context, scene| {
            context.set_distance(cobject, scene, max_distance)
        })
    }

    /// Operation 7: all primitive pairs of the leaves at most `epsilon` apart; of more than `max_count`, the nearest.
    pub fn witnesses(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        let listed = WitnessRequest {
            contacts: self.contacts,
            ..WitnessRequest::within(epsilon, max_count)
        };
        self.listed(cobject, at, listed)
    }

    /// Operation 8: the same, with the gradient of each contact's distance.
    pub fn gradients(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        let listed = WitnessRequest {
            with_gradients: true,
            contacts: self.contacts,
            ..WitnessRequest::within(epsilon, max_count)
        };
        self.listed(cobject, Configuration::Coordinates(q), listed)
    }

    fn listed(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        listed: WitnessRequest,
    ) -> Result<WitnessList> {
        check_threshold(listed.epsilon, "epsilon")?;
        cobject.require_one_metric()?;
        let world = self.look(cobject);
        self.ask(cobject, &world, at, |context, scene| {
            context.set_witnesses(cobject, scene, listed)
        })
    }

    /// Appendix A's `cstk-pseudo-normal`: everything about one configuration, witnesses and gradients within a shell.
    pub fn pseudo_normal(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        shell: &Shell,
    ) -> Result<PseudoNormal> {
        let world = self.look(cobject);
        self.pseudo_normal_in(&world, cobject, q, shell)
    }

    /// The same in a given world.
    pub fn pseudo_normal_in(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        shell: &Shell,
    ) -> Result<PseudoNormal> {
        check_threshold(shell.max_shell, "max_shell")?;
        cobject.require_one_metric()?;
        let listed = WitnessRequest {
            with_gradients: true,
            contacts: self.contacts,
            ..WitnessRequest::within(shell.max_shell, shell.max_count)
        };
        let at = Configuration::Coordinates(q);
        let mut found = self.ask(cobject, world, at, |context, scene| {
            match only_group(cobject) {
                Some(group) => context.group_pseudo_normal(group, scene, listed),
                None => Ok(PseudoNormal {
                    class: context.class_of(cobject, scene)?,
                    distance: context.set_distance(cobject, scene, f64::INFINITY)?,
                    list: context.set_witnesses(cobject, scene, listed)?,
                }),
            }
        })?;
        if shell.normalize {
            found.list.normalize();
        }
        Ok(found)
    }

    /// All of a union of induced sets from one look for candidates.
    fn group_pseudo_normal(
        &mut self,
        group: &Group,
        scene: &Scene,
        listed: WitnessRequest,
    ) -> Result<PseudoNormal> {
        let wanted = CandidateFilter {
            in_contact: true,
            nearest: Some(f64::INFINITY),
            ..CandidateFilter::within(listed.epsilon)
        };
        scene.check(group)?;
        let candidates = self.candidates(scene, group, wanted)?;
        let distance = self.distance_among(group, scene, &candidates, f64::INFINITY)?;
        let list = self.list(group, scene, &candidates, listed)?;
        let class = if distance.lower == 0.0 {
            Class::Inside
        } else if self.any_in_contact(&candidates, distance.lower)? {
            Class::Contact
        } else {
            Class::Outside
        };
        self.keep_memory(candidates);
        Ok(PseudoNormal {
            class,
            distance,
            list,
        })
    }
}

impl WitnessList {
    /// Scales gradients to length 1, but for those of length 0.
    fn normalize(&mut self) {
        for row in self.gradients.chunks_exact_mut(self.nv.max(1)) {
            let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
            if length > 0.0 {
                row.iter_mut().for_each(|x| *x /= length);
            }
        }
    }
}
