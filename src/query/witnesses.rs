//! Operations 7 and 8: the witnesses of all leaves of a set, nearest first, and the gradients of their contacts.

use std::cmp::Ordering;
use std::ops::Range;

use super::answer::{ContactRecord, ContactsListed, Witness, WitnessList};
use super::candidates::CandidateFilter;
use super::context::{QueryContext, check_threshold};
use super::leaves::Leaves;
use super::pure_answer::{PureAt, PureWitness};
use super::scene::{Configuration, Group, Scene};
use super::target::{Parties, Target};
use crate::cobject::{CObject, Leaf, PureSet};
use crate::error::Result;
use crate::pair::{Collect, Hit, Pairing, PrimitiveScratch, WorldContact, traverse};
use crate::pose::Vec3;
use crate::robot::RobotState;
use crate::space::Space;

/// Which witnesses a query lists, and what it computes for them.
#[derive(Clone, Copy)]
pub(crate) struct WitnessRequest {
    pub epsilon: f64,
    /// Only pairs at most this much farther apart than the nearest.
    pub band: f64,
    pub max_count: usize,
    pub with_gradients: bool,
    pub contacts: ContactsListed,
    /// Only pairs of bodies that stand for nothing but themselves.
    pub is_proved: bool,
    /// Pairs count as within `epsilon` if their lower bound is, as for classes; otherwise if their distance is.
    pub counts_doubt: bool,
}

impl WitnessRequest {
    pub fn within(epsilon: f64, max_count: usize) -> Self {
        Self {
            epsilon,
            band: f64::INFINITY,
            max_count,
            with_gradients: false,
            contacts: ContactsListed::All,
            is_proved: false,
            counts_doubt: false,
        }
    }
}

impl QueryContext {
    /// Operation 7: all primitive pairs of the leaves at most `epsilon` apart, nearest first, at most `max_count` of them.
    pub fn witnesses(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        let request = WitnessRequest {
            contacts: self.contacts,
            ..WitnessRequest::within(epsilon, max_count)
        };
        self.witness_list(cobject, at, request)
    }

    /// Operation 8: the same, with the gradient of each contact's distance.
    pub fn gradients(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        let request = WitnessRequest {
            with_gradients: true,
            contacts: self.contacts,
            ..WitnessRequest::within(epsilon, max_count)
        };
        self.witness_list(cobject, Configuration::Coordinates(q), request)
    }

    fn witness_list(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        check_threshold(request.epsilon, "epsilon")?;
        cobject.require_one_metric()?;
        let world = self.look(cobject);
        self.with_scene(cobject, &world, at, |context, scene| {
            context.set_witnesses(cobject, scene, request)
        })
    }

    pub(super) fn set_witnesses(
        &mut self,
        cobject: &CObject,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        if let Some(group) = cobject.only_group() {
            return self.group_witnesses(group, scene, request);
        }
        let leaves = Leaves::of(cobject);
        let mut lists = Vec::with_capacity(leaves.groups.len() + 1);
        for group in &leaves.groups {
            lists.push(self.group_witnesses(group, scene, request)?);
        }
        if !leaves.pure.is_empty() {
            lists.push(pure_witnesses(&leaves.pure, scene, request)?);
        }
        if lists.len() == 1
            && let Some(only) = lists.pop()
        {
            return Ok(only);
        }
        Ok(WitnessList::merged(lists, scene, request))
    }

    pub(super) fn group_witnesses(
        &mut self,
        group: &Group,
        scene: &Scene,
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        let filter = CandidateFilter {
            is_proved: request.is_proved,
            ..CandidateFilter::within(request.epsilon)
        };
        let candidates = self.candidates(scene, scene.checked(group)?, filter)?;
        let list = self.list(group, scene, &candidates, request)?;
        self.keep_memory(candidates);
        Ok(list)
    }

    /// The witnesses among the candidates.
    pub(crate) fn list(
        &mut self,
        group: &Group,
        scene: &Scene,
        candidates: &[Target],
        request: WitnessRequest,
    ) -> Result<WitnessList> {
        let mut visitor = Collect::new(request.epsilon, request.max_count, request.counts_doubt);
        visitor.band = request.band;
        let (hits, truncated) = self.collect(candidates, visitor)?;
        let mut list = WitnessList {
            truncated,
            ..WitnessList::empty(scene, request)
        };
        let ranked = by_rank(candidates);
        let leaf_of = |target: &Target| group[target.term as usize].leaf;
        list.push_hits(&ranked, &hits, request.contacts, leaf_of);
        if let Some(state) = scene.state().filter(|_| request.with_gradients) {
            let rows = &mut list.gradients;
            for (hit, witness) in hits.iter().zip(&list.witnesses) {
                let links = ranked[hit.key.pair as usize].links();
                for contact in &list.contacts[witness.contacts()] {
                    let (normal, points) = (&contact.normal, &contact.points);
                    push_gradient(scene.space(), state, links, normal, points, rows)?;
                }
            }
        }
        Ok(list)
    }

