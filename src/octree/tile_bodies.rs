//! The bodies of tiles, which all tiles with equal cells share.

use std::collections::BTreeMap;
use std::sync::{Arc, Weak};

use super::cells::{Cells, Cube};
use super::tile_boxes::{CELLS, pattern, tile_boxes};
use crate::body::{Body, BodyBuilder};
use crate::error::Result;
use crate::hierarchy::{Grouping, HierarchyOptions, WrapperKind};
use crate::pose::Vec3;

/// The bodies that tiles of one octree have, as long as any tile has them.
#[derive(Debug, Default)]
pub struct TileBodies {
    bodies: BTreeMap<Kind, Weak<Body>>,
    /// The number of bodies after those that no tile had any longer were last let go of.
    kept: usize,
}

/// What the body of a tile depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Kind {
    level: u32,
    /// See [`pattern`].
    pattern: u64,
    /// The bits of how far it is grown.
    overlap: u64,
}

impl TileBodies {
    /// The body of a tile, its boxes grown by `overlap` on all sides, in a frame whose origin is its lowest corner.
    pub fn body(
        &mut self,
        cells: &Cells,
        tile: Cube,
        resolution: f64,
        overlap: f64,
    ) -> Result<Arc<Body>> {
        let kind = Kind {
            level: tile.level,
            pattern: pattern(cells, tile),
            overlap: overlap.to_bits(),
        };
        if let Some(known) = self.bodies.get(&kind).and_then(Weak::upgrade) {
            return Ok(known);
        }
        let unit = f64::from(tile.edge() / CELLS) * resolution;
        let grown = |(low, edges): ([u32; 3], [u32; 3])| {
            let low = Vec3::from(low.map(f64::from)) * unit;
            let edges = Vec3::from(edges.map(f64::from)) * unit;
            (low.add_scalar(-overlap), edges.add_scalar(2.0 * overlap))
        };
        let boxes: Vec<(Vec3, Vec3)> = tile_boxes(kind.pattern).into_iter().map(grown).collect();
        let mut builder = BodyBuilder::new(3)?;
        builder.add_aligned_boxes(&boxes)?;
        // The boxes are aligned, and few.
        let options = HierarchyOptions {
            grouping: Grouping::TopDown,
            wrapper: WrapperKind::AlignedBox,
            ..HierarchyOptions::default()
        };
        let body = Arc::new(builder.build(&options, &mut |_| Ok(()))?);
        self.bodies.insert(kind, Arc::downgrade(&body));
        Ok(body)
    }

    /// Lets go of bodies that no tile has any longer, once they may be half of all.
    pub fn prune(&mut self) {
        if self.bodies.len() > 2 * self.kept + 64 {
            self.bodies.retain(|_, body| body.strong_count() > 0);
            self.kept = self.bodies.len();
        }
    }
}
