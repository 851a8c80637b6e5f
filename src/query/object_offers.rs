//! The broad phase of links against s-objects: the bodies that links carry are offered with the objects near them.

use super::answer::SSide;
use super::candidates::Candidates;
use super::scene::{AttachedObject, Scene};
use super::target::{Placement, Target};
use crate::body_bounds::Bounds;
use crate::cobject::{InducedOptions, LinksAndObjects, SObjects};
use crate::environment::{NearScratch, SObject, Snapshot};
use crate::index_set::IndexSet;

/// The r-side of a pair: a link's own body, or an s-object attached to the link.
#[derive(Clone, Copy)]
pub(super) struct RSide {
    pub link: usize,
    /// The object's id, or 0.
    pub attached: u64,
}

/// An induced set of links against s-objects, with its number in the group and the snapshot that it sees.
pub(super) struct ObjectsTerm<'t, 's> {
    pub pairs: &'t LinksAndObjects,
    pub options: &'t InducedOptions,
    pub number: u32,
    pub snapshot: &'s Snapshot,
}

/// The s-side of a pair: the object, its placement, and the link that holds it.
struct SObjectAt<'s> {
    object: &'s SObject,
    placement: Placement<'s>,
    carrier: Option<usize>,
}

impl<'s> SObjectAt<'s> {
    /// An object that no link holds, by its place in the snapshot.
    #[inline(always)]
    fn in_world(snapshot: &'s Snapshot, place: usize) -> Self {
        let object = snapshot.object(place);
        Self {
            object,
            placement: (&*object.body, &object.pose),
            carrier: None,
        }
    }
}

/// Offers the pairs of an induced set of links against s-objects as candidates.
struct ObjectOffers<'o, 's, 'a, 'm> {
    scene: &'s Scene<'a>,
    term: &'o ObjectsTerm<'o, 's>,
    candidates: &'o mut Candidates<'s, 'm>,
}

impl<'s> ObjectOffers<'_, 's, '_, '_> {
    /// Offers the objects in the world that the tree finds near the bodies.
    fn offer_near(&mut self, bodies: &IndexSet, scratch: &mut NearScratch) {
        let snapshot = self.term.snapshot;
        let cutoff = self.candidates.cutoff(self.term.options);
        let (tree, bounds) = (snapshot.tree(), self.scene.bounds());
        tree.visit_near(bounds, bodies, cutoff, scratch, |body, place, bound| {
            let other = snapshot.bounds(place);
            let at = SObjectAt::in_world(snapshot, place);
            self.offer(body, at, other, bound)
        });
    }

    /// Offers those of the objects with these ids that are in the world.
    fn offer_chosen(&mut self, bodies: &IndexSet, ids: &[u64]) {
        let snapshot = self.term.snapshot;
        for body in bodies.iter() {
            let places = ids.iter().filter_map(|id| snapshot.place_of(*id));
            for place in places.filter(|&place| snapshot.object(place).attachment.is_none()) {
                let (at, other) = (SObjectAt::in_world(snapshot, place), snapshot.bounds(place));
                self.offer(body, at, other, f64::NEG_INFINITY);
            }
        }
    }

    /// Offers the set's objects that are attached to links.
    fn offer_attached(&mut self, bodies: &IndexSet, environment: u64) {
        let objects = &self.term.pairs.objects;
        let held = self.scene.held_of(environment);
        let first_held = self.scene.space().bodies().count();
        for (i, held) in held.filter(|(_, held)| objects.contains(held.object.id)) {
            let other = &self.scene.bounds().get(first_held + i);
            for body in bodies.iter() {
                self.offer(body, held.as_s_side(), other, f64::NEG_INFINITY);
            }
        }
    }

    /// Offers a body and an object with its bounds and a lower bound of their distance. Returns the cutoff for further
    /// pairs.
    #[inline(always)]
    fn offer(&mut self, body: usize, at: SObjectAt<'s>, other: &Bounds, bound: f64) -> f64 {
        let (scene, term) = (self.scene, self.term);
        let r = scene.r_side(body);
        if !term.pairs.admits(r.link, r.attached, at.object) {
            return self.candidates.cutoff(term.options);
        }
        let bounds = scene.bounds().get(body);
        let target = || {
            let (placement, data) = scene.r_body(body);
            Target {
                options: *term.options,
                term: term.number,
                data: [data, at.object.data()],
                s_carrier: at.carrier,
                ..scene.target(r, SSide::Object(at.object.id), [placement, at.placement])
            }
        };
        self.candidates
            .offer(term.options, [&bounds, other], bound, target)
    }
}

impl<'a> Scene<'a> {
    /// Offers the pairs of an induced set of links against s-objects.
    pub(super) fn offer_objects<'s>(
        &'s self,
        term: &ObjectsTerm<'_, 's>,
        candidates: &mut Candidates<'s, '_>,
        bodies: &mut IndexSet,
        near: &mut NearScratch,
    ) {
        let LinksAndObjects {
            links,
            bodies: of_links,
            objects,
            ..
        } = term.pairs;
        let environment = objects.environment().serial();
        let last_link = candidates.last_link();
        let carriers = self.space().bodies().carriers();
        let up_to_last = carriers.partition_point(|&link| link <= last_link);
        bodies.clear(self.body_count());
        bodies.extend_below(of_links, up_to_last);
        for body in self.held_bodies_of(links, environment) {
            if self.r_side(body).link <= last_link {
                bodies.insert(body);
            }
        }
        let mut offers = ObjectOffers {
            scene: self,
            term,
            candidates,
        };
        match objects {
            SObjects::All(_) => offers.offer_near(bodies, near),
            SObjects::Some(_, ids) => offers.offer_chosen(bodies, ids),
        }
        offers.offer_attached(bodies, environment);
    }

    /// The numbers of the s-objects of an environment that are attached to links.
    pub(super) fn held_bodies_of<'s>(
        &'s self,
        links: &'s [usize],
        environment: u64,
    ) -> impl Iterator<Item = usize> + 's {
        let first_held = self.space().bodies().count();
        let held = self.held_of(environment);
        let held = held.filter(|(_, held)| links.contains(&held.attachment.link));
        held.map(move |(i, _)| first_held + i)
    }

    /// Who a body is, by its number.
    #[inline(always)]
    pub(super) fn r_side(&self, body: usize) -> RSide {
        match self.space().bodies().carriers().get(body) {
            Some(&link) => RSide { link, attached: 0 },
            None => {
                let held = &self.held()[body - self.space().bodies().count()];
                RSide {
                    link: held.attachment.link,
                    attached: held.object.id,
                }
            }
        }
    }

    /// A body by its number, at its pose, with its user data.
    #[inline(always)]
    pub(super) fn r_body(&self, body: usize) -> (Placement<'_>, usize) {
        match self.space().bodies().carriers().get(body) {
            Some(&link) => {
                let placement = self.link(link).expect("carriers have bodies");
                (placement, placement.0.data())
            }
            None => {
                let held = &self.held()[body - self.space().bodies().count()];
                ((&*held.object.body, &held.pose), held.object.data())
            }
        }
    }
}

impl<'a> AttachedObject<'a> {
    fn as_s_side(&self) -> SObjectAt<'_> {
        SObjectAt {
            object: self.object,
            placement: (&*self.object.body, &self.pose),
            carrier: Some(self.attachment.link),
        }
    }
}
