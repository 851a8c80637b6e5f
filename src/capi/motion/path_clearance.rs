//! The least distance along a path.

use std::ffi::c_void;

use super::clearance::{cstk_clearance_options, cstk_clearance_result};
use super::path::size;
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, options, slice};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;

/// The least distance along a path.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_path_clearance_result {
    /// The number of the segment with the nearest place; segment i leads from point i to point i + 1. Where nothing is nearer than
    /// max_distance, any.
    pub segment: usize,
    /// The bounds are of the whole path; `time` and `distance` are those of the nearest place, in its segment.
    pub clearance: cstk_clearance_result,
    pub reserved: [u64; 4],
}

/// Finds the least distance from a C-object along a path: that of cstk_motion_clearance over all its segments, in the state that the
/// environments are in at the call. `points` has count * nq doubles, one configuration after the other; `count` is at least 1, and a
/// single point is a segment that rests. `clearance_options` are those of cstk_motion_clearance and must not be NULL. `nearest`
/// may be NULL, or receives the configuration at the nearest place, `nq` doubles. `progress` may be NULL; it is called before each
/// segment, and `user` is passed to it.
///
/// Segments whose points are near come first; of most others it is only proved that they are no nearer than what was found. So
/// it takes little longer than cstk_motion_path, but for the segments near the nearest place. A path that meets the C-object ends the
/// search: its contact is not always the first.
///
/// The limit of cstk_query_set_limit counts for the whole path. What it ends is CSTK_CLEARANCE_UNDECIDED, with a lower bound of 0, once
/// a first segment is known; CSTK_ERROR_LIMIT before. CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space;
/// errors name the point or the segment. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for
/// cstk_motion_clearance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_path_clearance(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    points: *const f64,
    count: usize,
    nq: usize,
    clearance_options: *const cstk_clearance_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    nearest: *mut f64,
    out: *mut cstk_path_clearance_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            let numbers = size(&cobject, count, nq)?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (points, given) = unsafe {
                (
                    slice(points, numbers, "points")?,
                    options(clearance_options, "clearance_options")?,
                )
            };
            let nearest = OutputSlice::optional(nearest, nq, "nearest")?;
            let mut report = reporter(progress, user);
            let context = &mut state.context;
            let found = context.path_clearance(&cobject, points, &given.into(), &mut report)?;
            nearest.write(&found.clearance.configuration);
            out.write(cstk_path_clearance_result {
                segment: found.segment,
                clearance: (&found.clearance).into(),
                reserved: [0; 4],
            });
            Ok(())
        })
    })
}
