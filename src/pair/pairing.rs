//! Two bodies at two poses, brought into one frame.

use crate::body::Body;
use crate::convex::{
    Closest, Contact, DistanceScratch, Placed, PlacedBuffer, Precision, closest_points, contacts,
};
use crate::pose::{Pose, Vec3, relative_centered};
use crate::tolerance;

/// Bodies A (the r-side) and B (the s-side), seen from the centre of A.
pub struct Pairing<'a> {
    pub a: &'a Body,
    pub b: &'a Body,
    /// Places B's centred frame in A's.
    pub relative: Pose,
    /// Places A's centred frame in the world.
    pub frame: Pose,
    pub precision: Precision,
}

/// A contact with its points and normal in the world.
#[derive(Clone, Copy, Debug)]
pub struct WorldContact {
    pub contact: Contact,
    pub points: [Vec3; 2],
    pub normal: Vec3,
}

impl<'a> Pairing<'a> {
    pub fn new(a: &'a Body, pose_a: &Pose, b: &'a Body, pose_b: &Pose) -> Self {
        let relative = relative_centered(pose_a, a.center(), pose_b, b.center());
        let size = a.radius().max(relative.translation.norm() + b.radius());
        Self {
            a,
            b,
            relative,
            frame: Pose {
                rotation: pose_a.rotation,
                translation: pose_a.transform_point(a.center()),
            },
            precision: Precision {
                size,
                error: tolerance::DISTANCE_ERROR * size + a.deviation() + b.deviation(),
                planar: a.dimension() == 2,
            },
        }
    }

    /// What a wrapper's bound must be lowered by so that nothing it excludes could have mattered: the rounding of the bound,
    /// and the error of the distances on both sides of the comparison.
    pub fn slack(&self) -> f64 {
        tolerance::BOUND_ERROR * self.precision.size + 2.0 * self.precision.error
    }

    /// A safe lower bound of the distance, by the spheres around the bodies.
    pub fn sphere_bound(&self) -> f64 {
        let (wrapper_a, wrapper_b) = (self.a.tree().wrapper(0), self.b.tree().wrapper(0));
        wrapper_a.sphere_bound(&wrapper_b, &self.relative) - self.slack()
    }

    /// The closest points of one primitive pair: a pure function of the primitives and the relative pose.
    pub fn primitive_distance(
        &self,
        primitives: [u32; 2],
        buffers: &mut [PlacedBuffer; 2],
        scratch: &mut DistanceScratch,
    ) -> Closest {
        let [a, b] = self.place(primitives, buffers);
        closest_points(&a, &b, &self.precision, scratch)
    }

    /// The contacts of one primitive pair, in the world.
    pub fn world_contacts(&self, primitives: [u32; 2], closest: &Closest) -> Vec<WorldContact> {
        let mut buffers: [PlacedBuffer; 2] = Default::default();
        let [a, b] = self.place(primitives, &mut buffers);
        contacts(&a, &b, closest, &self.precision)
            .into_iter()
            .map(|contact| WorldContact {
                points: contact.points.map(|p| self.frame.transform_point(&p)),
                normal: self.frame.rotation * contact.normal,
                contact,
            })
            .collect()
    }

    /// Both primitives in A's centred frame.
    fn place<'b>(
        &'b self,
        primitives: [u32; 2],
        buffers: &'b mut [PlacedBuffer; 2],
    ) -> [Placed<'b>; 2] {
        let [buffer_a, buffer_b] = buffers;
        let a = &self.a.primitives()[primitives[0] as usize];
        let b = &self.b.primitives()[primitives[1] as usize];
        [
            buffer_a.place(a, &Pose::identity()),
            buffer_b.place(b, &self.relative),
        ]
    }

    /// The closest points in the world.
    pub fn world_points(&self, closest: &Closest) -> [Vec3; 2] {
        closest.points.map(|p| self.frame.transform_point(&p))
    }
}
