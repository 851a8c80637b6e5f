//! Two bodies at two poses, brought into one frame.

use crate::body::Body;
use crate::convex::{Closest, Contact, DistanceScratch, PlacedBuffer, closest_points, contacts};
use crate::pose::{Pose, Vec3, relative_centered};

/// Bodies A (the r-side) and B (the s-side), seen from the centre of A.
pub struct Pairing<'a> {
    pub a: &'a Body,
    pub b: &'a Body,
    /// Places B's centred frame in A's.
    pub relative: Pose,
    /// Places A's centred frame in the world.
    pub frame: Pose,
    /// L: the largest coordinate of the pair, in A's centred frame.
    pub size: f64,
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
        Self {
            a,
            b,
            relative,
            frame: Pose {
                rotation: pose_a.rotation,
                translation: pose_a.transform_point(a.center()),
            },
            size: a.radius().max(relative.translation.norm() + b.radius()),
        }
    }

    fn is_planar(&self) -> bool {
        self.a.dimension() == 2
    }

    /// A lower bound of the distance, by the spheres around the bodies.
    pub fn sphere_bound(&self) -> f64 {
        let (wrapper_a, wrapper_b) = (&self.a.tree().wrappers[0], &self.b.tree().wrappers[0]);
        wrapper_a.sphere_bound(wrapper_b, &self.relative)
    }

    /// The closest points of one primitive pair: a pure function of the primitives and the relative pose.
    pub fn primitive_distance(
        &self,
        primitives: [u32; 2],
        buffers: &mut [PlacedBuffer; 2],
        scratch: &mut DistanceScratch,
    ) -> Closest {
        let [buffer_a, buffer_b] = buffers;
        let a = buffer_a.place(
            &self.a.primitives()[primitives[0] as usize],
            &Pose::identity(),
        );
        let b = buffer_b.place(&self.b.primitives()[primitives[1] as usize], &self.relative);
        closest_points(&a, &b, self.size, self.is_planar(), scratch)
    }

    /// The contacts of one primitive pair, in the world.
    pub fn world_contacts(&self, primitives: [u32; 2], closest: &Closest) -> Vec<WorldContact> {
        let mut buffers: [PlacedBuffer; 2] = Default::default();
        let [buffer_a, buffer_b] = &mut buffers;
        let a = buffer_a.place(
            &self.a.primitives()[primitives[0] as usize],
            &Pose::identity(),
        );
        let b = buffer_b.place(&self.b.primitives()[primitives[1] as usize], &self.relative);
        contacts(&a, &b, closest, self.size, self.is_planar())
            .into_iter()
            .map(|contact| WorldContact {
                points: contact.points.map(|p| self.frame.transform_point(&p)),
                normal: self.frame.rotation * contact.normal,
                contact,
            })
            .collect()
    }

    /// The closest points in the world.
    pub fn world_points(&self, closest: &Closest) -> [Vec3; 2] {
        closest.points.map(|p| self.frame.transform_point(&p))
    }
}
