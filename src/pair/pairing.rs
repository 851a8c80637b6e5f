//! Two bodies at two poses, brought into one frame.

use super::hit::Hit;
use super::visitor::PrimitivePair;
use crate::body::Body;
use crate::convex::{
    Beyond, Closest, Contact, Core, DistanceScratch, MAX_CORNERS, NearestFeatures, Outline,
    Penetration, PlacedBuffer, PlacedPrimitive, PolygonDistance, Precision, PrimitiveDistance,
    contacts, cuboid, first_contact, measure, meeting_or_beyond, moved, parts, penetration,
    polygon_closest, polygon_distance,
};
use crate::error::Result;
use crate::gjk::{DistanceLimits, Proved, Support};
use crate::hierarchy::packed::PackedPrimitives;
use crate::lanes::{F64x4, Instructions, Points64, Work, with_widest};
use crate::pose::{Pose, Rows, Vec3, turned, turned_back};
use crate::primitive::{Form, SmoothKind};
use crate::relative_pose::{centered, relative_centered, relative_of};
use crate::tolerance;
use crate::work_meter::WorkMeter;

/// Bodies A (the r-side) and B (the s-side) in A's centred frame.
#[derive(Clone, Copy)]
pub struct Pairing<'a> {
    pub a: &'a Body,
    pub b: &'a Body,
    /// Places B's centred frame in A's.
    pub relative: Pose,
    /// Places A's centred frame in the world.
    pub frame: Pose,
    pub precision: Precision,
}

/// Buffer for the corners of a polygon.
pub type MovedOutline = [Points64; MAX_CORNERS / 4];

pub const EMPTY: MovedOutline = [[F64x4([0.0; 4]); 3]; MAX_CORNERS / 4];

/// Scratch memory of primitive distances, reused from pair to pair.
#[derive(Default)]
pub struct PrimitiveScratch {
    pub(super) buffer: PlacedBuffer,
    pub(super) distance: DistanceScratch,
}

/// The distance of two primitives, with what was computed on the way.
pub struct PairDistance {
    pub distance: f64,
    /// The nearest features, for polygons that do not cross.
    pub nearest: Option<NearestFeatures>,
    /// The full result, for other primitives.
    pub measured: Option<PrimitiveDistance>,
    /// How far the distance may exceed the true one, beyond the pair's error.
    pub doubt: f64,
}

/// The result for two primitives that are farther apart than the cutoff.
pub enum BeyondCutoff {
    /// Polygons with outlines; their nearest features, if these were computed.
    Outlines(Option<NearestFeatures>),
    /// Others; what proves it.
    Others(Beyond),
}

impl PairDistance {
    /// For primitives that meet.
    const NONE: Self = Self {
        distance: 0.0,
        nearest: None,
        measured: None,
        doubt: 0.0,
    };
}

/// A contact with its points and normal in the world.
#[derive(Clone, Copy, Debug)]
pub struct WorldContact {
    pub contact: Contact,
    pub points: [Vec3; 2],
    pub normal: Vec3,
}

impl<'a> Pairing<'a> {
    #[inline(always)]
    pub fn new(a: &'a Body, pose_a: &Pose, b: &'a Body, pose_b: &Pose) -> Self {
        let relative = relative_centered(pose_a, a.center(), pose_b, b.center());
        Self::seen([a, b], pose_a, relative)
    }

