//! The body of all occupied cells.

use super::cells::{Cells, GRID, WHOLE};
use crate::body::{Body, BodyBuilder};
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::HierarchyOptions;
use crate::pose::Vec3;

/// The most cubes of a body. So many take some 10 GB while it is built.
const MAX_CUBES: usize = 1 << 22;

/// Where a cell begins, in edges of a cell from the origin: the origin is the corner in the middle of the grid.
pub fn steps(cell: [u32; 3]) -> Vec3 {
    let middle = f64::from(GRID / 2);
    Vec3::from(cell.map(|c| f64::from(c) - middle))
}

/// The body of the occupied cells, in the octree's frame. Its primitives are the largest full cubes, in the order of
/// [`Cells::visit`], tagged with their numbers.
pub fn whole_body(
    cells: &Cells,
    resolution: f64,
    options: &HierarchyOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<Body> {
    let mut count = 0;
    cells.visit(WHOLE, 0, &mut |_| count += 1);
    if count > MAX_CUBES {
        return Err(Error::new(
            ErrorKind::Unsupported,
            format!("{count} cubes; a body holds at most {MAX_CUBES} of them"),
        ));
    }
    if count == 0 {
        return Err(Error::new(ErrorKind::Empty, "no cell is occupied"));
    }
    let mut cubes = Vec::with_capacity(count);
    cells.visit(WHOLE, 0, &mut |cube| {
        let edge = f64::from(cube.edge()) * resolution;
        cubes.push((steps(cube.low) * resolution, Vec3::repeat(edge)));
    });
    let mut builder = BodyBuilder::new(3)?;
    builder.add_aligned_boxes(&cubes)?;
    builder.build(options, progress)
}
