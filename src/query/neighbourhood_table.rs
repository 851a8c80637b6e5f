//! The free neighbourhoods of one link, found by where a configuration is.

use crate::lanes::{Instructions, Lanes8, Work, with_widest};

/// The cells of C-space that blocks of neighbourhoods are filed under: a power of two.
const SLOTS: usize = 1 << 12;

/// Neighbourhoods of one cell: more are looked through in vain, fewer leave holes.
const PER_CELL: usize = 8;

/// Cells come in this many sizes, each a quarter of the one before: small neighbourhoods are filed under small cells.
const LEVELS: usize = 3;

/// Cells are told apart by this many coordinates, the first of the chain: they move the link most.
const CELL_COORDINATES: usize = 4;

/// The largest sum of scaled differences inside. What it is less than 1 covers the rounding of the sum, of at most 64
/// coordinates: each term is within three roundings of 2^-24 of itself, and the sum within one for each term.
const INSIDE: f32 = 1.0 - 1e-5;

/// The error of a coordinate in single precision, relative to it: its own rounding and the centre's.
const COORDINATE_ERROR: f64 = 1.3e-7;

/// A coordinate that moves the link, and how it is cut into cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellCoordinate {
    /// Its index in the space.
    pub index: usize,
    /// Of the largest cells.
    pub cells_per_unit: f64,
}

/// Configurations around one, of which something is certified: all q with `sum of inverse_radii[k] |q[k] - center[k]| < 1`.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbourhood {
    pub center: Vec<f64>,
    pub inverse_radii: Vec<f64>,
}

/// Neighbourhoods over the coordinates that move one link. It holds at most [`Self::MAX_BLOCKS`] times
/// [`PER_CELL`]; the oldest go.
#[derive(Debug, Default)]
pub(super) struct NeighbourhoodTable {
    pub coordinates: Vec<CellCoordinate>,
    /// The block of each cell, plus 1; cells whose hashes agree share one, which is no harm.
    slots: Vec<u16>,
    /// Of each block: the cell's slot, and how many were put in.
    blocks: Vec<(u16, u32)>,
    /// Of each block the centres and then the inverse radii, a row of eight for each coordinate.
    rows: Vec<[f32; PER_CELL]>,
    max_blocks: usize,
    kept: usize,
    /// The block that is given to another cell next.
    oldest: usize,
    /// How many blocks there were of each size of cells.
    on_level: [u32; LEVELS],
}

impl NeighbourhoodTable {
    const MAX_BLOCKS: usize = 512;

    /// An empty table, which will take about `max_bytes` at most.
    pub fn new(coordinates: Vec<CellCoordinate>, max_bytes: usize) -> Self {
        let block = 2 * coordinates.len().max(1) * size_of::<[f32; PER_CELL]>();
        Self {
            coordinates,
            max_blocks: (max_bytes / block).clamp(1, Self::MAX_BLOCKS),
            ..Self::default()
        }
    }

    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// How many neighbourhoods there are.
    pub fn len(&self) -> usize {
        self.kept
    }

    /// Whether a configuration is known to be in a neighbourhood.
    #[inline]
    pub fn contains(&self, q: &[f64]) -> bool {
        (0..LEVELS).any(|level| self.lanes_around(level, q, q, INSIDE) != 0)
    }

    /// Whether some neighbourhood holds both ends of a straight segment, and so all of it, with a part of its radii to spare.
    pub fn contains_segment(&self, ends: [&[f64]; 2], spare: f32) -> bool {
        let limit = INSIDE - spare;
        // Filed under the cell of one end or the other.
        let cells = (0..LEVELS).flat_map(|level| ends.map(|cell| (level, cell)));
        cells.into_iter().any(|(level, cell)| {
            let first = self.lanes_around(level, cell, ends[0], limit);
            first != 0 && first & self.lanes_around(level, cell, ends[1], limit) != 0
        })
    }

    /// Keeps a neighbourhood, unless it is so small that rounding hides it.
    pub fn insert(&mut self, found: &Neighbourhood) -> bool {
        let pairs = || found.center.iter().zip(&found.inverse_radii);
        let rounding: f64 = pairs().map(|(c, r)| r * (c.abs() + 1.0)).sum();
        let limit = 1.0 - COORDINATE_ERROR * rounding;
        let is_large = limit > 0.9;
        if !is_large {
            return false;
        }
        let count = self.coordinates.len();
        let level = self.level_of(found);
        let block = self.block_for(level, self.slot(level, |k| found.center[k]));
        let (_, number) = &mut self.blocks[block];
        let lane = *number as usize % PER_CELL;
        self.kept += usize::from((*number as usize) < PER_CELL);
        *number += 1;
        let rows = &mut self.rows[2 * count * block..2 * count * (block + 1)];
        for (k, (center, inverse)) in pairs().enumerate() {
            rows[k][lane] = *center as f32;
            rows[count + k][lane] = ((inverse / limit) as f32).next_up();
        }
        true
    }

    /// The lanes of a cell's block whose neighbourhoods hold q: `cell` is any configuration of the cell.
    #[inline(always)]
    fn lanes_around(&self, level: usize, cell: &[f64], q: &[f64], limit: f32) -> u32 {
        if self.on_level[level] == 0 {
            return 0;
        }
        let slot = self.slot(level, |k| cell[self.coordinates[k].index]);
        let block = self.slots[slot] as usize;
        if block == 0 {
            return 0;
        }
        let count = self.coordinates.len();
        let rows = &self.rows[2 * count * (block - 1)..2 * count * block];
        with_widest(Inside {
            rows,
            coordinates: &self.coordinates,
            q,
            limit,
        })
    }

