//! Two bodies at two poses, brought into one frame.

use super::visitor::PrimitivePair;
use crate::body::Body;
use crate::convex::{
    Core, MAX_CORNERS, Outline, PlacedBuffer, PlacedPrimitive, Precision, cuboid, moved,
};
use crate::gjk::Support;
use crate::hierarchy::packed::PackedPrimitives;
use crate::lanes::{F64x4, Instructions, Points64};
use crate::pose::{Pose, Rows, Vec3, turned_back};
use crate::primitive::{Form, Primitive};
use crate::relative_pose::{centered, relative_centered, relative_of};
use crate::tolerance;

/// Buffer for the corners of a polygon.
pub type MovedOutline = [Points64; MAX_CORNERS / 4];

pub const EMPTY: MovedOutline = [[F64x4([0.0; 4]); 3]; MAX_CORNERS / 4];

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
        let packed = of.packed();
        let (primitive, form) = at_place(of, of.only_place()?);
        let only = PlacedPrimitive::at_home(primitive, form);
        let is_fitted = match only.shape.smooth() {
            Some(_) => only.shape.is_function(),
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

    /// The primitives at two places in A's centred frame.
    #[inline(always)]
    pub fn placed<'b>(
        &'b self,
        places: [u32; 2],
        buffer: &'b mut PlacedBuffer,
    ) -> [PlacedPrimitive<'b>; 2] {
        let (a, form_a) = at_place(self.a, places[0]);
        let (b, form_b) = at_place(self.b, places[1]);
        [
            PlacedPrimitive::at_home(a, form_a),
            buffer.place(b, form_b, &self.relative),
        ]
    }

    /// Both primitives in A's centred frame, with their forms if given.
    #[inline(always)]
    pub(super) fn place<'b>(
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

    /// The only primitive of A, which is a single leaf.
    #[inline(always)]
    pub(super) fn only_a(&self) -> PlacedPrimitive<'_> {
        let (only, form) = at_place(self.a, 0);
        PlacedPrimitive::at_home(only, form)
    }

    /// The only primitive of B, which is a single leaf, in A's centred frame.
    #[inline(always)]
    pub(super) fn only_b<'b>(&'b self, buffer: &'b mut PlacedBuffer) -> PlacedPrimitive<'b> {
        let (only, form) = at_place(self.b, 0);
        buffer.place(only, form, &self.relative)
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

    #[inline(always)]
    pub(super) fn above_error(&self, distance: f64) -> f64 {
        if distance <= self.precision.error {
            0.0
        } else {
            distance
        }
    }
}

/// The primitive at a place of a body's packed tree, with its form if it has one.
#[inline(always)]
fn at_place(body: &Body, place: u32) -> (Primitive<'_>, Option<&Form>) {
    let packed = body.packed().primitives();
    let entry = packed.entry(place as usize);
    let primitive = body.primitives().get(entry.primitive as usize);
    (primitive, packed.form(entry))
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
