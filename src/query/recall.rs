//! Temporal coherence: the primitive pair found last is tested first, since it mostly decides along a motion (§2.3.4).

use super::body_pairs::CheckedGroup;
use super::context::QueryContext;
use super::scene::Scene;
use crate::cobject::InducedOptions;
use crate::error::Result;
use crate::pair::{Pairing, Scratch};

impl QueryContext {
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
