//! The contacts that constrain a slide: of each leaf those within its shell.

use super::slide::SlideOptions;
use crate::cobject::{CObject, PureSet, Set};
use crate::error::Result;
use crate::query::{
    CandidateFilter, Configuration, Group, QueryContext, Scene, SceneMemory, Target, WitnessList,
    WitnessRequest, World, pure_witnesses,
};

/// Of a body pair with at most this many primitive pairs, all within the shell are listed; of a larger one only the nearest, since
/// a fine mesh has thousands within the shell that say the same. (`scripts/bench.sh slides`)
const SMALL_PAIR: usize = 64;

/// How much farther than the nearest, as a part of the shell, primitives of a larger pair are listed: what is parallel.
const BAND: f64 = 0.01;

/// At most this many witnesses of a larger pair are listed.
const MAX_OF_LARGE_PAIR: usize = 8;

/// Which contacts of a large pair are listed: the nearest say enough for most steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Detail {
    Nearest,
    All,
}

impl QueryContext {
    /// The witnesses that constrain a step, with gradients. Distances and gradients of a leaf with a shell of its own are divided
    /// by that and multiplied by the shell of the options, so that one desired distance serves all.
    pub(crate) fn slide_contacts(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        options: &SlideOptions,
        detail: Detail,
    ) -> Result<WitnessList> {
        let scene = &Scene::new(
            cobject.space(),
            world,
            Configuration::Coordinates(q),
            SceneMemory::default(),
        )?;
        let mut search = ContactSearch {
            options,
            detail,
            scene,
            lists: Vec::new(),
        };
        match cobject.set() {
            Set::Pure(set) => search.see_set(set)?,
            set => {
                if let Set::Union { induced, .. } = set {
                    search.see_bodies(self, induced)?;
                }
                for part in set.parts() {
                    if let Set::Pure(set) = part.set() {
                        search.see_set(set)?;
                    }
                }
            }
        }
        let listed = search.listed(f64::INFINITY);
        Ok(WitnessList::merged(search.lists, scene, listed))
    }
}

struct ContactSearch<'a> {
    options: &'a SlideOptions,
    detail: Detail,
    scene: &'a Scene<'a>,
    lists: Vec<WitnessList>,
}

impl ContactSearch<'_> {
    fn listed(&self, epsilon: f64) -> WitnessRequest {
        WitnessRequest {
            with_gradients: true,
            ..WitnessRequest::within(epsilon, self.options.max_witnesses)
        }
    }

    fn see_bodies(&mut self, context: &mut QueryContext, group: &Group) -> Result<()> {
        let (scene, max_shell) = (self.scene, self.options.max_shell);
        let checked = scene.checked(group)?;
        let shells = group.iter().map(|term| term.shell.unwrap_or(max_shell));
        let wanted = CandidateFilter::within(shells.fold(0.0, f64::max));
        let meter = context.scratch.meter_mut();
        let candidates = scene.candidates(checked, wanted, &mut context.candidates, meter)?;
        for target in &candidates {
            let shell = group[target.term as usize].shell.unwrap_or(max_shell);
            if target.bound > shell {
                continue;
            }
            // Alone in its searches, whose hits name it by its rank.
            let target = &[Target { rank: 0, ..*target }];
            let Some(listed) = self.listed_of(context, target, shell)? else {
                continue;
            };
            let list = context.list(group, scene, target, listed)?;
            self.take(list, shell);
        }
        Ok(())
    }

    /// What is asked of a body pair; `None` if the bodies are farther apart than the shell.
    fn listed_of(
        &self,
        context: &mut QueryContext,
        target: &[Target; 1],
        shell: f64,
    ) -> Result<Option<WitnessRequest>> {
        let whole = self.listed(shell);
        let [a, b] = target[0].sides.map(|(body, _)| body.primitives().len());
        if self.detail == Detail::All || a.saturating_mul(b) <= SMALL_PAIR {
            return Ok(Some(whole));
        }
        let Some((nearest, _)) = context.nearest(target, shell)?.hit else {
            return Ok(None);
        };
        let epsilon = (nearest.distance + BAND * shell).min(shell);
        // Of primitives that meet all must be seen: some may overlap.
        let max_count = match nearest.distance > 0.0 {
            true => whole.max_count.min(MAX_OF_LARGE_PAIR),
            false => whole.max_count,
        };
        Ok(Some(WitnessRequest {
            epsilon,
            max_count,
            ..whole
        }))
    }

    /// Floors and the world box are seen link by link: one that rests on a floor does not hide another.
    fn see_set(&mut self, set: &PureSet) -> Result<()> {
        let scene = self.scene;
        let parts = set.by_link();
        let shell = set.shell.unwrap_or(self.options.max_shell);
        let parts: Vec<(&PureSet, bool)> = parts.iter().map(|part| (part, false)).collect();
        let list = pure_witnesses(&parts, scene, self.listed(shell))?;
        self.take(list, shell);
        Ok(())
    }

    fn take(&mut self, mut list: WitnessList, shell: f64) {
        if list.witnesses.is_empty() {
            return;
        }
        let scale = self.options.max_shell / shell;
        if scale != 1.0 {
            list.scale(scale);
        }
        self.lists.push(list);
    }
}

impl WitnessList {
    /// Multiplies distances and gradients.
    fn scale(&mut self, scale: f64) {
        for witness in &mut self.witnesses {
            witness.distance *= scale;
        }
        for contact in &mut self.contacts {
            contact.distance *= scale;
            contact.clearance *= scale;
        }
        for entry in &mut self.gradients {
            *entry *= scale;
        }
    }
}