    /// The witnesses of bodies that are asked about without a set.
    pub(super) fn list_of_bodies(
        &mut self,
        targets: &[Target],
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        let visitor = Collect::new(epsilon, max_count, false);
        let (hits, truncated) = self.collect(targets, visitor)?;
        let mut list = WitnessList {
            truncated,
            ..Default::default()
        };
        let ranked = by_rank(targets);
        list.push_hits(&ranked, &hits, self.contacts, |_| Leaf::default());
        Ok(list)
    }

    /// All pieces inside other bodies and all primitive pairs that the visitor accepts, nearest first, and whether the list
    /// is truncated.
    pub(super) fn collect(
        &mut self,
        targets: &[Target],
        mut visitor: Collect,
    ) -> Result<(Vec<Hit>, bool)> {
        for target in targets {
            visitor.margin = target.margin();
            visitor.body_pair = target.rank;
            if target.bound > visitor.limit() {
                continue;
            }
            self.count_body_pair()?;
            if let Some(pairing) = target.pairing_within(visitor.limit()) {
                if pairing.has_solid() {
                    let contained = pairing.contained(target.rank, &mut self.scratch);
                    contained.into_iter().for_each(|hit| visitor.take(hit));
                }
                // Where the nearest pair bounds the search, the one remembered is a good beginning.
                let first = (visitor.band < f64::INFINITY)
                    .then(|| self.remembered(&target.key))
                    .flatten();
                let _ = traverse(&pairing, first, &mut self.scratch, &mut visitor);
            }
        }
        self.scratch.meter().check()?;
        let is_banded = visitor.band < f64::INFINITY;
        let (hits, truncated) = visitor.finish();
        if let Some(nearest) = hits
            .first()
            .filter(|hit| is_banded && hit.contained.is_none())
            && let Some(target) = targets
                .iter()
                .find(|target| target.rank == nearest.key.pair)
        {
            self.remember(target.key, nearest.places);
        }
        Ok((hits, truncated))
    }
}

/// The witnesses of pure sets, nearest first; `true` asks about the complement.
pub(crate) fn pure_witnesses(
    leaves: &[(&PureSet, bool)],
    scene: &Scene,
    request: WitnessRequest,
) -> Result<WitnessList> {
    let mut found: Vec<PureWitness> = Vec::new();
    for &(set, complement) in leaves {
        let pure = PureAt {
            set,
            complement,
            scene,
        };
        found.extend(pure.within(request.epsilon, request.with_gradients)?);
    }
    // A stable sort: ties stay in the order of the leaves.
    found.sort_by(|a, b| a.witness.distance.total_cmp(&b.witness.distance));
    let mut list = WitnessList::empty(scene, request);
    list.truncated = found.len() > request.max_count;
    for next in found.into_iter().take(request.max_count) {
        let first_contact = list.contacts.len();
        if request.contacts != ContactsListed::None {
            list.contacts.extend(next.contact);
            list.gradients.extend(next.row);
        }
        let is_undecided = request.contacts == ContactsListed::None && next.witness.distance == 0.0;
        list.witnesses.push(Witness {
            first_contact,
            contact_count: list.contacts.len() - first_contact,
            overlapping: next.witness.overlapping || is_undecided,
            ..next.witness
        });
    }
    Ok(list)
}

impl WitnessList {
    fn empty(scene: &Scene, request: WitnessRequest) -> Self {
        Self {
            version: scene.version(),
            nv: if request.with_gradients {
                scene.space().nv()
            } else {
                0
            },
            ..Self::default()
        }
    }

    /// Appends the primitive pairs found, with the contacts requested; hits name their targets by rank.
    fn push_hits(
        &mut self,
        ranked: &[&Target],
        hits: &[Hit],
        contacts: ContactsListed,
        leaf_of: impl Fn(&Target) -> Leaf,
    ) {
        // Most have one contact.
        self.witnesses.reserve(hits.len());
        self.contacts.reserve(hits.len());
        let mut scratch = PrimitiveScratch::default();
        // The next hit is often one of the same bodies.
        let mut last: Option<(u32, Pairing)> = None;
        for hit in hits {
            let target = ranked[hit.key.pair as usize];
            let (_, pairing) = match &mut last {
                Some(last) if last.0 == hit.key.pair => last,
                _ => last.insert((hit.key.pair, target.pairing())),
            };
            let leaf = leaf_of(target);
            self.push(target, pairing, hit, leaf, contacts, &mut scratch);
        }
    }

