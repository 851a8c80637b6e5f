//! Queries at a configuration: operations 4 to 8 of §2.2.4 and `cstk-pseudo-normal` of Appendix A.

use super::answer::{ContactRecord, Distance, DistanceKind, SSide, Witness, WitnessList};
use super::at_poses::contact_records;
use super::candidates::Wanted;
use super::context::QueryContext;
use super::scene::{Configuration, Scene};
use super::search::Found;
use super::target::Target;
use crate::cobject::{CObject, Class};
use crate::error::{Error, ErrorKind, Result};
use crate::robot::Posture;
use crate::space::Space;

/// Class, distance, witnesses and gradients at one configuration.
#[derive(Clone, Debug)]
pub struct PseudoNormal {
    pub class: Class,
    pub distance: Distance,
    pub list: WitnessList,
}

/// Refuses thresholds that are NaN or negative; infinity is welcome.
pub(super) fn check_threshold(value: f64, name: &str) -> Result<()> {
    if value.is_nan() {
        return Err(Error::new(ErrorKind::NotFinite, format!("{name} is NaN")));
    }
    if value < 0.0 {
        return Err(Error::invalid(format!("{name} is negative: {value}")));
    }
    Ok(())
}

impl QueryContext {
    /// Operation 4: whether the configuration is inside, in contact or outside.
    pub fn classify(&mut self, cobject: &CObject, at: Configuration) -> Result<Class> {
        let scene = Scene::new(cobject, at)?;
        if self.recent_is_within(&scene, 0.0) {
            return Ok(Class::Inside);
        }
        let candidates = scene.candidates(
            Wanted {
                in_contact: true,
                ..Wanted::within(0.0)
            },
            &mut self.near,
        )?;
        Ok(if self.any_within(&candidates, |_| 0.0) {
            Class::Inside
        } else if self.any_in_contact(&candidates, 0.0) {
            Class::Contact
        } else {
            Class::Outside
        })
    }

    /// Whether some pair is within its contact epsilon, if no distance is below `lower`.
    fn any_in_contact(&mut self, candidates: &[Target], lower: f64) -> bool {
        let reaches = |c: &Target| {
            let epsilon = c.options.contact_epsilon;
            if epsilon > 0.0 && epsilon >= lower {
                epsilon
            } else {
                f64::NEG_INFINITY
            }
        };
        candidates.iter().any(|c| reaches(c) >= 0.0) && self.any_within(candidates, reaches)
    }

    /// Whether the distance may be at most `threshold`: doubt within rounding counts as within.
    pub fn within(&mut self, cobject: &CObject, at: Configuration, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        let scene = Scene::new(cobject, at)?;
        if self.recent_is_within(&scene, threshold) {
            return Ok(true);
        }
        let candidates = scene.candidates(Wanted::within(threshold), &mut self.near)?;
        Ok(self.any_within(&candidates, |_| threshold))
    }

    /// Operation 6: the distance from contact, up to `max_distance`, and the nearest primitive pair.
    pub fn distance(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        max_distance: f64,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        let scene = Scene::new(cobject, at)?;
        let candidates = scene.candidates(
            Wanted {
                nearest: Some(max_distance),
                ..Wanted::within(0.0)
            },
            &mut self.near,
        )?;
        self.distance_among(&scene, &candidates, max_distance)
    }

    fn distance_among(
        &mut self,
        scene: &Scene,
        candidates: &[Target],
        max_distance: f64,
    ) -> Result<Distance> {
        if scene.is_empty() {
            return Ok(Distance::empty(scene.version));
        }
        let found = self.nearest(candidates, max_distance);
        Ok(Distance {
            version: scene.version,
            ..Distance::from_found(&found, candidates, max_distance)
        })
    }

    /// Operation 7: all primitive pairs at most `epsilon` apart; of more than `max_count`, the nearest.
    pub fn witnesses(
        &mut self,
        cobject: &CObject,
        at: Configuration,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        check_threshold(epsilon, "epsilon")?;
        let scene = Scene::new(cobject, at)?;
        let candidates = scene.candidates(Wanted::within(epsilon), &mut self.near)?;
        self.list(&scene, &candidates, epsilon, max_count, None)
    }

    /// Operation 8: the same, with the gradient of each contact's distance.
    pub fn gradients(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        check_threshold(epsilon, "epsilon")?;
        let scene = Scene::new(cobject, Configuration::Coordinates(q))?;
        let candidates = scene.candidates(Wanted::within(epsilon), &mut self.near)?;
        self.list(&scene, &candidates, epsilon, max_count, scene.posture())
    }

