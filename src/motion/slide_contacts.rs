//! The contacts that constrain a slide: those of each leaf within its shell.

use super::slide_options::SlideOptions;
use crate::cobject::{CObject, PureSet, Set};
use crate::error::Result;
use crate::query::{
    CandidateFilter, Configuration, Group, QueryContext, Scene, Target, WitnessList,
    WitnessRequest, World, pure_witnesses,
};

/// Body pairs with at most this many primitive pairs list all contacts within the shell. Larger ones list only the nearest,
/// since a fine mesh has thousands of nearly equal contacts there. (`scripts/bench.sh slides`)
const SMALL_PAIR: usize = 64;

/// Larger pairs list primitives up to this fraction of the shell farther than the nearest, so that parallel features are
/// listed.
const BAND: f64 = 0.01;

/// The most witnesses listed of a larger pair.
const MAX_OF_LARGE_PAIR: usize = 8;

/// Which contacts of a large pair are listed; the nearest are enough for most steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Detail {
    Nearest,
    All,
}

impl QueryContext {
    /// The witnesses that constrain a step, with gradients. For a leaf with its own shell, distances and gradients are
    /// scaled by the shell of the options over that of the leaf, so that one desired distance fits all.
    pub(crate) fn slide_contacts(
        &mut self,
        world: &World,
        cobject: &CObject,
        q: &[f64],
        options: &SlideOptions,
        detail: Detail,
    ) -> Result<WitnessList> {
        let at = Configuration::Coordinates(q);
        self.with_scene(cobject, world, at, |context, scene| {
            let mut search = ContactSearch {
                options,
                detail,
                scene,
                lists: Vec::new(),
            };
            match cobject.set() {
                Set::Pure(set) => search.add_set(set)?,
                set => {
                    if let Set::Union { induced, .. } = set {
                        search.add_bodies(context, induced)?;
                    }
                    for part in set.parts() {
                        if let Set::Pure(set) = part.set() {
                            search.add_set(set)?;
                        }
                    }
                }
            }
            let request = search.request(f64::INFINITY);
            Ok(WitnessList::merged(search.lists, scene, request))
        })
    }
}

struct ContactSearch<'a> {
    options: &'a SlideOptions,
    detail: Detail,
    scene: &'a Scene<'a>,
    lists: Vec<WitnessList>,
}

impl ContactSearch<'_> {
    fn request(&self, epsilon: f64) -> WitnessRequest {
        WitnessRequest {
            with_gradients: true,
            ..WitnessRequest::within(epsilon, self.options.max_witnesses)
        }
    }

    fn add_bodies(&mut self, context: &mut QueryContext, group: &Group) -> Result<()> {
        let (scene, max_shell) = (self.scene, self.options.max_shell);
        let checked = scene.checked(group)?;
        let shells = group.iter().map(|term| term.shell.unwrap_or(max_shell));
        let filter = CandidateFilter::within(shells.fold(0.0, f64::max));
        let meter = context.scratch.meter_mut();
        let candidates = scene.candidates(checked, filter, &mut context.candidates, meter)?;
        for target in &candidates {
            let shell = group[target.term as usize].shell.unwrap_or(max_shell);
            if target.bound > shell {
                continue;
            }
            // Searched alone, so its rank is 0: hits name their pair by rank.
            let target = &[Target { rank: 0, ..*target }];
            let whole = self.request(shell);
            let [a, b] = target[0].sides.map(|(body, _)| body.primitives().len());
            let is_cut = self.detail == Detail::Nearest && a.saturating_mul(b) > SMALL_PAIR;
            let request = match is_cut {
                true => WitnessRequest {
                    band: BAND * shell,
                    max_count: whole.max_count.min(MAX_OF_LARGE_PAIR),
                    ..whole
                },
                false => whole,
            };
            let mut list = context.list(group, scene, target, request)?;
            // All primitives that meet must be listed: some may overlap.
            if is_cut && list.witnesses.first().is_some_and(|w| w.distance == 0.0) {
                let epsilon = BAND * shell;
                list = context.list(group, scene, target, WitnessRequest { epsilon, ..whole })?;
            }
            self.add_list(list, shell);
        }
        Ok(())
    }

    /// Adds the contacts of a pure set. Floors and the world box are split by link: a link that rests on a floor must not
    /// hide another.
    fn add_set(&mut self, set: &PureSet) -> Result<()> {
        let scene = self.scene;
        let parts = set.by_link();
        let shell = set.shell.unwrap_or(self.options.max_shell);
        let parts: Vec<(&PureSet, bool)> = parts.iter().map(|part| (part, false)).collect();
        let list = pure_witnesses(&parts, scene, self.request(shell))?;
        self.add_list(list, shell);
        Ok(())
    }

    fn add_list(&mut self, mut list: WitnessList, shell: f64) {
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
