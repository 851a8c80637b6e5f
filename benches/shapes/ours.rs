//! Our queries, through the C interface.

use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr::null_mut;

use cstk::capi::body::body::{cstk_body, cstk_body_release};
use cstk::capi::body::builder::*;
use cstk::capi::body::shapes::*;
use cstk::capi::pair::{cstk_pair_distance, cstk_pair_within, cstk_pair_witnesses};
use cstk::capi::query::{cstk_query, cstk_query_create, cstk_query_release};
use cstk::capi::status::status::cstk_status;
use cstk_scenes::Pose;

use super::placement::Placement;
use super::shape::{Kind, Shape};

/// Two bodies and a context that all queries of a row share.
pub struct Ours {
    query: *mut cstk_query,
    bodies: [*mut cstk_body; 2],
}

fn check(status: cstk_status) {
    assert_eq!(status, cstk_status::CSTK_OK);
}

/// What a function of the C interface writes.
fn written<T>(call: impl FnOnce(*mut T) -> cstk_status) -> T {
    let mut out = MaybeUninit::uninit();
    check(call(out.as_mut_ptr()));
    // SAFETY: a call that ends well has written its output.
    unsafe { out.assume_init() }
}

impl Ours {
    pub fn new(shapes: &[Shape; 2]) -> Self {
        Self {
            // SAFETY: the output is a pointer.
            query: written(|out| unsafe { cstk_query_create(out) }),
            bodies: [body(&shapes[0]), body(&shapes[1])],
        }
    }

    pub fn distance(&self, at: &Placement) -> f64 {
        let [a, b] = self.bodies;
        let ([p, q], far) = (at.pointers(), f64::INFINITY);
        // SAFETY: handles of ours, and poses of 12 numbers.
        written(|out| unsafe { cstk_pair_distance(self.query, a, p, b, q, far, out) }).distance
    }

    pub fn within(&self, at: &Placement, threshold: f64) -> bool {
        let [a, b] = self.bodies;
        let [p, q] = at.pointers();
        // SAFETY: as above.
        written(|out| unsafe { cstk_pair_within(self.query, a, p, b, q, threshold, out) })
    }

    /// How many pairs of primitives that meet are listed.
    pub fn witnesses(&self, at: &Placement, most: usize) -> usize {
        let [a, b] = self.bodies;
        let [p, q] = at.pointers();
        // SAFETY: as above.
        let list =
            written(|out| unsafe { cstk_pair_witnesses(self.query, a, p, b, q, 0.0, most, out) });
        list.witness_count
    }
}

impl Drop for Ours {
    fn drop(&mut self) {
        // SAFETY: the references are ours, and not used after this.
        unsafe {
            check(cstk_query_release(self.query));
            for body in self.bodies {
                check(cstk_body_release(body));
            }
        }
    }
}

/// A body of this shape alone.
fn body(shape: &Shape) -> *mut cstk_body {
    // SAFETY: all arrays have the lengths that are given, and live during the calls.
    unsafe {
        let builder = written(|out| cstk_body_builder_create(3, out));
        check(add(builder, shape));
        let (options, user) = (std::ptr::null(), null_mut::<c_void>());
        let body = written(|out| cstk_body_build(builder, options, None, user, out));
        check(cstk_body_builder_release(builder));
        body
    }
}

/// # Safety
///
/// The builder is one.
unsafe fn add(builder: *mut cstk_body_builder, shape: &Shape) -> cstk_status {
    let pose = Pose::identity().0;
    let pose = pose.as_ptr();
    // SAFETY: as in `body`.
    unsafe {
        match &shape.kind {
            Kind::Sphere { radius } => {
                cstk_body_builder_add_sphere(builder, [0.0; 3].as_ptr(), *radius, 0)
            }
            Kind::Capsule { radius, length } => {
                let ends = [[0.0, 0.0, -length / 2.0], [0.0, 0.0, length / 2.0]];
                let [low, high] = [ends[0].as_ptr(), ends[1].as_ptr()];
                cstk_body_builder_add_capsule(builder, low, high, *radius, 0)
            }
            Kind::Box { half } => cstk_body_builder_add_box(builder, pose, half.as_ptr(), 0),
            Kind::Cylinder { radius, length } => {
                cstk_body_builder_add_cylinder(builder, pose, *radius, length / 2.0, 0)
            }
            Kind::Cone { radius, length } => {
                cstk_body_builder_add_cone(builder, pose, *radius, *length, 0)
            }
            Kind::Ellipsoid { semi_axes } => {
                cstk_body_builder_add_ellipsoid(builder, pose, semi_axes.as_ptr(), 0)
            }
            Kind::Hull(hull) => {
                let points = &hull.vertices;
                cstk_body_builder_add_polyhedron(builder, points.as_ptr(), points.len() / 3, 0)
            }
            Kind::Mesh(mesh) => cstk_body_builder_add_mesh(
                builder,
                mesh.vertices.as_ptr(),
                mesh.vertices.len() / 3,
                std::ptr::null(),
                mesh.triangles.len() / 3,
                mesh.triangles.as_ptr(),
                mesh.triangles.len(),
                pose,
                [1.0; 3].as_ptr(),
            ),
            Kind::Cloud { points, radius } => {
                let points = &points.vertices;
                cstk_body_builder_add_points(builder, points.as_ptr(), points.len() / 3, *radius)
            }
        }
    }
}
