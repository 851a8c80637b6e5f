//! The work of queries, counted for statistics and against a limit per call.

use crate::error::{Error, ErrorKind, Result};

/// Counts of work done, for the user.
#[derive(Clone, Copy, Debug, Default)]
pub struct Statistics {
    /// Pairs of boxes, or of the bodies' bounding spheres, whose bound was computed; for rays, the boxes tested.
    pub node_pairs: u64,
    /// Primitive pairs visited; for rays, the faces tested.
    pub primitive_pairs: u64,
    /// Primitive pairs whose distance was computed. Those that a direction from an earlier pair separates are not among them.
    pub primitive_distances: u64,
    /// Cached witnesses that were evaluated first.
    pub cache_hits: u64,
}

/// Counts node pairs and primitive pairs. Beyond the limit of a call, searches stop and [`WorkMeter::check`] refuses their
/// result.
#[derive(Debug)]
pub struct WorkMeter {
    pub done: Statistics,
    /// The limit of each call; `None` for no limit.
    pub limit: Option<u64>,
    /// The work left to the call; below 0 once its limit is exceeded.
    left: i64,
}

impl Default for WorkMeter {
    fn default() -> Self {
        Self {
            done: Statistics::default(),
            limit: None,
            left: i64::MAX,
        }
    }
}

impl WorkMeter {
    /// Starts a call: its work is counted from 0.
    pub fn start_call(&mut self) {
        let limit = self.limit.unwrap_or(u64::MAX);
        self.left = i64::try_from(limit).unwrap_or(i64::MAX);
    }

    #[inline(always)]
    pub fn count_nodes(&mut self, count: u64) {
        self.done.node_pairs += count;
        self.charge(count);
    }

    #[inline(always)]
    pub fn count_primitives(&mut self, count: u64) {
        self.done.primitive_pairs += count;
        self.charge(count);
    }

    /// Counts work against the limit only, not in the statistics.
    #[inline(always)]
    pub fn charge(&mut self, count: u64) {
        self.left = self.left.saturating_sub_unsigned(count);
    }

    /// Whether the call has needed more than its limit.
    #[inline(always)]
    pub fn is_exceeded(&self) -> bool {
        self.left < 0
    }

    /// Refuses the result of a call that exceeded its limit.
    pub fn check(&self) -> Result<()> {
        if !self.is_exceeded() {
            return Ok(());
        }
        let limit = self.limit.unwrap_or(u64::MAX);
        Err(Error::new(
            ErrorKind::Limit,
            format!(
                "the query needs more than its limit of {limit} node pairs and primitive pairs"
            ),
        ))
    }
}
