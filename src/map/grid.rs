//! The grid of a map: intervals of coordinates, each cut into cells.

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::robot::Coordinate;
use crate::space::Space;

/// The most coordinates that a map is over.
pub(super) const MAX_AXES: usize = 6;

/// An interval of a coordinate, cut into equal cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapAxis {
    /// The coordinate's number in the space.
    pub coordinate: usize,
    /// Where the first cell begins.
    pub low: f64,
    /// Where the last ends; above `low`. On a circle the interval may pass the place where angles wrap.
    pub high: f64,
    /// How many cells there are, at least one.
    pub cells: usize,
    /// The cells that the map is of: from the first to before the second.
    pub part: [usize; 2],
}

impl MapAxis {
    /// An axis whose cells are all on the map.
    pub fn new(coordinate: usize, [low, high]: [f64; 2], cells: usize) -> Self {
        Self {
            coordinate,
            low,
            high,
            cells,
            part: [0, cells],
        }
    }

    /// How many cells of it the map has.
    pub fn part_length(&self) -> usize {
        self.part[1] - self.part[0]
    }

    /// Where a cell begins, and the one before it ends.
    pub fn edge(&self, cell: usize) -> f64 {
        if cell == self.cells {
            return self.high;
        }
        self.at(cell as f64)
    }

    /// The middle of a cell: low + (high - low) * ((cell + 0.5) / cells).
    pub fn center(&self, cell: usize) -> f64 {
        self.at(cell as f64 + 0.5)
    }

    /// The coordinate so many cells after `low`.
    pub(crate) fn at(&self, cells: f64) -> f64 {
        let part = cells / self.cells as f64;
        (self.low + (self.high - self.low) * part).min(self.high)
    }

    fn check(&self, space: &Space) -> Result<()> {
        let coordinates = space.coordinates();
        let Some(coordinate) = coordinates.get(self.coordinate) else {
            return Err(Error::new(
                ErrorKind::NotFound,
                format!(
                    "there is no coordinate {} among {}",
                    self.coordinate,
                    coordinates.len()
                ),
            ));
        };
        if *coordinate == Coordinate::Quaternion {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("coordinate {} belongs to a quaternion", self.coordinate),
            ));
        }
        require_coordinates(&[self.low, self.high], "end")?;
        if self.low >= self.high {
            return Err(Error::invalid(format!(
                "low {} is not below high {}",
                self.low, self.high
            )));
        }
        if self.cells == 0 {
            return Err(Error::invalid("there are no cells"));
        }
        let [first, end] = self.part;
        if first >= end || end > self.cells {
            return Err(Error::invalid(format!(
                "there is no part of {} cells from {first} to before {end}",
                self.cells
            )));
        }
        Ok(())
    }
}

/// The axes of a map, and what the other coordinates are.
pub(super) struct Grid<'a> {
    pub axes: &'a [MapAxis],
    pub q: &'a [f64],
    /// How many cells the map has.
    pub cell_count: usize,
}

impl<'a> Grid<'a> {
    pub fn new(space: &Space, q: &'a [f64], axes: &'a [MapAxis]) -> Result<Self> {
        space.check_configuration(q)?;
        if axes.is_empty() || axes.len() > MAX_AXES {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!("a map has 1 to {MAX_AXES} axes, not {}", axes.len()),
            ));
        }
        for (i, axis) in axes.iter().enumerate() {
            let is_taken = |other: &MapAxis| other.coordinate == axis.coordinate;
            let checked = axis.check(space).and_then(|()| {
                if axes[..i].iter().any(is_taken) {
                    let number = axis.coordinate;
                    return Err(Error::invalid(format!("coordinate {number} has two axes")));
                }
                Ok(())
            });
            checked.map_err(|error| error.within(format_args!("axis {i}")))?;
        }
        // All cells are counted, also where the map is of a part: blocks of them are.
        axes.iter()
            .try_fold(1usize, |product, axis| product.checked_mul(axis.cells))
            .ok_or_else(|| Error::new(ErrorKind::WrongSize, "there are too many cells"))?;
        Ok(Self {
            axes,
            q,
            cell_count: axes.iter().map(MapAxis::part_length).product(),
        })
    }

    /// The number of a cell among those of the map: of the last axis, neighbours follow one another.
    pub fn number(&self, cell: &[usize; MAX_AXES]) -> usize {
        let axes = self.axes.iter().zip(cell);
        axes.fold(0, |number, (axis, &place)| {
            number * axis.part_length() + (place - axis.part[0])
        })
    }

    /// Writes the middle of a cell into a configuration that has the other coordinates.
    pub fn set_center(&self, cell: &[usize; MAX_AXES], q: &mut [f64]) {
        for (axis, &place) in self.axes.iter().zip(cell) {
            q[axis.coordinate] = axis.center(place);
        }
    }
}
