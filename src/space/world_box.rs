//! The world box: bounds for the links' origins.

use crate::error::{Error, ErrorKind, Result, require_coordinates};
use crate::pose::Vec3;

/// The axis-aligned box that the links' origins must stay in; ends may be infinite.
#[derive(Clone, Copy, Debug)]
pub struct WorldBox {
    /// The smallest x, y, z.
    pub low: [f64; 3],
    /// The largest x, y, z.
    pub high: [f64; 3],
}

impl WorldBox {
    /// The box that bounds nothing.
    pub fn unbounded() -> Self {
        Self {
            low: [f64::NEG_INFINITY; 3],
            high: [f64::INFINITY; 3],
        }
    }

    /// Whether a point is in the closed box.
    pub fn contains(&self, point: &Vec3) -> bool {
        (0..3).all(|i| self.low[i] <= point[i] && point[i] <= self.high[i])
    }

    pub(super) fn check(&self) -> Result<()> {
        for i in 0..3 {
            if self.low[i].is_nan() || self.high[i].is_nan() {
                return Err(Error::new(
                    ErrorKind::NotFinite,
                    "the world box holds a NaN",
                ));
            }
            let [low, high] = [self.low[i], self.high[i]];
            if low > high || low == f64::INFINITY || high == f64::NEG_INFINITY {
                return Err(Error::invalid(format!(
                    "the world box is empty along axis {i}: {low} to {high}"
                )));
            }
            for end in [low, high].into_iter().filter(|end| end.is_finite()) {
                require_coordinates(&[end], "end of the world box")?;
            }
        }
        Ok(())
    }
}
