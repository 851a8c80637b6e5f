//! The body pairs of a C-object at a configuration.

use std::sync::Arc;

use super::answer::SSide;
use crate::body::Body;
use crate::cobject::{CObject, InducedOptions, SObjects, Term};
use crate::environment::Snapshot;
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
    pub pairing: Pairing<'a>,
    pub options: InducedOptions,
    /// Place in the order of ids.
    pub rank: u32,
    /// A safe lower bound of the distance less the margin.
    pub bound: f64,
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

    /// All body pairs, each once, ranked by ids and sorted by bound.
    pub fn candidates(&self) -> Result<Vec<Candidate<'_>>> {
        let mut found = Vec::new();
        for (term, snapshot) in self.cobject.terms().iter().zip(&self.snapshots) {
            match (&**term, snapshot) {
                (Term::Links { pairs, options }, _) => {
                    for &[r, s] in pairs {
                        if let (Some(a), Some(b)) = (self.body(r), self.body(s)) {
                            let pairing = Pairing::new(a, &self.poses[r], b, &self.poses[s]);
                            found.push((r, SSide::Link(s), pairing, *options));
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
                    let chosen: Vec<_> = match objects {
                        SObjects::All(_) => snapshot.objects.iter().collect(),
                        SObjects::Some(_, ids) => {
                            ids.iter().filter_map(|id| snapshot.find(*id)).collect()
                        }
                    };
                    for &r in links {
                        let Some(a) = self.body(r) else { continue };
                        for object in &chosen {
                            if object.body.dimension() != a.dimension() {
                                return Err(Error::invalid(format!(
                                    "s-object {} and link {r} differ in dimension",
                                    object.id
                                )));
                            }
                            let pairing =
                                Pairing::new(a, &self.poses[r], &object.body, &object.pose);
                            found.push((r, SSide::Object(object.id), pairing, *options));
                        }
                    }
                }
                _ => {}
            }
        }
        let found = without_repeats(found);
        let mut candidates: Vec<Candidate> = found
            .into_iter()
            .enumerate()
            .map(|(rank, (r_link, s_side, pairing, options))| Candidate {
                bound: pairing.sphere_bound() - options.margin,
                r_link,
                s_side,
                pairing,
                options,
                rank: rank as u32,
            })
            .collect();
        candidates.sort_by(|a, b| a.bound.total_cmp(&b.bound).then(a.rank.cmp(&b.rank)));
        Ok(candidates)
    }

    fn body(&self, link: usize) -> Option<&Body> {
        self.cobject.space().link(link)?.body.as_deref()
    }

    pub fn cobject(&self) -> &CObject {
        self.cobject
    }
}

/// A body pair of a C-object's term.
type Found<'a> = (usize, SSide, Pairing<'a>, InducedOptions);

/// In order of ids, each pair once: where several terms hold a pair in one state, the most that any of them would call
/// inside (the largest margin), and in contact, remains. An object that an environment and its snapshot hold in two states
/// stands for two.
fn without_repeats(mut found: Vec<Found>) -> Vec<Found> {
    found.sort_by_key(|(r_link, s_side, ..)| (*r_link, *s_side));
    let mut kept: Vec<Found> = Vec::with_capacity(found.len());
    for (r_link, s_side, pairing, options) in found {
        let same_ids = kept
            .iter_mut()
            .rev()
            .take_while(|(r, s, ..)| (*r, *s) == (r_link, s_side));
        let known = same_ids.into_iter().find(|(_, _, other, _)| {
            other.relative == pairing.relative && other.b.serial() == pairing.b.serial()
        });
        match known {
            None => kept.push((r_link, s_side, pairing, options)),
            Some((_, _, _, merged)) => {
                let reach = |o: &InducedOptions| o.margin + o.contact_epsilon;
                let farthest = reach(merged).max(reach(&options));
                merged.margin = merged.margin.max(options.margin);
                merged.contact_epsilon = farthest - merged.margin;
            }
        }
    }
    kept
}
