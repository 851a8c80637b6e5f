//! Curves through C-space.

use super::motion::{ask_motion, cstk_motion_options, cstk_motion_result};
use super::path::size;
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::input::slice;
use crate::capi::query::cstk_query;
use crate::capi::status::status::cstk_status;
use crate::motion::Spline;

/// Proves that the motion on a Bezier curve keeps clear of a C-object, or finds its first contact, as cstk_motion does on a segment.
/// `points` has count * nq doubles, the control points, one configuration after the other; `count` is from 1 to 17. At time t each
/// coordinate is what de Casteljau's construction makes of its control values; coordinates on circles are not taken the shorter way
/// round. Coordinates of joints with quaternions must be the same in all control points: CSTK_ERROR_UNSUPPORTED otherwise.
/// `options`, `reached` and `out` as for cstk_motion. CSTK_ERROR_WRONG_SIZE if there is no point or `nq` is not that of the space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_curve(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    points: *const f64,
    count: usize,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            let numbers = size(asked.cobject, count, nq)?;
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { slice(points, numbers, "points")? };
            let context = asked.context;
            let answer = context.motion_on_curve(asked.cobject, points, &asked.options)?;
            let result = (&answer).into();
            Ok((answer.configuration, result))
        })
    })
}

/// The same on a B-spline of a degree from 1 to 16, with `count` control points, more than its degree, and `knot_count` knots that
/// never fall: count + degree + 1 of them. The parameter goes from the knot of number `degree` to that of number `count`; times of
/// the result go from 0 to 1 in proportion to it. What is before and behind is the caller's to leave out. A knot between the two
/// stands there at most `degree` times: with more the curve may jump, which is CSTK_ERROR_INVALID_ARGUMENT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_spline(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    degree: usize,
    knots: *const f64,
    knot_count: usize,
    points: *const f64,
    count: usize,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            let numbers = size(asked.cobject, count, nq)?;
            // SAFETY: checked for NULL; the caller states the lengths.
            let (points, knots) = unsafe {
                (
                    slice(points, numbers, "points")?,
                    slice(knots, knot_count, "knots")?,
                )
            };
            let spline = Spline {
                degree,
                knots,
                points,
            };
            let context = asked.context;
            let answer = context.motion_on_spline(asked.cobject, &spline, &asked.options)?;
            let result = (&answer).into();
            Ok((answer.configuration, result))
        })
    })
}
