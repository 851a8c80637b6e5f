//! What is proved of the link pairs of a set.

use super::clear_cells::ClearCells;

/// Grids of the pairs of links that few coordinates move relative to each other.
#[derive(Clone, Debug, Default)]
pub struct ClearPairs {
    /// The number of links of the space.
    links: usize,
    /// For each link a row over all links: 0, or the place of the pair's grid counted from 1.
    places: Vec<u32>,
    grids: Vec<ClearCells>,
}

impl ClearPairs {
    /// Of a space with so many links.
    pub fn new(links: usize) -> Self {
        Self {
            links,
            places: vec![0; links * links],
            grids: Vec::new(),
        }
    }

    /// Adds the grid of a pair, whose links may be given in either order.
    pub fn add(&mut self, [r, s]: [usize; 2], grid: ClearCells) {
        self.grids.push(grid);
        for [r, s] in [[r, s], [s, r]] {
            self.places[r * self.links + s] = self.grids.len() as u32;
        }
    }

    /// The grid of a pair.
    #[inline]
    pub fn of(&self, [r, s]: [usize; 2]) -> Option<&ClearCells> {
        let place = self.places[r * self.links + s].checked_sub(1)?;
        Some(&self.grids[place as usize])
    }

    /// All grids, in the order in which they were added.
    pub fn grids(&self) -> &[ClearCells] {
        &self.grids
    }
}
