//! Witnesses by region of C-space: what met last where the joints that move it were about as now (§2.3.4).

use super::cache_key::CacheKey;

/// Cells remembered: a power of two.
const CELLS: usize = 1 << 9;

/// Looks that a subject gets before it is judged, and how many of them must have found something that meets.
const WINDOW: u32 = 64;
const ENOUGH: u32 = WINDOW / 4;

/// Queries in which nothing is looked up after a window that found too little.
const REST: u32 = 1 << 10;

/// The primitive pair that met last in each cell.
#[derive(Debug, Default)]
pub(super) struct WitnessCells {
    /// By hash of the cell: cells whose hashes share a place replace each other.
    cells: Vec<Option<(u64, CacheKey, [u32; 2])>>,
    looks: u32,
    found: u32,
    rests: u32,
}

impl WitnessCells {
    pub fn insert(&mut self, hash: u64, key: CacheKey, places: [u32; 2]) {
        self.cells.resize(CELLS, None);
        self.cells[hash as usize % CELLS] = Some((hash, key, places));
    }

    /// What met last in a cell.
    #[inline]
    pub fn get(&mut self, hash: u64) -> Option<(CacheKey, [u32; 2])> {
        if self.rests > 0 {
            self.rests -= 1;
            return None;
        }
        let known = self.cells.get(hash as usize % CELLS)?.as_ref();
        known
            .filter(|(cell, ..)| *cell == hash)
            .map(|(_, key, places)| (*key, *places))
    }

    /// Counts a look at what [`Self::get`] gave.
    pub fn judge(&mut self, meets: bool) {
        self.looks += 1;
        self.found += u32::from(meets);
        if self.looks == WINDOW {
            if self.found < ENOUGH {
                self.rests = REST;
            }
            (self.looks, self.found) = (0, 0);
        }
    }
}