    /// Appendix A's `cstk-pseudo-normal`: everything about one configuration, witnesses and gradients within
    /// `max_shell`. With `normalize`, gradients are scaled to unit length.
    pub fn pseudo_normal(
        &mut self,
        cobject: &CObject,
        q: &[f64],
        max_shell: f64,
        max_count: usize,
        normalize: bool,
    ) -> Result<PseudoNormal> {
        check_threshold(max_shell, "max_shell")?;
        let scene = Scene::new(cobject, Configuration::Coordinates(q))?;
        let candidates = scene.candidates(
            Wanted {
                in_contact: true,
                nearest: Some(f64::INFINITY),
                ..Wanted::within(max_shell)
            },
            &mut self.near,
        )?;
        let distance = self.distance_among(&scene, &candidates, f64::INFINITY)?;
        let mut list = self.list(&scene, &candidates, max_shell, max_count, scene.posture())?;
        if normalize && list.nv > 0 {
            for row in list.gradients.chunks_exact_mut(list.nv) {
                let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
                if length > 0.0 {
                    row.iter_mut().for_each(|x| *x /= length);
                }
            }
        }
        let class = if distance.lower == 0.0 {
            Class::Inside
        } else if self.any_in_contact(&candidates, distance.lower) {
            Class::Contact
        } else {
            Class::Outside
        };
        Ok(PseudoNormal {
            class,
            distance,
            list,
        })
    }

    /// The witnesses among the candidates, with gradients where a posture is given.
    fn list(
        &mut self,
        scene: &Scene,
        candidates: &[Target],
        epsilon: f64,
        max_count: usize,
        posture: Option<Posture>,
    ) -> Result<WitnessList> {
        let (hits, truncated) = self.collect(candidates, epsilon, max_count);
        let space = scene.cobject().space();
        let mut list = WitnessList {
            truncated,
            version: scene.version,
            nv: posture.map_or(0, |_| space.nv()),
            ..Default::default()
        };
        let ranked = by_rank(candidates);
        for hit in &hits {
            let target = ranked[hit.key.pair as usize];
            let first = list.contacts.len();
            list.push(target, &target.pairing(), hit);
            if let Some(posture) = posture {
                for contact in &list.contacts[first..] {
                    push_gradient(space, posture, target, contact, &mut list.gradients)?;
                }
            }
        }
        Ok(list)
    }
}

/// Appends one row: the derivative of the contact's distance, eq. (39). Both points are those of the configuration at hand.
fn push_gradient(
    space: &Space,
    posture: Posture,
    target: &Target,
    contact: &ContactRecord,
    rows: &mut Vec<f64>,
) -> Result<()> {
    let first = rows.len();
    rows.resize(first + space.nv(), 0.0);
    let row = &mut rows[first..];
    let [on_r, on_s] = &contact.points;
    let (r_link, s_side) = target.parties();
    space.add_gradient(posture, r_link, on_r, &contact.normal, row)?;
    if let SSide::Link(s) = s_side {
        space.add_gradient(posture, s, on_s, &-contact.normal, row)?;
    }
    Ok(())
}

/// The candidates in the order of their ranks, by which hits name them.
fn by_rank<'t, 'a>(candidates: &'t [Target<'a>]) -> Vec<&'t Target<'a>> {
    let mut ranked: Vec<_> = candidates.iter().collect();
    ranked.sort_unstable_by_key(|candidate| candidate.rank);
    ranked
}

impl Distance {
    pub(super) fn empty(version: u64) -> Self {
        Self {
            kind: DistanceKind::Empty,
            distance: f64::INFINITY,
            lower: f64::INFINITY,
            upper: f64::INFINITY,
            witness: None,
            points: Default::default(),
            contact: None,
            version,
        }
    }

    /// The answer to a search among targets up to `max_distance`.
    pub(super) fn from_found(found: &Found, targets: &[Target], max_distance: f64) -> Self {
        let Some((hit, target)) = &found.hit else {
            let errors = targets.iter().map(|t| t.pairing().precision.error);
            return Self {
                kind: DistanceKind::BeyondMax,
                lower: (max_distance - errors.fold(0.0, f64::max)).max(0.0),
                ..Self::empty(0)
            };
        };
        let pairing = target.pairing();
        let error = pairing.precision.error;
        let closest = pairing.closest(hit);
        // The first is that at the closest points.
        let contacts = contact_records(&pairing, hit, &closest, target.options.margin);
        let contact = contacts.into_iter().next();
        let witness = Witness {
            contact_count: usize::from(contact.is_some()),
            overlapping: contact.is_none() && hit.apart == 0.0,
            ..Witness::of(target, hit)
        };
        Self {
            kind: DistanceKind::Exact,
            distance: hit.distance,
            lower: found.lower,
            // Sets count as meeting up to the error, which that of the measured distance may hide once more.
            upper: hit.distance
                + if hit.distance == 0.0 {
                    2.0 * error
                } else {
                    error
                },
            witness: Some(witness),
            points: pairing.world_points(&closest),
            contact,
            version: 0,
        }
    }
}
