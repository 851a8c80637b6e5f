//! The least distance along a motion.

use crate::capi::at_configuration::answers::cstk_distance_result;
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{OptionsStruct, Output, OutputSlice, options, slice, write_defaults};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::motion::{ClearanceOptions, ClearanceOutcome, MotionClearance};

/// Options of a clearance. Write it with cstk_clearance_options_default first, then set `tolerance`. Distances are lengths, or in
/// units of C-space for pure sets without a scale.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_clearance_options {
    pub size: u32,
    pub cookie: u32,
    /// The bounds come out at most this far apart: a distance, finite. Must be set, larger than 0. Where the motion is smooth
    /// at its nearest place, the work grows with the inverse square root of the tolerance.
    pub tolerance: f64,
    /// Or at most this part of the upper bound apart, if that is more: at least 0, less than 1. Default 0.
    pub relative_tolerance: f64,
    /// A clearance above this is only known to be so, in less time: a distance, at least 0. Default INFINITY.
    pub max_distance: f64,
}

// SAFETY: repr(C), two u32, three doubles: no padding.
unsafe impl OptionsStruct for cstk_clearance_options {
    const COOKIE: u32 = 0x4353_0503;
    const NAME: &'static str = "cstk_clearance_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            tolerance: 0.0,
            relative_tolerance: 0.0,
            max_distance: f64::INFINITY,
        }
    }
}

/// What is known of a clearance. The bounds hold whatever the outcome.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_clearance_outcome {
    /// The motion is proved free, as cstk_motion says it, and the bounds are within the tolerance; of bodies with a deviation (see
    /// cstk_body_builder_set_deviation) farther apart by what it leaves open.
    CSTK_CLEARANCE_KNOWN = 0,
    /// There is contact at `time`, not always the first: `lower` is 0, and `upper` 0 or what rounding leaves.
    CSTK_CLEARANCE_HIT = 1,
    /// Proved: at every time the distance is larger than max_distance, which is `lower`.
    CSTK_CLEARANCE_BEYOND_MAX = 2,
    /// The C-object is empty: there is nothing to hit, and both bounds are infinite.
    CSTK_CLEARANCE_EMPTY = 3,
    /// Rounding does not let the bounds come within the tolerance; if `lower` is 0, it may decide whether the motion is free.
    CSTK_CLEARANCE_NEAR = 4,
    /// The limit of cstk_query_set_limit ended the work. (Where the distance at q0 already needs more, the call ends with
    /// CSTK_ERROR_LIMIT.)
    CSTK_CLEARANCE_UNDECIDED = 5,
}

/// The least distance along a motion.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_clearance_result {
    pub outcome: cstk_clearance_outcome,
    pub reserved_word: u32,
    /// Proved: no distance on the motion is smaller.
    pub lower: f64,
    /// The distance at `time` is no larger; infinite if only a lower bound is known.
    pub upper: f64,
    /// Where the nearest place was found, from 0 to 1. Of several within the tolerance it is any.
    pub time: f64,
    /// The distance at `time`, with witness and contact.
    pub distance: cstk_distance_result,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_clearance_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_clearance_options_default(
    out: *mut cstk_clearance_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Finds the least distance from a C-object along the motion from q0 to q1, that of cstk_motion: two bounds, the lower one proved for
/// every time, the upper one the distance at a time of the motion. Distances are those of cstk_distance, less the margins of the
/// C-object. It takes a few times as long as cstk_motion, for small tolerances longer.
///
/// `q0` and `q1` have `nq` doubles; `clearance_options` must not be NULL; `nearest` may be NULL, or receives the configuration at
/// `time`, `nq` doubles, and may be q0 or q1. CSTK_ERROR_UNSUPPORTED as for cstk_motion, for C-objects that hold an intersection or a
/// complement, from which no exact distance is known, and for pure sets without a scale among
/// induced ones.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_clearance(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    clearance_options: *const cstk_clearance_options,
    nearest: *mut f64,
    out: *mut cstk_clearance_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (q0, q1, given) = unsafe {
                (
                    slice(q0, nq, "q0")?,
                    slice(q1, nq, "q1")?,
                    options(clearance_options, "clearance_options")?,
                )
            };
            let nearest = OutputSlice::optional(nearest, nq, "nearest")?;
            let context = &mut state.context;
            let found = context.motion_clearance(&cobject, q0, q1, &given.into())?;
            nearest.write(&found.configuration);
            out.write((&found).into());
            Ok(())
        })
    })
}

impl From<cstk_clearance_options> for ClearanceOptions {
    fn from(given: cstk_clearance_options) -> Self {
        Self {
            tolerance: given.tolerance,
            relative_tolerance: given.relative_tolerance,
            max_distance: given.max_distance,
        }
    }
}

impl From<&MotionClearance> for cstk_clearance_result {
    fn from(found: &MotionClearance) -> Self {
        Self {
            outcome: found.outcome.into(),
            reserved_word: 0,
            lower: found.lower,
            upper: found.upper,
            time: found.time,
            distance: (&found.distance).into(),
            reserved: [0; 8],
        }
    }
}

impl From<ClearanceOutcome> for cstk_clearance_outcome {
    fn from(outcome: ClearanceOutcome) -> Self {
        match outcome {
            ClearanceOutcome::Known => Self::CSTK_CLEARANCE_KNOWN,
            ClearanceOutcome::Hit => Self::CSTK_CLEARANCE_HIT,
            ClearanceOutcome::BeyondMax => Self::CSTK_CLEARANCE_BEYOND_MAX,
            ClearanceOutcome::Empty => Self::CSTK_CLEARANCE_EMPTY,
            ClearanceOutcome::Near => Self::CSTK_CLEARANCE_NEAR,
            ClearanceOutcome::Undecided => Self::CSTK_CLEARANCE_UNDECIDED,
        }
    }
}
