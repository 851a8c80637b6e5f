//! One motion: proved free, or its first contact.

use crate::capi::at_configuration::answers::cstk_distance_result;
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{
    OptionsStruct, Output, OutputSlice, options_or_default, slice, write_defaults,
};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::motion::{MotionAnswer, MotionOptions, MotionOutcome};
use crate::query::{Distance, QueryContext};

/// Options of a motion. Write it with cstk_motion_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_motion_options {
    pub size: u32,
    pub cookie: u32,
    /// A distance of at most this counts as contact: a length, finite, at least 0. 0, the default, asks for configurations
    /// that cstk_classify calls CSTK_CLASS_INSIDE.
    pub threshold: f64,
    /// How exactly the time of the first contact is found, as a part of the motion: 1e-12 to 1. Default 1e-6.
    pub tolerance: f64,
    /// Nonzero: yes or no; any contact on the motion will do, found in less time than the first, and no distance is told there.
    /// Default 0.
    pub any_contact: u32,
    pub reserved: u32,
}

// SAFETY: repr(C), two u32, two doubles, two u32: no padding.
unsafe impl OptionsStruct for cstk_motion_options {
    const COOKIE: u32 = 0x4353_0502;
    const NAME: &'static str = "cstk_motion_options";
    fn defaults() -> Self {
        let defaults = MotionOptions::default();
        Self {
            size: 0,
            cookie: 0,
            threshold: defaults.threshold,
            tolerance: defaults.tolerance,
            any_contact: u32::from(defaults.any_contact),
            reserved: 0,
        }
    }
}

/// How a motion ends.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_motion_outcome {
    /// Proved: at every time from 0 to 1 the distance is larger than the threshold.
    CSTK_MOTION_FREE = 0,
    /// There is contact at times[1]. All before times[0] is proved free, and the two differ by at most the tolerance, unless
    /// any_contact was set.
    CSTK_MOTION_HIT = 1,
    /// All before times[0] is proved free; up to times[1], at most the tolerance later, the motion comes so near the threshold that
    /// rounding decides. What comes after is not looked at.
    CSTK_MOTION_NEAR = 2,
    /// The limit of cstk_query_set_limit ended the proof, or the distance at a contact needs more; all before times[0] is proved free.
    CSTK_MOTION_UNDECIDED = 3,
}

/// What was found of a motion.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_motion_result {
    pub outcome: cstk_motion_outcome,
    /// `distance` holds the distance at times[1], with witness and contact: for hits and near motions, unless any_contact was set or
    /// lengths and units of C-space mix in the C-object: cstk_explain at the configuration reached then names what decides.
    pub has_distance: bool,
    pub reserved_bytes: [u8; 3],
    /// See cstk_motion_outcome; 1 and 1 for a free motion.
    pub times: [f64; 2],
    pub distance: cstk_distance_result,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_motion_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_options_default(
    out: *mut cstk_motion_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Proves that the motion from q0 to q1 keeps clear of a C-object, or finds its first contact. The motion is that of
/// cstk_space_interpolate, as time goes from 0 to 1; the environments are those at the call. `q0` and `q1` have `nq` doubles;
/// `options` may be NULL for the defaults; `reached` may be NULL, or receives the configuration at times[1], `nq` doubles, and
/// may be q0 or q1.
///
/// Every C-object that cstk_classify takes: links, link pairs, attached objects, unions, intersections, complements. Of the
/// complement of an induced set freedom is proved where primitives overlap more deeply than the motion can change, or where a body is
/// inside a solid; elsewhere the answer may be near. With a threshold above 0 the complement of an induced set counts as contact
/// everywhere, as for cstk_within. CSTK_ERROR_UNSUPPORTED, naming the set, for predicates that do not measure and for custom joints
/// that move without stating their speeds; and for a threshold above 0 where lengths and units of C-space mix.
///
/// A solid that the motion starts outside of is not entered without contact. A motion along contact at a distance of 0 is a hit at
/// its start; one that grazes ends near.
/// Bodies that keep their places relative to each other are asked at the start alone. Where the motion takes them so far away that
/// their places are rounded by more than their gap, cstk_classify may call them inside.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q0: *const f64,
    q1: *const f64,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            // SAFETY: checked for NULL; the caller states the lengths.
            let (q0, q1) = unsafe { (slice(q0, nq, "q0")?, slice(q1, nq, "q1")?) };
            let answer = asked
                .context
                .motion(asked.cobject, q0, q1, &asked.options)?;
            let result = (&answer).into();
            Ok((answer.configuration, result))
        })
    })
}

/// What a call about a motion asks with.
pub(in crate::capi) struct AskedMotion<'a> {
    pub context: &'a mut QueryContext,
    pub cobject: &'a CObject,
    pub options: MotionOptions,
}

/// A call about a motion: `ask` gives the configuration reached and the result.
pub(in crate::capi) fn ask_motion<R>(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut R,
    ask: impl FnOnce(AskedMotion) -> Result<(Vec<f64>, R), Failure>,
) -> Result<(), Failure> {
    with_query(query, |state| {
        let cobject = &*handle::share::<CObject>(cobject, "cobject")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for size and cookie.
        let options = unsafe { options_or_default(options, "options")? }.into();
        let reached = OutputSlice::optional(reached, nq, "reached")?;
        let context = &mut state.context;
        let (configuration, result) = ask(AskedMotion {
            context,
            cobject,
            options,
        })?;
        reached.write(&configuration);
        out.write(result);
        Ok(())
    })
}

impl From<cstk_motion_options> for MotionOptions {
    fn from(given: cstk_motion_options) -> Self {
        Self {
            threshold: given.threshold,
            tolerance: given.tolerance,
            any_contact: given.any_contact != 0,
        }
    }
}

impl<C> From<&MotionAnswer<C>> for cstk_motion_result {
    fn from(answer: &MotionAnswer<C>) -> Self {
        let nothing = Distance::unknown();
        Self {
            outcome: match answer.outcome {
                MotionOutcome::Free => cstk_motion_outcome::CSTK_MOTION_FREE,
                MotionOutcome::Hit => cstk_motion_outcome::CSTK_MOTION_HIT,
                MotionOutcome::Near => cstk_motion_outcome::CSTK_MOTION_NEAR,
                MotionOutcome::Undecided => cstk_motion_outcome::CSTK_MOTION_UNDECIDED,
            },
            has_distance: answer.distance.is_some(),
            reserved_bytes: [0; 3],
            times: answer.times,
            distance: answer.distance.as_ref().unwrap_or(&nothing).into(),
            reserved: [0; 8],
        }
    }
}
