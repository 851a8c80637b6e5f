//! The queries as visitors of the one walk. Each may see several body pairs in turn; `pair` and `margin` say which.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::hit::Hit;
use super::traversal::{Met, Visitor};

/// A primitive pair's distance less its margin, and a safe lower bound of it: both 0 when it is not above the error.
fn measured(met: &Met, margin: f64) -> (f64, f64) {
    let clear = met.apart - margin;
    if met.apart > 0.0 && clear > met.error {
        (clear, clear - met.error)
    } else {
        (0.0, 0.0)
    }
}

/// The nearest primitive pair, up to a limit.
pub struct Nearest {
    pub pair: u32,
    pub margin: f64,
    pub best: Option<Hit>,
    /// No primitive pair seen is nearer than this; safe against rounding.
    pub lower: f64,
    limit: f64,
}

impl Nearest {
    /// Looks for pairs no farther than `limit`.
    pub fn up_to(limit: f64) -> Self {
        Self {
            pair: 0,
            margin: 0.0,
            best: None,
            lower: f64::INFINITY,
            limit,
        }
    }

    /// Pairs that are farther apart than this, less their margin, are of no interest.
    pub fn limit(&self) -> f64 {
        self.limit
    }

    /// Takes a hit, of which the distance is no less than `lower`, if none better is known.
    pub fn take(&mut self, hit: Hit, lower: f64) {
        // Every pair counts here, whatever the limit has come to: so the bound does not depend on the order of visits.
        self.lower = self.lower.min(lower);
        if hit.distance <= self.limit
            && self
                .best
                .as_ref()
                .is_none_or(|best| hit.order(best).is_lt())
        {
            self.limit = hit.distance;
            self.best = Some(hit);
        }
    }
}

impl Visitor for Nearest {
    const REFINES: bool = true;

    fn bound(&self) -> f64 {
        self.limit + self.margin
    }

    fn settled_from(&self) -> Option<[u32; 2]> {
        // Where the sets meet nothing is nearer, and only lower ids are of interest.
        let best = self.best.as_ref().filter(|best| best.distance == 0.0)?;
        match best.key.pair.cmp(&self.pair) {
            Ordering::Less => Some([0, 0]),
            Ordering::Equal => Some(best.key.primitives),
            Ordering::Greater => None,
        }
    }

    fn visit(&mut self, met: &Met) -> ControlFlow<()> {
        let (distance, lower) = measured(met, self.margin);
        self.take(met.hit(self.pair, distance), lower);
        ControlFlow::Continue(())
    }
}

/// Whether some primitive pair is within a threshold; stops at the first.
pub struct Within {
    pub margin: f64,
    pub threshold: f64,
    /// The places of the first pair found.
    pub found: Option<[u32; 2]>,
}

impl Visitor for Within {
    const REFINES: bool = false;

    fn bound(&self) -> f64 {
        self.threshold + self.margin
    }

    fn visit(&mut self, met: &Met) -> ControlFlow<()> {
        let (_, lower) = measured(met, self.margin);
        if lower <= self.threshold {
            self.found = Some(met.places);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// All primitive pairs within a threshold; of more than `max_count`, the nearest.
pub struct Collect {
    pub pair: u32,
    pub margin: f64,
    pub hits: Vec<Hit>,
    /// More pairs than `max_count` are within the threshold.
    pub truncated: bool,
    threshold: f64,
    max_count: usize,
}

impl Collect {
    pub fn new(threshold: f64, max_count: usize) -> Self {
        Self {
            pair: 0,
            margin: 0.0,
            hits: Vec::new(),
            truncated: false,
            threshold,
            max_count,
        }
    }

    /// Pairs that are farther apart than this, less their margin, are of no interest.
    pub fn limit(&self) -> f64 {
        self.threshold
    }

    /// Takes a hit that is within the threshold.
    pub fn take(&mut self, hit: Hit) {
        self.hits.push(hit);
        if self.hits.len() > self.max_count.max(512).saturating_mul(2) {
            self.cut();
        }
    }

    /// The pairs, nearest first.
    pub fn finish(mut self) -> (Vec<Hit>, bool) {
        self.cut();
        (self.hits, self.truncated)
    }

    fn cut(&mut self) {
        self.hits.sort_unstable_by(Hit::order);
        // A primitive with several leaves is met more than once.
        self.hits.dedup_by_key(|hit| (hit.key, hit.contained));
        if self.hits.len() > self.max_count {
            self.hits.truncate(self.max_count);
            self.truncated = true;
            // What is farther than the last kept pair is of no interest any more.
            if let Some(last) = self.hits.last() {
                self.threshold = last.distance;
            }
        }
    }
}

impl Visitor for Collect {
    const REFINES: bool = true;

    fn bound(&self) -> f64 {
        self.threshold + self.margin
    }

    fn visit(&mut self, met: &Met) -> ControlFlow<()> {
        let (distance, _) = measured(met, self.margin);
        if distance <= self.threshold {
            self.take(met.hit(self.pair, distance));
        }
        ControlFlow::Continue(())
    }
}
