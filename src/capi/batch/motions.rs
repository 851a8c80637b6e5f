//! Batches of motions.

use std::ffi::c_void;

use super::arrays::{Entries, Place};
use super::batch::{cstk_batch, cstk_batch_options, cstk_batch_result, with_batch};
use super::call::put;
use super::configurations::configurations;
use crate::batch::Segments;
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::options_or_default;
use crate::capi::motion::motion::{cstk_motion_options, cstk_motion_result};
use crate::capi::status::callbacks::cstk_progress_fn;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;

/// cstk_motion for `count` motions, number i from q0 + i * nq to q1 + i * nq: both have count * nq doubles. Of the segments of a path
/// with n points, `q1` is q0 + nq and `count` n - 1. `motion_options` are those of cstk_motion, and may be NULL for the defaults.
/// `reached` may be NULL, or receives count * nq doubles, the configurations at times[1]; unlike cstk_motion's it must be an array of
/// its own. `results` and `statuses` receive `count` entries each. All else as for cstk_classify_batch.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_batch(
    batch: *mut cstk_batch,
    cobject: *const cstk_cobject,
    q0: *const f64,
    q1: *const f64,
    count: usize,
    nq: usize,
    motion_options: *const cstk_motion_options,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    reached: *mut f64,
    results: *mut cstk_motion_result,
    statuses: *mut cstk_status,
    out: *mut cstk_batch_result,
) -> cstk_status {
    // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
    guard(|| unsafe {
        with_batch(batch, options, progress, user, |call| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let segments = Segments {
                starts: configurations(cobject.space(), q0, count, nq, "q0")?,
                ends: configurations(cobject.space(), q1, count, nq, "q1")?,
            };
            let asked = options_or_default(motion_options, "motion_options")?.into();
            let reached = Entries::optional(reached, count, nq, "reached")?;
            let results = Entries::<cstk_motion_result>::checked(results, count, 1, "results")?;
            let inputs = [
                Place::of(segments.starts.q, "q0"),
                Place::of(segments.ends.q, "q1"),
            ];
            call.ask(
                count,
                &inputs,
                (reached, results),
                (statuses, out),
                |batch, job| {
                    batch.motion(&cobject, segments, &asked, job, |slots, item, answer| {
                        put(slots, item, answer, |(reached, results), motion| {
                            reached.write(item, motion.configuration.iter().copied());
                            results.write(item, [(&motion).into()]);
                        })
                    })
                },
            )
        })
    })
}
