//! The broad phase of induced sets: the candidate body pairs in a scene.

use std::ops::Deref;
use std::sync::Arc;

use super::answer::SSide;
use super::cache_key::CacheKey;
use super::candidates::{CandidateFilter, CandidateScratch, Candidates, ListOrder};
use super::context::QueryContext;
use super::link_boxes::LinkBoxes;
use super::object_offers::{ObjectsTerm, RSide};
use super::scene::{Group, Scene};
use super::target::{Placement, Target};
use crate::cobject::{
    BodyPairs, ClearPairs, Induced, InducedOptions, LinkRows, LinksAndObjects, SObjects,
};
use crate::environment::{SObject, Snapshot};
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Pairing;
use crate::work_meter::WorkMeter;

/// An induced set of links against links, with its number in the group.
struct LinksTerm<'t> {
    pairs: &'t [[usize; 2]],
    rows: &'t LinkRows,
    clear: Option<&'t ClearPairs>,
    options: &'t InducedOptions,
    number: u32,
}

/// How the pairs of a group are listed where any of them decides: as they are found, if none is in two terms for certain, as where there
/// is at most one term of each kind.
pub(super) fn order_of_any(group: &Group) -> ListOrder {
    let is_of_links = |term: &&Arc<Induced>| matches!(term.pairs, BodyPairs::Links { .. });
    let has_no_repeats = match group.len() {
        0 | 1 => true,
        2 => group.iter().filter(is_of_links).count() == 1,
        _ => false,
    };
    match has_no_repeats {
        true => ListOrder::Any,
        false => ListOrder::Bounds,
    }
}

/// A group that can be searched: it has passed [`Scene::checked`].
#[derive(Clone, Copy)]
pub(crate) struct CheckedGroup<'g>(&'g Group);

impl Deref for CheckedGroup<'_> {
    type Target = Group;

    fn deref(&self) -> &Group {
        self.0
    }
}

impl<'a> Scene<'a> {
    /// Whether the group obviously has no body pair: a cheap test.
    pub fn is_empty(&self, group: &Group) -> bool {
        group.iter().all(|term| match &term.pairs {
            BodyPairs::Links { pairs, .. } => pairs.is_empty(),
            BodyPairs::Objects(LinksAndObjects { links, objects, .. }) => {
                let Some(snapshot) = self.world().snapshot(objects.environment()) else {
                    return true;
                };
                let no_object = match objects {
                    SObjects::All(_) => snapshot.is_empty(),
                    SObjects::Some(_, ids) => ids.iter().all(|id| snapshot.find(*id).is_none()),
                };
                links.is_empty() || no_object
            }
        })
    }

