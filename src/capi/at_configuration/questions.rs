//! Queries on a C-object at a configuration, or at link poses.

use crate::capi::at_configuration::answers::{cstk_class, cstk_distance_result, cstk_witness_list};
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{Output, OutputSlice, require_width, slice};
use crate::capi::query::{State, cstk_query, with_query};
use crate::capi::robot::robot::read_poses;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::pose::Pose;
use crate::query::{Configuration, Shell};
use crate::space::Space;

/// The robot's state as the caller passed it: coordinates or link poses, and their number.
#[derive(Clone, Copy)]
pub(super) enum StateInput {
    Coordinates(*const f64, usize),
    LinkPoses(*const f64, usize),
}

impl StateInput {
    /// The checked state; poses are stored in memory that is reused.
    unsafe fn read<'a>(
        self,
        space: &Space,
        memory: &'a mut Vec<Pose>,
    ) -> Result<Configuration<'a>, Failure> {
        // SAFETY: as the caller states.
        unsafe {
            Ok(match self {
                Self::Coordinates(q, count) => Configuration::Coordinates(slice(q, count, "q")?),
                Self::LinkPoses(values, count) => {
                    space.check_link_poses(count)?;
                    read_poses(values, count, "link_poses", memory)?;
                    Configuration::LinkPoses(memory)
                }
            })
        }
    }
}

/// Checks the arguments that all queries share, and runs one; `at` reads the robot's state.
fn run<At, T>(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    at: impl FnOnce() -> Result<At, Failure>,
    out: *mut T,
    action: impl FnOnce(&mut State, &CObject, &At) -> Result<T, Failure>,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            // Shared ownership: a callback may release the handle during the call.
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            let at = at()?;
            out.write(action(state, &cobject, &at)?);
            Ok(())
        })
    })
}

/// The same for queries that also take link poses.
pub(super) unsafe fn run_at<T>(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    given: StateInput,
    out: *mut T,
    action: impl FnOnce(&mut State, &CObject, Configuration) -> Result<T, Failure>,
) -> cstk_status {
    let action = |state: &mut State, cobject: &CObject, (): &()| {
        let mut memory = std::mem::take(&mut state.poses);
        // SAFETY: the caller states the lengths.
        let at = unsafe { given.read(cobject.space(), &mut memory)? };
        let answer = action(state, cobject, at);
        state.poses = memory;
        answer
    };
    run(query, cobject, || Ok(()), out, action)
}

fn classify(
    state: &mut State,
    cobject: &CObject,
    at: Configuration,
) -> Result<cstk_class, Failure> {
    Ok(state.context.classify(cobject, at)?.into())
}

/// Writes the class of configuration q: inside the C-object, in contact with it, or outside (§2.2.4, operation 4). `q` has
/// `nq` doubles, as many as the space has coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_classify(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    out: *mut cstk_class,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::Coordinates(q, nq),
            out,
            classify,
        )
    }
}

/// cstk_classify for callers with their own kinematics. `link_poses` holds the pose of every link of the space in the
/// world, 12 doubles each, `link_count` poses in all. Such callers compute a contact's gradient as n^T (J_r - J_s), with
/// their own Jacobians of the points r_point and s_point of the links.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_classify_at_link_poses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    out: *mut cstk_class,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::LinkPoses(link_poses, link_count),
            out,
            classify,
        )
    }
}

/// Writes whether the distance at q is at most `threshold` (not negative; may be INFINITY). Doubt within rounding counts as
/// within. For unions of induced sets and closed pure sets, threshold 0 gives true where cstk_classify gives
/// CSTK_CLASS_INSIDE. It is also true on the boundary of an open set (at a joint limit, say), and where only a lower bound
/// of the distance from an intersection or a complement is known, although the class is lower there: use cstk_classify to
/// decide whether a configuration is allowed. Cheaper than cstk_distance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_within(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    threshold: f64,
    out: *mut bool,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::Coordinates(q, nq),
            out,
            |state, cobject, at| Ok(state.context.within(cobject, at, threshold)?),
        )
    }
}

/// cstk_within with link poses instead of q; see cstk_classify_at_link_poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_within_at_link_poses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    threshold: f64,
    out: *mut bool,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::LinkPoses(link_poses, link_count),
            out,
            |state, cobject, at| Ok(state.context.within(cobject, at, threshold)?),
        )
    }
}