    fn push(
        &mut self,
        target: &Target,
        pairing: &Pairing,
        hit: &Hit,
        leaf: Leaf,
        contacts: ContactsListed,
        scratch: &mut PrimitiveScratch,
    ) {
        let first_contact = self.contacts.len();
        if hit.contained.is_none() && contacts != ContactsListed::None {
            let measured = pairing.closest(hit, scratch);
            let record = |contact| ContactRecord::new(contact, target.margin());
            let primitives = hit.key.primitives;
            if contacts == ContactsListed::Nearest {
                let found = pairing.first_world_contact(primitives, &measured, scratch);
                self.contacts.extend(found.map(record));
            } else {
                let found = pairing.world_contacts(primitives, &measured, scratch);
                self.contacts.extend(found.into_iter().map(record));
            }
        }
        let contact_count = self.contacts.len() - first_contact;
        self.witnesses.push(Witness {
            first_contact,
            contact_count,
            overlapping: contact_count == 0 && hit.distance == 0.0,
            ..Witness::of(&target.parties(), hit, leaf)
        });
    }

    /// Merges lists, nearest first; ties go to earlier lists.
    pub(crate) fn merged(lists: Vec<WitnessList>, scene: &Scene, request: WitnessRequest) -> Self {
        let mut merged = Self::empty(scene, request);
        merged.take_nearest(&lists, request.max_count, |_, _| Ordering::Equal);
        merged
    }

    /// Appends the nearest witnesses of some lists; `ties` orders those equally near, and ties of it go to earlier lists.
    pub(super) fn take_nearest(
        &mut self,
        lists: &[WitnessList],
        max_count: usize,
        ties: impl Fn(&Witness, &Witness) -> Ordering,
    ) {
        let each = lists
            .iter()
            .flat_map(|list| list.witnesses.iter().map(move |witness| (list, witness)));
        let mut all: Vec<(&WitnessList, &Witness)> = each.collect();
        self.truncated = all.len() > max_count || lists.iter().any(|list| list.truncated);
        all.sort_by(|(_, a), (_, b)| {
            let nearer = a.distance.total_cmp(&b.distance);
            nearer.then_with(|| ties(a, b))
        });
        for (list, witness) in all.into_iter().take(max_count) {
            self.take(list, witness);
        }
    }

    /// Appends a witness of another list, with its contacts.
    pub(super) fn take(&mut self, list: &WitnessList, witness: &Witness) {
        let contacts = witness.contacts();
        self.witnesses.push(Witness {
            first_contact: self.contacts.len(),
            ..*witness
        });
        if list.nv > 0 && !list.gradients.is_empty() {
            let rows = contacts.start * list.nv..contacts.end * list.nv;
            self.gradients.extend_from_slice(&list.gradients[rows]);
        }
        self.contacts.extend_from_slice(&list.contacts[contacts]);
    }
}

impl Witness {
    /// The link that moves the r-side, and the one that moves the s-side, if one does.
    pub(super) fn links(&self) -> (usize, Option<usize>) {
        (self.r_link, self.s_side.link().or(self.s_carrier))
    }

    /// Where its contacts stand in the list.
    fn contacts(&self) -> Range<usize> {
        self.first_contact..self.first_contact + self.contact_count
    }

    /// A witness without contacts, which are added later.
    #[inline(always)]
    pub(super) fn of(parties: &Parties, hit: &Hit, leaf: Leaf) -> Self {
        Self {
            leaf,
            r_link: parties.r_link,
            r_object: parties.r_object,
            s_carrier: parties.s_carrier,
            s_side: parties.s_side,
            primitives: hit.key.primitives,
            tags: parties.tags(hit.key.primitives),
            parts: parties.parts(hit.key.primitives),
            data: parties.data,
            distance: hit.distance,
            first_contact: 0,
            contact_count: 0,
            overlapping: hit.contained.is_some(),
            contained: hit.contained.is_some(),
            complemented: false,
        }
    }
}

impl ContactRecord {
    /// A contact, with the margin subtracted from its distances.
    #[inline(always)]
    pub(super) fn new(found: WorldContact, margin: f64) -> Self {
        Self {
            points: found.points,
            normal: found.normal,
            distance: (found.contact.distance - margin).max(0.0),
            clearance: found.contact.gap - margin,
            mode: found.contact.mode,
            features: found.contact.features,
        }
    }
}

/// Appends one row: the derivative of the distance of two links' bodies along a normal, eq. (39). Both witness points are those at the
/// configuration.
pub(super) fn push_gradient(
    space: &Space,
    state: RobotState,
    (r_link, s_link): (usize, Option<usize>),
    normal: &Vec3,
    [on_r, on_s]: &[Vec3; 2],
    rows: &mut Vec<f64>,
) -> Result<()> {
    let first = rows.len();
    rows.resize(first + space.nv(), 0.0);
    let row = &mut rows[first..];
    space.add_gradient(state, r_link, on_r, normal, row)?;
    if let Some(s) = s_link {
        space.add_gradient(state, s, on_s, &-normal, row)?;
    }
    Ok(())
}

/// The candidates in order of rank: hits name them by rank.
fn by_rank<'t, 'a>(candidates: &'t [Target<'a>]) -> Vec<&'t Target<'a>> {
    let mut ranked: Vec<_> = candidates.iter().collect();
    ranked.sort_unstable_by_key(|candidate| candidate.rank);
    ranked
}
