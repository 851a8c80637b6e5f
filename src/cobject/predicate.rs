//! Pure sets defined by callbacks.

use super::Class;
use crate::error::Result;

/// A pure set defined by the caller. The functions must be pure; threads call them concurrently, from within queries.
pub trait Predicate: Send + Sync {
    /// The class of a configuration.
    fn classify(&self, q: &[f64]) -> Result<Class>;

    /// The signed distance of q from the set, in C-space units: positive outside; inside minus the depth if known, else 0.
    /// `None` if the set does not measure.
    fn distance(&self, q: &[f64]) -> Result<Option<f64>>;

    /// Whether the set measures.
    fn measures(&self) -> bool {
        true
    }

    /// Whether distances are exact; else, as by default, they are lower bounds.
    fn is_exact(&self) -> bool {
        false
    }

    /// Whether distances inside are minus the depth, the exact distance from the complement; by default they are not.
    fn knows_depth(&self) -> bool {
        false
    }

    /// Writes the derivative of the distance, one entry per velocity; returns false if it is not known, as by default.
    fn gradient(&self, q: &[f64], row: &mut [f64]) -> Result<bool> {
        let _ = (q, row);
        Ok(false)
    }
}
