//! Curved surfaces that bodies stand for, refined within a query until its answer is as near to the truth as asked for (§2.2.1).

use super::answer::{Distance, DistanceKind};
use super::context::QueryContext;
use super::part_search::PartSearch;
use super::target::Target;
use crate::cobject::Leaf;
use crate::error::{Error, Result, require_finite};
use crate::pair::Collect;

/// The most primitive pairs that a refinement begins with.
const MAX_PAIRS: usize = 1 << 14;

impl QueryContext {
    /// How far apart the bounds of an answer may be; `None` if curved surfaces are not refined.
    pub fn refinement(&self) -> Option<f64> {
        self.refinement
    }

    /// Sets the same for later calls. It must be above 0.
    pub fn set_refinement(&mut self, gap: Option<f64>) -> Result<()> {
        if let Some(gap) = gap {
            require_finite(&[gap], "gap")?;
            if gap <= 0.0 {
                return Err(Error::invalid(format!("gap is {gap}; it must be above 0")));
            }
        }
        self.refinement = gap;
        Ok(())
    }

    /// Runs a call that refines curved surfaces, if the caller wants that. Motions and other calls that prove more than what holds at a
    /// configuration do not: their bounds are those of the bodies grown by their deviations, and what is asked on the way must agree.
    #[inline(always)]
    pub(super) fn refining<T>(&mut self, call: impl FnOnce(&mut Self) -> T) -> T {
        self.gap = self.refinement;
        let answer = call(self);
        self.gap = None;
        answer
    }

    /// Whether the call refines some of these targets.
    pub(super) fn refines(&self, targets: &[Target]) -> bool {
        self.gap.is_some() && targets.iter().any(Target::is_curved)
    }

    /// Whether the distance of a target may be at most a threshold, given that the bodies grown by their deviations are that near.
    pub(super) fn refined_within(&mut self, target: &Target, threshold: f64) -> Result<bool> {
        let Some(mut search) = self.begin_refinement(target, threshold)? else {
            return Ok(true);
        };
        let end = |search: &PartSearch| search.lower() > threshold || search.upper <= threshold;
        search.run(threshold, end, &mut self.scratch)?;
        Ok(search.lower() <= threshold)
    }

    /// The distance of targets, up to a maximum: of each by itself, then the least. `leaf` gives the leaf of a target's term.
    pub(super) fn refined_distance(
        &mut self,
        targets: &[Target],
        max_distance: f64,
        leaf: impl Fn(u32) -> Leaf,
    ) -> Result<Distance> {
        let mut least: Option<Distance> = None;
        for target in targets {
            let upper = least.as_ref().map_or(f64::INFINITY, |least| least.upper);
            let limit = upper.min(max_distance);
            if target.bound > limit {
                continue;
            }
            let next = self.refined_distance_of(target, limit, leaf(target.term))?;
            least = Some(match least {
                Some(least) => least.least(next),
                None => next,
            });
        }
        Ok(least.unwrap_or_else(|| Distance::beyond(max_distance, max_distance)))
    }

    fn refined_distance_of(&mut self, target: &Target, limit: f64, leaf: Leaf) -> Result<Distance> {
        let targets = std::slice::from_ref(target);
        let found = self.nearest(targets, limit)?;
        let whole = Distance::from_found(&found, limit, |_| leaf, self.scratch.for_primitives());
        let is_contained = whole.witness.is_some_and(|witness| witness.contained);
        if whole.kind != DistanceKind::Exact || whole.excess == 0.0 || is_contained {
            return Ok(whole);
        }
        let Some(mut search) = self.begin_refinement(target, limit.min(whole.upper))? else {
            return Ok(whole);
        };
        search.run(limit, |_| false, &mut self.scratch)?;
        Ok(match search.lower() > limit {
            true => Distance::beyond(limit, search.lower()),
            false => search.answer(limit, whole, leaf, &mut self.scratch),
        })
    }

    /// The search among the primitive pairs of a target that are at most `limit` apart once they are grown by their deviations. `None`
    /// if a body has a piece inside the other, or neither is curved.
    fn begin_refinement<'t, 'a>(
        &mut self,
        target: &'t Target<'a>,
        limit: f64,
    ) -> Result<Option<PartSearch<'t, 'a>>> {
        let Some(gap) = self.gap.filter(|_| target.is_curved()) else {
            return Ok(None);
        };
        let visitor = Collect::new(limit, MAX_PAIRS, true);
        let (hits, is_truncated) = self.collect(std::slice::from_ref(target), visitor)?;
        if hits.iter().any(|hit| hit.contained.is_some()) {
            return Ok(None);
        }
        let error = target.pairing().precision.error;
        // Pairs that are not listed are no nearer than the last one.
        let unlisted = match (is_truncated, hits.last()) {
            (true, Some(last)) => (last.distance - error).max(0.0),
            _ => f64::INFINITY,
        };
        let mut search = PartSearch::new(target, gap.max(4.0 * error), hits, unlisted);
        search.begin(limit, &mut self.scratch)?;
        Ok(Some(search))
    }
}

impl Target<'_> {
    /// Whether one of the bodies has triangles that stand for curved surfaces.
    #[inline(always)]
    pub fn is_curved(&self) -> bool {
        let [(a, _), (b, _)] = self.sides;
        a.curved().is_some() || b.curved().is_some()
    }
}
