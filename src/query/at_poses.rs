//! Queries of two bodies at two poses: the level of FCL and Coal.

use super::answer::{
    ContactRecord, Distance, PenetrationList, PrimitivePenetration, Witness, WitnessList,
};
use super::at_configuration::check_threshold;
use super::context::{CacheKey, QueryContext};
use super::target::{Placement, Target};
use crate::body::Body;
use crate::cobject::{InducedOptions, Leaf};
use crate::convex::Closest;
use crate::error::{Error, Result};
use crate::pair::{Hit, Pairing};

fn target<'a>(a: Placement<'a>, b: Placement<'a>) -> Result<Target<'a>> {
    if a.0.dimension() != b.0.dimension() {
        return Err(Error::invalid(format!(
            "the bodies differ in dimension: {} and {}",
            a.0.dimension(),
            b.0.dimension()
        )));
    }
    for ((body, pose), name) in [(a, "pose_a"), (b, "pose_b")] {
        if body.dimension() == 2 && !pose.is_planar() {
            return Err(Error::invalid(format!(
                "{name} leaves the plane z = 0 of its body"
            )));
        }
    }
    Ok(Target {
        sides: [a, b],
        key: CacheKey::Bodies(a.0.serial(), b.0.serial()),
        options: InducedOptions::default(),
        data: [a.0.data(), b.0.data()],
        s_carrier: None,
        term: 0,
        rank: 0,
        bound: f64::NEG_INFINITY,
    })
}

impl QueryContext {
    /// The distance of two bodies, up to `max_distance`, and the nearest primitive pair.
    pub fn pair_distance(
        &mut self,
        a: Placement,
        b: Placement,
        max_distance: f64,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        let targets = [target(a, b)?];
        let found = self.nearest(&targets, max_distance);
        Ok(Distance::from_found(&found, max_distance, |_| {
            Leaf::default()
        }))
    }

    /// Whether the distance of two bodies may be at most `threshold`: doubt within rounding counts as within.
    pub fn pair_within(&mut self, a: Placement, b: Placement, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        let target = target(a, b)?;
        Ok(self.any_within(&[target], |_| threshold))
    }

    /// All primitive pairs at most `epsilon` apart; of more than `max_count`, the nearest.
    pub fn pair_witnesses(
        &mut self,
        a: Placement,
        b: Placement,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        check_threshold(epsilon, "epsilon")?;
        let target = target(a, b)?;
        let pairing = &target.pairing();
        let (hits, truncated) = self.collect(std::slice::from_ref(&target), epsilon, max_count);
        let mut list = WitnessList {
            truncated,
            ..Default::default()
        };
        for hit in &hits {
            list.push(&target, pairing, hit, Leaf::default());
        }
        Ok(list)
    }

    /// All primitive pairs that meet, with the shortest translation that takes each apart; of more than `max_count`, the
    /// deepest. Fails where a smooth primitive meets another: the depth of those is not computed. A piece that lies
    /// wholly inside a solid meets no primitive of it, and is not listed.
    pub fn pair_penetration(
        &mut self,
        a: Placement,
        b: Placement,
        max_count: usize,
    ) -> Result<PenetrationList> {
        let target = target(a, b)?;
        let pairing = &target.pairing();
        let (hits, _) = self.collect(std::slice::from_ref(&target), 0.0, usize::MAX);
        let mut penetrations: Vec<PrimitivePenetration> = hits
            .iter()
            .filter(|hit| hit.contained.is_none())
            .map(|hit| {
                let primitives = hit.key.primitives;
                let named = |e: Error| {
                    e.within(format_args!(
                        "primitives {} and {}",
                        primitives[0], primitives[1]
                    ))
                };
                Ok(PrimitivePenetration {
                    primitives,
                    tags: Witness::of(&target, hit, Leaf::default()).tags,
                    penetration: pairing.world_penetration(primitives).map_err(named)?,
                })
            })
            .collect::<Result<_>>()?;
        // Stable: those of equal depth stay in the order of their numbers.
        penetrations.sort_by(|x, y| y.penetration.depth.total_cmp(&x.penetration.depth));
        let truncated = penetrations.len() > max_count;
        penetrations.truncate(max_count);
        let is_one = |body: &Body| body.primitives().len() == 1;
        Ok(PenetrationList {
            penetrations,
            of_whole_bodies: is_one(a.0) && is_one(b.0),
            truncated,
        })
    }
}

impl Witness {
    /// A witness whose contacts are not known yet.
    pub(super) fn of(target: &Target, hit: &Hit, leaf: Leaf) -> Self {
        let (r_link, r_object, s_side) = target.parties();
        let [(a, _), (b, _)] = target.sides;
        let [on_a, on_b] = hit.key.primitives;
        Self {
            leaf,
            r_link,
            r_object,
            s_carrier: target.s_carrier,
            s_side,
            primitives: hit.key.primitives,
            tags: [a.tag(on_a), b.tag(on_b)],
            data: target.data,
            distance: hit.distance,
            first_contact: 0,
            contact_count: 0,
            overlapping: hit.contained.is_some(),
            contained: hit.contained.is_some(),
            complemented: false,
        }
    }
}

impl WitnessList {
    /// Takes a primitive pair with its contacts.
    pub(super) fn push(&mut self, target: &Target, pairing: &Pairing, hit: &Hit, leaf: Leaf) {
        let contacts = match hit.contained {
            Some(_) => Vec::new(),
            None => contact_records(pairing, hit, &pairing.closest(hit), target.options.margin),
        };
        self.witnesses.push(Witness {
            first_contact: self.contacts.len(),
            contact_count: contacts.len(),
            overlapping: contacts.is_empty() && hit.distance == 0.0,
            ..Witness::of(target, hit, leaf)
        });
        self.contacts.extend(contacts);
    }
}

/// The contacts of a primitive pair, given its closest points; distances less the margin.
pub(super) fn contact_records(
    pairing: &Pairing,
    hit: &Hit,
    closest: &Closest,
    margin: f64,
) -> Vec<ContactRecord> {
    pairing
        .world_contacts(hit.key.primitives, closest)
        .into_iter()
        .map(|found| ContactRecord {
            points: found.points,
            normal: found.normal,
            distance: (found.contact.distance - margin).max(0.0),
            clearance: found.contact.gap - margin,
            mode: found.contact.mode,
            features: found.contact.features,
        })
        .collect()
}