    /// Refuses groups that cannot be searched: planar bodies against spatial ones, and s-objects attached to links of
    /// another space, whose poses are unknown. Checking first makes the error independent of what the search visits.
    pub fn checked<'g>(&self, group: &'g Group) -> Result<CheckedGroup<'g>> {
        for term in group {
            self.check_term(term)?;
        }
        Ok(CheckedGroup(group))
    }

    /// The same of one induced set.
    pub(super) fn check_term(&self, term: &Induced) -> Result<()> {
        let BodyPairs::Objects(LinksAndObjects { links, objects, .. }) = &term.pairs else {
            return Ok(());
        };
        let Some(snapshot) = self.world().snapshot(objects.environment()) else {
            return Ok(());
        };
        self.check_dimensions(links, snapshot)?;
        let elsewhere = |object: &&SObject| {
            let space = object
                .attachment
                .as_ref()
                .map(|attachment| attachment.space);
            space != Some(self.space().serial()) && objects.contains(object.id)
        };
        match snapshot.attached().find(elsewhere) {
            Some(SObject { id, .. }) => Err(Error::new(
                ErrorKind::Unsupported,
                format!("s-object {id} is attached to a link of another space"),
            )),
            None => Ok(()),
        }
    }

    /// The candidates of a group, without duplicates, ranked by ids and sorted by bound.
    pub fn candidates(
        &self,
        group: CheckedGroup,
        filter: CandidateFilter,
        scratch: &mut CandidateScratch,
        meter: &mut WorkMeter,
    ) -> Result<Vec<Target<'_>>> {
        let mut candidates = Candidates::new(filter, scratch, meter);
        for (number, term) in (0..).zip(&*group) {
            match &term.pairs {
                BodyPairs::Links { pairs, rows, clear } => {
                    let term = LinksTerm {
                        pairs,
                        rows,
                        clear: clear.as_deref(),
                        options: &term.options,
                        number,
                    };
                    self.offer_links(&term, &mut candidates, &mut scratch.link_boxes);
                }
                BodyPairs::Objects(pairs) => {
                    let Some(snapshot) = self.world().snapshot(pairs.objects.environment()) else {
                        continue;
                    };
                    let term = ObjectsTerm {
                        pairs,
                        options: &term.options,
                        number,
                        snapshot,
                    };
                    let CandidateScratch { bodies, near, .. } = scratch;
                    self.offer_objects(&term, &mut candidates, bodies, near);
                }
            }
        }
        candidates.finish(scratch)
    }

    fn offer_links<'s>(
        &'s self,
        term: &LinksTerm,
        candidates: &mut Candidates<'s, '_>,
        boxes: &mut LinkBoxes,
    ) {
        let options = term.options;
        let target = |links: [usize; 2], sides: [Placement<'s>; 2]| Target {
            options: *options,
            term: term.number,
            ..self.link_pair(links, sides)
        };
        let cutoff = candidates.cutoff(options);
        let clear = term.clear.zip(self.coordinates());
        let clear = clear.filter(|_| candidates.wants_contacts_alone(options));
        let is_clear = |links: [usize; 2]| {
            clear.is_some_and(|(pairs, q)| pairs.of(links).is_some_and(|cells| cells.contain(q)))
        };
        candidates.count(term.pairs.len());
        let last_link = candidates.last_link();
        let links = self.space().bodies().carriers();
        boxes.visit_near(term.rows, self.bounds(), cutoff, |pair, bounds| {
            let [r, s] = pair.map(|body| links[body]);
            if r <= last_link
                && let (Some(a), Some(b)) = (self.link(r), self.link(s))
                && !is_clear([r, s])
            {
                return candidates.offer_bounded(options, bounds, || target([r, s], [a, b]));
            }
            candidates.cutoff(options)
        });
    }

    /// Two links with their bodies.
    pub fn link_pair<'s>(&self, [r, s]: [usize; 2], sides: [Placement<'s>; 2]) -> Target<'s> {
        let r = RSide {
            link: r,
            attached: 0,
        };
        Target {
            data: sides.map(|(body, _)| body.data()),
            ..self.target(r, SSide::Link(s), sides)
        }
    }

    fn check_dimensions(&self, links: &[usize], snapshot: &Snapshot) -> Result<()> {
        let Some(object) = snapshot.first() else {
            return Ok(());
        };
        // Links' bodies have the dimension of their robot.
        if object.body.dimension() == self.space().dimension() {
            return Ok(());
        }
        let differs = |&&r: &&usize| self.space().body(r).is_some();
        match links.iter().find(differs) {
            Some(r) => Err(Error::invalid(format!(
                "s-object {} and link {r} differ in dimension",
                object.id
            ))),
            None => Ok(()),
        }
    }

    #[inline(always)]
    pub(super) fn target<'s>(
        &self,
        r: RSide,
        s_side: SSide,
        sides: [Placement<'s>; 2],
    ) -> Target<'s> {
        Target {
            sides,
            key: CacheKey::Candidate {
                space: self.space().serial(),
                r_link: r.link,
                r_object: r.attached,
                s_side,
                body: sides[1].0.serial(),
            },
            options: InducedOptions::default(),
            data: [0; 2],
            s_carrier: None,
            term: 0,
            rank: 0,
            bound: f64::NEG_INFINITY,
        }
    }

    /// The body pair of a cache key, once for each term that (still) holds it, with the term's options.
    pub fn find<'s>(
        &'s self,
        group: &'s Group,
        key: &CacheKey,
    ) -> impl Iterator<Item = (Pairing<'s>, InducedOptions)> {
        let key = *key;
        group.iter().filter_map(move |term| {
            let [(a, pose_a), (b, pose_b)] = self.sides_of(term, &key)?;
            let fits = a.dimension() == b.dimension();
            fits.then(|| (Pairing::new(a, pose_a, b, pose_b), term.options))
        })
    }

    /// The two bodies of a cache key at their poses, if the induced set holds the pair.
    pub fn sides_of(&self, term: &Induced, key: &CacheKey) -> Option<[Placement<'_>; 2]> {
        let (r, s_side) = match *key {
            CacheKey::Candidate {
                space,
                r_link: link,
                r_object: attached,
                s_side,
                ..
            } if space == self.space().serial() => (RSide { link, attached }, s_side),
            _ => return None,
        };
        match (&term.pairs, s_side) {
            (BodyPairs::Links { rows, .. }, SSide::Link(s)) => {
                let bodies = self.space().bodies();
                let pair = [bodies.number(r.link)?, bodies.number(s)?];
                let is_held = r.attached == 0 && rows.contain(pair);
                is_held.then_some(())?;
                Some([self.link(r.link)?, self.link(s)?])
            }
            (BodyPairs::Objects(pairs), SSide::Object(id)) => {
                let is_chosen = pairs.links.contains(&r.link) && pairs.objects.contains(id);
                is_chosen.then_some(())?;
                let environment = pairs.objects.environment();
                let snapshot = self.world().snapshot(environment)?;
                let object = snapshot.find(id)?;
                let is_admitted = pairs.admits(r.link, r.attached, object);
                is_admitted.then_some(())?;
                let held = |id: u64| {
                    let mut all = self.held_of(environment.serial());
                    all.find_map(|(_, held)| (held.object.id == id).then_some(held))
                };
                let on_r = match r.attached {
                    0 => self.link(r.link)?,
                    id => {
                        let held = held(id).filter(|held| held.attachment.link == r.link)?;
                        (&*held.object.body, &held.pose)
                    }
                };
                let pose = match object.attachment {
                    None => &object.pose,
                    Some(_) => &held(id)?.pose,
                };
                Some([on_r, (&*object.body, pose)])
            }
            _ => None,
        }
    }
}

impl QueryContext {
    /// Takes back the memory of a candidate list for reuse.
    pub(super) fn keep_memory(&mut self, targets: Vec<Target>) {
        self.candidates.keep(targets);
    }

    /// The candidates of a group: see [`Scene::candidates`].
    pub(super) fn candidates<'s>(
        &mut self,
        scene: &'s Scene,
        group: CheckedGroup,
        filter: CandidateFilter,
    ) -> Result<Vec<Target<'s>>> {
        scene.candidates(
            group,
            filter,
            &mut self.candidates,
            self.scratch.meter_mut(),
        )
    }
}
