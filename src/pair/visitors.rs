//! The queries as visitors of the traversal. A visitor may see several body pairs in turn; `body_pair` and `margin` belong to
//! the current one.

use std::ops::ControlFlow;

use super::hit::Hit;
use super::shortlist::{Ranked, Shortlist};
use super::visitor::{PrimitivePair, Visitor, Wanted};
use crate::convex::PrimitiveDistance;
use crate::work_meter::WorkMeter;

/// Whether a primitive pair meets, to within the error of its distance.
pub fn meets(pair: &PrimitivePair) -> bool {
    measured(pair, 0.0).0 == 0.0
}

/// A primitive pair's distance minus the margin, and a safe lower bound of it: both 0 when it is not above the error.
fn measured(pair: &PrimitivePair, margin: f64) -> (f64, f64) {
    let clear = pair.apart - margin;
    if pair.apart > 0.0 && clear > pair.error {
        (clear, clear - pair.error)
    } else {
        (0.0, 0.0)
    }
}

/// The nearest primitive pair, up to a limit.
pub struct NearestPrimitives {
    pub body_pair: u32,
    pub margin: f64,
    pub best: Option<Hit>,
    /// The full result of the best pair, where it was computed.
    pub measured: Option<PrimitiveDistance>,
    /// A lower bound of the distances of all pairs seen; safe against rounding.
    pub lower: f64,
    limit: f64,
}

impl NearestPrimitives {
    /// A search for pairs no farther than `limit`.
    pub fn up_to(limit: f64) -> Self {
        Self {
            body_pair: 0,
            margin: 0.0,
            best: None,
            measured: None,
            lower: f64::INFINITY,
            limit,
        }
    }

    /// Pairs that are farther apart than this, less their margin, are of no interest.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Primitive pairs from this one on, in order of ids, are not better than the best, however near they are.
    pub fn irrelevant_from(&self) -> Option<[u32; 2]> {
        self.best.as_ref()?.outranks_from(self.body_pair)
    }

    /// Whether no primitive pair of the current body pair is better than the best, however near it is.
    pub fn is_outranked(&self) -> bool {
        self.irrelevant_from() == Some([0, 0])
    }

    /// Once something meets, distances up to 0 need not be more accurate.
    fn enough(&self) -> f64 {
        match self.limit == 0.0 && self.margin == 0.0 {
            true => 0.0,
            false => f64::NEG_INFINITY,
        }
    }

    /// Keeps a hit if it is the best so far. `lower` is a lower bound of its distance.
    pub fn take(&mut self, hit: Hit, lower: f64, measured: Option<&PrimitiveDistance>) {
        // Every pair counts here, even beyond the current limit, so that the bound does not depend on the order of visits.
        self.lower = self.lower.min(lower);
        if hit.distance <= self.limit
            && self
                .best
                .as_ref()
                .is_none_or(|best| hit.order(best).is_lt())
        {
            // Once something meets, the pairs that come after it are looked at no more closely than that takes.
            let is_exact = self.enough() < 0.0;
            self.measured = measured.filter(|_| is_exact).copied();
            self.limit = hit.distance;
            self.best = Some(hit);
        }
    }
}

impl Visitor for NearestPrimitives {
    fn wanted(&self) -> Wanted {
        Wanted {
            bound: self.limit + self.margin,
            enough: self.enough(),
            irrelevant_from: self.irrelevant_from(),
            refines: true,
        }
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        let (distance, lower) = measured(pair, self.margin);
        self.take(pair.hit(self.body_pair, distance), lower, pair.measured);
        ControlFlow::Continue(())
    }
}

/// Whether some primitive pair is within a threshold; stops at the first.
pub struct Within {
    pub margin: f64,
    pub threshold: f64,
    /// The places of the pair found.
    pub found: Option<[u32; 2]>,
}

impl Visitor for Within {
    fn wanted(&self) -> Wanted {
        let bound = self.threshold + self.margin;
        Wanted {
            bound,
            enough: bound,
            irrelevant_from: None,
            refines: bound > 0.0,
        }
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        let (_, lower) = measured(pair, self.margin);
        if lower <= self.threshold {
            self.found = Some(pair.places);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// All primitive pairs within a threshold; of more than `max_count`, the nearest.
pub struct Collect {
    pub body_pair: u32,
    pub margin: f64,
    /// Pairs farther apart than the nearest by more than this are left out.
    pub band: f64,
    list: Shortlist<Hit>,
    threshold: f64,
    counts_doubt: bool,
}

impl Collect {
    /// With `counts_doubt`, a pair is within the threshold if its lower bound is, as for [`Within`].
    pub fn new(threshold: f64, max_count: usize, counts_doubt: bool) -> Self {
        Self {
            body_pair: 0,
            margin: 0.0,
            band: f64::INFINITY,
            list: Shortlist::new(max_count),
            threshold,
            counts_doubt,
        }
    }

    /// Pairs that are farther apart than this, less their margin, are of no interest.
    pub fn limit(&self) -> f64 {
        self.threshold
    }

    /// Adds a hit that is within the threshold.
    pub fn take(&mut self, hit: Hit) {
        self.threshold = self.threshold.min(hit.distance + self.band);
        if self.list.offer(hit) && self.list.is_truncated() {
            // Pairs farther than the last one kept do not matter any more; if none is kept, no pair does.
            let last = self.list.last();
            let last = last.map_or(f64::NEG_INFINITY, |last| last.distance);
            self.threshold = self.threshold.min(last);
        }
    }

    /// The pairs, nearest first, and whether there are more.
    pub fn finish(self) -> (Vec<Hit>, bool) {
        let (mut hits, is_truncated) = self.list.finish();
        // Some were found before the nearest.
        if let Some(nearest) = hits.first() {
            let limit = nearest.distance + self.band;
            hits.retain(|hit| hit.distance <= limit);
        }
        (hits, is_truncated)
    }
}

impl Visitor for Collect {
    fn wanted(&self) -> Wanted {
        let last = self.list.last();
        Wanted {
            bound: self.threshold + self.margin,
            // Where only pairs that meet are listed, all of them are at distance 0.
            enough: match self.threshold + self.margin == 0.0 {
                true => 0.0,
                false => f64::NEG_INFINITY,
            },
            irrelevant_from: last.and_then(|last| last.outranks_from(self.body_pair)),
            refines: true,
        }
    }

    fn visit(&mut self, pair: &PrimitivePair, _: &mut WorkMeter) -> ControlFlow<()> {
        let (distance, lower) = measured(pair, self.margin);
        let compared = if self.counts_doubt { lower } else { distance };
        if compared <= self.threshold {
            self.take(pair.hit(self.body_pair, distance));
        }
        ControlFlow::Continue(())
    }
}
