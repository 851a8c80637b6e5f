//! Batches of pose pairs.

use std::ffi::c_void;

use super::arrays::{Entries, Place, poses};
use super::batch::{cstk_batch, cstk_batch_options, cstk_batch_result, with_batch};
use super::call::put;
use super::configurations::write_distance;
use crate::batch::PosePairs;
use crate::body::Body;
use crate::capi::at_configuration::answers::cstk_distance_result;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::status::callbacks::cstk_progress_fn;
use crate::capi::status::status::cstk_status;

/// Two bodies at the poses of a call, whose numbers are not yet checked.
unsafe fn pose_pairs<'a>(
    bodies: [&'a Body; 2],
    [poses_a, poses_b]: [*const f64; 2],
    count: usize,
) -> Result<PosePairs<'a>, Failure> {
    // SAFETY: as the caller states.
    let poses = unsafe {
        [
            poses(poses_a, count, "poses_a")?,
            poses(poses_b, count, "poses_b")?,
        ]
    };
    Ok(PosePairs { bodies, poses })
}

fn places(pairs: &PosePairs) -> [Place; 2] {
    let [a, b] = pairs.poses;
    [Place::of(a, "poses_a"), Place::of(b, "poses_b")]
}

/// cstk_pair_within for `count` pairs of poses: `poses_a` and `poses_b` have 12 * count doubles each. With threshold 0, whether the bodies
/// meet. `within` and `statuses` receive `count` entries each. A pose that is none fails its own item alone. All else as for
/// cstk_classify_batch.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_within_batch(
    batch: *mut cstk_batch,
    body_a: *const cstk_body,
    poses_a: *const f64,
    body_b: *const cstk_body,
    poses_b: *const f64,
    count: usize,
    threshold: f64,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    within: *mut bool,
    statuses: *mut cstk_status,
    out: *mut cstk_batch_result,
) -> cstk_status {
    // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
    guard(|| unsafe {
        with_batch(batch, options, progress, user, |call| {
            let a = handle::share::<Body>(body_a, "body_a")?;
            let b = handle::share::<Body>(body_b, "body_b")?;
            let pairs = pose_pairs([&a, &b], [poses_a, poses_b], count)?;
            let within = Entries::checked(within, count, 1, "within")?;
            call.ask(
                count,
                &places(&pairs),
                within,
                (statuses, out),
                |batch, job| {
                    batch.pair_within(pairs, threshold, job, |slots, item, answer| {
                        put(slots, item, answer, |within, answer| {
                            within.write(item, [answer])
                        })
                    })
                },
            )
        })
    })
}

/// cstk_pair_distance for `count` pairs of poses: `poses_a` and `poses_b` have 12 * count doubles each. `distances` and `results` receive
/// `count` entries each, the field `distance` and the whole answer; what is not wanted may be NULL. All else as for
/// cstk_pair_within_batch.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_distance_batch(
    batch: *mut cstk_batch,
    body_a: *const cstk_body,
    poses_a: *const f64,
    body_b: *const cstk_body,
    poses_b: *const f64,
    count: usize,
    max_distance: f64,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    distances: *mut f64,
    results: *mut cstk_distance_result,
    statuses: *mut cstk_status,
    out: *mut cstk_batch_result,
) -> cstk_status {
    // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
    guard(|| unsafe {
        with_batch(batch, options, progress, user, |call| {
            let a = handle::share::<Body>(body_a, "body_a")?;
            let b = handle::share::<Body>(body_b, "body_b")?;
            let pairs = pose_pairs([&a, &b], [poses_a, poses_b], count)?;
            let numbers = Entries::optional(distances, count, 1, "distances")?;
            let results = Entries::optional(results, count, 1, "results")?;
            call.ask(
                count,
                &places(&pairs),
                (numbers, results),
                (statuses, out),
                |batch, job| {
                    batch.pair_distance(pairs, max_distance, job, |slots, item, answer| {
                        put(slots, item, answer, |distances, distance| {
                            write_distance(distances, item, &distance)
                        })
                    })
                },
            )
        })
    })
}