/// Writes the distance from contact at q, and the nearest primitive pair (§2.2.4, operation 6). Distances above
/// `max_distance` are not computed, which saves time: the result is then CSTK_DISTANCE_BEYOND_MAX. Pass INFINITY for no
/// maximum.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_distance(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    max_distance: f64,
    out: *mut cstk_distance_result,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::Coordinates(q, nq),
            out,
            |state, cobject, at| Ok((&state.context.distance(cobject, at, max_distance)?).into()),
        )
    }
}

/// cstk_distance with link poses instead of q; see cstk_classify_at_link_poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_distance_at_link_poses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    max_distance: f64,
    out: *mut cstk_distance_result,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::LinkPoses(link_poses, link_count),
            out,
            |state, cobject, at| Ok((&state.context.distance(cobject, at, max_distance)?).into()),
        )
    }
}

/// cstk_distance and the gradient of the nearest pair in one call: `gradient` receives `nv` doubles, as many as the space has
/// velocities: the derivative of the distance of `contact` with respect to them, as cstk_gradients has it. It is 0 where has_contact is
/// false: where nothing is near, or the two overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_distance_with_gradient(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    max_distance: f64,
    out: *mut cstk_distance_result,
    gradient: *mut f64,
    nv: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { slice(q, nq, "q") },
        out,
        |state, cobject, q| {
            require_width(nv, cobject.space().nv(), "nv", "velocities")?;
            let gradient = OutputSlice::checked(gradient, nv, "gradient")?;
            let row = &mut state.row;
            let context = &mut state.context;
            let found = context.distance_with_gradient(cobject, q, max_distance, row)?;
            row.resize(nv, 0.0);
            gradient.write(row);
            Ok((&found).into())
        },
    )
}

/// Writes all primitive pairs at most `epsilon` apart at q, none missing, none twice (§2.2.4, operation 7), and their
/// contacts. Within rounding of epsilon, cstk_within may be true where no witness is listed. If there are more than
/// `max_count` pairs, the nearest are listed and `truncated` is set. Neighbouring faces of a mesh share edges and vertices,
/// so that one physical contact may have several witnesses. A piece of a body that lies inside another, a solid, is a
/// witness at distance 0 (see `contained`). The arrays stay valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_witnesses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    epsilon: f64,
    max_count: usize,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::Coordinates(q, nq),
            out,
            |state, cobject, at| {
                let list = state.context.witnesses(cobject, at, epsilon, max_count)?;
                Ok(state.keep(list))
            },
        )
    }
}

/// cstk_witnesses with link poses instead of q; see cstk_classify_at_link_poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_witnesses_at_link_poses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    epsilon: f64,
    max_count: usize,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::LinkPoses(link_poses, link_count),
            out,
            |state, cobject, at| {
                let list = state.context.witnesses(cobject, at, epsilon, max_count)?;
                Ok(state.keep(list))
            },
        )
    }
}

/// cstk_witnesses, with the gradient of each contact's distance (§2.2.4, operation 8; §4.4): its derivative with respect to
/// the velocities of cstk_space_step, the way out in joint space. Row i, at gradients + i * nv, belongs to contacts[i];
/// overlapping witnesses have neither contact nor row. A large epsilon visits every pair, whatever max_count: for the
/// nearest pair alone, call cstk_distance first and pass its `upper`, if finite, as epsilon. The arrays stay valid until
/// the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_gradients(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    epsilon: f64,
    max_count: usize,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { slice(q, nq, "q") },
        out,
        |state, cobject, q| {
            let list = state.context.gradients(cobject, q, epsilon, max_count)?;
            Ok(state.keep(list))
        },
    )
}

/// Class, distance, witnesses and gradients at one configuration: Appendix A's cstk-pseudo-normal.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_pseudo_normal_result {
    pub point_class: cstk_class,
    pub reserved: u32,
    pub distance: cstk_distance_result,
    /// Witnesses, contacts and gradients within the shell.
    pub list: cstk_witness_list,
}

/// Writes the class and the distance at q, and the witnesses and gradients within `max_shell`, at most `max_count`
/// witnesses. `normalize` scales gradients to length 1, except those of length 0. The list's arrays stay valid until the
/// next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pseudo_normal(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    max_shell: f64,
    max_count: usize,
    normalize: bool,
    out: *mut cstk_pseudo_normal_result,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { slice(q, nq, "q") },
        out,
        |state, cobject, q| {
            let shell = Shell {
                max_shell,
                max_count,
                normalize,
            };
            let found = state.context.pseudo_normal(cobject, q, &shell)?;
            Ok(cstk_pseudo_normal_result {
                point_class: found.class.into(),
                reserved: 0,
                distance: (&found.distance).into(),
                list: state.keep(found.list),
            })
        },
    )
}
