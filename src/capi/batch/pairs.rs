//! Batches of pose pairs.

use std::ffi::c_void;

use super::arrays::{Entries, Outcome, Place, poses};
use super::batch::{cstk_batch, cstk_batch_options, cstk_batch_result, with_batch};
use super::configurations::{put, put_distance};
use crate::batch::{BatchJob, PosePairs};
use crate::body::Body;
use crate::capi::at_configuration::answers::cstk_distance_result;
use crate::capi::body::body::cstk_body;
use crate::capi::boundary::guard;
use crate::capi::handle;
use crate::capi::status::callbacks::cstk_progress_fn;
use crate::capi::status::status::cstk_status;

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
        with_batch(
            batch,
            options,
            progress,
            user,
            |batch, options, progress| {
                let a = handle::share::<Body>(body_a, "body_a")?;
                let b = handle::share::<Body>(body_b, "body_b")?;
                let pairs = PosePairs {
                    bodies: [&a, &b],
                    poses: [
                        poses(poses_a, count, "poses_a")?,
                        poses(poses_b, count, "poses_b")?,
                    ],
                };
                let within = Entries::checked(within, count, 1, "within")?;
                let (outcome, statuses) = Outcome::checked(statuses, count, out)?;
                outcome.require_apart(
                    &[
                        Place::of(pairs.poses[0], "poses_a"),
                        Place::of(pairs.poses[1], "poses_b"),
                    ],
                    [within.place("within")],
                )?;
                let job = BatchJob {
                    options,
                    slots: (within, statuses),
                    progress,
                };
                outcome.write(
                    batch.pair_within(pairs, threshold, job, |slots, item, within| {
                        put(slots, item, within, |within| within)
                    })?,
                )
            },
        )
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
        with_batch(
            batch,
            options,
            progress,
            user,
            |batch, options, progress| {
                let a = handle::share::<Body>(body_a, "body_a")?;
                let b = handle::share::<Body>(body_b, "body_b")?;
                let pairs = PosePairs {
                    bodies: [&a, &b],
                    poses: [
                        poses(poses_a, count, "poses_a")?,
                        poses(poses_b, count, "poses_b")?,
                    ],
                };
                let numbers = Entries::optional(distances, count, 1, "distances")?;
                let results = Entries::optional(results, count, 1, "results")?;
                let (outcome, statuses) = Outcome::checked(statuses, count, out)?;
                outcome.require_apart(
                    &[
                        Place::of(pairs.poses[0], "poses_a"),
                        Place::of(pairs.poses[1], "poses_b"),
                    ],
                    [numbers.place("distances"), results.place("results")],
                )?;
                let job = BatchJob {
                    options,
                    slots: (numbers, (results, statuses)),
                    progress,
                };
                outcome.write(batch.pair_distance(pairs, max_distance, job, put_distance)?)
            },
        )
    })
}
