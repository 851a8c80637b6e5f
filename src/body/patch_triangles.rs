//! Patches as triangles that are proved to be within a tolerance of them: each is halved until two triangles over the corners of
//! each cell are near enough.

use super::builder::BodyBuilder;
use super::patch_cell::Cell;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::primitive::{Convex, convex_polygon, convex_polyhedron};

/// The most cells of a surface, of two triangles each.
pub const MAX_CELLS: usize = 1 << 18;

/// A cell is halved at most this often: sides get shorter than coordinates are rounded to.
const MAX_HALVINGS: u32 = 80;

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
        for_each_cell(patches, tolerance, |cell, bound| {
            deviation = deviation.max(bound);
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
        self.push_all(added, false)?;
        self.raise_deviation(deviation);
        Ok(())
    }
}

/// Halves cells until each part is proved to be within the tolerance of two triangles; gives each with its bound, in the order of the
/// patches.
fn for_each_cell(
    mut patches: impl ExactSizeIterator<Item = Cell>,
    tolerance: f64,
    mut visit: impl FnMut(&Cell, f64) -> Result<()>,
) -> Result<()> {
    let mut todo = Vec::new();
    let mut cells = 0;
    while let Some(cell) = todo.pop().or_else(|| patches.next()) {
        let bound = cell.deviation();
        if bound <= tolerance {
            cells += 1;
            visit(&cell, bound)?;
            continue;
        }
        if cells + todo.len() + patches.len() >= MAX_CELLS || cell.halvings() == MAX_HALVINGS {
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
