//! Appendix A's `cstk-pseudo-normal`: class, distance, witnesses and gradients at one configuration.

use super::answer::{Distance, WitnessList};
use super::candidates::CandidateFilter;
use super::context::{QueryContext, check_threshold};
use super::scene::{Configuration, Group, Scene};
use super::witnesses::WitnessRequest;
use super::world::World;
use crate::cobject::{CObject, Class};
use crate::error::Result;

/// Class, distance, witnesses and gradients at one configuration.
#[derive(Clone, Debug)]
pub struct PseudoNormal {
    /// The class of the configuration.
    pub class: Class,
    /// The distance, with the nearest witness.
    pub distance: Distance,
    /// Witnesses and gradients within the shell.
    pub list: WitnessList,
}

/// Which witnesses and gradients a pseudo-normal lists.
#[derive(Clone, Copy, Debug)]
pub struct Shell {
    /// The largest distance of a witness.
    pub max_shell: f64,
    /// The most witnesses, the nearest first.
    pub max_count: usize,
    /// Scales gradients to length 1, except those of length 0.
    pub normalize: bool,
}

impl QueryContext {
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
        let request = WitnessRequest {
            with_gradients: true,
            contacts: self.contacts,
            ..WitnessRequest::within(shell.max_shell, shell.max_count)
        };
        let at = Configuration::Coordinates(q);
        let mut found = self.with_scene(cobject, world, at, |context, scene| {
            match cobject.only_group() {
                Some(group) => context.group_pseudo_normal(group, scene, request),
                None => Ok(PseudoNormal {
                    class: context.class_of(cobject, scene)?,
                    distance: context.set_distance(cobject, scene, f64::INFINITY)?,
                    list: context.set_witnesses(cobject, scene, request)?,
                }),
            }
        })?;
        if shell.normalize {
            found.list.normalize();
        }
        Ok(found)
    }

    /// Answers everything from one list of candidates.
    fn group_pseudo_normal(
        &mut self,
        group: &Group,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<PseudoNormal> {
        let filter = CandidateFilter {
            in_contact: true,
            nearest: Some(f64::INFINITY),
            ..CandidateFilter::within(request.epsilon)
        };
        let candidates = self.candidates(scene, scene.checked(group)?, filter)?;
        let distance = self.distance_among(group, scene, &candidates, f64::INFINITY, None)?;
        let list = self.list(group, scene, &candidates, request)?;
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
