//! Paths made shorter by proofs.

use std::ffi::c_void;

use super::path::{cstk_path, cstk_path_result, size};
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{OptionsStruct, Output, options_or_default, slice, write_defaults};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::motion::{ShortcutOptions, ShortcutOutcome};

/// Options of cstk_path_shortcut. Write it with cstk_shortcut_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_shortcut_options {
    pub size: u32,
    pub cookie: u32,
    /// So many pairs of places on the path are tried, the first from end to end. Default 100.
    pub attempts: u64,
    /// The places are drawn with this seed: the same call has the same answer. Default 0.
    pub seed: u64,
    /// What comes at most this near counts as contact, as in cstk_motion_options: the path keeps farther than this. Default 0.
    pub threshold: f64,
}

// SAFETY: repr(C), two u32, two u64, a double: no padding.
unsafe impl OptionsStruct for cstk_shortcut_options {
    const COOKIE: u32 = 0x4353_0506;
    const NAME: &'static str = "cstk_shortcut_options";
    fn defaults() -> Self {
        let defaults = ShortcutOptions::default();
        Self {
            size: 0,
            cookie: 0,
            attempts: defaults.attempts as u64,
            seed: defaults.seed,
            threshold: defaults.threshold,
        }
    }
}

/// How the work on a path ended.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_shortcut_outcome {
    /// All attempts were made, or the path is straight.
    CSTK_SHORTCUT_DONE = 0,
    /// The limit of cstk_query_set_limit ended the attempts. The path is what was reached until then.
    CSTK_SHORTCUT_LIMITED = 1,
    /// The given path is not proved free: `given` says where. It is handed back as it was.
    CSTK_SHORTCUT_NOT_FREE = 2,
}

/// A path made shorter.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_shortcut_result {
    pub outcome: cstk_shortcut_outcome,
    pub reserved_word: u32,
    /// Unless the outcome is CSTK_SHORTCUT_NOT_FREE, cstk_motion proves each of its segments free.
    pub path: cstk_path,
    /// The lengths of the given path and of this one, which is never longer: sums of cstk_space_distance without weights.
    pub length_before: f64,
    pub length_after: f64,
    /// How many times the path was cut.
    pub cuts: u64,
    /// As cstk_motion_path tells it: the first segment of the given path that is not proved free, with some contact of it, or the last.
    /// Unlike there, no points are looked at before.
    pub given: cstk_path_result,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_shortcut_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_shortcut_options_default(
    out: *mut cstk_shortcut_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Makes a path shorter by straight motions that are proved free: for each attempt two places on the path are drawn, uniformly by
/// length, and what lies between them is replaced by the straight motion where that is shorter and proved free. Its ends
/// stay, to the last bit. The given path is proved first. All is done in the state that the environments are in at the call.
///
/// `points` has count * nq doubles, one configuration after the other; `count` is at least 1. `options` may be NULL for the defaults.
/// `progress` may be NULL; it is called before each segment of the given path and before each attempt, and `user` is passed to
/// it. The path of the answer belongs to the query context; it may be given to the next call.
///
/// The limit of cstk_query_set_limit counts for the whole call. An attempt costs a motion that any contact ends, and where
/// it succeeds two more. CSTK_ERROR_WRONG_SIZE if there is no point, or `nq` is not that of the space; errors name the point or the
/// segment. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_path_shortcut(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    points: *const f64,
    count: usize,
    nq: usize,
    options: *const cstk_shortcut_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut cstk_shortcut_result,
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
                    options_or_default(options, "options")?,
                )
            };
            let options = ShortcutOptions {
                attempts: usize::try_from(given.attempts).unwrap_or(usize::MAX),
                seed: given.seed,
                threshold: given.threshold,
            };
            let mut report = reporter(progress, user);
            let context = &mut state.context;
            let found = context.path_shortcut(&cobject, points, &options, &mut report)?;
            out.write(cstk_shortcut_result {
                outcome: match found.outcome {
                    ShortcutOutcome::Done => cstk_shortcut_outcome::CSTK_SHORTCUT_DONE,
                    ShortcutOutcome::Limited => cstk_shortcut_outcome::CSTK_SHORTCUT_LIMITED,
                    ShortcutOutcome::NotFree => cstk_shortcut_outcome::CSTK_SHORTCUT_NOT_FREE,
                },
                reserved_word: 0,
                path: state.keep_path(found.points, nq),
                length_before: found.lengths[0],
                length_after: found.lengths[1],
                cuts: found.cuts as u64,
                given: (&found.given).into(),
                reserved: [0; 8],
            });
            Ok(())
        })
    })
}
