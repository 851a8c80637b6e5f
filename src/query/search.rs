//! The searches over many body pairs that the queries share: nearest, within, all within.

use super::context::{CacheKey, QueryContext};
use crate::pair::{Collect, Hit, Nearest, Pairing, Visitor, Within, traverse, visit_pair};

/// One body pair of a search: its geometry, its rank among all pairs, and the margin taken off its distances.
pub(super) struct Target<'a> {
    pub pairing: &'a Pairing<'a>,
    pub key: CacheKey,
    pub rank: u32,
    pub margin: f64,
    /// A safe lower bound of the distance less the margin.
    pub bound: f64,
}

/// The nearest primitive pair over all targets, which come sorted by bound, if one is within `limit`.
pub(super) struct Found {
    pub hit: Option<Hit>,
    pub lower: f64,
}

impl QueryContext {
    pub(super) fn nearest(&mut self, targets: &[Target], limit: f64) -> Found {
        let mut visitor = Nearest::up_to(limit);
        // The pairs last nearest between each two bodies bound the distance before any tree is walked.
        for target in targets.iter().filter(|_| targets.len() > 1) {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin > visitor.bound() {
                break;
            }
            if let Some(places) = self.remembered(&target.key) {
                let _ = visit_pair(target.pairing, places, &mut self.scratch, &mut visitor);
            }
        }
        for target in targets {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin <= visitor.bound() {
                let first = self.remembered(&target.key);
                let _ = traverse(target.pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        if let Some(hit) = &visitor.best
            && let Some(target) = targets.iter().find(|target| target.rank == hit.key.pair)
        {
            self.remember(target.key, hit.places);
        }
        Found {
            lower: visitor.lower,
            hit: visitor.best,
        }
    }

    /// The lower bound that shows some primitive pair to be within its target's threshold, if there is one. The
    /// thresholds may differ from target to target.
    pub(super) fn first_within<'a>(
        &mut self,
        targets: impl Iterator<Item = (&'a Target<'a>, f64)>,
    ) -> Option<f64> {
        for (target, threshold) in targets {
            let mut visitor = Within {
                margin: target.margin,
                threshold,
                found: None,
            };
            if target.bound > threshold {
                continue;
            }
            let first = self.remembered(&target.key);
            let _ = traverse(target.pairing, first, &mut self.scratch, &mut visitor);
            if let Some((places, lower)) = visitor.found {
                self.remember(target.key, places);
                return Some(lower);
            }
        }
        None
    }

    /// All primitive pairs within the threshold, nearest first, and whether there are more than `max_count`.
    pub(super) fn collect(
        &mut self,
        targets: &[Target],
        threshold: f64,
        max_count: usize,
    ) -> (Vec<Hit>, bool) {
        let mut visitor = Collect::new(threshold, max_count);
        for target in targets {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin <= visitor.bound() {
                let _ = traverse(target.pairing, None, &mut self.scratch, &mut visitor);
            }
        }
        visitor.finish()
    }
}
