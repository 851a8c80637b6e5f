//! Cells of the coordinates between two links in which the links' bodies are proved apart, so that no query needs to look at them there.

use smallvec::SmallVec;

/// The most coordinates that a grid goes over: more of them would make its cells too large.
pub const MAX_CELL_AXES: usize = 3;

/// Cells are proved this much larger on every side, a part of their width, so that where a configuration or a motion is rounded
/// to a neighbouring cell is of no account.
pub const CELL_PAD: f64 = 1e-6;

/// Angles farther from 0 are not looked up: their turns are rounded by more than the pad allows for.
const FARTHEST_ANGLE: f64 = 1e3;

/// How a coordinate is divided into cells.
#[derive(Clone, Copy, Debug)]
pub struct CellAxis {
    /// The coordinate in the space.
    pub coordinate: usize,
    /// Its velocity.
    pub velocity: usize,
    /// Where the first cell begins.
    pub low: f64,
    /// The width of a cell.
    pub width: f64,
    /// The number of cells.
    pub count: u32,
    /// After the last cell comes the first: all of them are a whole turn.
    pub is_periodic: bool,
}

/// A grid of cells, some of which are proved: at no configuration with coordinates in them are the bodies within the contact epsilon of
/// their set of each other, margins taken off, whatever the other coordinates are.
#[derive(Clone, Debug)]
pub struct ClearCells {
    axes: SmallVec<[CellAxis; MAX_CELL_AXES]>,
    /// One bit for each cell; the first axis is the fastest.
    proved: Vec<u64>,
}

impl CellAxis {
    /// Where the cells between two numbers are, with the pad.
    pub fn range(&self, cells: [u32; 2]) -> [f64; 2] {
        let [first, end] = cells.map(f64::from);
        [
            self.low + (first - CELL_PAD) * self.width,
            self.low + (end + CELL_PAD) * self.width,
        ]
    }

    /// A coordinate's place in cells; `None` where there are none.
    #[inline]
    fn place(&self, x: f64) -> Option<f64> {
        let place = (x - self.low) / self.width;
        let is_in = if self.is_periodic {
            x.abs() <= FARTHEST_ANGLE
        } else {
            0.0 <= place && place <= f64::from(self.count)
        };
        is_in.then_some(place)
    }

    /// The cell of a number, which may lie turns away.
    #[inline]
    fn cell(&self, number: i64) -> u64 {
        let count = i64::from(self.count);
        if self.is_periodic {
            number.rem_euclid(count) as u64
        } else {
            number.clamp(0, count - 1) as u64
        }
    }
}

impl ClearCells {
    /// Nothing is proved yet.
    pub fn new(axes: SmallVec<[CellAxis; MAX_CELL_AXES]>) -> Self {
        let cells: u64 = axes.iter().map(|axis| u64::from(axis.count)).product();
        Self {
            axes,
            proved: vec![0; cells.div_ceil(64) as usize],
        }
    }

    /// How its coordinates are divided.
    pub fn axes(&self) -> &[CellAxis] {
        &self.axes
    }

    /// Notes that a block of cells is proved, given by the first number and that behind the last along each axis.
    pub fn prove(&mut self, block: &[[u32; 2]]) {
        let mut cell: SmallVec<[u32; MAX_CELL_AXES]> =
            block.iter().map(|[first, _]| *first).collect();
        'cells: loop {
            let number = self.number(cell.iter().map(|&place| i64::from(place)));
            self.proved[(number / 64) as usize] |= 1 << (number % 64);
            for (place, [first, end]) in cell.iter_mut().zip(block) {
                *place += 1;
                if *place < *end {
                    continue 'cells;
                }
                *place = *first;
            }
            return;
        }
    }

    /// The part of the cells that is proved.
    pub fn proved_share(&self) -> f64 {
        let cells: f64 = self.axes.iter().map(|axis| f64::from(axis.count)).product();
        let proved: u32 = self.proved.iter().map(|bits| bits.count_ones()).sum();
        f64::from(proved) / cells
    }

    /// The memory that it takes.
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(self.proved.as_slice())
    }

    /// Whether the bodies are proved apart at a configuration.
    #[inline]
    pub fn contain(&self, q: &[f64]) -> bool {
        let mut numbers = [0i64; MAX_CELL_AXES];
        for (number, axis) in numbers.iter_mut().zip(&self.axes) {
            let Some(place) = axis.place(q[axis.coordinate]) else {
                return false;
            };
            *number = place.floor() as i64;
        }
        self.is_proved(&numbers)
    }

    /// Whether the bodies are proved apart on the whole way from q with velocity v for a unit of time: it goes from cell to cell, always
    /// over the side that comes next (Amanatides and Woo 1987).
    pub fn contain_motion(&self, q: &[f64], v: &[f64]) -> bool {
        let mut numbers = [0i64; MAX_CELL_AXES];
        // When the next side is reached, and the time from side to side.
        let mut next = [f64::INFINITY; MAX_CELL_AXES];
        let mut between = [f64::INFINITY; MAX_CELL_AXES];
        let mut forward = [false; MAX_CELL_AXES];
        for (k, axis) in self.axes.iter().enumerate() {
            let (start, rate) = (q[axis.coordinate], v[axis.velocity]);
            let (Some(place), Some(_)) = (axis.place(start), axis.place(start + rate)) else {
                return false;
            };
            let speed = rate / axis.width;
            numbers[k] = place.floor() as i64;
            forward[k] = speed > 0.0;
            if speed != 0.0 {
                let side = numbers[k] as f64 + f64::from(u8::from(forward[k]));
                between[k] = 1.0 / speed.abs();
                next[k] = (side - place) / speed;
            }
        }
        loop {
            if !self.is_proved(&numbers) {
                return false;
            }
            let mut first = 0;
            for k in 1..MAX_CELL_AXES {
                if next[k] < next[first] {
                    first = k;
                }
            }
            if next[first] > 1.0 {
                return true;
            }
            next[first] += between[first];
            numbers[first] += if forward[first] { 1 } else { -1 };
        }
    }

    #[inline]
    fn is_proved(&self, numbers: &[i64; MAX_CELL_AXES]) -> bool {
        let number = self.number(numbers[..self.axes.len()].iter().copied());
        self.proved[(number / 64) as usize] >> (number % 64) & 1 == 1
    }

    /// A cell's number among all.
    #[inline]
    fn number(&self, numbers: impl Iterator<Item = i64>) -> u64 {
        let (mut number, mut stride) = (0, 1);
        for (place, axis) in numbers.zip(&self.axes) {
            number += stride * axis.cell(place);
            stride *= u64::from(axis.count);
        }
        number
    }
}
