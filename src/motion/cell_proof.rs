//! Proves cells of C-space free of contact, whole blocks of them first.

use std::collections::VecDeque;

use smallvec::SmallVec;

use super::gathering::Keeps;
use super::region_proof::{BoxProof, BoxWork, Center, Region};
use crate::cobject::{CObject, CellAxis, ClearCells, MAX_CELL_AXES};
use crate::error::Result;
use crate::query::{Configuration, QueryContext, World};

/// How many parts the proof of a block halves it into before it is given up or divided.
const PARTS_OF_BLOCK: usize = 4;

/// The same of a single cell.
const PARTS_OF_CELL: usize = 32;

/// A block is not tried if its bodies are nearer, in its middle, than this part of how far they go to its corners.
const HOPELESS: f64 = 0.1;

/// Some cells of a grid: the first along each axis, and that behind the last.
type Block = SmallVec<[[u32; 2]; MAX_CELL_AXES]>;

/// The proofs of one grid.
pub(super) struct CellProof<'a> {
    pub world: &'a World,
    /// What cells are to be free of: inside wherever the bodies in question are in contact in the set that was given.
    pub cobject: CObject,
    /// About how far the bodies go with a velocity.
    pub moves: &'a dyn Fn(&[f64]) -> f64,
    /// The most blocks that are tried.
    pub max_blocks: usize,
}

impl CellProof<'_> {
    /// Tries whole blocks, the largest first, and divides what is not proved: first where the middle is free.
    pub fn run(
        &self,
        context: &mut QueryContext,
        mut grid: ClearCells,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<ClearCells> {
        let over_a_cell = self.over_a_cell(grid.axes());
        let whole: Block = grid.axes().iter().map(|axis| [0, axis.count]).collect();
        let (mut blocks, mut inside) = (VecDeque::from([whole]), VecDeque::new());
        let mut tried = 0;
        while let Some(block) = blocks.pop_front().or_else(|| inside.pop_front()) {
            if tried == self.max_blocks {
                break;
            }
            if tried % 64 == 0 {
                progress(tried as f64 / self.max_blocks as f64)?;
            }
            tried += 1;
            let region = self.region(grid.axes(), &block);
            let Center { q, .. } = region.center(self.cobject.space());
            let sides = block.iter().zip(&over_a_cell);
            let sides: SmallVec<[f64; MAX_CELL_AXES]> = sides
                .map(|([first, end], length)| f64::from(end - first) * length)
                .collect();
            let reach = 0.5 * sides.iter().sum::<f64>();
            let at = Configuration::Coordinates(&q);
            let found =
                context.distance_in(self.world, &self.cobject, at, reach.max(f64::MIN_POSITIVE))?;
            let is_inside = found.lower <= 0.0;
            let is_hopeless = is_inside || found.lower < HOPELESS * reach;
            if !is_hopeless && self.is_clear(context, &region, &block)? {
                grid.prove(&block);
                continue;
            }
            let divided = (0..block.len()).filter(|&k| block[k][1] - block[k][0] > 1);
            let longest = divided.max_by(|&a, &b| sides[a].total_cmp(&sides[b]));
            if let Some(k) = longest {
                let [first, end] = block[k];
                let width = end - first;
                for half in [[first, first + width / 2], [first + width / 2, end]] {
                    let mut part = block.clone();
                    part[k] = half;
                    if is_inside {
                        inside.push_back(part);
                    } else {
                        blocks.push_back(part);
                    }
                }
            }
        }
        Ok(grid)
    }

    /// About how far the bodies go over a cell along each axis.
    fn over_a_cell(&self, axes: &[CellAxis]) -> SmallVec<[f64; MAX_CELL_AXES]> {
        let along = |axis: &CellAxis| {
            let mut v = vec![0.0; self.cobject.space().nv()];
            v[axis.velocity] = axis.width;
            (self.moves)(&v)
        };
        axes.iter().map(along).collect()
    }

    /// The block with its pad; other coordinates, which are of no account, are at rest.
    fn region(&self, axes: &[CellAxis], block: &Block) -> Region {
        let space = self.cobject.space();
        let rest = space.clamp(&space.neutral());
        let mut region = Region {
            low: rest.clone(),
            high: rest,
        };
        for (axis, cells) in axes.iter().zip(block) {
            let [low, high] = axis.range(*cells);
            region.low[axis.coordinate] = low;
            region.high[axis.coordinate] = high;
        }
        region
    }

    fn is_clear(&self, context: &mut QueryContext, region: &Region, block: &Block) -> Result<bool> {
        let is_cell = block.iter().all(|[first, end]| end - first == 1);
        let work = BoxWork {
            max_boxes: if is_cell {
                PARTS_OF_CELL
            } else {
                PARTS_OF_BLOCK
            },
            samples: 0,
        };
        let found = context.prove_region(self.world, &self.cobject, region, Keeps::Out, work)?;
        Ok(matches!(found, BoxProof::Free))
    }
}
