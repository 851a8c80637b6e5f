//! Two bodies of one primitive each whose cores' nearest points are known in closed form: what follows from these and the radii.

use super::hit::Hit;
use super::pairing::Pairing;
use super::singles::{SinglesNearest, is_within};
use crate::convex::{Contact, beyond_radii, middle_of_overlap, mode_of};
use crate::pose::Vec3;
use crate::primitive::Feature;

/// Two cores, of A and of B, in the centred frame of A.
pub struct ClosedCores<'a> {
    pub pairing: &'a Pairing<'a>,
    /// The radii around them.
    pub radii: [f64; 2],
    /// Their nearest points.
    pub points: [Vec3; 2],
    /// From the point of B to that of A.
    pub between: Vec3,
    /// Their distance.
    pub apart: f64,
}

impl ClosedCores<'_> {
    /// Whether their distance may be at most `threshold`, radii included; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&self, threshold: f64) -> bool {
        is_within(self.distance(), self.pairing.precision.error, threshold)
    }

    /// The distance beyond the radii; 0 where the two meet.
    #[inline(always)]
    fn distance(&self) -> f64 {
        beyond_radii(self.apart, self.radii)
    }

    /// The answer, given the features that hold the points, the unit normal from B to A there, and the gap of the cores along it. `None` where
    /// these features have no contact mode.
    #[inline(always)]
    pub fn nearest(
        &self,
        features: [Feature; 2],
        normal: Vec3,
        core_gap: f64,
    ) -> Option<SinglesNearest> {
        let (pairing, precision) = (self.pairing, &self.pairing.precision);
        let ([on_a, on_b], [a, b], apart) = (self.points, self.radii, self.apart);
        let gap = core_gap - a - b;
        let gap = if gap.abs() > precision.error {
            gap
        } else {
            0.0
        };
        let contact = pairing.in_world(Contact {
            points: [on_a - normal * a, on_b + normal * b],
            normal,
            distance: gap.max(0.0),
            gap,
            mode: mode_of(features)?,
            features,
        });
        let way = self.between / apart;
        let points = if apart >= a + b {
            pairing.points_in_world(&[on_a - way * a, on_b + way * b])
        } else {
            let middle = middle_of_overlap(apart, [a, b]);
            [pairing.frame.transform_point(&(on_a - way * middle)); 2]
        };
        let distance = pairing.above_error(self.distance());
        let is_apart = distance > 0.0;
        Some(SinglesNearest {
            hit: Hit::of_singles(distance, is_apart),
            lower: if is_apart {
                distance - precision.error
            } else {
                0.0
            },
            points,
            contact: Some(contact),
        })
    }
}
