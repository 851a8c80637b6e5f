//! Maps are built coarse to fine: blocks of cells that are proved free or inside are filled at once, others are halved.

use std::sync::atomic::{AtomicU8, AtomicU64, AtomicUsize, Ordering};

use super::blocks::Block;
use super::grid::{Grid, MAX_AXES, MapAxis};
use super::map::{Map, MapValues};
use crate::batch::{Batch, BatchJob, BatchOptions};
use crate::cobject::{CObject, Class};
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{RegionOptions, RegionOutcome};
use crate::query::{Configuration, QueryContext, World, check_threshold};

/// Blocks of at most this many cells are not proved where middles alone count: asking them costs less.
const FEW_CELLS: usize = 16;
/// The parts that a proof halves a block into: more would rather be spent on its halves.
const BOXES_PER_BLOCK: usize = 2;
/// The parts of a grid that threads take, one after the other.
const TILES: usize = 256;

/// What a map tells of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// The class of each middle, as [`QueryContext::classify`] has it.
    Classes,
    /// The distance at each middle.
    Distances,
    /// What is proved of each whole cell, as [`QueryContext::classify_region`] has it.
    Cells,
}

/// What a map is to be, and what it may cost.
#[derive(Clone, Copy, Debug)]
pub struct MapOptions {
    /// What it tells.
    pub kind: MapKind,
    /// Distances beyond this are not computed.
    pub max_distance: f64,
    /// The parts that the proof of a single cell halves it into.
    pub max_boxes: usize,
    /// The number of threads, at most 1024; 0 for the machine's available parallelism. The map does not depend on it.
    pub threads: u32,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            kind: MapKind::Classes,
            max_distance: f64::INFINITY,
            max_boxes: 64,
            threads: 0,
        }
    }
}

/// The values of cells, which threads write each in its own tiles.
enum Cells {
    Bytes(Vec<AtomicU8>),
    /// The bits of distances.
    Numbers(Vec<AtomicU64>),
}

fn zeros<T: Default>(count: usize) -> Result<Vec<T>> {
    let mut cells = Vec::new();
    let reserved = cells.try_reserve_exact(count);
    reserved.map_err(|error| {
        let bytes = count as u128 * size_of::<T>() as u128;
        Error::memory(error).within(format_args!("a map of {count} cells takes {bytes} bytes"))
    })?;
    cells.resize_with(count, T::default);
    Ok(cells)
}

/// A map that is being built.
struct Builder<'a> {
    grid: &'a Grid<'a>,
    /// The cells that the map is of.
    part: Block,
    world: &'a World,
    cobject: &'a CObject,
    options: &'a MapOptions,
    /// A configuration that is not inside is outside: there are neither contact epsilons nor pure sets.
    never_touches: bool,
    cells: Cells,
    proofs: AtomicU64,
    questions: AtomicU64,
    /// How many cells have their value.
    done: AtomicUsize,
}

/// Tells progress; fails where a map is to be left.
type Pulse<'p> = &'p mut dyn FnMut() -> Result<()>;

