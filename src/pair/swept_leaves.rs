//! Two primitives over an interval of time, or a box of configurations: whether they stay apart, or meet at its middle.

use super::Scratch;
use super::pair_distance::{PairDistance, PrimitiveScratch};
use super::pairing::{EMPTY, Pairing};
use crate::convex::{Sweep, first_contact, stays_apart_along};
use crate::gjk::{DistanceLimits, gjk};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::{Vec3, turned, turned_back};
use crate::tolerance::EPSILON;

/// What is asked of primitives over an interval.
#[derive(Clone, Copy, Debug)]
pub struct SweptLimits {
    /// Primitives at most this far apart meet.
    pub threshold: f64,
    /// What the rounding of a gap may take off.
    pub slack: f64,
    /// No point of A moves farther than this, seen from B, from where the primitives are compared.
    pub displacement: f64,
}

/// What is known of two primitives over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SweptLeaves {
    /// They stay farther apart than the threshold.
    Free,
    /// They are within the threshold at its middle, up to rounding.
    Meet,
    /// They are apart at its middle, and more is not known. The direction in B's frame, from B to A, parts them there.
    Undecided([f32; 3]),
    /// The same, and so near the threshold at its middle that rounding hides whether they are apart there: halves show no more.
    Grazed([f32; 3]),
}

/// Closest points have errors of some EPSILON of the pair's size L, and the direction between them one of that over their distance d. What
/// it tilts takes that times L off a gap, which shows once d times what the gap has to spare is at most this times L^2.
const HAIR: f64 = 1e4 * EPSILON;

/// The direction that parts two hulls is looked for no longer once they are as near as this part of their size: no interval is then long
/// enough for one to be of use.
const HULLS_NEAR: f64 = 1e-4;

/// A look at two primitives, in the widest instructions.
struct SweptPair<'a, 'p> {
    pairing: &'a Pairing<'p>,
    places: [u32; 2],
    direction: &'a [f32; 3],
    sweep: &'a Sweep<'a>,
    limits: &'a SweptLimits,
    scratch: &'a mut PrimitiveScratch,
}

impl Work for SweptPair<'_, '_> {
    type Output = SweptLeaves;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> SweptLeaves {
        self.pairing.swept_pair(
            lanes,
            self.places,
            self.direction,
            self.sweep,
            self.limits,
            self.scratch,
        )
    }
}

