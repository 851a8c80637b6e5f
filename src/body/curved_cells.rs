//! The curved cells of a body: which parts of which patches its triangles stand for, so that queries can refine them.

use super::patch_cell::{Cell, CellPlace};
use crate::pose::Pose;

/// The patches of a body, and which part of them each two triangles stand for. A cell of many control points is halved out of its
/// patch again when it is asked for: the memory is that of the places.
#[derive(Clone, Debug, Default)]
pub(crate) struct CurvedCells {
    patches: Vec<Cell>,
    /// The number of the patches' control points.
    controls: usize,
    /// In order of their primitives.
    cells: Vec<CurvedCell>,
}

#[derive(Clone, Copy, Debug)]
struct CurvedCell {
    /// The first of its two primitives.
    first: u32,
    /// The number of the patch.
    patch: u32,
    place: CellPlace,
}

impl CurvedCells {
    /// Adds a cell of the next patch; its triangles are the primitives `first` and the one after.
    pub fn push(&mut self, first: u32, place: CellPlace) {
        self.cells.push(CurvedCell {
            first,
            patch: self.patches.len() as u32,
            place,
        });
    }

    /// Adds the patch of the cells since the last one.
    pub fn end_patch(&mut self, patch: Cell) {
        self.controls += patch.control_count();
        self.patches.push(patch);
    }

    /// The number of the patches' control points.
    pub fn control_count(&self) -> usize {
        self.controls
    }

    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// Appends the cells of others, moved; their primitives follow from this number on.
    pub fn append(&mut self, others: &Self, first: u32, pose: &Pose) {
        let patches = self.patches.len() as u32;
        self.controls += others.controls;
        let moved = others.patches.iter().map(|patch| patch.moved(pose));
        self.patches.extend(moved);
        self.cells
            .extend(others.cells.iter().map(|cell| CurvedCell {
                first: cell.first + first,
                patch: cell.patch + patches,
                ..*cell
            }));
    }

    /// Brings cells that were appended out of order into the order of their primitives.
    pub fn sort(&mut self) {
        self.cells.sort_unstable_by_key(|cell| cell.first);
    }

    /// The number of the cell that a primitive is of, if it is of one.
    pub fn of(&self, primitive: u32) -> Option<u32> {
        let after = self.cells.partition_point(|cell| cell.first <= primitive);
        let number = after.checked_sub(1)?;
        (primitive - self.cells[number].first < 2).then_some(number as u32)
    }

    /// A cell by its number, in the body's own frame.
    pub fn cell(&self, number: u32) -> Cell {
        let CurvedCell { patch, place, .. } = &self.cells[number as usize];
        self.patches[*patch as usize].part(place)
    }
}
