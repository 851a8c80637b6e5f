//! Penetration depths of two bodies: the deepest of all primitive pairs that meet.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::answer::{PenetrationList, PrimitivePenetration};
use super::context::QueryContext;
use super::pairs::target;
use super::target::{Placement, Target};
use crate::body::Body;
use crate::error::{Error, Result};
use crate::pair::{Pairing, PrimitivePair, Ranked, Shortlist, Visitor, Wanted, meets, traverse};
use crate::work_meter::WorkMeter;

impl Ranked for PrimitivePenetration {
    /// Deepest first; ties go to the lowest numbers.
    fn order(&self, other: &Self) -> Ordering {
        let depths = [self, other].map(|found| found.penetration.depth);
        let deepest_first = depths[1].total_cmp(&depths[0]);
        deepest_first.then(self.primitives.cmp(&other.primitives))
    }
}

/// The deepest of the primitive pairs that meet.
struct Deepest<'a> {
    target: &'a Target<'a>,
    pairing: &'a Pairing<'a>,
    list: Shortlist<PrimitivePenetration>,
    /// The lowest pair whose depth cannot be computed, and the error, which fails the call.
    failed: Option<([u32; 2], Error)>,
}

impl Deepest<'_> {
    /// Pairs from the first that failed on cannot change the result.
    fn irrelevant_from(&self) -> Option<[u32; 2]> {
        self.failed.as_ref().map(|(primitives, _)| *primitives)
    }
}

impl Visitor for Deepest<'_> {
    fn wanted(&self) -> Wanted {
        Wanted {
            irrelevant_from: self.irrelevant_from(),
            ..Wanted::MEETING
        }
    }

    fn visit(&mut self, pair: &PrimitivePair, meter: &mut WorkMeter) -> ControlFlow<()> {
        let primitives = pair.primitives;
        let is_irrelevant = self
            .irrelevant_from()
            .is_some_and(|from| from <= primitives);
        if !meets(pair) || is_irrelevant {
            return ControlFlow::Continue(());
        }
        match self.pairing.world_penetration(pair.places, meter) {
            Ok(penetration) => {
                let parties = self.target.parties();
                self.list.offer(PrimitivePenetration {
                    primitives,
                    tags: parties.tags(primitives),
                    parts: parties.parts(primitives),
                    penetration,
                });
            }
            Err(error) => {
                let [a, b] = primitives;
                let error = error.within(format_args!("primitives {a} and {b}"));
                self.failed = Some((primitives, error));
            }
        }
        ControlFlow::Continue(())
    }
}

impl QueryContext {
    /// All primitive pairs that meet, each with the shortest translation that separates it; if there are more than
    /// `max_count`, the deepest. Fails where a smooth primitive meets another, whose depth is not computed. A piece that
    /// lies wholly inside a solid meets none of its primitives, and is not listed.
    pub fn pair_penetration(
        &mut self,
        a: Placement,
        b: Placement,
        max_count: usize,
    ) -> Result<PenetrationList> {
        let target = &target(a, b)?;
        self.scratch.meter_mut().start_call();
        self.count_body_pair()?;
        let mut list = Shortlist::new(max_count);
        if let Some(pairing) = &target.pairing_within(0.0) {
            let mut visitor = Deepest {
                target,
                pairing,
                list,
                failed: None,
            };
            let _ = traverse(pairing, None, &mut self.scratch, &mut visitor);
            self.scratch.meter().check()?;
            if let Some((_, error)) = visitor.failed {
                return Err(error);
            }
            list = visitor.list;
        }
        let (penetrations, truncated) = list.finish();
        let is_one = |body: &Body| body.primitives().len() == 1;
        Ok(PenetrationList {
            penetrations,
            of_whole_bodies: is_one(a.0) && is_one(b.0),
            truncated,
        })
    }
}
