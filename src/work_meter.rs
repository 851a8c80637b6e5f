//! The work of queries, counted for statistics and against a limit per call.

use crate::error::{Error, ErrorKind, Result};

/// Work done, for the user's eyes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Statistics {
    /// Pairs of boxes, or of the spheres around bodies, whose bound was computed; of rays, the boxes tested.
    pub node_pairs: u64,
    /// Primitive pairs that were looked at; of rays, the faces tested.
    pub primitive_pairs: u64,
    /// Of those, pairs whose distance was asked for: polygons that a direction known before parts are left out.
    pub primitive_distances: u64,
    /// Remembered witnesses that were evaluated first.
    pub cache_hits: u64,
}

/// Counts node pairs and primitive pairs. Past the limit of a call, searches stop; [`WorkMeter::check`] then refuses what they
/// have found.
#[derive(Debug)]
pub struct WorkMeter {
    pub done: Statistics,
    /// The limit of each call; `None` for no limit.
    pub limit: Option<u64>,
    /// What the call may still count; below 0 it has needed more than its limit.
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

    /// Counts work against the limit alone.
    #[inline(always)]
    pub fn charge(&mut self, count: u64) {
        self.left = self.left.saturating_sub_unsigned(count);
    }

    /// Whether the call has needed more than its limit.
    #[inline(always)]
    pub fn is_exceeded(&self) -> bool {
        self.left < 0
    }

    /// Refuses an answer for which the limit was not enough.
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
