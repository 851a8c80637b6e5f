//! The step that slides.

use super::boundary::guard;
use super::cobject::cstk_cobject;
use super::handle;
use super::input::{OptionsStruct, Output, OutputSlice, options, slice, write_defaults};
use super::query::{cstk_query, with_query};
use super::status::cstk_status;
use crate::cobject::CObject;
use crate::query::{SlideOptions, SlideOutcome};

/// How to slide. Write it with cstk_slide_options_default first, then set `max_shell`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_options {
    pub size: u32,
    pub cookie: u32,
    /// The stand-off: contacts up to this distance constrain the step. Must be set, larger than 0.
    pub max_shell: f64,
    /// The distance at which the robot slides; where it is nearer it is pushed out. Negative, the default, stands for a
    /// tenth of max_shell. Independent of the C-object's contact epsilon.
    pub desired_distance: f64,
    /// 1 lengthens the step along the contact to that of the step asked for, at most fourfold; 0, the default, leaves what
    /// is left of the step.
    pub keep_length: u32,
    /// At most so many witnesses are considered, the nearest first. Default 256.
    pub max_witnesses: u32,
}

// SAFETY: repr(C), two u32, two doubles, two u32: no padding.
unsafe impl OptionsStruct for cstk_slide_options {
    const COOKIE: u32 = 0x4353_0501;
    const NAME: &'static str = "cstk_slide_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            max_shell: 0.0,
            desired_distance: -1.0,
            keep_length: 0,
            max_witnesses: 256,
        }
    }
}

/// How a slide ended.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_slide_outcome {
    /// A step was found, and it keeps clear of the C-object all the way.
    CSTK_SLIDE_MOVED = 0,
    /// The configuration is inside the C-object; nothing was moved.
    CSTK_SLIDE_INSIDE = 1,
    /// No step leads on: contacts, ranges or the world box are in the way; nothing was moved.
    CSTK_SLIDE_BLOCKED = 2,
}

/// What a slide did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_result {
    pub outcome: cstk_slide_outcome,
    /// How many contacts constrained the step.
    pub contact_count: u32,
    /// The distance at the configuration given, and at the one reached.
    pub distance_before: f64,
    pub distance_after: f64,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_slide_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide_options_default(
    out: *mut cstk_slide_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Takes one step from q that slides along contacts instead of running into them (Appendix A): `step` itself where
/// nothing is within the shell; else the nearest step that brings no contact nearer than the desired distance, shortened
/// until the whole way is proved free (from a touching start, all but the first 1e-4 of max_shell, where the contacts'
/// gradients must do). Along a contact only part of the step is left; see keep_length. `slide_options` must
/// not be NULL. `q`, `step` and `reached` have `nq` doubles; `reached` may be `q`. Unless the
/// outcome is CSTK_SLIDE_MOVED, `reached` receives q.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    step: *const f64,
    nq: usize,
    slide_options: *const cstk_slide_options,
    reached: *mut f64,
    out: *mut cstk_slide_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::borrow::<CObject>(cobject, "cobject")?;
            let reached = OutputSlice::checked(reached, nq, "reached")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (q, step, given) = unsafe {
                (
                    slice(q, nq, "q")?,
                    slice(step, nq, "step")?,
                    options(slide_options, "slide_options")?,
                )
            };
            let mut options = SlideOptions::with_shell(given.max_shell);
            options.keep_length = given.keep_length != 0;
            options.max_witnesses = given.max_witnesses as usize;
            // NaN must reach the check.
            if given.desired_distance.is_nan() || given.desired_distance >= 0.0 {
                options.desired_distance = given.desired_distance;
            }
            let taken = state.context.slide(cobject, q, step, &options)?;
            reached.write(&taken.configuration);
            out.write(cstk_slide_result {
                outcome: match taken.outcome {
                    SlideOutcome::Moved => cstk_slide_outcome::CSTK_SLIDE_MOVED,
                    SlideOutcome::Inside => cstk_slide_outcome::CSTK_SLIDE_INSIDE,
                    SlideOutcome::Blocked => cstk_slide_outcome::CSTK_SLIDE_BLOCKED,
                },
                contact_count: taken.contacts as u32,
                distance_before: taken.distance_before,
                distance_after: taken.distance_after,
                reserved: [0; 8],
            });
            Ok(())
        })
    })
}
