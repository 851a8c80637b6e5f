//! The body pairs of a C-object at a configuration.

use std::borrow::Borrow;
use std::sync::Arc;

use super::answer::SSide;
use super::context::CacheKey;
use super::search::{Placement, Target};
use crate::body::Body;
use crate::cobject::{CObject, InducedOptions, SObjects, Term};
use crate::environment::{Bounds, NearScratch, SObject, Snapshot};
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Pairing;
use crate::pose::Pose;

/// Where the robot is: by its coordinates, or by the pose of every link of the space.
#[derive(Clone, Copy, Debug)]
pub enum Configuration<'a> {
    Coordinates(&'a [f64]),
    LinkPoses(&'a [Pose]),
}

/// The world at one configuration: link poses, and one snapshot of each environment.
pub struct Scene<'a> {
    cobject: &'a CObject,
    pub poses: Vec<Pose>,
    snapshots: Vec<Option<Arc<Snapshot>>>,
    pub version: u64,
}

/// A body pair with what its C-object says of it.
pub struct Candidate<'a> {
    pub r_link: usize,
    pub s_side: SSide,
    pub options: InducedOptions,
    pub target: Target<'a>,
}

impl<'a> Borrow<Target<'a>> for Candidate<'a> {
    fn borrow(&self) -> &Target<'a> {
        &self.target
    }
}

impl<'a> Scene<'a> {
    pub fn new(cobject: &'a CObject, configuration: Configuration) -> Result<Self> {
        let space = cobject.space();
        let poses = match configuration {
            Configuration::Coordinates(q) => {
                space.check_configuration(q)?;
                space.link_poses(q)
            }
            Configuration::LinkPoses(poses) => {
                if poses.len() != space.link_count() {
                    return Err(Error::new(
                        ErrorKind::WrongSize,
                        format!(
                            "{} link poses given, the space has {} links",
                            poses.len(),
                            space.link_count()
                        ),
                    ));
                }
                if let Some(link) = poses.iter().position(|pose| !pose.is_planar())
                    && space.dimension() == 2
                {
                    return Err(Error::invalid(format!(
                        "the pose of link {link} leaves the plane z = 0 of its robot"
                    )));
                }
                poses.to_vec()
            }
        };
        // One snapshot per environment, however many terms refer to it.
        let mut taken: Vec<(u64, Arc<Snapshot>)> = Vec::new();
        let mut version = 0;
        let mut snapshots = Vec::with_capacity(cobject.terms().len());
        for term in cobject.terms() {
            snapshots.push(match &**term {
                Term::Links { .. } => None,
                Term::Objects { objects, .. } => {
                    let (SObjects::All(environment) | SObjects::Some(environment, _)) = objects;
                    let serial = environment.serial();
                    let known = taken.iter().find(|(other, _)| *other == serial);
                    let snapshot = match known {
                        Some((_, snapshot)) => snapshot.clone(),
                        None => {
                            let snapshot = environment.snapshot();
                            taken.push((serial, snapshot.clone()));
                            snapshot
                        }
                    };
                    version = version.max(snapshot.version);
                    Some(snapshot)
                }
            });
        }
        Ok(Self {
            cobject,
            poses,
            snapshots,
            version,
        })
    }

    /// Whether there is no pair of bodies at all.
    pub fn is_empty(&self) -> bool {
        let nothing = |(term, snapshot): (&Arc<Term>, &Option<Arc<Snapshot>>)| match &**term {
            Term::Links { pairs, .. } => pairs.is_empty(),
            Term::Objects { links, objects, .. } => {
                let Some(snapshot) = snapshot else {
                    return true;
                };
                let no_object = match objects {
                    SObjects::All(_) => snapshot.objects.is_empty(),
                    SObjects::Some(_, ids) => ids.iter().all(|id| snapshot.find(*id).is_none()),
                };
                links.is_empty() || no_object
            }
        };
        self.cobject
            .terms()
            .iter()
            .zip(&self.snapshots)
            .all(nothing)
    }

