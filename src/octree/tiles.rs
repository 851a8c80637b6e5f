//! The tiles that an octree is cut into, each an object of the environment that the octree is placed in.

use std::collections::BTreeMap;

use super::cells::{Cells, Cube, LEVELS};

/// A tile has 4 cells along an edge, or it is a larger cube of occupied cells. Larger tiles make fewer objects for queries to
/// find, but a change of a cell builds the body of its tile anew: at most 32 boxes, with 8 cells along an edge at most 256.
/// Four also lets 64 bits tell what a tile holds, so that equal ones share a body.
pub const TILE_LEVEL: u32 = 2;

/// A tile and its object.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    pub cube: Cube,
    /// The id of its object.
    pub id: u64,
}

/// The tiles by the places of their lowest cells along the octree's order.
pub type Tiles = BTreeMap<u64, Tile>;

/// The place of a cell along the order of the octants: cubes take up consecutive places.
pub fn place_of(cell: [u32; 3]) -> u64 {
    (0..LEVELS).fold(0, |place, level| {
        let bit = |axis: usize| u64::from((cell[axis] >> level) & 1) << (3 * level + axis as u32);
        place | bit(0) | bit(1) | bit(2)
    })
}

/// The places of a cube's cells.
fn places_of(cube: Cube) -> std::ops::Range<u64> {
    let first = place_of(cube.low);
    first..first + (1 << (3 * cube.level))
}

/// The tiles within a cube.
pub fn within(tiles: &Tiles, cube: Cube) -> impl Iterator<Item = (u64, Tile)> {
    tiles
        .range(places_of(cube))
        .map(|(&place, &tile)| (place, tile))
}

/// The tile that holds a cell.
fn around(tiles: &Tiles, cell: [u32; 3]) -> Option<Tile> {
    let place = place_of(cell);
    let (_, tile) = tiles.range(..=place).next_back()?;
    places_of(tile.cube).contains(&place).then_some(*tile)
}

/// Disjoint cubes whose tiles must be made anew after the cells of some cubes changed: as large as the largest tile there was
/// or is now around each.
pub fn outdated(tiles: &Tiles, cells: &Cells, changed: &[Cube]) -> Vec<Cube> {
    let mut cubes: Vec<Cube> = changed
        .iter()
        .map(|cube| {
            let before = around(tiles, cube.low).map_or(0, |tile| tile.cube.level);
            let now = match cells.leaf(cube.low) {
                (level, true) => level,
                (_, false) => 0,
            };
            let level = TILE_LEVEL.max(cube.level).max(before).max(now);
            Cube::around(cube.low, level)
        })
        .collect();
    cubes.sort_unstable_by_key(|cube| (place_of(cube.low), LEVELS - cube.level));
    let mut last: Option<Cube> = None;
    cubes.retain(|&cube| {
        let is_new = last.is_none_or(|last| !last.holds(cube));
        if is_new {
            last = Some(cube);
        }
        is_new
    });
    cubes
}
