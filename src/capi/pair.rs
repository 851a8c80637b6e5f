//! Pair queries.
//!
//! Two bodies at two poses: what is asked of FCL or Coal.
//!
//! ```c
//! cstk_distance_result nearest;
//! bool meet;
//! check(cstk_pair_distance(query, body, pose_a, body, pose_b, INFINITY, &nearest));
//! check(cstk_pair_within(query, body, pose_a, body, pose_b, 0, &meet));
//! ```

use super::boundary::{Failure, guard};
use super::handle;
use super::input::{Output, pose};
use super::query::{State, cstk_query, with_borrowed_query, with_query};
use crate::body::Body;
use crate::capi::at_configuration::answers::{
    cstk_distance_result, cstk_penetration_list, cstk_witness_list,
};
use crate::capi::body::body::cstk_body;
use crate::capi::status::status::cstk_status;
use crate::pose::Pose;

type Placement<'a> = (&'a Body, &'a Pose);

/// Checks the arguments all pair queries share, and runs one.
unsafe fn run<T>(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    out: *mut T,
    ask: impl FnOnce(&mut State, Placement, Placement, Output<T>) -> Result<(), Failure>,
) -> cstk_status {
    guard(|| {
        let a = handle::borrowed::<Body>(body_a, "body_a")?;
        let b = handle::borrowed::<Body>(body_b, "body_b")?;
        let answer = |state: &mut State| {
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL; the header states the lengths.
            let (pose_a, pose_b) = unsafe { (pose(pose_a, "pose_a")?, pose(pose_b, "pose_b")?) };
            ask(state, (a, &pose_a), (b, &pose_b), out)
        };
        if a.has_functions() || b.has_functions() {
            // Functions of the caller's may release what is asked.
            let _kept = handle::share::<Body>(body_a, "body_a")?;
            let _kept_too = handle::share::<Body>(body_b, "body_b")?;
            return with_query(query, answer);
        }
        with_borrowed_query(query, answer)
    })
}

/// Writes the distance of body a at pose_a from body b at pose_b, and the nearest pair of primitives. Poses are 12
/// doubles, row-major [R | t], the body's frame in the world. Distances beyond `max_distance` (INFINITY to have them
/// all) are not computed; the answer is then CSTK_DISTANCE_BEYOND_MAX.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_distance(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    max_distance: f64,
    out: *mut cstk_distance_result,
) -> cstk_status {
    // SAFETY: the caller states the lengths.
    unsafe {
        run(
            query,
            body_a,
            pose_a,
            body_b,
            pose_b,
            out,
            |state, a, b, out| {
                out.write((&state.context.pair_distance(a, b, max_distance)?).into());
                Ok(())
            },
        )
    }
}

/// Writes whether the two bodies are at most `threshold` apart (not negative; may be INFINITY); 0 asks whether they meet.
/// Doubt within rounding counts as within. Cheaper than a distance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_within(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    threshold: f64,
    out: *mut bool,
) -> cstk_status {
    // SAFETY: the caller states the lengths.
    unsafe {
        run(
            query,
            body_a,
            pose_a,
            body_b,
            pose_b,
            out,
            |state, a, b, out| {
                out.write(state.context.pair_within(a, b, threshold)?);
                Ok(())
            },
        )
    }
}

/// Writes all pairs of primitives at most `epsilon` apart, none missing, none twice, and their contacts; and at distance 0
/// each piece of a body that lies inside the other, a solid (see `contained`). Of more than `max_count`, the nearest are
/// given and `truncated` is set. The arrays stay valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_witnesses(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    epsilon: f64,
    max_count: usize,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: the caller states the lengths.
    unsafe {
        run(
            query,
            body_a,
            pose_a,
            body_b,
            pose_b,
            out,
            |state, a, b, out| {
                let list = state.context.pair_witnesses(a, b, epsilon, max_count)?;
                out.write(state.keep(list));
                Ok(())
            },
        )
    }
}

/// Writes all pairs of primitives that meet, none missing, none twice, and how deep they are in one another: the shortest
/// translation that takes the two apart. Bodies of one convex primitive each are taken apart by it; those of several are
/// not, for it is about two primitives only (see `of_whole_bodies`). Exact to rounding, with radii too; the work for a
/// pair of polyhedra grows with the number of their edges and with that of the pairs of edges that face each other.
/// CSTK_ERROR_UNSUPPORTED where a cylinder, cone, ellipsoid
/// or support function meets another primitive. What lies wholly inside a solid (cstk_body_builder_set_solid) meets none
/// of its primitives: nothing is listed for it. Of more than `max_count` pairs, the deepest are given and `truncated` is
/// set. The array stays valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pair_penetration(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    max_count: usize,
    out: *mut cstk_penetration_list,
) -> cstk_status {
    // SAFETY: the caller states the lengths.
    unsafe {
        run(
            query,
            body_a,
            pose_a,
            body_b,
            pose_b,
            out,
            |state, a, b, out| {
                let list = state.context.pair_penetration(a, b, max_count)?;
                out.write(state.keep_penetrations(&list));
                Ok(())
            },
        )
    }
}
