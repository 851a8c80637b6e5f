//! The coordinates of a configuration: their topology, and the blocks of coordinates that move together.

use std::ops::Range;

/// The topology of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// The circle S^1: angles in radians, equal modulo 2 pi.
    Circle,
    /// A closed interval; either end may be infinite.
    Interval {
        /// The lowest value.
        lower: f64,
        /// The highest value.
        upper: f64,
    },
    /// One of the four entries of a unit quaternion.
    Quaternion,
}

impl Coordinate {
    /// The whole line.
    pub const LINE: Self = Self::Interval {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };

    /// Whether a value is in the range; true for circles and quaternions.
    pub fn contains(&self, value: f64) -> bool {
        match *self {
            Coordinate::Circle | Coordinate::Quaternion => true,
            Coordinate::Interval { lower, upper } => lower <= value && value <= upper,
        }
    }
}

/// The kind of a block of coordinates, which decides how velocities move it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockKind {
    /// One coordinate; its velocity is its rate of change.
    Line,
    /// A unit quaternion x, y, z, w; its three velocities are angular, in the moved frame.
    Rotation,
    /// x, y, z and a unit quaternion; its six velocities are linear, then angular, in the moved frame.
    Placement,
}

impl BlockKind {
    /// The number of coordinates, the first ones, that move along lines.
    pub fn lines(self) -> usize {
        match self {
            BlockKind::Line => 1,
            BlockKind::Rotation => 0,
            BlockKind::Placement => 3,
        }
    }

    /// The number of coordinates.
    pub fn nq(self) -> usize {
        match self {
            BlockKind::Line => 1,
            BlockKind::Rotation => 4,
            BlockKind::Placement => 7,
        }
    }

    /// The number of velocities.
    pub fn nv(self) -> usize {
        match self {
            BlockKind::Line => 1,
            BlockKind::Rotation => 3,
            BlockKind::Placement => 6,
        }
    }
}

/// A block of coordinates that move together, with its velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block {
    /// What the coordinates stand for.
    pub kind: BlockKind,
    /// The first coordinate.
    pub coordinate: usize,
    /// The first velocity.
    pub velocity: usize,
}

impl Block {
    /// The coordinates that a quaternion ties to each other, its own and those of the place it stands beside; none of a line.
    pub fn tied_coordinates(&self) -> Range<usize> {
        match self.kind {
            BlockKind::Line => 0..0,
            BlockKind::Rotation | BlockKind::Placement => {
                self.coordinate..self.coordinate + self.kind.nq()
            }
        }
    }
}