    /// The body pairs that a search may need, each once, ranked by ids and sorted by bound.
    pub fn candidates(
        &self,
        wanted: Wanted,
        scratch: &mut NearScratch,
    ) -> Result<Vec<Candidate<'_>>> {
        let mut near = Near {
            wanted,
            nearest: f64::INFINITY,
            found: Vec::new(),
        };
        for (term, snapshot) in self.cobject.terms().iter().zip(&self.snapshots) {
            match (&**term, snapshot) {
                (Term::Links { pairs, options }, _) => {
                    for &[r, s] in pairs {
                        if let (Some(a), Some(b)) = (self.body(r), self.body(s)) {
                            let [ball, other] = [(a, r), (b, s)]
                                .map(|(body, link)| Bounds::of(body, &self.poses[link]));
                            near.offer(r, Side::Link(s), ball.distance(&other), options);
                        }
                    }
                }
                (
                    Term::Objects {
                        links,
                        objects,
                        options,
                    },
                    Some(snapshot),
                ) => self.offer_objects(links, objects, options, snapshot, &mut near, scratch)?,
                _ => {}
            }
        }
        let found = without_repeats(self.placed(near.finish()));
        let mut order: Vec<(f64, usize)> = found.iter().map(|found| found.bound).zip(0..).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let space = self.cobject.space().serial();
        let candidate = |(_, rank): (f64, usize)| {
            let Found {
                r_link,
                s_side,
                sides,
                options,
                bound,
            } = found[rank];
            Candidate {
                r_link,
                s_side,
                options,
                target: Target {
                    sides,
                    key: CacheKey::Candidate {
                        space,
                        r_link,
                        s_side,
                        body: sides[1].0.serial(),
                    },
                    rank: rank as u32,
                    margin: options.margin,
                    bound,
                },
            }
        };
        Ok(order.into_iter().map(candidate).collect())
    }

    /// The bodies of pairs.
    fn placed<'s>(&'s self, pairs: impl Iterator<Item = Offered<'s>>) -> Vec<Found<'s>> {
        let found = pairs.filter_map(|offered| {
            let (s_side, body, pose) = match offered.side {
                Side::Link(s) => (SSide::Link(s), self.body(s)?, &self.poses[s]),
                Side::Object(object) => (SSide::Object(object.id), &*object.body, &object.pose),
            };
            let r_link = offered.r_link;
            Some(Found {
                r_link,
                s_side,
                sides: [(self.body(r_link)?, &self.poses[r_link]), (body, pose)],
                options: offered.options,
                bound: offered.lower,
            })
        });
        found.collect()
    }

    /// The body pair that a key names, with the options of each term that holds it; nothing if none does (any more).
    pub fn find(&self, key: &CacheKey) -> impl Iterator<Item = (Pairing<'_>, InducedOptions)> {
        let named = match *key {
            CacheKey::Candidate {
                space,
                r_link,
                s_side,
                ..
            } if space == self.cobject.space().serial() => Some((r_link, s_side)),
            _ => None,
        };
        let terms = self.cobject.terms().iter().zip(&self.snapshots);
        let pairing = move |(term, snapshot)| -> Option<(Pairing<'_>, InducedOptions)> {
            let (r_link, s_side) = named?;
            let term: &Arc<Term> = term;
            let snapshot: &Option<Arc<Snapshot>> = snapshot;
            let (options, body, pose) = match (&**term, s_side) {
                (Term::Links { pairs, options }, SSide::Link(s)) => {
                    pairs.contains(&[r_link, s]).then_some(())?;
                    (options, self.body(s)?, &self.poses[s])
                }
                (
                    Term::Objects {
                        links,
                        objects,
                        options,
                    },
                    SSide::Object(id),
                ) => {
                    let is_chosen = match objects {
                        SObjects::All(_) => true,
                        SObjects::Some(_, ids) => ids.contains(&id),
                    };
                    (is_chosen && links.contains(&r_link)).then_some(())?;
                    let object = snapshot.as_ref()?.find(id)?;
                    (options, &*object.body, &object.pose)
                }
                _ => return None,
            };
            let a = self.body(r_link)?;
            let fits = a.dimension() == body.dimension();
            fits.then(|| (Pairing::new(a, &self.poses[r_link], body, pose), *options))
        };
        terms.filter_map(pairing)
    }

    fn offer_objects<'s>(
        &self,
        links: &[usize],
        objects: &SObjects,
        options: &InducedOptions,
        snapshot: &'s Snapshot,
        near: &mut Near<'s>,
        scratch: &mut NearScratch,
    ) -> Result<()> {
        let tree = snapshot.tree();
        for &r in links {
            let Some(body) = self.body(r) else { continue };
            if let Some(object) = snapshot.objects.first()
                && object.body.dimension() != body.dimension()
            {
                return Err(Error::invalid(format!(
                    "s-object {} and link {r} differ in dimension",
                    object.id
                )));
            }
            let bounds = Bounds::of(body, &self.poses[r]);
            let limit = near.limit(options) + options.margin;
            let mut offer = |place: usize, bound: f64| {
                let side = Side::Object(&snapshot.objects[place]);
                let [lower, upper] = bounds.distance(tree.bounds(place));
                near.offer(r, side, [lower.max(bound), upper], options)
            };
            match objects {
                SObjects::All(_) => tree.visit_near(&bounds, limit, scratch, offer),
                SObjects::Some(_, ids) => {
                    for place in ids.iter().filter_map(|id| snapshot.place_of(*id)) {
                        offer(place, f64::NEG_INFINITY);
                    }
                }
            }
        }
        Ok(())
    }

    fn body(&self, link: usize) -> Option<&Body> {
        self.cobject.space().link(link)?.body.as_deref()
    }

    pub fn cobject(&self) -> &CObject {
        self.cobject
    }
}

