//! Two bodies of one sphere each: measured by their centres. Bit for bit what [`Singles`](super::Singles) answers, which takes
//! four times as long.

use super::hit::Hit;
use super::pairing::Pairing;
use super::singles::{SinglesNearest, is_within};
use crate::convex::{Contact, ContactMode};
use crate::pose::Vec3;
use crate::primitive::Feature;
use crate::tolerance;

/// The only primitives of two bodies, where both are spheres, in the centred frame of A.
pub struct Spheres<'a> {
    pairing: &'a Pairing<'a>,
    centers: [Vec3; 2],
    radii: [f64; 2],
    /// From the centre of B to that of A.
    between: Vec3,
    /// The distance of the centres.
    apart: f64,
}

impl<'a> Spheres<'a> {
    /// `None` if a body is more than a single sphere.
    #[inline(always)]
    pub fn of(pairing: &'a Pairing<'a>) -> Option<Self> {
        let (a, b) = (pairing.a.only_sphere()?, pairing.b.only_sphere()?);
        let centers = [a.center, pairing.relative.transform_point(&b.center)];
        let between = centers[0] - centers[1];
        Some(Self {
            pairing,
            centers,
            radii: [a.radius, b.radius],
            between,
            apart: between.norm(),
        })
    }

    /// The distance beyond the radii; 0 where the spheres meet.
    #[inline(always)]
    fn distance(&self) -> f64 {
        let ([a, b], apart) = (self.radii, self.apart);
        if apart >= a + b { apart - a - b } else { 0.0 }
    }

    /// Whether their distance may be at most `threshold`; doubt counts as within.
    #[inline(always)]
    pub fn are_within(&self, threshold: f64) -> bool {
        is_within(self.distance(), self.pairing.precision.error, threshold)
    }

    /// Their nearest points and contact, whatever their distance; `None` where the centres are too close together to define a normal.
    #[inline(always)]
    pub fn nearest(&self) -> Option<SinglesNearest> {
        let (pairing, precision) = (self.pairing, &self.pairing.precision);
        let ([on_a, on_b], [a, b], apart) = (self.centers, self.radii, self.apart);
        let doubt = 64.0 * tolerance::EPSILON * precision.size / apart;
        // NaN, of two centres at one place, is no doubt below the limit.
        let is_clear = doubt < tolerance::NORMAL_ERROR;
        if !is_clear || apart <= tolerance::MIN_NORMAL_DISTANCE * precision.size {
            return None;
        }
        let normal = self.between / apart;
        let gap = normal.dot(&self.between) - a - b;
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
            mode: ContactMode::PointPoint,
            features: [Feature::vertex(0); 2],
        });
        let points = if apart >= a + b {
            contact.points
        } else {
            // The middle of the overlap along the line between the centres.
            let middle = 0.5 * ((apart - b).max(0.0) + a.min(apart));
            [pairing.frame.transform_point(&(on_a - normal * middle)); 2]
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
