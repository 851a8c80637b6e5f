//! The broad phase of links against s-objects: the bodies that links carry are offered with the objects near them.

use super::answer::SSide;
use super::candidates::Candidates;
use super::scene::{AttachedObject, Scene};
use super::target::{Placement, Target};
use crate::body::Body;
use crate::body_bounds::Bounds;
use crate::cobject::{Exceptions, InducedOptions, SObjects};
use crate::environment::{Named, NearScratch, SObject, Snapshot};

/// The r-side of a pair: a link's own body, or an s-object attached to the link.
#[derive(Clone, Copy)]
pub(super) struct RSide {
    pub link: usize,
    /// The object's id, or 0.
    pub attached: u64,
}

/// An induced set of links against s-objects, with its number in the group and the snapshot that it sees.
pub(super) struct ObjectsTerm<'t, 's> {
    pub links: &'t [usize],
    pub objects: &'t SObjects,
    pub exceptions: &'t Exceptions,
    pub options: &'t InducedOptions,
    pub number: u32,
    pub snapshot: &'s Snapshot,
}

impl ObjectsTerm<'_, '_> {
    /// Whether the set contains a body pair; the link of `r` must be one of its links.
    pub fn admits(&self, r: RSide, object: &SObject) -> bool {
        if self.exceptions.have(r.link, r.attached, object) {
            return false;
        }
        let Some(attachment) = &object.attachment else {
            return true;
        };
        // An attached object is not tested against the link that holds it, nor against its touch links. Of two attached
        // objects, the one with the lower id is the r-side.
        let touches = attachment.link == r.link
            || (r.attached == 0 && attachment.touch_links.contains(&r.link));
        let is_mirrored = r.attached > object.id
            && self.objects.contains(r.attached)
            && self.links.contains(&attachment.link);
        !touches && !is_mirrored
    }
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
    fn offer_near(&mut self, bodies: &[Named<'s>], scratch: &mut NearScratch) {
        let snapshot = self.term.snapshot;
        let cutoff = self.candidates.cutoff(self.term.options);
        snapshot
            .tree()
            .visit_near(bodies, cutoff, scratch, |named, place, bound| {
                let other = snapshot.bounds(place);
                let at = SObjectAt::in_world(snapshot, place);
                self.offer(named, at, other, bound)
            });
    }

    /// Offers those of the objects with these ids that are in the world.
    fn offer_chosen(&mut self, bodies: &[Named<'s>], ids: &[u64]) {
        let snapshot = self.term.snapshot;
        for named in bodies {
            let places = ids.iter().filter_map(|id| snapshot.place_of(*id));
            for place in places.filter(|&place| snapshot.object(place).attachment.is_none()) {
                let (at, other) = (SObjectAt::in_world(snapshot, place), snapshot.bounds(place));
                self.offer(named, at, other, f64::NEG_INFINITY);
            }
        }
    }

    /// Offers the set's objects that are attached to links.
    fn offer_attached(&mut self, bodies: &[Named<'s>], environment: u64) {
        let objects = self.term.objects;
        let held = self.scene.held_of(environment);
        let first_held = self.scene.space().link_count();
        for (i, held) in held.filter(|(_, held)| objects.contains(held.object.id)) {
            let other = &self.scene.bounds()[first_held + i];
            for named in bodies {
                self.offer(named, held.as_s_side(), other, f64::NEG_INFINITY);
            }
        }
    }

    /// Offers a body and an object with its bounds and a lower bound of their distance. Returns the cutoff for further
    /// pairs.
    #[inline(always)]
    fn offer(&mut self, named: &Named<'s>, at: SObjectAt<'s>, other: &Bounds, bound: f64) -> f64 {
        let (scene, term) = (self.scene, self.term);
        let &Named {
            number,
            body,
            pose,
            bounds,
        } = named;
        let r = scene.r_side(number);
        if !term.admits(r, at.object) {
            return self.candidates.cutoff(term.options);
        }
        let target = || Target {
            options: *term.options,
            term: term.number,
            data: [scene.r_data(number, body), at.object.data()],
            s_carrier: at.carrier,
            ..scene.target(r, SSide::Object(at.object.id), [(body, pose), at.placement])
        };
        self.candidates
            .offer(term.options, [bounds, other], bound, target)
    }
}

impl<'a> Scene<'a> {
    /// Offers the pairs of an induced set of links against s-objects.
    pub(super) fn offer_objects<'s>(
        &'s self,
        term: &ObjectsTerm<'_, 's>,
        candidates: &mut Candidates<'s, '_>,
        scratch: &mut NearScratch,
    ) {
        let environment = term.objects.environment().serial();
        let mut bodies = scratch.take_bodies();
        self.append_r_sides(term.links, candidates.last_link(), environment, &mut bodies);
        let mut offers = ObjectOffers {
            scene: self,
            term,
            candidates,
        };
        match term.objects {
            SObjects::All(_) => offers.offer_near(&bodies, scratch),
            SObjects::Some(_, ids) => offers.offer_chosen(&bodies, ids),
        }
        offers.offer_attached(&bodies, environment);
        scratch.keep_bodies(bodies);
    }

    /// What carries a number of [`Scene::append_r_sides`].
    #[inline(always)]
    pub(super) fn r_side(&self, number: usize) -> RSide {
        match number.checked_sub(self.space().link_count()) {
            None => RSide {
                link: number,
                attached: 0,
            },
            Some(i) => {
                let held = &self.held()[i];
                RSide {
                    link: held.attachment.link,
                    attached: held.object.id,
                }
            }
        }
    }

    /// The user data of a body with a number of [`Scene::append_r_sides`].
    fn r_data(&self, number: usize, body: &Body) -> usize {
        match number.checked_sub(self.space().link_count()) {
            None => body.data(),
            Some(i) => self.held()[i].object.data(),
        }
    }

    /// Appends the bodies of links and the s-objects attached to them, which are numbered after all links; none of links behind the
    /// last.
    pub(super) fn append_r_sides<'s>(
        &'s self,
        links: &[usize],
        last_link: usize,
        environment: u64,
        sides: &mut Vec<Named<'s>>,
    ) {
        let bounds = self.bounds();
        for &link in links {
            if link <= last_link
                && let Some((body, pose)) = self.link(link)
            {
                sides.push(Named {
                    number: link,
                    body,
                    pose,
                    bounds: &bounds[link],
                });
            }
        }
        let first_held = self.space().link_count();
        for (i, held) in self.held_of(environment) {
            let link = held.attachment.link;
            if link <= last_link && links.contains(&link) {
                sides.push(Named {
                    number: first_held + i,
                    body: &held.object.body,
                    pose: &held.pose,
                    bounds: &bounds[first_held + i],
                });
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
