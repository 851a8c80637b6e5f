//! One coordinate of a C-space.

/// The topology of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// The circle S^1: angles in radians, equal modulo 2 pi.
    Circle,
    /// A closed interval; either end may be infinite.
    Interval { lower: f64, upper: f64 },
}

impl Coordinate {
    pub fn contains(&self, value: f64) -> bool {
        match *self {
            Coordinate::Circle => true,
            Coordinate::Interval { lower, upper } => lower <= value && value <= upper,
        }
    }

    /// The nearest value in range.
    pub fn clamp(&self, value: f64) -> f64 {
        match *self {
            Coordinate::Circle => value,
            Coordinate::Interval { lower, upper } => value.clamp(lower, upper),
        }
    }
}
