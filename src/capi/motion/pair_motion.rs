//! Two bodies that move.

use super::motion::{cstk_motion_options, cstk_motion_result};
use crate::body::Body;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, options_or_default, pose};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::status::cstk_status;
use crate::motion::PairMotion;

/// Proves that two bodies that move keep farther apart than the threshold, or finds their first contact. From time 0 to 1 each body
/// goes from its start to its end on a screw: with constant velocity in its own frame, by the shortest rotation. A translation is a
/// straight line, and is followed exactly. Poses are 12 doubles, row-major [R | t], the body's frame in the world.
///
/// `options` are those of cstk_motion, and may be NULL. `reached` may be NULL, or receives the poses of both bodies at times[1], 24
/// doubles. `out` as for cstk_motion; a body inside a solid one is in contact, as for cstk_pair_within.
/// CSTK_ERROR_INVALID_ARGUMENT for bodies of different dimension.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_motion(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    start_a: *const f64,
    end_a: *const f64,
    body_b: *const cstk_body,
    start_b: *const f64,
    end_b: *const f64,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let a = handle::share::<Body>(body_a, "body_a")?;
            let b = handle::share::<Body>(body_b, "body_b")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the header states the lengths.
            let (poses_a, poses_b, options) = unsafe {
                (
                    [pose(start_a, "start_a")?, pose(end_a, "end_a")?],
                    [pose(start_b, "start_b")?, pose(end_b, "end_b")?],
                    options_or_default(options, "options")?,
                )
            };
            let reached = OutputSlice::optional(reached, 24, "reached")?;
            let [moving_a, moving_b] =
                [(&a, &poses_a), (&b, &poses_b)].map(|(body, poses)| PairMotion {
                    body,
                    poses: [&poses[0], &poses[1]],
                });
            let context = &mut state.context;
            let answer = context.pair_motion(&moving_a, &moving_b, &options.into())?;
            let rows = answer.configuration.map(|pose| pose.to_row_major());
            reached.write(&rows.concat());
            out.write((&answer).into());
            Ok(())
        })
    })
}