impl Builder<'_> {
    fn set(&self, cell: &[usize; MAX_AXES], value: u8) {
        if let Cells::Bytes(cells) = &self.cells {
            cells[self.grid.number(cell)].store(value, Ordering::Relaxed);
        }
    }

    fn fill(&self, block: &Block, value: u8) {
        block.cells().for_each(|cell| self.set(&cell, value));
        self.done.fetch_add(block.cell_count(), Ordering::Relaxed);
    }

    /// The class or the distance of each middle.
    fn ask_each(&self, block: &Block, context: &mut QueryContext, pulse: Pulse) -> Result<()> {
        let mut q = self.grid.q.to_vec();
        for cell in block.cells() {
            self.grid.set_center(&cell, &mut q);
            let asked = self.ask(&cell, &q, context);
            asked.map_err(|error| {
                let place = &cell[..self.grid.axes.len()];
                error.within(format_args!("cell {place:?}"))
            })?;
            self.done.fetch_add(1, Ordering::Relaxed);
            pulse()?;
        }
        let count = block.cell_count() as u64;
        self.questions.fetch_add(count, Ordering::Relaxed);
        Ok(())
    }

    fn ask(&self, cell: &[usize; MAX_AXES], q: &[f64], context: &mut QueryContext) -> Result<()> {
        match &self.cells {
            Cells::Bytes(_) => {
                let class = context.classify_in(self.world, self.cobject, q)?;
                self.set(cell, class as u8);
            }
            Cells::Numbers(cells) => {
                let at = Configuration::Coordinates(q);
                let limit = self.options.max_distance;
                let found = context.distance_in(self.world, self.cobject, at, limit)?;
                let place = &cells[self.grid.number(cell)];
                place.store(found.distance.to_bits(), Ordering::Relaxed);
            }
        }
        Ok(())
    }

    /// What is proved of the box around a block's middles, or around its cells.
    fn prove(
        &self,
        block: &Block,
        max_boxes: usize,
        context: &mut QueryContext,
    ) -> Result<RegionOutcome> {
        let (mut low, mut high) = (self.grid.q.to_vec(), self.grid.q.to_vec());
        for (i, axis) in self.grid.axes.iter().enumerate() {
            let (first, end) = (block.first[i], block.end[i]);
            let ends = match self.options.kind {
                MapKind::Cells => [axis.edge(first), axis.edge(end)],
                _ => [axis.center(first), axis.center(end - 1)],
            };
            [low[axis.coordinate], high[axis.coordinate]] = ends;
        }
        self.proofs.fetch_add(1, Ordering::Relaxed);
        let options = &RegionOptions { max_boxes };
        let answer =
            context.classify_region_in(self.world, self.cobject, [&low, &high], options)?;
        Ok(answer.outcome)
    }

    /// Decides all cells of a block that the map is of. Blocks that reach beyond the map are proved whole: so a part of a map is
    /// decided as in the whole, and equals it.
    fn decide(&self, whole: &Block, context: &mut QueryContext, pulse: Pulse) -> Result<()> {
        let mut rest = vec![*whole];
        while let Some(block) = rest.pop() {
            pulse()?;
            let Some(kept) = &block.within(&self.part) else {
                continue;
            };
            let is_asked = match self.options.kind {
                MapKind::Distances => true,
                MapKind::Classes => block.cell_count() <= FEW_CELLS,
                MapKind::Cells => false,
            };
            if is_asked {
                self.ask_each(kept, context, pulse)?;
                continue;
            }
            let halves = block.halves();
            let boxes = match halves {
                Some(_) => BOXES_PER_BLOCK,
                None => self.options.max_boxes,
            };
            let outcome = match (self.prove(&block, boxes, context), self.options.kind) {
                // Classes need no proof: of what states no speeds, each middle is asked.
                (Err(error), MapKind::Classes) if error.kind == ErrorKind::Unsupported => {
                    self.ask_each(kept, context, pulse)?;
                    continue;
                }
                (proved, _) => proved?,
            };
            match (self.options.kind, outcome, halves) {
                (MapKind::Classes, RegionOutcome::Inside, _) => {
                    self.fill(kept, Class::Inside as u8);
                }
                (MapKind::Classes, RegionOutcome::Free, _) if self.never_touches => {
                    self.fill(kept, Class::Outside as u8);
                }
                (MapKind::Classes, RegionOutcome::Free, _) => {
                    self.ask_each(kept, context, pulse)?;
                }
                (_, RegionOutcome::Free, _) => self.fill(kept, 0),
                (_, RegionOutcome::Inside, _) => self.fill(kept, 1),
                (_, _, Some(halves)) => rest.extend(halves),
                (_, RegionOutcome::Mixed, None) => self.fill(kept, 2),
                (_, RegionOutcome::Undecided, None) => self.fill(kept, 3),
            }
        }
        Ok(())
    }

    fn finished(self) -> Map {
        let values = match self.cells {
            Cells::Bytes(cells) => {
                let cells = cells.into_iter().map(AtomicU8::into_inner).collect();
                match self.options.kind {
                    MapKind::Cells => MapValues::Cells(cells),
                    _ => MapValues::Classes(cells),
                }
            }
            Cells::Numbers(cells) => {
                let bits = cells.into_iter().map(AtomicU64::into_inner);
                MapValues::Distances(bits.map(f64::from_bits).collect())
            }
        };
        Map {
            axes: self.grid.axes.to_vec(),
            values,
            proofs: self.proofs.into_inner(),
            questions: self.questions.into_inner(),
        }
    }
}

impl Map {
    /// Builds a map over some coordinates; the others are those of `q`. All cells see one state of the environments. `progress`
    /// receives the fraction done, and may end the work with an error.
    pub fn build(
        cobject: &CObject,
        q: &[f64],
        axes: &[MapAxis],
        options: &MapOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Self> {
        let grid = &Grid::new(cobject.space(), q, axes)?;
        let cells = match options.kind {
            MapKind::Distances => {
                check_threshold(options.max_distance, "max_distance")?;
                cobject.require_one_metric()?;
                Cells::Numbers(zeros(grid.cell_count)?)
            }
            MapKind::Classes | MapKind::Cells => Cells::Bytes(zeros(grid.cell_count)?),
        };
        RegionOptions {
            max_boxes: options.max_boxes,
        }
        .check()?;
        let builder = Builder {
            grid,
            part: Block::part(grid),
            world: &World::of(cobject),
            cobject,
            options,
            never_touches: cobject.never_touches(),
            cells,
            proofs: AtomicU64::new(0),
            questions: AtomicU64::new(0),
            done: AtomicUsize::new(0),
        };
        let mut tiles = Block::whole(grid).parts(TILES);
        tiles.retain(|tile| tile.within(&builder.part).is_some());
        let on_threads = BatchOptions {
            threads: options.threads,
            ..Default::default()
        };
        let job = BatchJob {
            options: &on_threads,
            slots: (),
            progress: &mut |_| {
                let done = builder.done.load(Ordering::Relaxed);
                progress(done as f64 / grid.cell_count as f64)
            },
        };
        Batch::new().work_off(job, tiles.len(), |context, tile, pulse| {
            builder.decide(&tiles[tile], context, pulse)
        })?;
        Ok(builder.finished())
    }
}
