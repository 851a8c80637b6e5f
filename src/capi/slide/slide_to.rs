//! Slides that go on until they arrive or are blocked.

use std::ffi::c_void;

use super::slide::cstk_slide_options;
use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{self, OptionsStruct, Output, optional_slice, slice, write_defaults};
use crate::capi::motion::path::cstk_path;
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::motion::{SlideToOptions, SlideToOutcome};

/// Options of cstk_slide_to. Write it with cstk_slide_to_options_default first, then set `step`. Lengths are those of
/// cstk_space_distance with the weights of the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_to_options {
    pub size: u32,
    pub cookie: u32,
    /// The length of a sliding step. Must be set, larger than 0.
    pub step: f64,
    /// The robot has arrived where it is no farther than this from the goal; at least 0, the default: in the goal.
    pub tolerance: f64,
    /// A sliding step that comes nearer to the goal by less than this part of `step` gains nothing; at least 0, less than 1.
    /// Default 0.05.
    pub min_gain: f64,
    /// No more sliding steps than this are taken; at least 1. Default 1000.
    pub max_steps: u64,
    /// The slide ends after more than this many steps in a row that gain nothing. Corners take one or two. Default 3.
    pub max_idle_steps: u64,
    /// The straight motion to the goal is tried at the start, after this many sliding steps each time, and within a step of the goal; at
    /// least 1. Default 8.
    pub steps_between_motions: u64,
}

// SAFETY: repr(C), two u32, three doubles, three u64: no padding.
unsafe impl OptionsStruct for cstk_slide_to_options {
    const COOKIE: u32 = 0x4353_0507;
    const NAME: &'static str = "cstk_slide_to_options";
    fn defaults() -> Self {
        let defaults = SlideToOptions::with_step(0.0, 0.0);
        Self {
            size: 0,
            cookie: 0,
            step: 0.0,
            tolerance: defaults.tolerance,
            min_gain: defaults.min_gain,
            max_steps: defaults.max_steps as u64,
            max_idle_steps: defaults.max_idle_steps as u64,
            steps_between_motions: defaults.steps_between_motions as u64,
        }
    }
}

/// Why a slide to a goal ended.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_slide_to_outcome {
    /// The last configuration is in the goal, or no farther from it than the tolerance.
    CSTK_SLIDE_TO_ARRIVED = 0,
    /// q is inside the C-object; it is not moved.
    CSTK_SLIDE_TO_INSIDE = 1,
    /// No sliding step is possible: see CSTK_SLIDE_BLOCKED.
    CSTK_SLIDE_TO_BLOCKED = 2,
    /// Steps are possible, but more than max_idle_steps in a row gained nothing.
    CSTK_SLIDE_TO_IDLE = 3,
    /// max_steps sliding steps were taken.
    CSTK_SLIDE_TO_STEPS = 4,
    /// The limit of cstk_query_set_limit ended the work.
    CSTK_SLIDE_TO_LIMITED = 5,
}

/// Where a slide to a goal led.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_to_result {
    pub outcome: cstk_slide_to_outcome,
    pub reserved_word: u32,
    /// The configurations from q on. The motion from each to the next, that of cstk_space_interpolate, is proved free.
    pub path: cstk_path,
    /// How far the last of them is from the goal.
    pub remaining: f64,
    /// How many sliding steps were tried, and how many straight motions to the goal.
    pub steps: u64,
    pub motions: u64,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_slide_to_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide_to_options_default(
    out: *mut cstk_slide_to_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Leads the robot from q towards a goal: straight as far as that is proved free, then by steps of cstk_slide towards the goal, with
/// another straight motion from time to time, until it has arrived, is blocked or gets no farther. It looks ahead by one
/// step and remembers nothing: what a planner calls its local planner. All is done in the state that the environments are in at the
/// call; the same call has the same answer.
///
/// The goal is the box from `goal_low` to `goal_high`, which may be the same pointer: then it is one configuration. On a circle the box
/// is the arc from low upwards to high. A coordinate from -INFINITY to INFINITY may have any value. The entries of a
/// quaternion must be equal in both, or all four be free. `q`, `goal_low` and `goal_high` have `nq` doubles. `weights` has `nv`
/// doubles, larger than 0, and may be NULL with an `nv` of 0: then each is 1. What is measured is the distance from the nearest
/// configuration of the box, each velocity multiplied by its weight.
///
/// `slide_options` are those of cstk_slide, `options` those of the whole way; neither may be NULL. `progress` may be NULL; it is called
/// before each sliding step, and `user` is passed to it. The path of the answer belongs to the query context; it may be given to the
/// next call. It keeps to the ranges and the world box at its points, unless q does not: then it is blocked.
///
/// A motion whose start touches is proved as cstk_slide proves it; all others cstk_motion proves too. Where q is in the goal the path is q
/// alone, and nothing is asked. The limit of cstk_query_set_limit counts for the whole way and ends it with
/// CSTK_SLIDE_TO_LIMITED. CSTK_ERROR_CANCELLED where `progress` says so. CSTK_ERROR_UNSUPPORTED as for cstk_slide, but only where a sliding
/// step is needed: what the straight motion decides is answered for every C-object that cstk_motion takes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide_to(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    goal_low: *const f64,
    goal_high: *const f64,
    nq: usize,
    weights: *const f64,
    nv: usize,
    slide_options: *const cstk_slide_options,
    options: *const cstk_slide_to_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut cstk_slide_to_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (q, low, high, steps, given) = unsafe {
                (
                    slice(q, nq, "q")?,
                    slice(goal_low, nq, "goal_low")?,
                    slice(goal_high, nq, "goal_high")?,
                    input::options(slide_options, "slide_options")?,
                    input::options(options, "options")?,
                )
            };
            // SAFETY: checked for NULL; the caller states the length.
            let weights = unsafe { optional_slice(weights, nv, "weights")? };
            let count = |count: u64| usize::try_from(count).unwrap_or(usize::MAX);
            let options = SlideToOptions {
                slide: steps.into(),
                step: given.step,
                max_steps: count(given.max_steps),
                tolerance: given.tolerance,
                min_gain: given.min_gain,
                max_idle_steps: count(given.max_idle_steps),
                steps_between_motions: count(given.steps_between_motions),
            };
            let mut report = reporter(progress, user);
            let context = &mut state.context;
            let goal = [low, high];
            let led = context.slide_to(&cobject, q, goal, weights, &options, &mut report)?;
            out.write(cstk_slide_to_result {
                outcome: led.outcome.into(),
                reserved_word: 0,
                path: state.keep_path(led.points, nq),
                remaining: led.remaining,
                steps: led.steps as u64,
                motions: led.motions as u64,
                reserved: [0; 8],
            });
            Ok(())
        })
    })
}

impl From<SlideToOutcome> for cstk_slide_to_outcome {
    fn from(outcome: SlideToOutcome) -> Self {
        match outcome {
            SlideToOutcome::Arrived => Self::CSTK_SLIDE_TO_ARRIVED,
            SlideToOutcome::Inside => Self::CSTK_SLIDE_TO_INSIDE,
            SlideToOutcome::Blocked => Self::CSTK_SLIDE_TO_BLOCKED,
            SlideToOutcome::Idle => Self::CSTK_SLIDE_TO_IDLE,
            SlideToOutcome::Steps => Self::CSTK_SLIDE_TO_STEPS,
            SlideToOutcome::Limited => Self::CSTK_SLIDE_TO_LIMITED,
        }
    }
}
