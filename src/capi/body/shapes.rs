//! Predefined shapes, point clouds, height fields and support functions.

use std::ffi::c_void;
use std::sync::Arc;

use crate::body::{BodyBuilder, HeightField};
use crate::capi::body::builder::{cstk_body_builder, with_builder};
use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{array, points, pose, slice};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::CallerData;
use crate::error::{Error, ErrorKind};
use crate::pose::Vec3;
use crate::primitive::SupportFunction;

/// Writes to `point` (three doubles) a support point of a bounded convex set: one that is farthest along the unit vector
/// `direction` (three doubles). Returns CSTK_OK, or anything else for failure.
pub type cstk_support_fn =
    Option<unsafe extern "C" fn(direction: *const f64, point: *mut f64, user: *mut c_void) -> i32>;

/// Adds one primitive; error messages name its kind and its index.
fn run<A: FnOnce(&mut BodyBuilder) -> Result<(), Failure>>(
    builder: *mut cstk_body_builder,
    what: &str,
    action: A,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            let index = builder.len();
            action(builder).map_err(|failure| Failure {
                message: format!("{what} (primitive {index}): {}", failure.message),
                ..failure
            })
        })
    })
}

/// A point of three doubles.
unsafe fn point(xyz: *const f64, argument: &str) -> Result<Vec3, Failure> {
    // SAFETY: as the caller states.
    Ok(Vec3::from(*unsafe { array::<3>(xyz, argument)? }))
}

/// Adds a ball around `center` (three doubles); in the plane a disc. Exact to 1e-12 of the largest coordinate, as points
/// are. A radius of 0 gives a point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_sphere(
    builder: *mut cstk_body_builder,
    center: *const f64,
    radius: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "sphere", |builder| {
        // SAFETY: checked for NULL; the header states the length.
        let center = unsafe { point(center, "center")? };
        Ok(builder.add_sphere(&center, radius, tag)?)
    })
}

/// Adds all points within `radius` of the segment from `a` to `b` (three doubles each). Exact to 1e-12 of the largest
/// coordinate, as segments are. Along a face or another capsule it has several contacts, which span the common part.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_capsule(
    builder: *mut cstk_body_builder,
    a: *const f64,
    b: *const f64,
    radius: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "capsule", |builder| {
        // SAFETY: checked for NULL; the header states the lengths.
        let (a, b) = unsafe { (point(a, "a")?, point(b, "b")?) };
        Ok(builder.add_capsule(&a, &b, radius, tag)?)
    })
}

/// Adds the solid box with `half_extents` (three doubles, positive) around the origin of the frame at `pose`, along its
/// axes. It is a polyhedron, with the features and the exactness of one. Refused in the plane: use a polygon there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_box(
    builder: *mut cstk_body_builder,
    pose: *const f64,
    half_extents: *const f64,
    tag: u64,
) -> cstk_status {
    run(builder, "box", |builder| {
        // SAFETY: checked for NULL; the header states the lengths.
        let (pose, half) = unsafe {
            (
                self::pose(pose, "pose")?,
                point(half_extents, "half_extents")?,
            )
        };
        Ok(builder.add_box(&pose, &half, tag)?)
    })
}

/// Adds the solid cylinder around the z axis of the frame at `pose`, from -half_length to half_length. Its surface is
/// smooth: distances are iterated, usually until they are known to about 1e-15 of the largest coordinate, and to 1e-11 of its
/// diameter at worst. `lower` and `upper` of the result allow for that worst case on either side, for each smooth primitive of the
/// pair, and for more where the iteration ends before. The feature of its contacts is CSTK_FEATURE_SURFACE, which counts as a
/// point in contact modes, and there is only one contact, even where it stands or lies on a face. cstk_pair_penetration refuses it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_cylinder(
    builder: *mut cstk_body_builder,
    pose: *const f64,
    radius: f64,
    half_length: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "cylinder", |builder| {
        // SAFETY: checked for NULL; the header states the length.
        let pose = unsafe { self::pose(pose, "pose")? };
        Ok(builder.add_cylinder(&pose, radius, half_length, tag)?)
    })
}

/// Adds the solid cone around the z axis of the frame at `pose`: the base at z = -height / 2, the apex at z = height / 2.
/// Smooth: see cstk_body_builder_add_cylinder.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_cone(
    builder: *mut cstk_body_builder,
    pose: *const f64,
    radius: f64,
    height: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "cone", |builder| {
        // SAFETY: checked for NULL; the header states the length.
        let pose = unsafe { self::pose(pose, "pose")? };
        Ok(builder.add_cone(&pose, radius, height, tag)?)
    })
}

/// Adds the solid ellipsoid with `semi_axes` (three doubles, positive) around the origin of the frame at `pose`. Smooth:
/// see cstk_body_builder_add_cylinder.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_ellipsoid(
    builder: *mut cstk_body_builder,
    pose: *const f64,
    semi_axes: *const f64,
    tag: u64,
) -> cstk_status {
    run(builder, "ellipsoid", |builder| {
        // SAFETY: checked for NULL; the header states the lengths.
        let (pose, axes) = unsafe { (self::pose(pose, "pose")?, point(semi_axes, "semi_axes")?) };
        Ok(builder.add_ellipsoid(&pose, &axes, tag)?)
    })
}

