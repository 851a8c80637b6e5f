//! The searches over many body pairs that the queries share: nearest, within, all within.

use super::context::QueryContext;
use super::scene::{Group, Scene};
use super::target::Target;
use crate::cobject::InducedOptions;
use crate::convex::PrimitiveDistance;
use crate::error::Result;
use crate::pair::{Collect, Hit, Nearest, Pairing, Scratch, Visitor, Within, traverse, visit_pair};

/// The nearest primitive pair over all targets.
pub(crate) struct NearestHit<'t, 'a> {
    /// With its body pair, if one is within the limit.
    pub hit: Option<(Hit, &'t Target<'a>)>,
    /// No primitive pair seen is nearer than this; safe against rounding.
    pub lower: f64,
    /// What else was found out about the hit.
    pub measured: Option<PrimitiveDistance>,
}

impl QueryContext {
    /// The nearest primitive pair, or piece of a body inside another, over all targets, which come sorted by bound, if
    /// one is within `limit`.
    pub(crate) fn nearest<'t, 'a>(
        &mut self,
        targets: &'t [Target<'a>],
        limit: f64,
    ) -> Result<NearestHit<'t, 'a>> {
        let mut visitor = Nearest::up_to(limit);
        // The pairs last nearest between each two bodies bound the distance before any tree is walked.
        for target in targets.iter().filter(|_| targets.len() > 1) {
            visitor.margin = target.options.margin;
            visitor.pair = target.rank;
            if target.bound > visitor.limit() {
                break;
            }
            self.count_body_pair()?;
            if let Some(places) = self.remembered(&target.key) {
                let _ = visit_pair(&target.pairing(), places, &mut self.scratch, &mut visitor);
            }
        }
        for target in targets {
            visitor.margin = target.options.margin;
            visitor.pair = target.rank;
            if target.bound > visitor.limit() {
                continue;
            }
            self.count_body_pair()?;
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                if pairing.has_solid() && visitor.settled_from() != Some([0, 0]) {
                    let contained = pairing.contained(target.rank, &mut self.scratch);
                    contained
                        .iter()
                        .for_each(|&hit| visitor.take(hit, 0.0, None));
                }
                let first = self.remembered(&target.key);
                let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        self.scratch.meter().check()?;
        let lower = visitor.lower;
        let hit = visitor.best.and_then(|hit| {
            let target = targets.iter().find(|target| target.rank == hit.key.pair)?;
            if hit.contained.is_none() {
                self.remember(target.key, hit.places);
            }
            Some((hit, target))
        });
        Ok(NearestHit {
            hit,
            lower,
            measured: visitor.measured,
        })
    }

    /// Whether the primitive pair that was found within a threshold last is within one now: mostly so along a motion, and
    /// then nothing else need be asked.
    pub(super) fn recent_is_within(
        &mut self,
        scene: &Scene,
        group: &Group,
        threshold: f64,
    ) -> Result<bool> {
        let mut is_within = false;
        self.visit_recent(scene, group, |pairing, places, options, scratch| {
            let mut visitor = Within::<false> {
                margin: options.margin,
                threshold,
                found: None,
            };
            let _ = visit_pair(pairing, places, scratch, &mut visitor);
            is_within |= visitor.found.is_some();
        })?;
        Ok(is_within)
    }

    /// How far the primitive pair is that was found last, up to `limit`: nothing farther need be looked at.
    pub(super) fn recent_distance(
        &mut self,
        scene: &Scene,
        group: &Group,
        limit: f64,
    ) -> Result<f64> {
        let mut least = limit;
        self.visit_recent(scene, group, |pairing, places, options, scratch| {
            let mut visitor = Nearest::up_to(least);
            visitor.margin = options.margin;
            let _ = visit_pair(pairing, places, scratch, &mut visitor);
            least = visitor.limit();
        })?;
        Ok(least)
    }

    /// Visits the primitive pair that was found last, once for each term that holds it.
    fn visit_recent(
        &mut self,
        scene: &Scene,
        group: &Group,
        mut visit: impl FnMut(&Pairing, [u32; 2], &InducedOptions, &mut Scratch),
    ) -> Result<()> {
        scene.check(group)?;
        let recent = self
            .recent
            .and_then(|key| Some((key, self.remembered(&key)?)));
        if let Some((key, places)) = recent {
            for (pairing, options) in scene.find(group, &key) {
                visit(&pairing, places, &options, &mut self.scratch);
            }
        }
        self.scratch.meter().check()
    }

    /// Whether some primitive pair is within the threshold, or a body inside another; the threshold may differ from
    /// target to target.
    pub(super) fn any_within(
        &mut self,
        targets: &[Target],
        threshold: impl Fn(&Target) -> f64,
    ) -> Result<bool> {
        // Those last found to meet first.
        let recent = self.recent;
        let is_recent = |target: &&Target| recent == Some(target.key);
        let first = targets.iter().filter(is_recent);
        for target in first.chain(targets.iter().filter(|target| !is_recent(target))) {
            let threshold = threshold(target);
            self.count_body_pair()?;
            let Some(pairing) = target.pairing_within(threshold) else {
                continue;
            };
            let is_one_inside = pairing.has_solid() && pairing.is_one_inside(&mut self.scratch);
            self.scratch.meter().check()?;
            if is_one_inside {
                return Ok(true);
            }
            let margin = target.options.margin;
            let found = if threshold + margin > 0.0 {
                self.first_within::<true>(&pairing, target, threshold)?
            } else {
                self.first_within::<false>(&pairing, target, threshold)?
            };
            if let Some(places) = found {
                self.remember(target.key, places);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The places of the first primitive pair that is found within a threshold.
    fn first_within<const REFINES: bool>(
        &mut self,
        pairing: &Pairing,
        target: &Target,
        threshold: f64,
    ) -> Result<Option<[u32; 2]>> {
        let mut visitor = Within::<REFINES> {
            margin: target.options.margin,
            threshold,
            found: None,
        };
        let first = self.remembered(&target.key);
        let _ = traverse(pairing, first, &mut self.scratch, &mut visitor);
        self.scratch.meter().check()?;
        Ok(visitor.found)
    }

    /// All pieces inside other bodies and all primitive pairs that the visitor lists, nearest first, and whether there are
    /// more than it keeps.
    pub(super) fn collect(
        &mut self,
        targets: &[Target],
        mut visitor: Collect,
    ) -> Result<(Vec<Hit>, bool)> {
        for target in targets {
            visitor.margin = target.options.margin;
            visitor.pair = target.rank;
            if target.bound > visitor.limit() {
                continue;
            }
            self.count_body_pair()?;
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                if pairing.has_solid() {
                    let contained = pairing.contained(target.rank, &mut self.scratch);
                    contained.into_iter().for_each(|hit| visitor.take(hit));
                }
                let _ = traverse(&pairing, None, &mut self.scratch, &mut visitor);
            }
        }
        self.scratch.meter().check()?;
        Ok(visitor.finish())
    }

    /// Counts the bounds of two bodies; refuses to go on past the limit of the call.
    pub(super) fn count_body_pair(&mut self) -> Result<()> {
        let meter = self.scratch.meter_mut();
        meter.count_nodes(1);
        meter.check()
    }
}
