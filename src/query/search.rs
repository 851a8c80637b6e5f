//! The searches over many body pairs that the queries share: nearest, within, all within.

use std::borrow::Borrow;

use super::candidates::Scene;
use super::context::{CacheKey, QueryContext};
use crate::pair::{Collect, Hit, Nearest, Pairing, Visitor, Within, traverse, visit_pair};

/// One body pair of a search: its geometry, its rank among all pairs, and the margin taken off its distances.
pub(super) struct Target<'a> {
    pub pairing: Pairing<'a>,
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
    pub(super) fn nearest<'a>(&mut self, targets: &[impl Borrow<Target<'a>>], limit: f64) -> Found {
        let mut visitor = Nearest::up_to(limit);
        let targets = || targets.iter().map(Borrow::borrow);
        // The pairs last nearest between each two bodies bound the distance before any tree is walked.
        for target in targets().filter(|_| targets().len() > 1) {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin > visitor.bound() {
                break;
            }
            if let Some(places) = self.remembered(&target.key) {
                let _ = visit_pair(&target.pairing, places, &mut self.scratch, &mut visitor);
            }
        }
        for target in targets() {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin <= visitor.bound() {
                let first = self.remembered(&target.key);
                let _ = traverse(&target.pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        if let Some(hit) = &visitor.best
            && let Some(target) = targets().find(|target| target.rank == hit.key.pair)
        {
            self.remember(target.key, hit.places);
        }
        Found {
            lower: visitor.lower,
            hit: visitor.best,
        }
    }

    /// Whether the primitive pair that was found within a threshold last is within one now: mostly so along a motion, and
    /// then nothing else need be asked.
    pub(super) fn recent_is_within(&mut self, scene: &Scene, threshold: f64) -> bool {
        let Some((key, places)) = self
            .recent
            .and_then(|key| Some((key, self.remembered(&key)?)))
        else {
            return false;
        };
        scene.find(&key).iter().any(|(pairing, options)| {
            let mut visitor = Within {
                margin: options.margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(pairing, places, &mut self.scratch, &mut visitor);
            visitor.found.is_some()
        })
    }

    /// Whether some primitive pair is within the threshold, which may differ from target to target.
    pub(super) fn any_within<'a, T: Borrow<Target<'a>>>(
        &mut self,
        targets: &[T],
        threshold: impl Fn(&T) -> f64,
    ) -> bool {
        // Those last found to meet first.
        let recent = self.recent;
        let is_recent = |target: &&T| recent == Some((*target).borrow().key);
        let first = targets.iter().filter(is_recent);
        for target in first.chain(targets.iter().filter(|target| !is_recent(target))) {
            let threshold = threshold(target);
            let target = target.borrow();
            if target.bound > threshold {
                continue;
            }
            let mut visitor = Within {
                margin: target.margin,
                threshold,
                found: None,
            };
            let first = self.remembered(&target.key);
            let _ = traverse(&target.pairing, first, &mut self.scratch, &mut visitor);
            if let Some(places) = visitor.found {
                self.remember(target.key, places);
                return true;
            }
        }
        false
    }

    /// All primitive pairs within the threshold, nearest first, and whether there are more than `max_count`.
    pub(super) fn collect<'a>(
        &mut self,
        targets: &[impl Borrow<Target<'a>>],
        threshold: f64,
        max_count: usize,
    ) -> (Vec<Hit>, bool) {
        let mut visitor = Collect::new(threshold, max_count);
        for target in targets.iter().map(Borrow::borrow) {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound + target.margin <= visitor.bound() {
                let _ = traverse(&target.pairing, None, &mut self.scratch, &mut visitor);
            }
        }
        visitor.finish()
    }
}