impl Pairing<'_> {
    /// Looks at the primitives at two places. `direction` may part them: in B's frame, or zero.
    pub fn swept_leaves(
        &self,
        places: [u32; 2],
        direction: &[f32; 3],
        sweep: &Sweep,
        limits: &SweptLimits,
        scratch: &mut PrimitiveScratch,
    ) -> SweptLeaves {
        with_widest(SweptPair {
            pairing: self,
            places,
            direction,
            sweep,
            limits,
            scratch,
        })
    }

    #[inline(always)]
    fn swept_pair<I: Instructions>(
        &self,
        lanes: I,
        places: [u32; 2],
        direction: &[f32; 3],
        sweep: &Sweep,
        limits: &SweptLimits,
        scratch: &mut PrimitiveScratch,
    ) -> SweptLeaves {
        let needed = limits.threshold + limits.slack;
        if *direction != [0.0; 3] {
            let direction = turned(&self.relative.rotation, &direction.map(f64::from).into());
            if self.stays_apart(places, &direction, sweep, needed, scratch) {
                return SweptLeaves::Free;
            }
        }
        let mut buffer = EMPTY;
        let outline = self.outline_b(lanes, places[1], &mut buffer);
        let exact = DistanceLimits {
            cutoff: needed + limits.displacement,
            ..DistanceLimits::EXACT
        };
        let found = self.distance_to(lanes, places, &outline, &Vec3::zeros(), exact, scratch);
        let apart = match found {
            Ok(apart) => apart,
            Err(_) => return SweptLeaves::Free,
        };
        let error = self.precision.error + apart.doubt;
        let lower = apart.distance - error;
        if apart.distance == 0.0 || lower <= 0.0 || lower <= limits.threshold {
            return SweptLeaves::Meet;
        }
        if lower - limits.displacement > needed {
            return SweptLeaves::Free;
        }
        let outlines = self.outline_a(lanes, places[0]).zip(outline);
        let between = match (&outlines, &apart) {
            (
                Some((a, b)),
                PairDistance {
                    nearest: Some(nearest),
                    ..
                },
            ) => nearest.across(a, b),
            (_, PairDistance { measured, .. }) => measured.map_or_else(Vec3::zeros, |measured| {
                if measured.direction == Vec3::zeros() {
                    measured.closest.points[0] - measured.closest.points[1]
                } else {
                    measured.direction
                }
            }),
        };
        let Some(direction) = between.try_normalize(0.0) else {
            return SweptLeaves::Undecided([0.0; 3]);
        };
        if self.stays_apart(places, &direction, sweep, needed, scratch) {
            return SweptLeaves::Free;
        }
        let to_spare = lower - needed;
        let is_hair = to_spare > 0.0
            && apart.distance * to_spare <= HAIR * self.precision.size * self.precision.size;
        let normal = is_hair.then(|| self.contact_direction(places, scratch));
        let direction = normal.flatten().unwrap_or(direction);
        if is_hair && self.stays_apart(places, &direction, sweep, needed, scratch) {
            return SweptLeaves::Free;
        }
        let in_b = turned_back(&self.relative.rotation, &direction);
        let in_b = [in_b.x as f32, in_b.y as f32, in_b.z as f32];
        match apart.distance - self.precision.error <= needed {
            true => SweptLeaves::Grazed(in_b),
            false => SweptLeaves::Undecided(in_b),
        }
    }

    /// Whether one direction parts two primitives, whose cores are no smooth sets, through the interval. `direction`, from B to A in
    /// B's frame or zero, is tried first; it becomes another one that parts them at the middle, or zero where that does not.
    pub fn parted_by_one(
        &self,
        places: [u32; 2],
        direction: &mut [f32; 3],
        sweep: &Sweep,
        limits: &SweptLimits,
        scratch: &mut PrimitiveScratch,
    ) -> bool {
        let needed = limits.threshold + limits.slack;
        let mut start = -self.relative.translation;
        if *direction != [0.0; 3] {
            start = turned(&self.relative.rotation, &direction.map(f64::from).into());
            if self.stays_apart(places, &start, sweep, needed, scratch) {
                return true;
            }
        }
        let [a, b] = self.placed(places, &mut scratch.buffer);
        let near = DistanceLimits {
            cutoff: needed + limits.displacement,
            enough: HULLS_NEAR * self.precision.size,
        };
        let found = gjk(&a, &b, start, near);
        let in_b = turned_back(&self.relative.rotation, &found.direction);
        *direction = [in_b.x as f32, in_b.y as f32, in_b.z as f32];
        found.direction != Vec3::zeros()
            && self.stays_apart(places, &found.direction, sweep, needed, scratch)
    }

    /// The normal of the contact of primitives that are apart, in A's frame: it comes from their features, and does not lose digits
    /// where the closest points are only a rounding error apart.
    fn contact_direction(&self, places: [u32; 2], scratch: &mut PrimitiveScratch) -> Option<Vec3> {
        let found = self.closest_at(places, scratch)?;
        let [a, b] = self.placed(places, &mut scratch.buffer);
        Some(first_contact(&a, &b, &found, &self.precision)?.normal)
    }

    /// The distance of the primitives at two places, 0 where they touch to within the pair's error.
    pub fn distance_of_leaves(&self, places: [u32; 2], scratch: &mut PrimitiveScratch) -> f64 {
        let distance = self.distance(places, f64::INFINITY, scratch);
        distance.unwrap_or(f64::INFINITY)
    }

    /// Whether the primitives are certain to stay within the threshold of each other through the interval: they are nearer at its
    /// middle, or overlap more deeply, than the motion can change. Where every direction of A's and B's supports overlaps by more
    /// than their points move, no direction parts them.
    pub fn stays_within(
        &self,
        places: [u32; 2],
        limits: &SweptLimits,
        scratch: &mut Scratch,
    ) -> bool {
        let taken_off = limits.displacement + limits.slack;
        let Some(primitives) = scratch.for_one_pair().ok() else {
            return false;
        };
        let found = self.distance(places, limits.threshold, primitives);
        let nearest = match found {
            None => return false,
            Some(distance) if distance > 0.0 => distance + self.precision.error,
            Some(_) => {
                let depth = self.world_penetration(places, scratch.meter_mut());
                // Of smooth primitives no depth is known.
                self.precision.error - depth.map_or(0.0, |found| found.depth)
            }
        };
        !scratch.meter().is_exceeded() && nearest + taken_off <= limits.threshold
    }

    /// Whether a direction of A's frame, of about unit length, parts two primitives by more than `needed` through the interval.
    fn stays_apart(
        &self,
        places: [u32; 2],
        direction: &Vec3,
        sweep: &Sweep,
        needed: f64,
        scratch: &mut PrimitiveScratch,
    ) -> bool {
        let [a, b] = self.placed(places, &mut scratch.buffer);
        // What a function of the caller's calls farthest is so but for an error of its own.
        if a.shape.is_function() || b.shape.is_function() {
            return false;
        }
        let direction = direction.normalize();
        stays_apart_along(&a, &b, &direction, sweep, needed)
    }
}
