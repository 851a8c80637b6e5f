//! An octree: cells of one size that are occupied or not, changed while it is part of an environment.

use std::path::Path;
use std::sync::Arc;

use super::cells::{Cells, Cube, GRID, WHOLE};
use super::cubes::{steps, whole_body};
use super::octomap_file::read_octomap_file;
use super::placement::Placement;
use crate::body::Body;
use crate::environment::Environment;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::hierarchy::HierarchyOptions;
use crate::pose::{Pose, Vec3};
use crate::tolerance::{LARGEST_COORDINATE, SMALLEST_DIAMETER};
use crate::user_data::UserData;

/// A set of occupied cells of a grid of 2^16 cells along each axis, centred on the origin. The occupied cells are solid.
#[derive(Debug)]
pub struct Octree {
    resolution: f64,
    cells: Cells,
    placement: Option<Placement>,
}

/// Changes of cells that are taken back unless they are kept: also where a panic ends them.
struct Attempt<'a> {
    cells: &'a mut Cells,
    is_occupied: bool,
    /// The cells that were not so before.
    changed: Vec<Cube>,
}

impl Attempt<'_> {
    fn set(&mut self, cell: [u32; 3]) -> Result<()> {
        if self.cells.set(cell, self.is_occupied)? {
            self.changed.push(Cube::around(cell, 0));
        }
        Ok(())
    }

    /// The number of cells that changed.
    fn keep(mut self) -> usize {
        std::mem::take(&mut self.changed).len()
    }
}

impl Drop for Attempt<'_> {
    fn drop(&mut self) {
        for &cube in &self.changed {
            self.cells.put_cube(cube, !self.is_occupied);
        }
    }
}

impl Octree {
    /// An octree without occupied cells; `resolution` is the edge of a cell.
    pub fn new(resolution: f64) -> Result<Self> {
        Self::of(resolution, Cells::default())
    }

    /// Reads an OctoMap file (.bt or .ot). Of an .ot file, leaves whose occupancy is at least `min_occupancy` are occupied; a
    /// .bt file says itself which are.
    pub fn load(path: &Path, min_occupancy: f64) -> Result<Self> {
        let named = |error: Error| error.within(path.display());
        let (resolution, cells) = read_octomap_file(path, min_occupancy).map_err(named)?;
        Self::of(resolution, cells).map_err(named)
    }

    fn of(resolution: f64, cells: Cells) -> Result<Self> {
        require_finite(&[resolution], "resolution")?;
        let largest = LARGEST_COORDINATE / f64::from(GRID);
        if !(SMALLEST_DIAMETER..=largest).contains(&resolution) {
            return Err(Error::invalid(format!(
                "the resolution is {resolution}; it must be from {SMALLEST_DIAMETER:e} to {largest:e}"
            )));
        }
        Ok(Self {
            resolution,
            cells,
            placement: None,
        })
    }

    /// The edge of a cell.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The number of occupied cells.
    pub fn cell_count(&self) -> u64 {
        self.cells.count()
    }

    /// The number of objects that it is, where it is placed in an environment.
    pub fn object_count(&self) -> usize {
        self.placement.as_ref().map_or(0, Placement::object_count)
    }

    /// The largest cubes of occupied cells: lowest corner and edge. Equal sets of cells have equal cubes in equal order.
    pub fn cubes(&self) -> Vec<(Vec3, f64)> {
        let mut cubes = Vec::new();
        self.visit_cubes(&mut |low, edge| cubes.push((low, edge)));
        cubes
    }

    /// Visits the cubes of [`Octree::cubes`] in their order.
    pub fn visit_cubes(&self, visit: &mut dyn FnMut(Vec3, f64)) {
        self.cells.visit(WHOLE, 0, &mut |cube: Cube| {
            let edge = f64::from(cube.edge()) * self.resolution;
            visit(steps(cube.low) * self.resolution, edge);
        });
    }

    /// Whether the cells around points are occupied.
    pub fn are_occupied(&self, points: &[Vec3]) -> Result<Vec<bool>> {
        let cells = self.cells_at(points)?;
        Ok(cells.into_iter().map(|cell| self.cells.get(cell)).collect())
    }

