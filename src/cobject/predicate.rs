//! Sets that the caller defines by functions.

use super::Class;
use crate::error::Result;

/// A pure set by functions of the caller. They must be pure; threads may call them at once, also within queries.
pub trait Predicate: Send + Sync {
    /// Whether a configuration is in the set, near it or outside.
    fn classify(&self, q: &[f64]) -> Result<Class>;

    /// How far q is from the set, in C-space units: positive outside, and not positive inside (0, or minus the depth if that
    /// is known). `None` if the set does not measure.
    fn distance(&self, q: &[f64]) -> Result<Option<f64>>;

    /// Whether there are distances at all.
    fn measures(&self) -> bool {
        true
    }

    /// Whether distances are exact; else the truth may be more.
    fn is_exact(&self) -> bool;

    /// Whether distances inside are minus the depth: the distance from the complement, exactly.
    fn knows_depth(&self) -> bool;

    /// Writes the derivative of the distance, one entry a velocity; false if it is not known.
    fn gradient(&self, q: &[f64], row: &mut [f64]) -> Result<bool>;
}
