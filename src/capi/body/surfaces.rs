//! Curved surfaces that become triangles when they are added to a builder.

use crate::body::{BezierPatch, NurbsSurface};
use crate::capi::body::builder::{cstk_body_builder, with_builder};
use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{points, slice};
use crate::capi::status::status::cstk_status;

/// Adds a tensor product Bezier patch as triangles: it is halved until each cell is proved to be within `tolerance` of two triangles.
/// Queries halve cells further where they are asked to (cstk_query_set_refinement). The body states the deviation that is left (cstk_body_builder_set_deviation), so that all answers hold for
/// the patch itself; the tolerance, in your unit, decides how near the bounds of a distance are to each other.
///
/// `xyz` holds (degree_u + 1) x (degree_v + 1) control points of three doubles, row by row: those of one row have the same index in
/// u. `weights` holds one for each, all above 0, of a rational patch, or is NULL. All triangles have this tag. In 3-D
/// the patch is a surface; cstk_body_builder_set_solid does not count it among the faces of a boundary. Edges of a patch may be points.
///
/// Degrees are from 1 to 32; a weight is at least 1e-6 of the largest: CSTK_ERROR_INVALID_ARGUMENT otherwise. CSTK_ERROR_WRONG_SIZE for
/// another number of points. CSTK_ERROR_LIMIT where the tolerance asks for more than 2^18 cells; halving it takes about twice as many.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_bezier_patch(
    builder: *mut cstk_body_builder,
    degree_u: u32,
    degree_v: u32,
    xyz: *const f64,
    weights: *const f64,
    point_count: usize,
    tolerance: f64,
    tag: u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { points(xyz, point_count, "xyz")? };
            // SAFETY: as above.
            let weights = unsafe { optional_weights(weights, point_count)? };
            let patch = BezierPatch {
                degrees: [degree_u as usize, degree_v as usize],
                points,
                weights,
            };
            let index = builder.len();
            Ok(builder
                .add_bezier_patch(&patch, tolerance, tag)
                .map_err(|e| e.within(format_args!("patch (primitive {index})")))?)
        })
    })
}

/// Adds a NURBS surface as triangles: a tensor product B-spline surface, rational if it has weights. Knots are inserted until it is one
/// Bezier patch for each pair of knot spans that are not empty, and each patch is added as cstk_body_builder_add_bezier_patch does: what
/// that says of `tolerance`, the stated deviation, solids and tags holds here too. Patches are added in the order of their spans, those in
/// v running fastest.
///
/// `knots_u` has degree_u + 1 entries more than there are rows of control points, `knots_v` degree_v + 1 more than there are columns. No
/// knot is less than the one before it. Counted from 0, the surface lies between knots `degree` and `count - 1 - degree`. These need not
/// have full multiplicity: unclamped and periodic knots are as good as clamped ones. `control_points` holds `point_count` points of three
/// doubles, row by row: those of one row have the same index in u. `weights` holds one for each, all above 0, or is NULL for ones.
///
/// CSTK_ERROR_INVALID_ARGUMENT, with a message that names the knots or the weight: for degrees and weights as for a patch; for knots that
/// fall, are beyond 1e50, or are unequal but less than 2.3e-308 apart; if the surface has no extent; for a knot inside of it that is there
/// more often than its degree, where it would be torn; for any other that is there more often than its degree and once more.
/// CSTK_ERROR_WRONG_SIZE for another number of control points than the knots ask for. CSTK_ERROR_LIMIT for more than 2^18 patches, or
/// where the tolerance asks for more than 2^18 cells. Nothing is added then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_body_builder_add_nurbs_surface(
    builder: *mut cstk_body_builder,
    degree_u: u32,
    degree_v: u32,
    knots_u: *const f64,
    knot_count_u: usize,
    knots_v: *const f64,
    knot_count_v: usize,
    control_points: *const f64,
    point_count: usize,
    weights: *const f64,
    tolerance: f64,
    tag: u64,
) -> cstk_status {
    guard(|| {
        with_builder(builder, |builder| {
            // SAFETY: checked for NULL; the caller states the lengths.
            let knots = unsafe {
                [
                    slice(knots_u, knot_count_u, "knots_u")?,
                    slice(knots_v, knot_count_v, "knots_v")?,
                ]
            };
            // SAFETY: as above.
            let points = unsafe { points(control_points, point_count, "control_points")? };
            // SAFETY: as above.
            let weights = unsafe { optional_weights(weights, point_count)? };
            let surface = NurbsSurface {
                degrees: [degree_u as usize, degree_v as usize],
                knots,
                points,
                weights,
            };
            let index = builder.len();
            Ok(builder
                .add_nurbs_surface(&surface, tolerance, tag)
                .map_err(|e| e.within(format_args!("surface (primitive {index})")))?)
        })
    })
}

/// One weight for each control point, or none.
unsafe fn optional_weights<'a>(
    weights: *const f64,
    point_count: usize,
) -> Result<Option<&'a [f64]>, Failure> {
    if weights.is_null() {
        return Ok(None);
    }
    // SAFETY: as the caller states.
    Ok(Some(unsafe { slice(weights, point_count, "weights")? }))
}
