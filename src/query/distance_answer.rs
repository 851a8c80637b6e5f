//! Builds distance answers: from the hit of a search, from a pure set, for an empty set; and combines them.

use super::answer::{ContactRecord, Distance, DistanceKind, Witness};
use super::distance::NearestHit;
use super::target::{Parties, Target};
use crate::cobject::{BoundedDistance, Leaf};
use crate::convex::PrimitiveDistance;
use crate::pair::{Hit, Pairing, PrimitiveScratch};
use crate::pose::Vec3;

/// The nearest primitive pair, with its witness points in the world, and its contact there if it has one.
pub(super) struct NearestPair<'a> {
    pub hit: &'a Hit,
    pub points: [Vec3; 2],
    pub contact: Option<ContactRecord>,
    /// What is subtracted from its distance (see `Target::margin`).
    pub margin: f64,
    /// How much of that are the bodies' stated deviations.
    pub stated_deviation: f64,
}

impl Distance {
    /// The distance where nothing was measured.
    pub(crate) fn unknown() -> Self {
        Self::empty(0)
    }

    /// Whether something meets, or may.
    pub(super) fn is_zero(&self) -> bool {
        self.distance == 0.0
    }

    pub(super) fn empty(version: u64) -> Self {
        Self {
            kind: DistanceKind::Empty,
            distance: f64::INFINITY,
            lower: f64::INFINITY,
            upper: f64::INFINITY,
            witness: None,
            points: Default::default(),
            contact: None,
            excess: 0.0,
            version,
        }
    }

    /// The answer where nothing is within `max_distance`. `lower` bounds the distances seen.
    pub(super) fn beyond(max_distance: f64, lower: f64) -> Self {
        Self {
            kind: DistanceKind::BeyondMax,
            // Pairs that were not visited are farther than `max_distance`, whatever the error of their distance.
            lower: max_distance.min(lower),
            ..Self::empty(0)
        }
    }

    /// The answer of a search up to `max_distance`. `leaf` gives the leaf of a target's term.
    pub(super) fn from_found(
        found: &NearestHit,
        max_distance: f64,
        leaf: impl Fn(u32) -> Leaf,
        scratch: &mut PrimitiveScratch,
    ) -> Self {
        let Some((hit, target)) = &found.hit else {
            return Self::beyond(max_distance, found.lower);
        };
        let measured = found.measured.as_ref();
        let leaf = leaf(target.term);
        let pairing = &target.pairing();
        Self::of_hit(hit, found.lower, measured, target, pairing, leaf, scratch)
    }

    /// The answer of a search that has a hit; `measured` saves measuring it again.
    pub(super) fn of_hit(
        hit: &Hit,
        lower: f64,
        measured: Option<&PrimitiveDistance>,
        target: &Target,
        pairing: &Pairing,
        leaf: Leaf,
        scratch: &mut PrimitiveScratch,
    ) -> Self {
        let error = pairing.precision.error;
        let (points, contact) = match hit.contained {
            Some(inner) => (pairing.points_inside(inner, hit), None),
            None => {
                let again;
                let measured = match measured {
                    Some(measured) => measured,
                    None => {
                        again = pairing.closest(hit, scratch);
                        &again
                    }
                };
                let contact = pairing.first_world_contact(hit.key.primitives, measured, scratch);
                let record = contact.map(|c| ContactRecord::new(c, target.margin()));
                (pairing.world_points(&measured.closest), record)
            }
        };
        let found = NearestPair {
            hit,
            points,
            contact,
            margin: target.margin(),
            stated_deviation: target.stated_deviation(),
        };
        Self::of_pair(&found, lower, &target.parties(), error, leaf)
    }

    /// The answer for a nearest pair with its witness points and contact.
    #[inline(always)]
    pub(super) fn of_pair(
        found: &NearestPair,
        lower: f64,
        parties: &Parties,
        error: f64,
        leaf: Leaf,
    ) -> Self {
        let &NearestPair {
            hit,
            points,
            contact,
            margin,
            stated_deviation,
        } = found;
        let upper_beside = |excess: f64| {
            // Sets that meet by their measured distance may be apart by twice the error: they count as meeting up to the
            // error, and the measured distance may itself be too small by it. Where it was not measured exactly, `apart` is
            // an upper bound of it.
            if hit.distance > 0.0 {
                return hit.distance + error + excess;
            }
            match hit.apart - margin + error + excess {
                beyond if beyond <= 0.0 => 0.0,
                beyond => beyond.max(2.0 * error),
            }
        };
        // The distance is less the stated deviations already.
        let upper = upper_beside(2.0 * stated_deviation);
        let excess = match stated_deviation > 0.0 {
            true => upper - upper_beside(0.0),
            false => 0.0,
        };
        let witness = Witness {
            contact_count: usize::from(contact.is_some()),
            overlapping: contact.is_none() && hit.distance == 0.0,
            ..Witness::of(parties, hit, leaf)
        };
        Self {
            kind: DistanceKind::Exact,
            distance: hit.distance,
            lower,
            upper,
            witness: Some(witness),
            points,
            contact,
            excess,
            version: 0,
        }
    }