/// Which body pairs a search needs.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// All that may be within this.
    pub within: f64,
    /// All that may be in contact.
    pub in_contact: bool,
    /// Those that may be nearest, if within this.
    pub nearest: Option<f64>,
}

impl Wanted {
    pub fn within(threshold: f64) -> Self {
        Self {
            within: threshold,
            in_contact: false,
            nearest: None,
        }
    }
}

#[derive(Clone, Copy)]
enum Side<'s> {
    Link(usize),
    Object(&'s SObject),
}

/// A body pair of a C-object's term, with a safe lower bound of its distance less the margin.
struct Offered<'s> {
    lower: f64,
    r_link: usize,
    side: Side<'s>,
    options: InducedOptions,
}

/// Body pairs with the bounds of their distances, of which those that are too far fall away as nearer ones are met.
struct Near<'s> {
    wanted: Wanted,
    /// No pair that is farther than this, less its margin, is nearest.
    nearest: f64,
    found: Vec<Offered<'s>>,
}

impl<'s> Near<'s> {
    /// Takes a pair if it may matter. Returns how far other pairs of the same options may be to matter.
    fn offer(
        &mut self,
        r_link: usize,
        side: Side<'s>,
        [lower, upper]: [f64; 2],
        options: &InducedOptions,
    ) -> f64 {
        self.nearest = self.nearest.min(upper - options.margin);
        if lower - options.margin <= self.limit(options) {
            self.found.push(Offered {
                lower: lower - options.margin,
                r_link,
                side,
                options: *options,
            });
        }
        self.limit(options) + options.margin
    }

    fn limit(&self, options: &InducedOptions) -> f64 {
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

    fn finish(mut self) -> impl Iterator<Item = Offered<'s>> {
        let found = std::mem::take(&mut self.found);
        let matters = move |offered: &Offered| offered.lower <= self.limit(&offered.options);
        found.into_iter().filter(matters)
    }
}

/// The same with its bodies.
struct Found<'a> {
    r_link: usize,
    s_side: SSide,
    sides: [Placement<'a>; 2],
    options: InducedOptions,
    bound: f64,
}

/// In order of ids, each pair once: where several terms hold a pair in one state, the most that any of them would call
/// inside (the largest margin), and in contact, remains. An object that an environment and its snapshot hold in two states
/// stands for two.
fn without_repeats(mut found: Vec<Found>) -> Vec<Found> {
    let ids = |found: &Found| (found.r_link, found.s_side);
    found.sort_by_key(ids);
    if found.windows(2).all(|two| ids(&two[0]) != ids(&two[1])) {
        return found;
    }
    let mut kept: Vec<Found> = Vec::with_capacity(found.len());
    for next in found {
        let same_ids = kept.iter_mut().rev().take_while(|k| ids(k) == ids(&next));
        let known = same_ids.into_iter().find(|known| {
            let [(body, pose), (other_body, other_pose)] = [known.sides[1], next.sides[1]];
            pose == other_pose && body.serial() == other_body.serial()
        });
        match known {
            None => kept.push(next),
            Some(known) => {
                let reach = |o: &InducedOptions| o.margin + o.contact_epsilon;
                let merged = &mut known.options;
                let farthest = reach(merged).max(reach(&next.options));
                merged.margin = merged.margin.max(next.options.margin);
                merged.contact_epsilon = farthest - merged.margin;
                known.bound = known.bound.min(next.bound);
            }
        }
    }
    kept
}
