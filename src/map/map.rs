//! A map: its axes and the values of its cells.

use std::path::Path;

use super::grid::MapAxis;
use super::npy::npy_head;
use super::png::{Colors, Png};
use crate::error::{Error, ErrorKind, Result};
use crate::whole_file::write_piecewise;

/// The values of a map's cells, row-major: of the last axis, neighbours follow one another.
#[derive(Clone, Debug, PartialEq)]
pub enum MapValues {
    /// The class of each middle: 0 outside, 1 contact, 2 inside.
    Classes(Vec<u8>),
    /// The distance at each middle; infinity beyond the maximum.
    Distances(Vec<f64>),
    /// What is proved of each cell: 0 free, 1 inside, 2 mixed, 3 undecided.
    Cells(Vec<u8>),
}

/// Outside, contact, inside: white, orange, dark red.
const CLASS_COLORS: [[u8; 3]; 3] = [[255, 255, 255], [240, 160, 48], [136, 24, 32]];
/// Free, inside, mixed, undecided: white, dark red, light gray, gray.
const CELL_COLORS: [[u8; 3]; 4] = [
    [255, 255, 255],
    [136, 24, 32],
    [208, 208, 208],
    [128, 128, 128],
];

/// A map of C-space.
#[derive(Clone, Debug)]
pub struct Map {
    pub(super) axes: Vec<MapAxis>,
    pub(super) values: MapValues,
    pub(super) proofs: u64,
    pub(super) questions: u64,
}

impl Map {
    /// The axes, the slowest first.
    pub fn axes(&self) -> &[MapAxis] {
        &self.axes
    }

    /// The values of the cells.
    pub fn values(&self) -> &MapValues {
        &self.values
    }

    /// How many boxes it took to prove.
    pub fn proofs(&self) -> u64 {
        self.proofs
    }

    /// How many configurations were asked one by one.
    pub fn questions(&self) -> u64 {
        self.questions
    }

    /// Writes the values as an array of NumPy's (.npy), of 8-bit or 64-bit numbers, with as many dimensions as the map has axes. The
    /// file is written whole or not at all.
    pub fn save(&self, file: &Path) -> Result<()> {
        let shape: Vec<usize> = self.axes.iter().map(MapAxis::part_length).collect();
        write_piecewise(file, |file| match &self.values {
            MapValues::Classes(values) | MapValues::Cells(values) => {
                file.write_all(&npy_head("|u1", &shape))?;
                file.write_all(values)
            }
            MapValues::Distances(values) => {
                file.write_all(&npy_head("<f8", &shape))?;
                let mut numbers = values.iter();
                numbers.try_for_each(|number| file.write_all(&number.to_le_bytes()))
            }
        })
    }

    /// Writes a picture (.png) of a map with two axes, a pixel a cell: the first axis goes to the right, the second up. Classes are
    /// white, orange and dark red (inside), cells white, dark red, light gray (mixed) and gray (undecided). A distance of 0 is
    /// black, the largest that is finite, and what is infinite, white.
    pub fn show(&self, file: &Path) -> Result<()> {
        let [first, second] = &self.axes[..] else {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("the map has {} axes: a picture needs 2", self.axes.len()),
            ));
        };
        let (width, height) = (first.part_length(), second.part_length());
        let (colors, values) = match &self.values {
            MapValues::Classes(values) => (Colors::Palette(&CLASS_COLORS), Pixels::Bytes(values)),
            MapValues::Cells(values) => (Colors::Palette(&CELL_COLORS), Pixels::Bytes(values)),
            MapValues::Distances(values) => (Colors::Gray, Pixels::shades(values)),
        };
        let picture = Png::new([width, height], colors)?;
        let pixel = |row: usize, column: usize| values.at(column * height + height - 1 - row);
        write_piecewise(file, |file| picture.write(file, pixel))
    }
}

/// What the cells look like.
enum Pixels<'a> {
    Bytes(&'a [u8]),
    /// Of distances, up to the largest that is finite.
    Shades {
        distances: &'a [f64],
        largest: f64,
    },
}

impl<'a> Pixels<'a> {
    fn shades(distances: &'a [f64]) -> Self {
        let finite = distances.iter().filter(|distance| distance.is_finite());
        let largest = finite.fold(0.0, |largest: f64, &distance| largest.max(distance));
        Self::Shades { distances, largest }
    }

    /// Black for 0, and for nothing else; white for the largest finite distance and all beyond.
    fn at(&self, cell: usize) -> u8 {
        match *self {
            Self::Bytes(values) => values[cell],
            Self::Shades { distances, largest } => match distances[cell] {
                0.0 => 0,
                some if some >= largest => 255,
                some => (255.0 * (some / largest)).round().max(1.0) as u8,
            },
        }
    }
}
