//! Proves once and for all where links are apart that few coordinates move relative to each other, so that queries need not ask again.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use smallvec::SmallVec;

use super::gathering::Keeps;
use super::region_proof::{BoxProof, BoxWork, Center, Region};
use crate::cobject::{
    CObject, CellAxis, Class, ClearCells, ClearPairs, InducedOptions, MAX_CELL_AXES,
};
use crate::error::{Error, ErrorKind, Result};
use crate::query::{QueryContext, World};
use crate::robot::{Coordinate, JointKind, ToCarrier};
use crate::space::Space;

/// The number of cells along an axis: of a grid over one coordinate, over two and over three.
const CELLS: [u32; MAX_CELL_AXES] = [256, 128, 48];

/// How many parts the proof of a block halves it into before it is given up or divided.
const PARTS_OF_BLOCK: usize = 4;

/// The same of a single cell.
const PARTS_OF_CELL: usize = 32;

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

/// Some cells of a grid: the first along each axis, and that behind the last.
type Block = SmallVec<[[u32; 2]; MAX_CELL_AXES]>;

/// The proofs of one pair.
struct PairProof<'a> {
    world: &'a World,
    /// The set of the pair alone, which has it inside wherever it is in contact in the set that was given.
    cobject: CObject,
    max_blocks: usize,
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
        let mut proved = Vec::new();
        for (number, &links) in pairs.iter().enumerate() {
            progress(number as f64 / pairs.len() as f64)?;
            let Some(axes) = axes_between(space, links) else {
                continue;
            };
            let in_contact = InducedOptions {
                contact_epsilon: 0.0,
                margin: (margin + contact_epsilon).min(f64::MAX),
            };
            let proof = PairProof {
                world,
                cobject: CObject::induced_links(space.clone(), &[links], in_contact)?,
                max_blocks: options.max_blocks,
            };
            let part = |done: f64| (number as f64 + done) / pairs.len() as f64;
            let grid = proof.run(self, axes, &mut |done| progress(part(done)))?;
            if grid.proved_share() > 0.0 {
                proved.push((links, grid));
            }
        }
        progress(1.0)?;
        let found = cobject.with_clear_pairs(ClearPairs::new(space.link_count(), proved));
        found.ok_or_else(|| Error::invalid("the set has no link pairs"))
    }
}

impl PairProof<'_> {
    /// Tries whole blocks, the largest first, and divides what is not proved.
    fn run(
        &self,
        context: &mut QueryContext,
        axes: SmallVec<[CellAxis; MAX_CELL_AXES]>,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<ClearCells> {
        let mut grid = ClearCells::new(axes);
        let whole: Block = grid.axes().iter().map(|axis| [0, axis.count]).collect();
        let mut blocks = VecDeque::from([whole]);
        let mut tried = 0;
        while let Some(block) = blocks.pop_front() {
            if tried == self.max_blocks {
                break;
            }
            if tried % 64 == 0 {
                progress(tried as f64 / self.max_blocks as f64)?;
            }
            tried += 1;
            if self.is_clear(context, grid.axes(), &block)? {
                grid.prove(&block);
                continue;
            }
            let widths = block.iter().map(|[first, end]| end - first);
            let Some((k, width)) = widths.enumerate().max_by_key(|(_, width)| *width) else {
                continue;
            };
            if width > 1 {
                let [first, end] = block[k];
                for half in [[first, first + width / 2], [first + width / 2, end]] {
                    let mut part = block.clone();
                    part[k] = half;
                    blocks.push_back(part);
                }
            }
        }
        Ok(grid)
    }

    fn is_clear(
        &self,
        context: &mut QueryContext,
        axes: &[CellAxis],
        block: &Block,
    ) -> Result<bool> {
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
        let (world, cobject) = (self.world, &self.cobject);
        let Center { q, .. } = region.center(space);
        if context.classify_in(world, cobject, &q)? == Class::Inside {
            return Ok(false);
        }
        let is_cell = block.iter().all(|[first, end]| end - first == 1);
        let work = BoxWork {
            max_boxes: if is_cell {
                PARTS_OF_CELL
            } else {
                PARTS_OF_BLOCK
            },
            samples: 0,
        };
        let found = context.prove_region(world, cobject, &region, Keeps::Out, work)?;
        Ok(matches!(found, BoxProof::Free))
    }
}

/// How the coordinates are divided that move two links relative to each other; `None` where these are none or too many, or of other
/// joints, or where one has no bounds.
fn axes_between(space: &Space, links: [usize; 2]) -> Option<SmallVec<[CellAxis; MAX_CELL_AXES]>> {
    let mut coordinates: SmallVec<[[usize; 2]; MAX_CELL_AXES]> = SmallVec::new();
    for (_, link) in ToCarrier::new(links.map(Some), |link| space.parent(link)) {
        let joint = &space.link(link)?.joint;
        match joint.kind {
            JointKind::Fixed => continue,
            JointKind::Revolute | JointKind::Prismatic => {}
            _ => return None,
        }
        let offset = space.offsets()[space.robot_of(link)];
        let own = [
            offset.coordinate + joint.coordinate,
            offset.velocity + joint.velocity,
        ];
        if !coordinates.contains(&own) {
            coordinates.push(own);
        }
    }
    let count = *CELLS.get(coordinates.len().checked_sub(1)?)?;
    let axis = |&[coordinate, velocity]: &[usize; 2]| {
        let is_periodic = space.is_periodic(coordinate);
        let (low, high, is_periodic) = match space.coordinates()[coordinate] {
            Coordinate::Circle => (-PI, PI, true),
            Coordinate::Interval { lower, upper } if is_periodic && upper - lower >= TAU => {
                (-PI, PI, true)
            }
            Coordinate::Interval { lower, upper } => (lower, upper, false),
            Coordinate::Quaternion => return None,
        };
        let width = (high - low) / f64::from(count);
        let is_divided = width.is_finite() && width > 0.0;
        is_divided.then_some(CellAxis {
            coordinate,
            velocity,
            low,
            width,
            count,
            is_periodic,
        })
    };
    coordinates.iter().map(axis).collect()
}