/// Adds all points within `radius` of a convex polygon given as for cstk_body_builder_add_polygon. As exact as the polygon,
/// whose features its contacts have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_rounded_polygon(
    builder: *mut cstk_body_builder,
    xyz: *const f64,
    point_count: usize,
    radius: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "rounded polygon", |builder| {
        // SAFETY: checked for NULL; the caller states the length.
        let vertices = unsafe { points(xyz, point_count, "xyz")? };
        Ok(builder.add_rounded_polygon(vertices, radius, tag)?)
    })
}

/// Adds all points within `radius` of the convex hull of `point_count` points. As exact as the hull, whose features its
/// contacts have.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_rounded_polyhedron(
    builder: *mut cstk_body_builder,
    xyz: *const f64,
    point_count: usize,
    radius: f64,
    tag: u64,
) -> cstk_status {
    run(builder, "rounded polyhedron", |builder| {
        // SAFETY: checked for NULL; the caller states the length.
        let vertices = unsafe { points(xyz, point_count, "xyz")? };
        Ok(builder.add_rounded_polyhedron(vertices, radius, tag)?)
    })
}

/// Adds a point cloud: balls of one radius around `point_count` points of three doubles, tagged with their indices. A
/// radius of 0 gives points. Exact to 1e-12 of the largest coordinate. On failure the message names the point, and nothing
/// is added.
///
/// A body of points only builds in 1 to 2 microseconds a point, and takes less than 100 bytes a point: its points are split
/// top-down whatever the grouping, unless that is CSTK_GROUPING_BASIC. Its wrappers are computed when nodes of its
/// hierarchy are first inspected, which takes 10 to 30 microseconds and about 1 kB a point; queries do not need them. Mixed
/// with other primitives, points are built as those are, at up to 60 microseconds each: keep clouds in their own bodies.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_points(
    builder: *mut cstk_body_builder,
    xyz: *const f64,
    point_count: usize,
    radius: f64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { points(xyz, point_count, "xyz")? };
            Ok(builder.add_points(points, radius)?)
        })
    })
}

/// Adds a height field over the xy-plane: `nx` by `ny` nodes, at least two each way, `cell_x` and `cell_y` apart, the first
/// at the origin; `heights[j * nx + i]` is the z of node (i, j). Each cell is two triangles, split along the diagonal from
/// (i, j) to (i + 1, j + 1), both tagged with j * (nx - 1) + i. If `base` is NaN the field is a surface; otherwise it is
/// solid ground down to z = base, which must be below all heights, and each triangle becomes a prism. Exact to 1e-12 of the
/// largest coordinate. CSTK_ERROR_NOT_CONVERGED, with the cell, for a prism so steep that rounding leaves it no closed hull: its heights
/// differ by a million times its sides and more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_height_field(
    builder: *mut cstk_body_builder,
    nx: usize,
    ny: usize,
    heights: *const f64,
    cell_x: f64,
    cell_y: f64,
    base: f64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the length.
            let heights = unsafe { slice(heights, nx.saturating_mul(ny), "heights")? };
            Ok(builder.add_height_field(&HeightField {
                nodes: [nx, ny],
                heights,
                cell: [cell_x, cell_y],
                base: (!base.is_nan()).then_some(base),
            })?)
        })
    })
}

/// Adds the bounded convex set that the function `support` describes, in the frame in which the body is given. Smooth: see
/// cstk_body_builder_add_cylinder; its distances are as exact as the function's points.
///
/// The function is called from any thread that queries the body, concurrently, and from within queries. It must be pure,
/// must not throw, and must not call back into the running query. It is tested here along the axes and 300 other
/// directions: CSTK_ERROR_CALLBACK_FAILED if it fails, CSTK_ERROR_NOT_FINITE if it writes numbers that are not finite, or
/// none, CSTK_ERROR_NOT_CONVEX if two points contradict each other. A later failure does not fail the query: the set then
/// counts as the bounding box found here. So an answer of "free" of the set stays safe; what is larger for the box is not: upper bounds of
/// distances, depths, and "free" of the set's complement.
///
/// `destroy` may be NULL. It is called once with `user`, by the thread that drops the last reference to whatever uses the
/// function, and not if this call fails. Such a body cannot be saved.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_support(
    builder: *mut cstk_body_builder,
    support: cstk_support_fn,
    user: *mut c_void,
    destroy: cstk_destroy_fn,
    tag: u64,
) -> cstk_status {
    run(builder, "support function", |builder| {
        let function = Arc::new(Function {
            support: support.ok_or_else(|| {
                Failure::new(cstk_status::CSTK_ERROR_NULL_ARGUMENT, "support is NULL")
            })?,
            user: CallerData::new(user, destroy),
        });
        builder.add_support(function.clone(), tag)?;
        function.user.take_ownership();
        Ok(())
    })
}

/// The caller's function and its user data.
struct Function {
    support: unsafe extern "C" fn(*const f64, *mut f64, *mut c_void) -> i32,
    user: Arc<CallerData>,
}

impl SupportFunction for Function {
    fn support(&self, direction: &Vec3) -> Result<Vec3, Error> {
        let direction: [f64; 3] = (*direction).into();
        let mut point = [f64::NAN; 3];
        let user = self.user.address();
        // SAFETY: the header states the lengths, and asks that any thread may call, several at once.
        let status = unsafe { (self.support)(direction.as_ptr(), point.as_mut_ptr(), user) };
        if status != 0 {
            return Err(Error::new(
                ErrorKind::Callback,
                format!("the support function returned {status}"),
            ));
        }
        Ok(point.into())
    }
}
