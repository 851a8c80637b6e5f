//! The cells of a tile as few boxes: a piece of a wall is one box, not sixteen cells.

use super::cells::{Cells, Cube};
use super::tiles::TILE_LEVEL;

/// The cells along an edge of a tile; of a larger one, which is full, as many cubes of cells stand for them.
pub const CELLS: u32 = 1 << TILE_LEVEL;

/// A box of cells: its lowest one, and the number of cells along each edge.
pub type CellBox = ([u32; 3], [u32; 3]);

/// How far apart in a pattern two cells are that are neighbours along each axis.
const STRIDES: [u32; 3] = [1, CELLS, CELLS * CELLS];

/// Which cells of a tile are occupied, one bit each, those along x first, then y, then z.
pub fn pattern(cells: &Cells, tile: Cube) -> u64 {
    let unit = tile.edge() / CELLS;
    let mut bits = 0;
    cells.visit(tile, tile.level - TILE_LEVEL, &mut |cube| {
        let low = [0, 1, 2].map(|axis| (cube.low[axis] - tile.low[axis]) / unit);
        bits |= mask(low, [cube.edge() / unit; 3]);
    });
    bits
}

/// Boxes that cover the occupied cells of a pattern and no other. They may overlap, and none could be larger.
pub fn tile_boxes(pattern: u64) -> Vec<CellBox> {
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let covers = orders.map(|order| cover(pattern, order));
    let fewest = covers.into_iter().min_by_key(Vec::len);
    fewest.unwrap_or_default()
}

/// Each box begins with the first cell that no box before it covers, and grows along one axis after the other.
fn cover(pattern: u64, order: [usize; 3]) -> Vec<CellBox> {
    let mut boxes = Vec::new();
    let mut rest = pattern;
    while rest != 0 {
        let first = rest.trailing_zeros();
        let low = STRIDES.map(|stride| first / stride % CELLS);
        let (mut low, mut edges) = (low, [1; 3]);
        let is_within = |low: [u32; 3], edges: [u32; 3]| {
            let bits = mask(low, edges);
            pattern & bits == bits
        };
        for axis in order {
            while low[axis] + edges[axis] < CELLS && is_within(low, with(edges, axis, 1)) {
                edges[axis] += 1;
            }
            // Below are cells that other boxes cover.
            while low[axis] > 0 && is_within(with(low, axis, u32::MAX), with(edges, axis, 1)) {
                low[axis] -= 1;
                edges[axis] += 1;
            }
        }
        boxes.push((low, edges));
        rest &= !mask(low, edges);
    }
    boxes
}

fn with(mut numbers: [u32; 3], axis: usize, more: u32) -> [u32; 3] {
    numbers[axis] = numbers[axis].wrapping_add(more);
    numbers
}

/// The bits of a box of cells.
fn mask(low: [u32; 3], edges: [u32; 3]) -> u64 {
    let mut bits = 1;
    for (edge, stride) in edges.into_iter().zip(STRIDES) {
        bits = (0..edge).fold(0, |all, i| all | bits << (i * stride));
    }
    let place: u32 = (0..3).map(|axis| low[axis] * STRIDES[axis]).sum();
    bits << place
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;

    #[test]
    fn boxes_cover_the_cells_of_a_pattern_and_no_other() {
        let mut random = Random::new(1);
        let checked = |pattern: u64| {
            let boxes = tile_boxes(pattern);
            let mut covered = [false; 64];
            for (low, edges) in &boxes {
                let range = |axis: usize| low[axis]..low[axis] + edges[axis];
                for z in range(2) {
                    for y in range(1) {
                        range(0).for_each(|x| covered[(x + 4 * y + 16 * z) as usize] = true);
                    }
                }
            }
            assert!((0..64).all(|cell| covered[cell] == (pattern >> cell & 1 == 1)));
            boxes.len()
        };
        for _ in 0..1000 {
            let bits = [0; 3].map(|_| random.bits());
            for pattern in [bits[0], bits[0] & bits[1], bits[0] | bits[1] | bits[2]] {
                assert!(checked(pattern) <= pattern.count_ones() as usize);
            }
        }
        let (wall, two_walls, post) = (0xffff, 0xffff_000f_000f_000f, 0x8000_8000_8000_8000);
        assert_eq!(
            [0, u64::MAX, wall, two_walls, post].map(checked),
            [0, 1, 1, 2, 1]
        );
        let chequered = (0..64).filter(|i| (i ^ i >> 2 ^ i >> 4) & 1 == 0);
        assert_eq!(checked(chequered.map(|i| 1u64 << i).sum()), 32);
    }
}
