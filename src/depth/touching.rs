//! What touches once a translation has parted two bodies: the contacts that keep the translation from being shorter.

use super::least::least;
use crate::convex::HalfSpace;
use crate::pair::{Collect, Pairing, Scratch, traverse};
use crate::pose::Vec3;

/// A contact after the translation of A. Everything in A's centred frame before it moved.
#[derive(Clone, Copy, Debug)]
pub struct Touching {
    /// The unit normal from B to A.
    pub normal: Vec3,
    /// The point of A, where it was before the translation, and the point of B.
    pub points: [Vec3; 2],
    /// The distance of A, after the translation, from B.
    pub gap: f64,
    pub primitives: [u32; 2],
}

/// Why a way out is as long as it is: its direction is the sum of the normals of contacts, times their weights.
#[derive(Clone, Debug, Default)]
pub struct WayOut {
    /// Weights with contacts of the same normal, which span the common part of parallel features.
    pub terms: Vec<(f64, Vec<Touching>)>,
    /// The contacts explain the direction.
    pub is_explained: bool,
    /// They do, and no other contact would take a part of it: moved a little, the bodies have one shortest way out near this one.
    pub is_regular: bool,
}

/// Of more contacts, the others are left out; the way out then counts as not regular.
const MAX_CONTACTS: usize = 64;

/// The direction of a way out must be explained by contacts to within this, for its derivative to be.
const DIRECTION_ERROR: f64 = 1e-6;

/// Normals closer than this are of parallel features.
const SAME_NORMAL: f64 = 1e-9;

/// The contacts within `cutoff` after A has moved by `way`, and whether these are all.
pub fn touching_at(
    pairing: &Pairing,
    way: &Vec3,
    cutoff: f64,
    scratch: &mut Scratch,
) -> (Vec<Touching>, bool) {
    let shifted = pairing.shifted(way);
    let mut visitor = Collect::new(cutoff, MAX_CONTACTS, false);
    let _ = traverse(&shifted, None, scratch, &mut visitor);
    let (hits, is_truncated) = visitor.finish();
    let mut found = Vec::new();
    for hit in &hits {
        let primitives = hit.key.primitives;
        let memory = scratch.for_primitives();
        let measured = shifted.closest(hit, memory);
        for contact in shifted.world_contacts(primitives, &measured, memory) {
            let [on_a, on_b] = contact.points;
            found.push(Touching {
                normal: contact.normal,
                points: [on_a, on_b + way],
                gap: contact.contact.gap,
                primitives,
            });
        }
    }
    (found, !is_truncated)
}

/// The shortest translation near `way` by which the touching features keep clear of each other by `clearance`, as if they
/// were planes.
pub fn straightened(touching: &[Touching], way: &Vec3, clearance: f64, rounding: f64) -> Vec3 {
    let spaces: Vec<HalfSpace> = touching
        .iter()
        .map(|contact| HalfSpace {
            normal: contact.normal,
            offset: contact.normal.dot(way) - contact.gap + clearance,
        })
        .collect();
    least(&spaces, 0.0, rounding).point
}

impl WayOut {
    /// Explains a translation by the contacts after it. `clearance` is the largest gap of a contact that counts as touching.
    pub fn of(touching: &[Touching], way: &Vec3, clearance: f64, rounding: f64) -> Self {
        let near: Vec<&Touching> = touching.iter().filter(|c| c.gap <= clearance).collect();
        let spaces: Vec<HalfSpace> = near
            .iter()
            .map(|contact| HalfSpace {
                normal: contact.normal,
                offset: contact.normal.dot(way),
            })
            .collect();
        let length = way.norm();
        let explained = least(&spaces, 0.0, rounding);
        let is_same = |a: &Vec3, b: &Vec3| (a - b).norm() <= SAME_NORMAL;
        let basis: Vec<Vec3> = explained
            .multipliers
            .iter()
            .map(|&(i, _)| near[i].normal)
            .collect();
        let terms = explained.multipliers.iter().map(|&(i, multiplier)| {
            let alike = near.iter().filter(|c| is_same(&c.normal, &near[i].normal));
            (multiplier / length, alike.map(|c| **c).collect())
        });
        let is_explained =
            length > 0.0 && (explained.point - way).norm() <= DIRECTION_ERROR * length;
        let has_others = near
            .iter()
            .any(|c| !basis.iter().any(|n| is_same(n, &c.normal)));
        let is_strict = explained
            .multipliers
            .iter()
            .all(|(_, m)| *m > DIRECTION_ERROR * length);
        Self {
            terms: terms.collect(),
            is_explained,
            is_regular: is_explained && !has_others && is_strict,
        }
    }
}
