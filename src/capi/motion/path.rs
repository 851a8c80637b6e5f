//! Paths of several segments.

use std::ffi::c_void;

use super::motion::{ask_motion, cstk_motion_options, cstk_motion_result};
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::input::{require_width, slice};
use crate::capi::query::cstk_query;
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind};
use crate::motion::PathAnswer;

/// A path: configurations one after the other, with straight motions between them. The array belongs to the query context and stays
/// valid until its next call or its release; that call may take it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_path {
    /// count * nq doubles; NULL if there are none, as in a space without coordinates, which has one configuration.
    pub points: *const f64,
    pub count: usize,
    pub nq: usize,
    pub reserved: [u64; 3],
}

/// What was found of a path.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_path_result {
    /// The number of the segment that `motion` is about; segment i leads from point i to point i + 1. It is the first that is not
    /// free, or the one with the contact if any contact was asked for; the last segment of a path that is free.
    pub segment: usize,
    /// The answer of that segment, with times from 0 to 1 within it.
    pub motion: cstk_motion_result,
    pub reserved: [u64; 4],
}

/// Proves that a path keeps clear of a C-object, or finds its first contact: cstk_motion for each of its segments in turn, all in
/// the state that the environments are in at the call. `points` has point_count * nq doubles, one configuration after the other;
/// `point_count` is at least 1, and a single point is a segment that rests. `options` are those of cstk_motion, and may be NULL for the
/// defaults; their tolerance is of each segment's time. `progress` may be NULL; it is called before each segment, and `user` is
/// passed to it. `reached` may be NULL, or receives the configuration at motion.times[1] of the segment, `nq` doubles.
///
/// Unless the outcome is a hit and any_contact was set, all segments before the one of the answer are proved free. With
/// any_contact, the points and the middles of the segments are looked at first, so that most contacts are found in a fraction of the
/// time of a proof.
///
/// The limit of cstk_query_set_limit counts for the whole path. What it ends is CSTK_MOTION_UNDECIDED, never CSTK_ERROR_LIMIT.
/// CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space; errors name the point or the segment.
/// CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_path(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    points: *const f64,
    point_count: usize,
    nq: usize,
    options: *const cstk_motion_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    reached: *mut f64,
    out: *mut cstk_path_result,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            let numbers = size(asked.cobject, point_count, nq)?;
            // SAFETY: checked for NULL; the caller states the length.
            let points = unsafe { slice(points, numbers, "points")? };
            let mut report = reporter(progress, user);
            let context = asked.context;
            let answer = context.motion_path(asked.cobject, points, &asked.options, &mut report)?;
            let result = (&answer).into();
            Ok((answer.motion.configuration, result))
        })
    })
}

impl From<&PathAnswer> for cstk_path_result {
    fn from(answer: &PathAnswer) -> Self {
        Self {
            segment: answer.segment,
            motion: (&answer.motion).into(),
            reserved: [0; 4],
        }
    }
}

/// How many numbers the points have.
pub(in crate::capi) fn size(cobject: &CObject, count: usize, nq: usize) -> Result<usize, Failure> {
    require_width(nq, cobject.space().nq(), "nq", "coordinates")?;
    let wrong = |message: String| Err(Error::new(ErrorKind::WrongSize, message).into());
    if count == 0 {
        return wrong("count is 0: there is at least one point".to_string());
    }
    match count.checked_mul(nq) {
        Some(numbers) => Ok(numbers),
        None => wrong(format!("points cannot have {count} times {nq} entries")),
    }
}