    /// The same of poses that are stored in any way, within code that is compiled for an instruction set.
    #[inline(always)]
    pub(crate) fn of<I: Instructions, P: Rows>(
        lanes: I,
        bodies: [&'a Body; 2],
        poses: [&P; 2],
    ) -> Self {
        let relative = relative_of(lanes, poses, bodies.map(Body::center));
        Self::seen(bodies, poses[0], relative)
    }

    /// Two bodies, given the pose of B's centred frame in that of A.
    #[inline(always)]
    fn seen([a, b]: [&'a Body; 2], pose_a: &impl Rows, relative: Pose) -> Self {
        let size = a.radius().max(relative.translation.norm() + b.radius());
        Self {
            a,
            b,
            relative,
            frame: centered(pose_a, a.center()),
            precision: Precision {
                size,
                error: tolerance::DISTANCE_ERROR * size + a.deviation() + b.deviation(),
                planar: a.dimension() == 2,
            },
        }
    }

    /// The same with A moved by `way`, in A's centred frame before it moved. Contacts are then in A's frame after it moved.
    pub fn shifted(&self, way: &Vec3) -> Self {
        let relative = Pose {
            translation: self.relative.translation - way,
            ..self.relative
        };
        let size = self
            .precision
            .size
            .max(relative.translation.norm() + self.b.radius());
        Self {
            relative,
            frame: Pose::identity(),
            precision: Precision {
                size,
                ..self.precision
            },
            ..*self
        }
    }

    /// How far both bodies together may be from what they stand for. No part of the error: distances are those of the bodies.
    pub fn stated_deviation(&self) -> f64 {
        self.a.stated_deviation() + self.b.stated_deviation()
    }

    /// The slack of a wrapper's bound, so that pruning is safe: the rounding of the bound, and the error of the distances on
    /// both sides of the comparison.
    pub fn slack(&self) -> f64 {
        tolerance::BOUND_ERROR * self.precision.size + 2.0 * self.precision.error
    }

    /// The places of the two primitives, if each body has exactly one.
    pub fn only_places(&self) -> Option<[u32; 2]> {
        Some([self.a.only_place()?, self.b.only_place()?])
    }

    /// Of a body with a single primitive, 0 for A and 1 for B, the point of the primitive's core that is nearest to the other body along
    /// a direction, which leads from there to it. Both are in the other body's frame. `None` where the body's box fits as closely, where the
    /// boxes do not leave out the radius around the core, and for support functions of the caller's.
    #[inline(never)]
    pub fn nearest_of_only(&self, body: usize, direction: &Vec3) -> Option<Vec3> {
        let of = [self.a, self.b][body];
        let (place, packed) = (of.only_place()?, of.packed());
        let entry = packed.primitives().entry(place as usize);
        let primitive = of.primitives().get(entry.primitive as usize);
        let only = PlacedPrimitive::at_home(primitive, packed.primitives().form(entry));
        let is_fitted = match only.shape.smooth() {
            Some(smooth) => matches!(smooth.kind, SmoothKind::Function(_)),
            None => only.vertex_count() <= 2 || cuboid(&only).is_some(),
        };
        if is_fitted || self.precision.planar || only.shape.radius() != packed.core_radius() {
            return None;
        }
        let to_other = match body {
            0 => self.relative.inverse(),
            _ => self.relative,
        };
        let towards = -turned_back(&to_other.rotation, direction);
        Some(to_other.transform_point(&Core::of(&only).support(&towards)))
    }

    /// Whether both primitives are polygons with outlines.
    pub fn are_outlines(&self, places: [u32; 2]) -> bool {
        let sides = [(self.a, places[0]), (self.b, places[1])];
        let corners = sides.map(|(body, place)| {
            let primitives = body.packed().primitives();
            primitives.entry(place as usize).corners
        });
        !self.precision.planar && corners.iter().all(|count| *count > 0)
    }

    /// A safe lower bound of the distance, from the bodies' bounding spheres.
    #[inline(always)]
    pub fn sphere_bound(&self) -> f64 {
        let (a, b) = (self.a.packed().whole(), self.b.packed().whole());
        a.ball().apart(&b.ball(), &self.relative) - self.slack()
    }

    /// The gap of A beyond B along a unit direction of the world: a safe lower bound of the distance where it is above 0.
    pub fn gap_along(&self, direction: &Vec3) -> f64 {
        let in_a = turned_back(&self.frame.rotation, direction);
        let nearest_a = self.a.farthest(&-in_a).point;
        let farthest_b = self
            .b
            .farthest(&turned_back(&self.relative.rotation, &in_a))
            .point;
        let gap = in_a.dot(&nearest_a) - in_a.dot(&self.relative.transform_point(&farthest_b));
        gap - self.precision.error
    }

    /// The distance of the primitives at two places, unless it is above `cutoff`: a pure function of the primitives and
    /// the relative pose. 0 where they touch to within the pair's error.
    pub fn distance(
        &self,
        places: [u32; 2],
        cutoff: f64,
        scratch: &mut PrimitiveScratch,
    ) -> Option<f64> {
        with_widest(DistanceOfPair {
            pairing: self,
            places,
            cutoff,
            scratch,
        })
    }

    #[inline(always)]
    pub fn outline_a<I: Instructions>(&self, lanes: I, place: u32) -> Option<Outline<'_, I>> {
        outline(lanes, self.a.packed().primitives(), place)
    }

    /// The outline of a primitive of B in A's frame, if it has one.
    #[inline(always)]
    pub fn outline_b<'b, I: Instructions>(
        &self,
        lanes: I,
        place: u32,
        buffer: &'b mut MovedOutline,
    ) -> Option<Outline<'b, I>> {
        let outline = outline(lanes, self.b.packed().primitives(), place)?;
        (!self.precision.planar).then(|| moved(&outline, &self.relative, buffer))
    }

    /// The same as `distance`, given the outline of B's primitive and a separating direction to try first.
    #[inline(always)]
    pub fn distance_to<I: Instructions>(
        &self,
        lanes: I,
        places: [u32; 2],
        outline_b: &Option<Outline<I>>,
        direction: &Vec3,
        limits: DistanceLimits,
        scratch: &mut PrimitiveScratch,
    ) -> std::result::Result<PairDistance, BeyondCutoff> {
        let outline_a = outline(lanes, self.a.packed().primitives(), places[0]);
        let found = match (&outline_a, outline_b) {
            (Some(a), Some(b)) => polygon_distance(a, b, limits.cutoff, self.precision.size),
            _ => PolygonDistance::Doubt,
        };
        let apart = match found {
            PolygonDistance::Beyond(nearest) => return Err(BeyondCutoff::Outlines(nearest)),
            PolygonDistance::Apart(distance, nearest) => PairDistance {
                distance: self.above_error(distance),
                nearest: Some(nearest),
                ..PairDistance::NONE
            },
            PolygonDistance::Cross => PairDistance::NONE,
            PolygonDistance::Doubt => {
                let measured = self.measured_apart(places, direction, limits, scratch);
                return measured.map_err(BeyondCutoff::Others);
            }
        };
        if apart.distance <= limits.cutoff {
            Ok(apart)
        } else {
            Err(BeyondCutoff::Outlines(apart.nearest))
        }
    }

    /// The same for primitives of which at least one has no outline. `direction`, a unit vector from B to A or zero, is first
    /// tried as a separating direction.
    pub fn measured_apart(
        &self,
        places: [u32; 2],
        direction: &Vec3,
        limits: DistanceLimits,
        scratch: &mut PrimitiveScratch,
    ) -> std::result::Result<PairDistance, Beyond> {
        let PrimitiveScratch { buffer, distance } = scratch;
        let [a, b] = &self.placed(places, buffer);
        let is_aimed = *direction != Vec3::zeros();
        if is_aimed && parts(a, b, direction, &self.precision, limits.cutoff) {
            return Err(Beyond::SOMEHOW);
        }
        if limits.enough >= 0.0
            && let Some(proved) = meeting_or_beyond(a, b, &self.precision, limits)
        {
            return match proved {
                Proved::Meet => Ok(PairDistance::NONE),
                Proved::Beyond { direction, lowest } => Err(Beyond::along(&direction, &lowest)),
            };
        }
        let measured = measure(a, b, &self.precision, limits, distance)?;
        let Closest {
            distance, doubt, ..
        } = measured.closest;
        let distance = self.above_error(distance);
        if distance - doubt > limits.cutoff {
            let [on_a, on_b] = measured.closest.points;
            let across = on_a - on_b;
            return Err(Beyond::along(&across, &across));
        }
        Ok(PairDistance {
            distance,
            nearest: None,
            measured: Some(measured),
            doubt,
        })
    }

    #[inline(always)]
    pub(super) fn above_error(&self, distance: f64) -> f64 {
        if distance <= self.precision.error {
            0.0
        } else {
            distance
        }
    }

    /// A primitive pair at a known distance, as visitors get it.
    pub fn primitive_pair(&self, places: [u32; 2], apart: f64) -> PrimitivePair<'static> {
        let [a, b] = [self.a, self.b].map(|body| body.packed().primitives());
        let primitives = [a.entry(places[0] as usize), b.entry(places[1] as usize)];
        PrimitivePair {
            primitives: primitives.map(|entry| entry.primitive),
            places,
            apart,
            error: self.precision.error,
            measured: None,
        }
    }

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

    /// The penetration of a primitive pair that meets, in the world. Fails for smooth primitives. The result is meaningless if
    /// the meter's limit is exceeded.
    pub fn world_penetration(
        &self,
        primitives: [u32; 2],
        meter: &mut WorkMeter,
    ) -> Result<Penetration> {
        let mut buffer = PlacedBuffer::default();
        let [a, b] = self.place(primitives, [None; 2], &mut buffer);
        let found = penetration(&a, &b, &self.precision, meter)?;
        Ok(Penetration {
            depth: found.depth,
            direction: self.frame.rotation * found.direction,
            points: found.points.map(|p| self.frame.transform_point(&p)),
        })
    }

    /// The primitives at two places in A's centred frame.
    #[inline(always)]
    pub fn placed<'b>(
        &'b self,
        places: [u32; 2],
        buffer: &'b mut PlacedBuffer,
    ) -> [PlacedPrimitive<'b>; 2] {
        let (a, b) = (self.a.packed().primitives(), self.b.packed().primitives());
        let (on_a, on_b) = (a.entry(places[0] as usize), b.entry(places[1] as usize));
        let forms = [a.form(on_a), b.form(on_b)];
        self.place([on_a.primitive, on_b.primitive], forms, buffer)
    }

    /// Both primitives in A's centred frame, with their forms if given.
    #[inline(always)]
    fn place<'b>(
        &'b self,
        primitives: [u32; 2],
        forms: [Option<&'b Form>; 2],
        buffer: &'b mut PlacedBuffer,
    ) -> [PlacedPrimitive<'b>; 2] {
        let a = self.a.primitives().get(primitives[0] as usize);
        let b = self.b.primitives().get(primitives[1] as usize);
        [
            PlacedPrimitive::at_home(a, forms[0]),
            buffer.place(b, forms[1], &self.relative),
        ]
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

struct DistanceOfPair<'a> {
    pairing: &'a Pairing<'a>,
    places: [u32; 2],
    cutoff: f64,
    scratch: &'a mut PrimitiveScratch,
}

impl Work for DistanceOfPair<'_> {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Option<f64> {
        let Self {
            pairing, places, ..
        } = self;
        let mut buffer = EMPTY;
        let b = pairing.outline_b(lanes, places[1], &mut buffer);
        let limits = DistanceLimits {
            cutoff: self.cutoff,
            ..DistanceLimits::EXACT
        };
        let apart = pairing.distance_to(lanes, places, &b, &Vec3::zeros(), limits, self.scratch);
        Some(apart.ok()?.distance)
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

#[inline(always)]
fn outline<I: Instructions>(
    lanes: I,
    primitives: &PackedPrimitives,
    place: u32,
) -> Option<Outline<'_, I>> {
    let entry = primitives.entry(place as usize);
    (entry.corners > 0).then(|| {
        let packed = primitives.outline(entry);
        Outline {
            lanes,
            blocks: packed.blocks,
            corners: entry.corners.into(),
            normal: packed.normal,
            offset: packed.offset,
        }
    })
}
