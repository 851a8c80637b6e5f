//! The searches over many body pairs that the queries share: nearest, within, all within.

use std::borrow::Borrow;

use super::candidates::Scene;
use super::context::{CacheKey, QueryContext};
use crate::body::Body;
use crate::pair::{Collect, Hit, Nearest, Pairing, Within, traverse, visit_pair};
use crate::pose::Pose;

/// A body at a pose.
pub type Placement<'a> = (&'a Body, &'a Pose);

/// One body pair of a search, its rank among all pairs, and the margin taken off its distances.
#[derive(Clone, Copy)]
pub(super) struct Target<'a> {
    pub sides: [Placement<'a>; 2],
    pub key: CacheKey,
    pub rank: u32,
    pub margin: f64,
    /// A safe lower bound of the distance less the margin.
    pub bound: f64,
}

impl<'a> Target<'a> {
    /// The two in one frame: made when it is needed, as most targets turn out to be too far.
    pub fn pairing(&self) -> Pairing<'a> {
        let [a, b] = self.sides;
        Pairing::new(a.0, a.1, b.0, b.1)
    }

    /// The same, unless the balls around the bodies are more than `limit` apart, less the margin.
    fn pairing_within(&self, limit: f64) -> Option<Pairing<'a>> {
        if self.bound > limit {
            return None;
        }
        let pairing = self.pairing();
        (pairing.sphere_bound() - self.margin <= limit).then_some(pairing)
    }
}

/// The nearest primitive pair over all targets, which come sorted by bound, if one is within `limit`.
pub(super) struct Found {
    pub hit: Option<Hit>,
    pub lower: f64,
    /// To what the distance is known; without a hit, to what all are.
    pub error: f64,
}

impl QueryContext {
    pub(super) fn nearest<'a>(&mut self, targets: &[impl Borrow<Target<'a>>], limit: f64) -> Found {
        let mut visitor = Nearest::up_to(limit);
        let targets = || targets.iter().map(Borrow::borrow);
        // The pairs last nearest between each two bodies bound the distance before any tree is walked.
        for target in targets().filter(|_| targets().len() > 1) {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if target.bound > visitor.limit() {
                break;
            }
            if let Some(places) = self.remembered(&target.key) {
                let _ = visit_pair(&target.pairing(), places, &mut self.scratch, &mut visitor);
            }
        }
        for target in targets() {
            visitor.margin = target.margin;
            visitor.pair = target.rank;
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                let first = self.remembered(&target.key);
                let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        let error = |target: &Target| target.pairing().precision.error;
        let winner = visitor.best.as_ref().and_then(|hit| {
            let target = targets().find(|target| target.rank == hit.key.pair)?;
            Some((target, hit.places))
        });
        let error = match winner {
            Some((target, places)) => {
                self.remember(target.key, places);
                error(target)
            }
            None => targets().map(error).fold(0.0, f64::max),
        };
        Found {
            error,
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
        scene.find(&key).any(|(pairing, options)| {
            let mut visitor = Within {
                margin: options.margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(&pairing, places, &mut self.scratch, &mut visitor);
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
            let Some(pairing) = target.pairing_within(threshold) else {
                continue;
            };
            let mut visitor = Within {
                margin: target.margin,
                threshold,
                found: None,
            };
            let first = self.remembered(&target.key);
            let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
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
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                let _ = traverse(&pairing, None, &mut self.scratch, &mut visitor);
            }
        }
        visitor.finish()
    }
}