    /// The answer of a pure set, up to `max_distance`.
    pub(super) fn from_bounds(
        bounds: BoundedDistance,
        max_distance: f64,
        witness: Witness,
        contact: Option<ContactRecord>,
    ) -> Self {
        if bounds.lower == f64::INFINITY {
            return Self::empty(0);
        }
        if bounds.distance > max_distance {
            return Self::beyond(max_distance, bounds.lower);
        }
        Self {
            kind: if bounds.is_exact {
                DistanceKind::Exact
            } else {
                DistanceKind::LowerBound
            },
            distance: bounds.distance,
            lower: bounds.lower,
            upper: bounds.upper,
            witness: Some(witness),
            points: contact.map_or_else(Default::default, |contact| contact.points),
            contact,
            excess: bounds.excess,
            version: 0,
        }
    }

    /// The answer of a set that does not measure: 0 if the configuration is known to be inside, else nothing is known.
    pub(super) fn of_place(is_inside: bool) -> Self {
        Self {
            kind: if is_inside {
                DistanceKind::Exact
            } else {
                DistanceKind::LowerBound
            },
            distance: 0.0,
            lower: 0.0,
            upper: if is_inside { 0.0 } else { f64::INFINITY },
            ..Self::empty(0)
        }
    }

    /// An upper bound of the distance of the bodies grown by their stated deviations.
    pub(crate) fn upper_of_grown(&self) -> f64 {
        self.upper - self.excess
    }

    /// The distance from a union: the smallest. Ties go to `self`.
    pub(super) fn least(self, other: Self) -> Self {
        let (best, rest) = if other.order_in_union() < self.order_in_union() {
            (other, self)
        } else {
            (self, other)
        };
        if best.kind == DistanceKind::Empty {
            return best;
        }
        let lower = best.lower.min(rest.lower);
        let upper = best.upper.min(rest.upper);
        let excess = match upper.is_finite() {
            true => upper - best.upper_of_grown().min(rest.upper_of_grown()),
            false => 0.0,
        };
        let is_undecided = rest.kind == DistanceKind::LowerBound && rest.lower < best.distance;
        if is_undecided && best.kind != DistanceKind::LowerBound {
            return Self {
                kind: DistanceKind::LowerBound,
                distance: lower,
                lower,
                upper,
                excess,
                ..best
            };
        }
        Self {
            lower,
            upper,
            excess,
            ..best
        }
    }

    /// The order of preference in a union: known distances, lower bounds, beyond the maximum, empty.
    fn order_in_union(&self) -> (u8, f64) {
        match self.kind {
            DistanceKind::Exact => (0, self.distance),
            DistanceKind::LowerBound => (1, self.lower),
            DistanceKind::BeyondMax => (2, 0.0),
            DistanceKind::Empty => (3, 0.0),
        }
    }

    /// The distance from an intersection: at least the largest of the parts. It is known only where it is 0 or infinite.
    pub(super) fn most(self, other: Self) -> Self {
        let rank = |d: &Self| match d.kind {
            DistanceKind::Empty => 2,
            DistanceKind::BeyondMax => 1,
            DistanceKind::Exact | DistanceKind::LowerBound => 0,
        };
        let is_more = (rank(&other), other.lower) > (rank(&self), self.lower);
        let is_zero = |d: &Self| d.kind == DistanceKind::Exact && d.distance == 0.0;
        if is_zero(&self) && is_zero(&other) {
            // Two sets that contain the configuration only up to rounding need not meet there.
            let is_inside = |d: &Self| {
                let overlaps = d.witness.is_some_and(|w| w.overlapping);
                (overlaps && d.excess == 0.0) || d.upper == 0.0
            };
            let is_certain = is_inside(&self) && is_inside(&other);
            let widest = if other.upper > self.upper {
                other
            } else {
                self
            };
            let upper = if is_certain {
                widest.upper
            } else {
                f64::INFINITY
            };
            return Self { upper, ..widest };
        }
        let (farthest, _) = if is_more {
            (other, self)
        } else {
            (self, other)
        };
        match farthest.kind {
            DistanceKind::Empty | DistanceKind::BeyondMax => farthest,
            DistanceKind::Exact | DistanceKind::LowerBound => Self {
                kind: DistanceKind::LowerBound,
                distance: farthest.lower,
                upper: f64::INFINITY,
                ..farthest
            },
        }
    }
}
