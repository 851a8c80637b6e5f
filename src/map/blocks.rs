//! Blocks of cells: they are halved until they can be decided.

use super::grid::{Grid, MAX_AXES};

/// Consecutive cells along each axis: from `first` to before `end`. Axes that a map does not have have one cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub first: [usize; MAX_AXES],
    pub end: [usize; MAX_AXES],
}

impl Block {
    /// All cells.
    pub fn whole(grid: &Grid) -> Self {
        let mut end = [1; MAX_AXES];
        for (end, axis) in end.iter_mut().zip(grid.axes) {
            *end = axis.cells;
        }
        Self {
            first: [0; MAX_AXES],
            end,
        }
    }

    /// The cells that the map is of.
    pub fn part(grid: &Grid) -> Self {
        let mut part = Self::whole(grid);
        for (i, axis) in grid.axes.iter().enumerate() {
            [part.first[i], part.end[i]] = axis.part;
        }
        part
    }

    /// The cells that are in another block too; `None` if there are none.
    pub fn within(&self, other: &Self) -> Option<Self> {
        let mut both = *self;
        for i in 0..MAX_AXES {
            both.first[i] = self.first[i].max(other.first[i]);
            both.end[i] = self.end[i].min(other.end[i]);
            if both.first[i] >= both.end[i] {
                return None;
            }
        }
        Some(both)
    }

    pub fn cell_count(&self) -> usize {
        let sides = self.first.iter().zip(&self.end);
        sides.map(|(first, end)| end - first).product()
    }

    /// Both halves across the axis with the most cells; `None` for a single cell.
    pub fn halves(&self) -> Option<[Self; 2]> {
        let length = |axis: usize| self.end[axis] - self.first[axis];
        // Of equal ones the first.
        let longest = (0..MAX_AXES).rev().max_by_key(|&axis| length(axis))?;
        if length(longest) < 2 {
            return None;
        }
        let middle = self.first[longest] + length(longest) / 2;
        let mut halves = [*self; 2];
        halves[0].end[longest] = middle;
        halves[1].first[longest] = middle;
        Some(halves)
    }

    /// Parts of about equal size, at least so many if there are cells enough.
    pub fn parts(&self, count: usize) -> Vec<Self> {
        let mut parts = vec![*self];
        while parts.len() < count {
            let halved = parts.iter().flat_map(|part| match part.halves() {
                Some(halves) => halves.to_vec(),
                None => vec![*part],
            });
            let halved: Vec<Self> = halved.collect();
            if halved.len() == parts.len() {
                break;
            }
            parts = halved;
        }
        parts
    }

    /// The cells, those of the last axis following one another.
    pub fn cells(&self) -> impl Iterator<Item = [usize; MAX_AXES]> {
        let Self { first, end } = *self;
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let cell = next?;
            let mut after = cell;
            next = (0..MAX_AXES).rev().find_map(|axis| {
                after[axis] += 1;
                if after[axis] < end[axis] {
                    return Some(after);
                }
                after[axis] = first[axis];
                None
            });
            Some(cell)
        })
    }
}
