//! The body pairs of a C-object that a search may need.

use super::target::Target;
use crate::cobject::InducedOptions;
use crate::environment::{Bounds, NearScratch};
use crate::error::Result;
use crate::reused::emptied;
use crate::work_meter::WorkMeter;

/// Which body pairs a search needs.
#[derive(Clone, Copy, Debug)]
pub struct CandidateFilter {
    /// All that may be within this.
    pub within: f64,
    /// All that may be in contact.
    pub in_contact: bool,
    /// Those that may be nearest, if within this.
    pub nearest: Option<f64>,
}

impl CandidateFilter {
    pub fn within(threshold: f64) -> Self {
        Self {
            within: threshold,
            in_contact: false,
            nearest: None,
        }
    }
}

/// Memory of searches for body pairs, used again by the next.
#[derive(Default)]
pub(crate) struct CandidateScratch {
    pub near: NearScratch,
    /// What bounds each link that is met.
    pub links: Vec<Option<Bounds>>,
    targets: Vec<Target<'static>>,
}

impl CandidateScratch {
    /// Takes the memory of a list that is not needed any more.
    pub fn keep(&mut self, targets: Vec<Target>) {
        self.targets = emptied(targets);
    }
}

/// Body pairs with the bounds of their distances, of which those that are too far fall away as nearer ones are met.
pub(super) struct Candidates<'s, 'm> {
    wanted: CandidateFilter,
    meter: &'m mut WorkMeter,
    /// No pair that is farther than this, less its margin, is nearest.
    nearest: f64,
    found: Vec<Target<'s>>,
}

impl<'s, 'm> Candidates<'s, 'm> {
    pub fn new(
        wanted: CandidateFilter,
        scratch: &mut CandidateScratch,
        meter: &'m mut WorkMeter,
    ) -> Self {
        Self {
            wanted,
            meter,
            nearest: f64::INFINITY,
            found: emptied(std::mem::take(&mut scratch.targets)),
        }
    }

    /// Takes a pair if it may matter, given what bounds the two and how far apart they are at least. Returns how far other
    /// pairs of the same options may be to matter.
    #[inline(always)]
    pub fn offer(
        &mut self,
        options: &InducedOptions,
        bounds: [&Bounds; 2],
        at_least: f64,
        target: impl FnOnce() -> Target<'s>,
    ) -> f64 {
        self.meter.count_nodes(1);
        let [lower, upper] = bounds[0].distance(bounds[1]);
        let bound = lower.max(at_least) - options.margin;
        self.nearest = self.nearest.min(upper - options.margin);
        let limit = self.limit(options);
        if bound <= limit {
            self.found.push(Target { bound, ..target() });
        }
        limit + options.margin
    }

    /// Pairs that are farther apart than this, less their margin, do not matter: none does where the call has done enough.
    #[inline(always)]
    fn limit(&self, options: &InducedOptions) -> f64 {
        if self.meter.is_exceeded() {
            return f64::NEG_INFINITY;
        }
        let contact = if self.wanted.in_contact {
            options.contact_epsilon
        } else {
            0.0
        };
        let nearest = self
            .wanted
            .nearest
            .map_or(0.0, |most| self.nearest.min(most));
        self.wanted.within.max(contact).max(nearest)
    }

    /// How far the first pairs of these options may be apart to matter.
    pub fn cutoff(&self, options: &InducedOptions) -> f64 {
        self.limit(options) + options.margin
    }

    /// Those that still matter, each once, ranked by ids and sorted by bound.
    pub fn finish(mut self) -> Result<Vec<Target<'s>>> {
        self.meter.check()?;
        let mut found = std::mem::take(&mut self.found);
        found.retain(|target| target.bound <= self.limit(&target.options));
        found.sort_unstable_by_key(|target| (target.parties(), target.term));
        if found
            .windows(2)
            .any(|two| two[0].parties() == two[1].parties())
        {
            found = without_repeats(found);
        }
        for (target, rank) in found.iter_mut().zip(0..) {
            target.rank = rank;
        }
        found.sort_unstable_by(|a, b| a.bound.total_cmp(&b.bound).then(a.rank.cmp(&b.rank)));
        Ok(found)
    }
}

/// Each pair once, given in order of ids: where several terms hold a pair in one state, the most that any of them would call
/// inside (the largest margin), and in contact, remains. An object that an environment and its snapshot hold in two states
/// stands for two.
fn without_repeats(found: Vec<Target>) -> Vec<Target> {
    let mut kept: Vec<Target> = Vec::with_capacity(found.len());
    for next in found {
        let same_ids = kept
            .iter_mut()
            .rev()
            .take_while(|known| known.parties() == next.parties());
        let known = same_ids.into_iter().find(|known| {
            let sides = known.sides.iter().zip(&next.sides);
            let mut sides = sides
                .map(|((a, pose_a), (b, pose_b))| pose_a == pose_b && a.serial() == b.serial());
            sides.all(|is_same| is_same)
        });
        match known {
            None => kept.push(next),
            Some(known) => {
                let farthest_contact = |o: &InducedOptions| o.margin + o.contact_epsilon;
                let by_distance = |o: &InducedOptions| (o.margin, o.contact_epsilon);
                if by_distance(&next.options) > by_distance(&known.options) {
                    known.term = next.term;
                }
                let merged = &mut known.options;
                let farthest = farthest_contact(merged).max(farthest_contact(&next.options));
                merged.margin = merged.margin.max(next.options.margin);
                merged.contact_epsilon = farthest - merged.margin;
                known.bound = known.bound.min(next.bound);
            }
        }
    }
    kept
}
