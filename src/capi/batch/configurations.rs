//! Batches of configurations.

use std::ffi::c_void;

use super::arrays::{Entries, Place};
use super::batch::{cstk_batch, cstk_batch_options, cstk_batch_result, with_batch};
use super::call::put;
use crate::batch::Configurations;
use crate::capi::at_configuration::answers::{cstk_class, cstk_distance_result};
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{numbers, require_width};
use crate::capi::status::callbacks::cstk_progress_fn;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind};
use crate::query::Distance;
use crate::space::Space;

/// The configurations of a call, checked but for their numbers.
pub(super) unsafe fn configurations<'a>(
    space: &Space,
    q: *const f64,
    count: usize,
    nq: usize,
    argument: &str,
) -> Result<Configurations<'a>, Failure> {
    require_width(nq, space.nq(), "nq", "coordinates")?;
    // SAFETY: as the caller states.
    let q = unsafe { numbers(q, count, nq, argument)? };
    Ok(Configurations { q, count })
}

/// cstk_classify for `count` configurations: `q` has count * nq doubles, one configuration after the other. `options` may be NULL for
/// the defaults. `progress` may be NULL; it is called on this thread, with the part of the items that is done, and `user` is passed to
/// it. `classes` and `statuses` receive `count` entries each, in order. A count of 0 is a batch without items; its arrays may be NULL.
/// Configurations that lie near each other in the order of `q`, those of a path say, are answered in less time.
///
/// CSTK_ERROR_WRONG_SIZE if `nq` is not that of the space, or count * nq too large; CSTK_ERROR_CANCELLED where `progress` says so.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_classify_batch(
    batch: *mut cstk_batch,
    cobject: *const cstk_cobject,
    q: *const f64,
    count: usize,
    nq: usize,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    classes: *mut cstk_class,
    statuses: *mut cstk_status,
    out: *mut cstk_batch_result,
) -> cstk_status {
    // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
    guard(|| unsafe {
        with_batch(batch, options, progress, user, |call| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let at = configurations(cobject.space(), q, count, nq, "q")?;
            let classes = Entries::checked(classes, count, 1, "classes")?;
            call.ask(
                count,
                &[Place::of(at.q, "q")],
                classes,
                (statuses, out),
                |batch, job| {
                    batch.classify(&cobject, at, job, |slots, item, class| {
                        put(slots, item, class, |classes, class| {
                            classes.write(item, [cstk_class::from(class)])
                        })
                    })
                },
            )
        })
    })
}

/// cstk_within for `count` configurations; `within` and `statuses` receive `count` entries each. All else as for cstk_classify_batch.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_within_batch(
    batch: *mut cstk_batch,
    cobject: *const cstk_cobject,
    q: *const f64,
    count: usize,
    nq: usize,
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
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let at = configurations(cobject.space(), q, count, nq, "q")?;
            let within = Entries::checked(within, count, 1, "within")?;
            call.ask(
                count,
                &[Place::of(at.q, "q")],
                within,
                (statuses, out),
                |batch, job| {
                    batch.within(&cobject, at, threshold, job, |slots, item, answer| {
                        put(slots, item, answer, |within, answer| {
                            within.write(item, [answer])
                        })
                    })
                },
            )
        })
    })
}

/// Where distances go: the number alone, and all that cstk_distance tells.
pub(super) type DistanceOutputs<'a> = (Entries<'a, f64>, Entries<'a, cstk_distance_result>);

/// Writes a distance where it is wanted.
pub(super) fn write_distance(
    (numbers, results): &mut DistanceOutputs,
    item: usize,
    distance: &Distance,
) {
    numbers.write(item, [distance.distance]);
    if !results.is_absent() {
        results.write(item, [distance.into()]);
    }
}

/// cstk_distance for `count` configurations. `distances` and `results` receive `count` entries each: the field `distance`, and the whole
/// answer. `gradients` receives count * nv doubles, nv being the number of the space's velocities: row i is the gradient of
/// results[i].contact, as cstk_gradients has it for the nearest pair with CSTK_CONTACTS_NEAREST, and 0 where has_contact is false.
/// What is not wanted may be NULL, `nv` then 0 without gradients. All else as for cstk_classify_batch.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_distance_batch(
    batch: *mut cstk_batch,
    cobject: *const cstk_cobject,
    q: *const f64,
    count: usize,
    nq: usize,
    max_distance: f64,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    distances: *mut f64,
    results: *mut cstk_distance_result,
    gradients: *mut f64,
    nv: usize,
    statuses: *mut cstk_status,
    out: *mut cstk_batch_result,
) -> cstk_status {
    // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
    guard(|| unsafe {
        with_batch(batch, options, progress, user, |call| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let at = configurations(cobject.space(), q, count, nq, "q")?;
            let numbers = Entries::optional(distances, count, 1, "distances")?;
            let results = Entries::optional(results, count, 1, "results")?;
            let rows = gradient_rows(cobject.space(), gradients, count, nv)?;
            let (inputs, distances) = ([Place::of(at.q, "q")], (numbers, results));
            if rows.is_absent() {
                return call.ask(count, &inputs, distances, (statuses, out), |batch, job| {
                    batch.distance(&cobject, at, max_distance, job, |slots, item, answer| {
                        put(slots, item, answer, |distances, distance| {
                            write_distance(distances, item, &distance)
                        })
                    })
                });
            }
            call.ask(
                count,
                &inputs,
                (distances, rows),
                (statuses, out),
                |batch, job| {
                    batch.distance_with_gradient(
                        &cobject,
                        at,
                        max_distance,
                        job,
                        |slots, item, answer| {
                            put(slots, item, answer, |(distances, rows), (distance, row)| {
                                rows.write(item, row.iter().copied().chain(std::iter::repeat(0.0)));
                                write_distance(distances, item, &distance)
                            })
                        },
                    )
                },
            )
        })
    })
}

/// The gradients, if they are wanted.
unsafe fn gradient_rows<'a>(
    space: &Space,
    gradients: *mut f64,
    count: usize,
    nv: usize,
) -> Result<Entries<'a, f64>, Failure> {
    // The array of a batch without items may be NULL.
    if !gradients.is_null() || (count == 0 && nv != 0) {
        require_width(nv, space.nv(), "nv", "velocities")?;
    } else if nv != 0 {
        let message = format!("nv must be 0 without gradients, not {nv}");
        return Err(Error::new(ErrorKind::WrongSize, message).into());
    }
    // SAFETY: as the caller states.
    unsafe { Entries::optional(gradients, count, nv, "gradients") }
}
