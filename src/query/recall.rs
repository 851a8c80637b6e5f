//! Temporal coherence: the primitive pair found last is tested first, since it mostly decides along a motion (§2.3.4).

use super::body_pairs::CheckedGroup;
use super::context::QueryContext;
use super::scene::Scene;
use crate::error::Result;
use crate::pair::{Pairing, Scratch};

impl QueryContext {
    /// Visits the primitive pair found last, once for each term that holds it, with what is subtracted from its distance.
    pub(super) fn visit_recent(
        &mut self,
        scene: &Scene,
        group: CheckedGroup,
        mut visit: impl FnMut(&Pairing, [u32; 2], f64, &mut Scratch),
    ) -> Result<()> {
        let recent = self
            .recent
            .and_then(|key| Some((key, self.remembered(&key)?)));
        if let Some((key, places)) = recent {
            for (pairing, options) in scene.find(&group, &key) {
                let margin = options.margin + pairing.stated_deviation();
                visit(&pairing, places, margin, &mut self.scratch);
            }
        }
        self.scratch.meter().check()
    }
}
