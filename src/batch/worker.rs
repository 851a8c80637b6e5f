//! What a thread of a batch keeps.

use crate::query::QueryContext;

/// Its caches and scratch memory.
#[derive(Default)]
pub(super) struct Worker {
    pub context: QueryContext,
    /// A row of a gradient.
    pub row: Vec<f64>,
}