    /// The size of cells for a neighbourhood: its radii are about their sides.
    fn level_of(&self, found: &Neighbourhood) -> usize {
        let scaled = self.coordinates.iter().zip(&found.inverse_radii);
        let cells_per_radius = scaled
            .map(|(coordinate, inverse)| inverse / coordinate.cells_per_unit)
            .filter(|ratio| ratio.is_finite())
            .fold(0.0, f64::max);
        // Of cells with sides s, radii from s / 2 to 2 s are on the first level.
        let levels = [2.0, 8.0].iter();
        levels.filter(|limit| cells_per_radius > **limit).count()
    }

    #[inline(always)]
    fn slot(&self, level: usize, q: impl Fn(usize) -> f64) -> usize {
        (self.hash(level, q) >> 20) as usize % SLOTS
    }

    /// Of the middle-sized cell around a configuration.
    #[inline]
    pub fn cell(&self, q: &[f64]) -> u64 {
        self.hash(1, |k| q[self.coordinates[k].index])
    }

    #[inline(always)]
    fn hash(&self, level: usize, q: impl Fn(usize) -> f64) -> u64 {
        let scale = [1.0, 4.0, 16.0][level];
        let mut hash = level as u64;
        for (k, coordinate) in self.coordinates.iter().take(CELL_COORDINATES).enumerate() {
            // Saturates far out, where cells then coincide.
            let cell = (q(k) * coordinate.cells_per_unit * scale).floor() as i64;
            hash = (hash ^ cell as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            hash ^= hash >> 29;
        }
        hash
    }

    /// The block of a slot; a new one if it has none, or that of another slot once there are as many as may be.
    fn block_for(&mut self, level: usize, slot: usize) -> usize {
        self.slots.resize(SLOTS, 0);
        if self.slots[slot] > 0 {
            return self.slots[slot] as usize - 1;
        }
        self.on_level[level] += 1;
        let rows = 2 * self.coordinates.len();
        let block = if self.blocks.len() < self.max_blocks {
            self.blocks.push((0, 0));
            self.rows.resize(rows * self.blocks.len(), [0.0; PER_CELL]);
            self.blocks.len() - 1
        } else {
            let block = self.oldest;
            self.oldest = (block + 1) % self.max_blocks;
            let (slot, number) = self.blocks[block];
            self.slots[slot as usize] = 0;
            self.kept -= (number as usize).min(PER_CELL);
            block
        };
        // Empty lanes hold nothing.
        let (centers, radii) = self.rows[rows * block..rows * (block + 1)].split_at_mut(rows / 2);
        centers.fill([1e30; PER_CELL]);
        radii.fill([1.0; PER_CELL]);
        self.blocks[block] = (slot as u16, 0);
        self.slots[slot] = block as u16 + 1;
        block
    }
}

/// Which of eight neighbourhoods hold a configuration.
struct Inside<'a> {
    rows: &'a [[f32; PER_CELL]],
    coordinates: &'a [CellCoordinate],
    q: &'a [f64],
    limit: f32,
}

impl Work for Inside<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> u32 {
        let (centers, inverse_radii) = self.rows.split_at(self.coordinates.len());
        let mut sum: Lanes8<I> = lanes.splat(0.0);
        let rows = centers.iter().zip(inverse_radii);
        for (coordinate, (center, inverse)) in self.coordinates.iter().zip(rows) {
            let q = lanes.splat(self.q[coordinate.index] as f32);
            let apart = lanes.abs(lanes.sub(q, lanes.load(center)));
            sum = lanes.mul_add(apart, lanes.load(inverse), sum);
        }
        lanes.at_most(sum, self.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(count: usize) -> NeighbourhoodTable {
        let coordinate = |index| CellCoordinate {
            index,
            cells_per_unit: 2.0,
        };
        NeighbourhoodTable::new((0..count).map(coordinate).collect(), 1 << 20)
    }

    #[test]
    fn a_neighbourhood_holds_what_the_sum_of_scaled_differences_says() {
        let mut table = table(2);
        let center = vec![0.25, 0.25];
        let inverse_radii = vec![4.0, 8.0];
        assert!(table.insert(&Neighbourhood {
            center,
            inverse_radii
        }));
        assert!(table.contains(&[0.25 + 0.12, 0.25 + 0.06]));
        assert!(!table.contains(&[0.25 + 0.13, 0.25 + 0.07]));
        // Another cell.
        assert!(!table.contains(&[0.75, 0.25]));
        let ends: [&[f64]; 2] = [&[0.2, 0.25], &[0.3, 0.25]];
        assert!(table.contains_segment(ends, 0.1));
        assert!(!table.contains_segment([ends[0], &[0.49, 0.25]], 0.1));
    }

    #[test]
    fn far_from_the_origin_rounding_refuses_small_ones() {
        let mut table = table(1);
        let small = |center: f64| Neighbourhood {
            center: vec![center],
            inverse_radii: vec![1e3],
        };
        assert!(table.insert(&small(1.0)));
        assert!(!table.insert(&small(1e4)));
    }

    #[test]
    fn memory_is_bounded() {
        let mut table = table(3);
        for i in 0..100_000 {
            let center = vec![
                f64::from(i % 100),
                f64::from(i / 100 % 100),
                f64::from(i / 10_000),
            ];
            let inverse_radii = vec![1.0; 3];
            table.insert(&Neighbourhood {
                center,
                inverse_radii,
            });
        }
        assert!(table.len() <= NeighbourhoodTable::MAX_BLOCKS * PER_CELL);
        assert_eq!(table.rows.len(), 6 * NeighbourhoodTable::MAX_BLOCKS);
    }
}
