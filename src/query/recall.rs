//! Temporal coherence: the primitive pair found last is tested first, since it mostly decides along a motion (§2.3.4).

use super::answer::SSide;
use super::body_pairs::CheckedGroup;
use super::cache_key::CacheKey;
use super::context::QueryContext;
use super::neighbourhoods::{FreePairs, Subject};
use super::scene::Scene;
use crate::cobject::InducedOptions;
use crate::error::Result;
use crate::pair::{Pairing, Scratch, Within, visit_pair};

impl QueryContext {
    /// Whether something is within the threshold that was so in this region of C-space before. `free` is left out.
    pub(super) fn region_is_within(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        threshold: f64,
        free: FreePairs,
    ) -> Result<bool> {
        let Some(state) = scene.state().filter(|_| self.neighbourhoods.is_on) else {
            return Ok(false);
        };
        let mut neighbourhoods = std::mem::take(&mut self.neighbourhoods);
        let memory = neighbourhoods.find(scene.world(), &group, threshold);
        let subjects = memory.map_or(&mut [][..], |memory| &mut memory.subjects[..]);
        let mut found = None;
        for subject in subjects
            .iter_mut()
            .filter(|subject| !free.has(subject.subject))
        {
            let cell = subject.table.cell(state.q);
            let Some((key, places)) = subject.witnesses.get(cell) else {
                continue;
            };
            let meets = self.pair_is_within(scene, group, (key, places), threshold);
            subject.witnesses.judge(meets);
            if meets {
                found = Some((key, places));
                break;
            }
        }
        neighbourhoods.counts.witnesses += u64::from(found.is_some());
        self.neighbourhoods = neighbourhoods;
        if let Some((key, places)) = found {
            self.remember(key, places);
        }
        self.scratch.meter().check()?;
        Ok(found.is_some())
    }

    /// Keeps the pair found last as what met in this region.
    pub(super) fn keep_for_region(&mut self, scene: &Scene, group: CheckedGroup, threshold: f64) {
        let found = self
            .recent
            .and_then(|key| Some((key, self.remembered(&key)?)));
        let (Some((key, places)), Some(state)) = (found, scene.state()) else {
            return;
        };
        let memory = self.neighbourhoods.find(scene.world(), &group, threshold);
        let Some(memory) = memory else {
            return;
        };
        let mut subjects = memory.subjects.iter_mut();
        if let Some(own) = subjects.find(|subject| scene.is_of(&key, subject.subject)) {
            let cell = own.table.cell(state.q);
            own.witnesses.insert(cell, key, places);
        }
    }

    /// Whether a primitive pair of a body pair is within a threshold, for some term that holds it.
    fn pair_is_within(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        (key, places): (CacheKey, [u32; 2]),
        threshold: f64,
    ) -> bool {
        scene.find(&group, &key).any(|(pairing, options)| {
            let mut visitor = Within::<false> {
                margin: options.margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(&pairing, places, &mut self.scratch, &mut visitor);
            visitor.found.is_some()
        })
    }

    /// Visits the primitive pair found last, once for each term that holds it.
    pub(super) fn visit_recent(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        mut visit: impl FnMut(&Pairing, [u32; 2], &InducedOptions, &mut Scratch),
    ) -> Result<()> {
        let recent = self
            .recent
            .and_then(|key| Some((key, self.remembered(&key)?)));
        if let Some((key, places)) = recent {
            for (pairing, options) in scene.find(&group, &key) {
                visit(&pairing, places, &options, &mut self.scratch);
            }
        }
        self.scratch.meter().check()
    }
}

impl Scene<'_> {
    /// Whether a body pair belongs to the pairs of a subject.
    fn is_of(&self, key: &CacheKey, subject: Subject) -> bool {
        let CacheKey::Candidate { r_link, s_side, .. } = *key else {
            return false;
        };
        match (subject, s_side) {
            (Subject::Pair { links, .. }, SSide::Link(s)) => links == [r_link, s],
            (Subject::Link(link), SSide::Object(id)) => {
                let mut held = self.held().iter();
                let held = held.find(|held| held.object.id == id);
                let carrier = held.map_or(0, |held| held.attachment.link);
                r_link.max(carrier) == link
            }
            _ => false,
        }
    }
}
