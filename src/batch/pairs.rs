//! Batches of pose pairs: two bodies at many poses.

use super::batch::Batch;
use super::job::{BatchJob, BatchSummary, ItemAnswer};
use super::slots::Slots;
use crate::body::Body;
use crate::error::{Error, ErrorKind, Result};
use crate::query::{Distance, GivenPair, QueryContext, check_threshold};

/// A thread is begun for so many pairs of poses.
const PER_THREAD: usize = 32;

/// Two bodies at pairs of poses. A pose that is none fails its own item alone.
#[derive(Clone, Copy)]
pub struct PosePairs<'a> {
    /// The two bodies.
    pub bodies: [&'a Body; 2],
    /// The poses of each, row-major [R | t], as many of the one as of the other.
    pub poses: [&'a [[f64; 12]]; 2],
}

impl<'a> PosePairs<'a> {
    fn at(&self, item: usize) -> GivenPair<'a> {
        let [a, b] = self.poses;
        GivenPair {
            bodies: self.bodies,
            poses: [&a[item], &b[item]],
        }
    }

    fn checked_count(&self) -> Result<usize> {
        let [a, b] = self.poses.map(<[_]>::len);
        if a != b {
            return Err(Error::new(
                ErrorKind::WrongSize,
                format!("{a} poses of one body cannot be paired with {b} of the other"),
            ));
        }
        Ok(a)
    }
}

impl Batch {
    /// Whether the distance of the bodies may be at most `threshold`, at each pair of poses; 0 asks whether they meet. Within is a hit.
    pub fn pair_within<S: Slots>(
        &mut self,
        pairs: PosePairs,
        threshold: f64,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<bool>) + Sync,
    ) -> Result<BatchSummary> {
        check_threshold(threshold, "threshold")?;
        let ask = |context: &mut QueryContext, item| {
            let is_within = context.given_within(&pairs.at(item), threshold)?;
            Ok((is_within, is_within))
        };
        self.answer_each(job, pairs.checked_count()?, PER_THREAD, ask, put)
    }

    /// The distance of the bodies at each pair of poses, up to `max_distance`. Distance 0 is a hit.
    pub fn pair_distance<S: Slots>(
        &mut self,
        pairs: PosePairs,
        max_distance: f64,
        job: BatchJob<S>,
        put: impl Fn(&mut S, usize, ItemAnswer<Distance>) + Sync,
    ) -> Result<BatchSummary> {
        check_threshold(max_distance, "max_distance")?;
        let ask = |context: &mut QueryContext, item| {
            let with_hit = |distance: Distance| {
                let is_hit = distance.distance == 0.0;
                (distance, is_hit)
            };
            context.take_given_distance(&pairs.at(item), max_distance, with_hit)
        };
        self.answer_each(job, pairs.checked_count()?, PER_THREAD, ask, put)
    }
}
