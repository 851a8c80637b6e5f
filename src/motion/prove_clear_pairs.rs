//! Proves once and for all where links are apart that few coordinates move relative to each other, so that queries need not ask again.

use super::cell_axes::{coordinates_between, divided};
use super::cell_proof::CellProof;
use crate::body::Body;
use crate::cobject::{CObject, ClearCells, ClearPairs, InducedOptions};
use crate::error::{Error, ErrorKind, Result};
use crate::query::QueryContext;

/// How much is to be proved of link pairs.
#[derive(Clone, Copy, Debug)]
pub struct ClearPairOptions {
    /// The most blocks of cells that are tried for a pair.
    pub max_blocks: usize,
}

impl Default for ClearPairOptions {
    fn default() -> Self {
        Self { max_blocks: 20_000 }
    }
}

impl ClearPairOptions {
    fn check(&self) -> Result<()> {
        if self.max_blocks == 0 {
            return Err(Error::invalid("max_blocks is 0: nothing is tried"));
        }
        Ok(())
    }
}

impl QueryContext {
    /// The same set of link pairs with grids of cells in which pairs are proved apart: of each pair that up to three coordinates
    /// of revolute and prismatic joints, with limits or whole turns, move relative to each other. `progress` receives the fraction done
    /// and may stop the work with an error.
    pub fn prove_clear_pairs(
        &mut self,
        cobject: &CObject,
        options: &ClearPairOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<CObject> {
        let Some((induced, pairs)) = cobject.link_pairs() else {
            return Err(Error::new(
                ErrorKind::Unsupported,
                "only an induced set of link pairs takes proofs of its pairs: give them before it is combined",
            ));
        };
        options.check()?;
        let space = cobject.space();
        let world = &self.look(cobject);
        let InducedOptions {
            contact_epsilon,
            margin,
        } = induced.options;
        let rest = space.clamp(&space.neutral());
        let mut proved = Vec::new();
        for (number, &links) in pairs.iter().enumerate() {
            let part = |done: f64| (number as f64 + done) / pairs.len() as f64;
            progress(part(0.0))?;
            let sides = links.map(|link| {
                let radius = space.body(link).map(Body::radius_from_origin);
                (link, radius.unwrap_or_default())
            });
            let moves = |v: &[f64]| space.relative_motion_bound(sides, &rest, v);
            let coordinates = coordinates_between(space, links);
            let Some(axes) = coordinates.and_then(|between| divided(space, &between, &moves))
            else {
                continue;
            };
            let in_contact = InducedOptions {
                contact_epsilon: 0.0,
                margin: (margin + contact_epsilon).min(f64::MAX),
            };
            let proof = CellProof {
                world,
                cobject: CObject::induced_links(space.clone(), &[links], in_contact)?,
                moves: &moves,
                max_blocks: options.max_blocks,
            };
            let cells = ClearCells::new(axes);
            let grid = proof.run(self, cells, &mut |done| progress(part(done)))?;
            if grid.proved_share() > 0.0 {
                proved.push((links, grid));
            }
        }
        progress(1.0)?;
        let found = cobject.with_clear_pairs(ClearPairs::new(space.link_count(), proved));
        found.ok_or_else(|| Error::invalid("the set has no link pairs"))
    }
}
