//! Candidates: the body pairs that the broad phase lets through.

use super::cache_key::PairIds;
use super::link_boxes::LinkBoxes;
use super::pair_order::PairOrder;
use super::target::Target;
use crate::body_bounds::Bounds;
use crate::cobject::InducedOptions;
use crate::environment::NearScratch;
use crate::error::Result;
use crate::index_set::IndexSet;
use crate::reused::emptied;
use crate::work_meter::WorkMeter;

/// Which body pairs a search needs: those that fit any of the criteria.
#[derive(Clone, Copy, Debug)]
pub struct CandidateFilter {
    /// Pairs that may be within this distance.
    pub within: f64,
    /// Pairs that may be in contact.
    pub in_contact: bool,
    /// Pairs that may be the nearest, if within this distance.
    pub nearest: Option<f64>,
    /// Only pairs of bodies that stand for nothing but themselves.
    pub is_proved: bool,
    /// How the pairs are listed.
    pub order: ListOrder,
    /// Only pairs that come no later in order of ids: this one meets, and the first that does is asked for.
    pub last: Option<PairIds>,
}

/// The order of a list of body pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListOrder {
    /// By bound; those of the same bound by ids.
    Bounds,
    /// By ids.
    Ids,
    /// As they are found, without ranks; only where none is in two terms.
    Any,
}

impl CandidateFilter {
    pub fn within(threshold: f64) -> Self {
        Self {
            within: threshold,
            in_contact: false,
            nearest: None,
            is_proved: false,
            order: ListOrder::Bounds,
            last: None,
        }
    }
}

/// Memory of the broad phase, reused by the next query.
#[derive(Default)]
pub(crate) struct CandidateScratch {
    /// The bodies that look for objects near them.
    pub bodies: IndexSet,
    pub near: NearScratch,
    pub link_boxes: LinkBoxes,
    targets: Vec<Target<'static>>,
    /// Of the pairs in the order in which they were offered.
    offered: Vec<Target<'static>>,
    order: PairOrder,
}

impl CandidateScratch {
    /// Takes back the memory of a candidate list for reuse.
    pub fn keep(&mut self, targets: Vec<Target>) {
        self.targets = emptied(targets);
    }
}

/// Collects body pairs with lower bounds of their distances; the cutoff falls as nearer pairs are found.
pub(super) struct Candidates<'s, 'm> {
    filter: CandidateFilter,
    meter: &'m mut WorkMeter,
    /// The smallest upper bound of a distance less margin: pairs with a larger lower bound are not nearest.
    nearest: f64,
    targets: Vec<Target<'s>>,
}

impl<'s, 'm> Candidates<'s, 'm> {
    pub fn new(
        filter: CandidateFilter,
        scratch: &mut CandidateScratch,
        meter: &'m mut WorkMeter,
    ) -> Self {
        Self {
            filter,
            meter,
            nearest: f64::INFINITY,
            targets: emptied(std::mem::take(&mut scratch.offered)),
        }
    }

