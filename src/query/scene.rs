//! The world at a configuration.

use std::borrow::Cow;
use std::sync::Arc;

use super::answer::SSide;
use super::candidates::{Candidates, Wanted};
use super::context::CacheKey;
use super::target::{Placement, Target};
use crate::cobject::{CObject, InducedOptions, SObjects, Term};
use crate::environment::{Bounds, Environment, Named, NearScratch, Snapshot};
use crate::error::{Error, ErrorKind, Result};
use crate::pair::Pairing;
use crate::pose::Pose;
use crate::robot::Posture;

/// Where the robot is: by its coordinates, or by the pose of every link of the space.
#[derive(Clone, Copy, Debug)]
pub enum Configuration<'a> {
    Coordinates(&'a [f64]),
    LinkPoses(&'a [Pose]),
}

/// The world at one configuration: link poses, and one snapshot of each environment.
pub struct Scene<'a> {
    cobject: &'a CObject,
    q: Option<&'a [f64]>,
    pub poses: Cow<'a, [Pose]>,
    snapshots: Vec<Option<Arc<Snapshot>>>,
    pub version: u64,
}

impl<'a> Scene<'a> {
    pub fn new(cobject: &'a CObject, configuration: Configuration<'a>) -> Result<Self> {
        let space = cobject.space();
        let poses = match configuration {
            Configuration::Coordinates(q) => {
                space.check_configuration(q)?;
                Cow::Owned(space.link_poses(q)?)
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
                Cow::Borrowed(poses)
            }
        };
        let mut version = 0;
        let mut snapshots: Vec<Option<Arc<Snapshot>>> = Vec::with_capacity(cobject.terms().len());
        for term in cobject.terms() {
            let snapshot = environment(term).map(|environment| {
                // One snapshot per environment, however many terms refer to it.
                let is_same = |other: &Arc<Environment>| other.serial() == environment.serial();
                let mut before = cobject.terms().iter().zip(&snapshots);
                let taken = before.find(|(other, _)| self::environment(other).is_some_and(is_same));
                let taken = taken.and_then(|(_, snapshot)| snapshot.clone());
                taken.unwrap_or_else(|| environment.snapshot())
            });
            version = version.max(snapshot.as_ref().map_or(0, |snapshot| snapshot.version));
            snapshots.push(snapshot);
        }
        let q = match configuration {
            Configuration::Coordinates(q) => Some(q),
            Configuration::LinkPoses(_) => None,
        };
        Ok(Self {
            cobject,
            q,
            poses,
            snapshots,
            version,
        })
    }

    /// The configuration with its link poses; `None` where only the poses are known.
    pub fn posture(&self) -> Option<Posture<'_>> {
        let poses = &self.poses;
        self.q.map(|q| Posture { q, poses })
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
    pub fn candidates(&self, wanted: Wanted, scratch: &mut NearScratch) -> Result<Vec<Target<'_>>> {
        let mut candidates = Candidates::new(wanted);
        for (term, snapshot) in self.cobject.terms().iter().zip(&self.snapshots) {
            match (&**term, snapshot) {
                (Term::Links { pairs, options }, _) => {
                    for &[r, s] in pairs {
                        if let (Some(a), Some(b)) = (self.link(r), self.link(s)) {
                            let [bounds, other] = [a, b].map(|(body, pose)| Bounds::of(body, pose));
                            let sides = [a, b];
                            let target = || self.target(r, SSide::Link(s), sides, options);
                            candidates.offer(options, [&bounds, &other], f64::NEG_INFINITY, target);
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
                ) => {
                    self.check_dimensions(links, snapshot)?;
                    self.offer_objects(links, objects, options, snapshot, &mut candidates, scratch);
                }
                _ => {}
            }
        }
        Ok(candidates.finish())
    }

    fn check_dimensions(&self, links: &[usize], snapshot: &Snapshot) -> Result<()> {
        let Some(object) = snapshot.objects.first() else {
            return Ok(());
        };
        let differs = |&&r: &&usize| {
            let body = self.link(r).map(|(body, _)| body);
            body.is_some_and(|body| body.dimension() != object.body.dimension())
        };
        match links.iter().find(differs) {
            Some(r) => Err(Error::invalid(format!(
                "s-object {} and link {r} differ in dimension",
                object.id
            ))),
            None => Ok(()),
        }
    }

    fn offer_objects<'s>(
        &'s self,
        links: &[usize],
        objects: &SObjects,
        options: &InducedOptions,
        snapshot: &'s Snapshot,
        candidates: &mut Candidates<'s>,
        scratch: &mut NearScratch,
    ) {
        let tree = snapshot.tree();
        let reach = candidates.reach(options);
        let bodies = links.iter().filter_map(|&r| {
            let (body, pose) = self.link(r)?;
            Some((r, body, pose))
        });
        let mut offer =
            |&(r, body, pose): &Named<'s>, bounds: &Bounds, place: usize, bound: f64| {
                let object = &snapshot.objects[place];
                let sides = [(body, pose), (&*object.body, &object.pose)];
                let target = || self.target(r, SSide::Object(object.id), sides, options);
                candidates.offer(options, [bounds, tree.bounds(place)], bound, target)
            };
        match objects {
            SObjects::All(_) => tree.visit_near(bodies, reach, scratch, offer),
            SObjects::Some(_, ids) => {
                for named in bodies {
                    let (_, body, pose) = named;
                    let bounds = Bounds::of(body, pose);
                    for place in ids.iter().filter_map(|id| snapshot.place_of(*id)) {
                        offer(&named, &bounds, place, f64::NEG_INFINITY);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn target<'s>(
        &self,
        r_link: usize,
        s_side: SSide,
        sides: [Placement<'s>; 2],
        options: &InducedOptions,
    ) -> Target<'s> {
        Target {
            sides,
            key: CacheKey::Candidate {
                space: self.cobject.space().serial(),
                r_link,
                s_side,
                body: sides[1].0.serial(),
            },
            options: *options,
            rank: 0,
            bound: f64::NEG_INFINITY,
        }
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
                    let (body, pose) = self.link(s)?;
                    (options, body, pose)
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
            let (a, pose_a) = self.link(r_link)?;
            let fits = a.dimension() == body.dimension();
            fits.then(|| (Pairing::new(a, pose_a, body, pose), *options))
        };
        terms.filter_map(pairing)
    }

    /// A link's body, if it has one, at its pose.
    fn link(&self, link: usize) -> Option<Placement<'_>> {
        let body = self.cobject.space().link(link)?.body.as_deref()?;
        Some((body, &self.poses[link]))
    }

    pub fn cobject(&self) -> &CObject {
        self.cobject
    }
}

fn environment(term: &Term) -> Option<&Arc<Environment>> {
    match term {
        Term::Links { .. } => None,
        Term::Objects {
            objects: SObjects::All(environment) | SObjects::Some(environment, _),
            ..
        } => Some(environment),
    }
}