    /// Makes the cells around points occupied, or empty. Returns how many cells changed. Where the octree is placed in an
    /// environment, the objects follow in one change of it; if that fails, nothing changes.
    pub fn set(&mut self, points: &[Vec3], is_occupied: bool) -> Result<usize> {
        let named = self.cells_at(points)?;
        let mut attempt = Attempt {
            cells: &mut self.cells,
            is_occupied,
            changed: Vec::new(),
        };
        for cell in named {
            attempt.set(cell)?;
        }
        if let Some(placement) = &mut self.placement {
            placement.follow(attempt.cells, self.resolution, &attempt.changed)?;
        }
        Ok(attempt.keep())
    }

    /// Makes the cells that are occupied in another octree occupied. Both must have one resolution.
    pub fn insert(&mut self, other: &Self) -> Result<()> {
        if other.resolution != self.resolution {
            return Err(Error::invalid(format!(
                "the resolutions are {} and {}; they must be the same",
                self.resolution, other.resolution
            )));
        }
        let mut changed = Vec::new();
        other.cells.visit(WHOLE, 0, &mut |cube| {
            let (level, is_occupied) = self.cells.leaf(cube.low);
            if !is_occupied || level < cube.level {
                changed.push(cube);
            }
        });
        if changed.is_empty() {
            return Ok(());
        }
        let mut cells = self.cells.clone();
        for &cube in &changed {
            cells.set_cube(cube, true)?;
        }
        if let Some(placement) = &mut self.placement {
            placement.follow(&cells, self.resolution, &changed)?;
        }
        self.cells = cells;
        Ok(())
    }

    /// The body of the occupied cells, in the octree's frame; it does not follow changes. Its primitives are those of
    /// [`Octree::cubes`], tagged with their numbers.
    pub fn body(
        &self,
        options: &HierarchyOptions,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Body> {
        whole_body(&self.cells, self.resolution, options, progress)
    }

    /// Places the octree in an environment, where it follows all further changes. It can be in one environment only. Data are
    /// those of its objects.
    pub fn place(
        &mut self,
        environment: &Arc<Environment>,
        pose: &Pose,
        data: Option<UserData>,
    ) -> Result<()> {
        if self.placement.is_some() {
            return Err(Error::invalid(
                "the octree is in an environment; remove it there first",
            ));
        }
        let placed = Placement::new(environment, pose, data, &self.cells, self.resolution)?;
        self.placement = Some(placed);
        Ok(())
    }

    /// Moves the octree within its environment.
    pub fn move_to(&mut self, pose: &Pose) -> Result<()> {
        match &mut self.placement {
            Some(placement) => placement.move_to(pose, &self.cells, self.resolution),
            None => Err(Error::new(
                ErrorKind::NotFound,
                "the octree is in no environment",
            )),
        }
    }

    /// Takes the octree out of its environment, if it is in one.
    pub fn remove(&mut self) -> Result<()> {
        if let Some(placement) = &mut self.placement {
            placement.remove()?;
        }
        self.placement = None;
        Ok(())
    }

    fn cells_at(&self, points: &[Vec3]) -> Result<Vec<[u32; 3]>> {
        let cells = points.iter().enumerate().map(|(i, point)| {
            let named = |e: Error| e.within(format_args!("point {i}"));
            self.cell_at(point).map_err(named)
        });
        cells.collect()
    }

    /// The cell around a point. A point between two cells belongs to the upper one.
    fn cell_at(&self, point: &Vec3) -> Result<[u32; 3]> {
        require_finite(point.as_slice(), "coordinate")?;
        let mut cell = [0; 3];
        for (axis, c) in cell.iter_mut().enumerate() {
            let steps = (point[axis] / self.resolution).floor() + f64::from(GRID / 2);
            if !(0.0..f64::from(GRID)).contains(&steps) {
                let half = self.resolution * f64::from(GRID / 2);
                return Err(Error::invalid(format!(
                    "coordinate {axis} is {}; the octree reaches from {} to {half}",
                    point[axis], -half
                )));
            }
            *c = steps as u32;
        }
        Ok(cell)
    }
}