    /// Adds a pair unless its bounds are beyond the cutoff. `at_least` is a lower bound of its distance. Returns the cutoff
    /// for further pairs with the same options.
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
        self.offer_bounded(options, [lower.max(at_least), upper], target)
    }

    /// The same for a pair with a lower and an upper bound of its distance.
    #[inline(always)]
    pub fn offer_bounded(
        &mut self,
        options: &InducedOptions,
        [lower, upper]: [f64; 2],
        target: impl FnOnce() -> Target<'s>,
    ) -> f64 {
        self.nearest = self.nearest.min(upper - options.margin);
        self.take(options, lower - options.margin, target)
    }

    /// Returns the cutoff for further pairs with the same options.
    #[inline(always)]
    fn take(
        &mut self,
        options: &InducedOptions,
        bound: f64,
        target: impl FnOnce() -> Target<'s>,
    ) -> f64 {
        let limit = self.limit(options);
        if bound <= limit {
            let target = target();
            let is_behind = self.filter.last.is_some_and(|last| target.ids() > last);
            let is_doubtful = self.filter.is_proved && target.stated_deviation() > 0.0;
            if !is_behind && !is_doubtful {
                self.targets.push(Target { bound, ..target });
            }
        }
        limit + options.margin
    }

    /// Only pairs whose r-link has at most this number are wanted.
    pub fn last_link(&self) -> usize {
        self.filter.last.map_or(usize::MAX, |(link, ..)| link)
    }

    /// Whether only pairs count that are in contact, by the options of their set: what is proved farther apart need not be offered.
    pub fn wants_contacts_alone(&self, options: &InducedOptions) -> bool {
        self.filter.nearest.is_none() && self.limit(options) <= options.contact_epsilon
    }

    /// Counts tests of bounds.
    pub fn count(&mut self, tests: usize) {
        self.meter.count_nodes(tests as u64);
    }

    /// The cutoff of the distance less margin; minus infinity once the call has reached its work limit.
    #[inline(always)]
    fn limit(&self, options: &InducedOptions) -> f64 {
        if self.meter.is_exceeded() {
            return f64::NEG_INFINITY;
        }
        let contact = if self.filter.in_contact {
            options.contact_epsilon
        } else {
            0.0
        };
        let nearest = self
            .filter
            .nearest
            .map_or(0.0, |most| self.nearest.min(most));
        self.filter.within.max(contact).max(nearest)
    }

    /// The cutoff of the distance itself.
    pub fn cutoff(&self, options: &InducedOptions) -> f64 {
        self.limit(options) + options.margin
    }

    /// The pairs still within the cutoff, without duplicates, ranked by ids, in the order that the filter asks for.
    pub fn finish(mut self, scratch: &mut CandidateScratch) -> Result<Vec<Target<'s>>> {
        self.meter.check()?;
        let mut offered = std::mem::take(&mut self.targets);
        if self.filter.order == ListOrder::Any {
            // Nothing is moved: the memory of the list goes back and forth.
            scratch.offered = std::mem::take(&mut scratch.targets);
            return Ok(offered);
        }
        let order = &mut scratch.order;
        let is_near = |target: &Target| target.bound <= self.limit(&target.options);
        if order.by_ids(&offered, is_near) {
            offered.retain(is_near);
            offered.sort_unstable_by(|a, b| {
                let by_state = a.ids().cmp(&b.ids()).then_with(|| a.order_of_states(b));
                by_state.then(a.term.cmp(&b.term))
            });
            offered = without_repeats(offered);
            order.as_they_are(offered.len());
        }
        order.set_ranks(&mut offered);
        if self.filter.order == ListOrder::Bounds {
            order.by_bounds(&offered);
        }
        let mut targets = emptied(std::mem::take(&mut scratch.targets));
        targets.extend(order.places().map(|place| offered[place]));
        scratch.offered = emptied(offered);
        Ok(targets)
    }
}

/// Removes duplicates from pairs in order of ids. Where several terms hold a pair at the same poses, it gets the largest
/// margin and the farthest contact distance of any: it is inside, or in contact, if it is for any term. An object
/// whose two pairs differ in pose or body, as those of an environment and of an older snapshot of it may, counts as two, which come
/// in an order of their own: not that of the terms, since which of these are in the list depends on how far it goes.
fn without_repeats(targets: Vec<Target>) -> Vec<Target> {
    let mut unique: Vec<Target> = Vec::with_capacity(targets.len());
    for next in targets {
        let same_ids = unique
            .iter_mut()
            .rev()
            .take_while(|known| known.ids() == next.ids());
        let repeated = same_ids.into_iter().find(|known| {
            let sides = known.sides.iter().zip(&next.sides);
            let mut sides = sides
                .map(|((a, pose_a), (b, pose_b))| pose_a == pose_b && a.serial() == b.serial());
            sides.all(|is_same| is_same)
        });
        match repeated {
            None => unique.push(next),
            Some(known) => {
                let farthest_contact = |o: &InducedOptions| o.margin + o.contact_epsilon;
                let by_distance = |o: &InducedOptions| (o.margin, o.contact_epsilon);
                if by_distance(&next.options) > by_distance(&known.options) {
                    (known.term, known.s_carrier, known.data) =
                        (next.term, next.s_carrier, next.data);
                }
                let merged = &mut known.options;
                let farthest = farthest_contact(merged).max(farthest_contact(&next.options));
                merged.margin = merged.margin.max(next.options.margin);
                merged.contact_epsilon = farthest - merged.margin;
                known.bound = known.bound.min(next.bound);
            }
        }
    }
    unique
}
