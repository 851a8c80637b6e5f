//! Patches as triangles that are proved to be within a tolerance of them: each is halved until two triangles over the corners of
//! each cell are near enough.

use super::builder::BodyBuilder;
use super::curved_cells::CurvedCells;
use super::patch_cell::Cell;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::primitive::{Convex, convex_polygon, convex_polyhedron};

/// The most cells of a surface, of two triangles each.
pub const MAX_CELLS: usize = 1 << 18;

/// The patches of a surface are kept for queries to refine if they have at most so many control points together, 32 bytes each.
/// Inserted knots make many times more of them than were given.
const MAX_KEPT: usize = 1 << 20;

impl BodyBuilder {
    /// Adds triangles that are within the tolerance of a surface of patches: all of them or none. The body states how far they are from
    /// it at most; they are no part of the boundary of a solid.
    pub(super) fn add_patches(
        &mut self,
        patches: impl ExactSizeIterator<Item = Cell>,
        tolerance: f64,
        tag: u64,
    ) -> Result<()> {
        require_finite(&[tolerance], "tolerance")?;
        if tolerance <= 0.0 {
            return Err(Error::invalid(format!(
                "tolerance is {tolerance}; it must be above 0"
            )));
        }
        let mut added: Vec<(Convex, u64)> = Vec::new();
        let mut deviation = 0.0f64;
        let first = self.len();
        let mut curved = Some(CurvedCells::default());
        let mut count = 0;
        let mut to_come = patches.len();
        for patch in patches {
            to_come -= 1;
            for_each_cell(&patch, tolerance, (&mut count, to_come), |cell, bound| {
                deviation = deviation.max(bound);
                if let Some(cells) = &mut curved {
                    cells.push((first + added.len()) as u32, cell.place());
                }
                for triangle in cell.triangles() {
                    let primitive = match convex_polygon(&triangle) {
                        // Where an edge of the patch is a point.
                        Err(error) if error.kind == ErrorKind::Degenerate => {
                            convex_polyhedron(&triangle)?
                        }
                        polygon => polygon?,
                    };
                    added.push((primitive, tag));
                }
                Ok(())
            })?;
            if let Some(cells) = &mut curved {
                cells.end_patch(patch);
            }
            curved = curved.filter(|cells| cells.control_count() <= MAX_KEPT);
        }
        self.push_all(added, false)?;
        self.take_curved(curved, deviation);
        Ok(())
    }
}

/// Halves a patch until each part is proved to be within the tolerance of two triangles; gives each with its bound. `count` is the
/// number of cells so far, `to_come` that of the patches after this one.
fn for_each_cell(
    patch: &Cell,
    tolerance: f64,
    (count, to_come): (&mut usize, usize),
    mut visit: impl FnMut(&Cell, f64) -> Result<()>,
) -> Result<()> {
    let mut todo = vec![patch.clone()];
    while let Some(cell) = todo.pop() {
        let bound = cell.deviation();
        if bound <= tolerance {
            *count += 1;
            visit(&cell, bound)?;
            continue;
        }
        if *count + todo.len() + to_come >= MAX_CELLS || !cell.has_halves() {
            return Err(Error::new(
                ErrorKind::Limit,
                format!(
                    "tolerance {tolerance:e} needs more than {MAX_CELLS} cells, or is less than what coordinates are rounded to"
                ),
            ));
        }
        let along = cell.bent_along();
        let [lower, upper] = cell.halves(along);
        todo.extend([upper, lower]);
    }
    Ok(())
}
