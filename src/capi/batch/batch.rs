//! The handle, the options and the result of batches.

use std::ffi::c_void;
use std::sync::Arc;

use super::call::Call;
use crate::batch::{Batch, BatchOptions};
use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{OptionsStruct, Output, options_or_default, write_defaults};
use crate::capi::query::cstk_query_statistics;
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::error::Error;
use crate::exclusive::Exclusive;

/// The caches and scratch memory of a batch's threads, kept from one call to the next: once warm, calls allocate a little for their
/// threads and nothing for their items. Items that do allocate are motions, gradients of pure sets and of custom joints, predicates,
/// balls of C-space, and contacts of what touches. A batch serves one call at a time; other calls meanwhile return CSTK_ERROR_BUSY.
/// Caches change how long answers take, never the answers.
pub struct cstk_batch {
    _opaque: [u8; 0],
}

/// How a batch is worked off. Write it with cstk_batch_options_default first. Answers depend on `limit` alone.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_batch_options {
    pub size: u32,
    pub cookie: u32,
    /// The number of threads, the caller's among them, at most 1024; 0, the default, for as many as the machine runs at once. Few
    /// items have fewer.
    pub threads: u32,
    /// Nonzero: the batch ends at its first hit, the one with the lowest number. All items before it are answered, those after it have
    /// the status CSTK_ERROR_CANCELLED. Default 0.
    pub stop_at_hit: u32,
    /// Limits the work of each item as cstk_query_set_limit does: an item that needs more has the status CSTK_ERROR_LIMIT (a motion
    /// the outcome CSTK_MOTION_UNDECIDED). Each item is then asked as by a new context, so that nothing depends on other items
    /// or threads; that takes longer. 0, the default, for no limit.
    pub limit: u64,
}

// SAFETY: repr(C), four u32, a u64: no padding.
unsafe impl OptionsStruct for cstk_batch_options {
    const COOKIE: u32 = 0x4353_0601;
    const NAME: &'static str = "cstk_batch_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            threads: 0,
            stop_at_hit: 0,
            limit: 0,
        }
    }
}

impl From<cstk_batch_options> for BatchOptions {
    fn from(given: cstk_batch_options) -> Self {
        Self {
            threads: given.threads,
            stop_at_hit: given.stop_at_hit != 0,
            limit: (given.limit > 0).then_some(given.limit),
        }
    }
}

/// How a batch ended; also written where its progress function cancels it, of the items until then.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_batch_result {
    /// How many items have the status CSTK_OK.
    pub answered: usize,
    /// How many have another, but for those that were not reached.
    pub failed: usize,
    /// The first of these, if `failed` is not 0. cstk_last_error_message() tells why it failed.
    pub first_failed: usize,
    /// The first hit, if `has_hit` is set.
    pub first_hit: usize,
    /// stop_at_hit was set, and there was a hit: of cstk_classify_batch CSTK_CLASS_INSIDE, of cstk_within_batch and
    /// cstk_pair_within_batch true, of distances 0, of motions any outcome but CSTK_MOTION_FREE.
    pub has_hit: bool,
    pub reserved_bytes: [u8; 7],
    /// The version of the environment that all items saw, the largest of several; 0 without an environment.
    pub environment_version: u64,
    pub reserved: [u64; 4],
}

pub(super) struct Batches(Exclusive<Batch>);

impl Noun for Batches {
    type Handle = cstk_batch;
    const KIND: u32 = 11;
    const NAME: &'static str = "cstk_batch";
}

/// The progress function of a call.
pub(super) type Report = dyn FnMut(f64) -> Result<(), Error>;

/// Runs a call with exclusive access to the batch, its options and its progress function.
pub(super) unsafe fn with_batch(
    batch: *mut cstk_batch,
    options: *const cstk_batch_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    action: impl FnOnce(Call) -> Result<(), Failure>,
) -> Result<(), Failure> {
    // Shared ownership: a callback may release the handle during the call.
    let batches = handle::share::<Batches>(batch, "batch")?;
    // SAFETY: checked for size and cookie.
    let options = unsafe { options_or_default(options, "options")? }.into();
    let renew = |batch: &mut Batch| *batch = Batch::new();
    batches.0.with("the batch", renew, |batch| {
        action(Call {
            batch,
            options: &options,
            progress: &mut reporter(progress, user),
        })
    })
}

/// Creates a batch, without threads: they come and go with each call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_batch_create(out: *mut *mut cstk_batch) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(Batches(Exclusive::default()))));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_batch_retain(batch: *mut cstk_batch) -> cstk_status {
    guard(|| handle::retain::<Batches>(batch, "batch"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_batch_release(batch: *mut cstk_batch) -> cstk_status {
    guard(|| handle::release::<Batches>(batch, "batch"))
}

/// Writes the default options. `size` is sizeof(cstk_batch_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_batch_options_default(
    out: *mut cstk_batch_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Writes the work done by all threads of the batch since it was created, or since the last call with `reset`; `reset` sets the counts
/// to 0. What the threads remember, and with it the work, may differ from run to run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_batch_get_statistics(
    batch: *mut cstk_batch,
    reset: bool,
    out: *mut cstk_query_statistics,
) -> cstk_status {
    guard(|| {
        let none = std::ptr::null();
        // SAFETY: there are no options and no progress function.
        unsafe {
            with_batch(
                batch,
                none,
                None,
                std::ptr::null_mut(),
                |Call { batch, .. }| {
                    let out = Output::checked(out, "out")?;
                    let done = batch.statistics();
                    if reset {
                        batch.reset_statistics();
                    }
                    out.write(done.into());
                    Ok(())
                },
            )
        }
    })
}
