//! Bezier patches.

use super::builder::BodyBuilder;
use super::control_points::{require_degrees, weighted};
use super::patch_cell::{Cell, size};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

/// A tensor product Bezier patch, rational where it has weights. Control points come row by row: point j of row i belongs to degree i
/// of the first parameter and j of the second.
#[derive(Clone, Copy, Debug)]
pub struct BezierPatch<'a> {
    /// In the first and the second parameter.
    pub degrees: [usize; 2],
    /// The control points.
    pub points: &'a [Vec3],
    /// A positive weight for each; `None` for ones.
    pub weights: Option<&'a [f64]>,
}

impl BodyBuilder {
    /// Adds triangles that are within the tolerance of a patch. The body states how far they are from it at most, for this patch; it is
    /// no part of the boundary of a solid.
    pub fn add_bezier_patch(
        &mut self,
        patch: &BezierPatch,
        tolerance: f64,
        tag: u64,
    ) -> Result<()> {
        let cell = patch.cell()?;
        self.require_planar(patch.points)?;
        self.add_patches(std::iter::once(cell), tolerance, tag)
    }
}

impl BezierPatch<'_> {
    /// The checked patch.
    fn cell(&self) -> Result<Cell> {
        require_degrees(self.degrees)?;
        let sizes = self.degrees.map(|degree| degree + 1);
        let count = sizes[0] * sizes[1];
        if self.points.len() != count {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!(
                    "degrees {} and {} need {count} control points, not {}",
                    self.degrees[0],
                    self.degrees[1],
                    self.points.len()
                ),
            ));
        }
        let controls = weighted(self.points, self.weights)?;
        let size = size(&controls);
        Ok(Cell::whole(sizes, controls, size, 0))
    }
}
