//! Where two primitives of a pair of bodies are closest, touch, and how deep they overlap.

use super::hit::Hit;
use super::pair_distance::PrimitiveScratch;
use super::pairing::{EMPTY, Pairing};
use crate::convex::{
    Closest, Contact, Penetration, PlacedBuffer, PrimitiveDistance, contacts, first_contact,
    is_flat_contact, measure, penetration, polygon_closest,
};
use crate::error::Result;
use crate::gjk::DistanceLimits;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pose::{Vec3, turned};
use crate::work_meter::WorkMeter;

/// A contact with its points and normal in the world.
#[derive(Clone, Copy, Debug)]
pub struct WorldContact {
    pub contact: Contact,
    pub points: [Vec3; 2],
    pub normal: Vec3,
}

impl Pairing<'_> {
    #[inline(never)]
    fn measure(
        &self,
        places: [u32; 2],
        limits: DistanceLimits,
        scratch: &mut PrimitiveScratch,
    ) -> Option<PrimitiveDistance> {
        let [a, b] = self.placed(places, &mut scratch.buffer);
        measure(&a, &b, &self.precision, limits, &mut scratch.distance).ok()
    }

    /// The closest points of a hit, in A's centred frame, and what its contacts are computed from.
    pub fn closest(&self, hit: &Hit, scratch: &mut PrimitiveScratch) -> PrimitiveDistance {
        let found = self.closest_at(hit.places, scratch);
        let mut found = found.expect("nothing is beyond infinity");
        found.closest.distance = hit.apart;
        found
    }

    /// The closest points of the primitives at two places, in A's centred frame; their distance is 0 at most up to the error.
    pub fn closest_at(
        &self,
        places: [u32; 2],
        scratch: &mut PrimitiveScratch,
    ) -> Option<PrimitiveDistance> {
        let found = self.closest_outlines(places);
        let found = found.map(PrimitiveDistance::of_hulls);
        found.or_else(|| self.measure(places, DistanceLimits::EXACT, scratch))
    }

    /// The same for polygons that do not cross.
    fn closest_outlines(&self, places: [u32; 2]) -> Option<Closest> {
        let entries = [(self.a, places[0]), (self.b, places[1])]
            .map(|(body, place)| body.packed().primitives().entry(place as usize));
        let is_plain = entries.iter().all(|entry| entry.is_plain);
        is_plain
            .then(|| {
                with_widest(ClosestOutlines {
                    pairing: self,
                    places,
                })
            })
            .flatten()
    }

    /// The contacts of one primitive pair, in the world.
    pub fn world_contacts(
        &self,
        primitives: [u32; 2],
        measured: &PrimitiveDistance,
        scratch: &mut PrimitiveScratch,
    ) -> Vec<WorldContact> {
        let [a, b] = self.place(primitives, [None; 2], &mut scratch.buffer);
        let found = contacts(&a, &b, measured, &self.precision);
        found.into_iter().map(|c| self.in_world(c)).collect()
    }

    /// Whether more than a point of each of two primitives, one of them smooth, is nearest along a unit normal of A's centred frame, from B to
    /// A: of a cap on a face one contact is listed, which stands for all.
    pub fn is_flat_contact(&self, primitives: [u32; 2], normal: &Vec3) -> bool {
        let mut buffer = PlacedBuffer::default();
        let [a, b] = self.place(primitives, [None; 2], &mut buffer);
        is_flat_contact(&a, &b, normal)
    }

    /// The first of these contacts: the one at the closest points, if the primitives are apart.
    pub fn first_world_contact(
        &self,
        primitives: [u32; 2],
        measured: &PrimitiveDistance,
        scratch: &mut PrimitiveScratch,
    ) -> Option<WorldContact> {
        let [a, b] = self.place(primitives, [None; 2], &mut scratch.buffer);
        first_contact(&a, &b, measured, &self.precision).map(|c| self.in_world(c))
    }

    #[inline(always)]
    pub(super) fn in_world(&self, contact: Contact) -> WorldContact {
        WorldContact {
            points: self.points_in_world(&contact.points),
            normal: turned(&self.frame.rotation, &contact.normal),
            contact,
        }
    }

    /// The penetration of the primitives at two places, which meet, in the world. Fails for smooth primitives. The result is
    /// meaningless if the meter's limit is exceeded.
    pub fn world_penetration(
        &self,
        places: [u32; 2],
        meter: &mut WorkMeter,
    ) -> Result<Penetration> {
        let mut buffer = PlacedBuffer::default();
        let [a, b] = self.placed(places, &mut buffer);
        let found = penetration(&a, &b, &self.precision, meter)?;
        Ok(Penetration {
            depth: found.depth,
            direction: self.frame.rotation * found.direction,
            points: found.points.map(|p| self.frame.transform_point(&p)),
        })
    }

    /// The closest points in the world.
    #[inline(always)]
    pub fn world_points(&self, closest: &Closest) -> [Vec3; 2] {
        self.points_in_world(&closest.points)
    }

    #[inline(always)]
    pub(super) fn points_in_world(&self, [on_a, on_b]: &[Vec3; 2]) -> [Vec3; 2] {
        let frame = &self.frame;
        [frame.transform_point(on_a), frame.transform_point(on_b)]
    }
}

struct ClosestOutlines<'a> {
    pairing: &'a Pairing<'a>,
    places: [u32; 2],
}

impl Work for ClosestOutlines<'_> {
    type Output = Option<Closest>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Option<Closest> {
        let Self { pairing, places } = self;
        let mut buffer = EMPTY;
        let a = pairing.outline_a(lanes, places[0])?;
        let b = pairing.outline_b(lanes, places[1], &mut buffer)?;
        polygon_closest(&a, &b, pairing.precision.size, pairing.precision.error)
    }
}
