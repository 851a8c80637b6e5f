//! Pair queries.
//!
//! Two bodies at two poses, without a robot: the queries that FCL and Coal offer.
//!
//! ```c
//! cstk_distance_result nearest;
//! bool meet;
//! check(cstk_pair_distance(query, body, pose_a, body, pose_b, INFINITY, &nearest));
//! check(cstk_pair_within(query, body, pose_a, body, pose_b, 0, &meet));
//! ```

use super::boundary::{Failure, guard};
use super::handle;
use super::input::{Output, array};
use super::query::{State, cstk_query, with_borrowed_query, with_query};
use crate::body::Body;
use crate::capi::at_configuration::answers::{
    cstk_distance_result, cstk_penetration_list, cstk_witness_list,
};
use crate::capi::body::body::cstk_body;
use crate::capi::status::status::cstk_status;
use crate::query::{Distance, GivenPair, TakeDistance};

/// Checks the arguments that all pair queries share, and runs one.
unsafe fn run<T>(
    query: *mut cstk_query,
    body_a: *const cstk_body,
    pose_a: *const f64,
    body_b: *const cstk_body,
    pose_b: *const f64,
    out: *mut T,
    action: impl FnOnce(&mut State, &GivenPair, Output<T>) -> Result<(), Failure>,
) -> cstk_status {
    guard(|| {
        let a = handle::borrowed::<Body>(body_a, "body_a")?;
        let b = handle::borrowed::<Body>(body_b, "body_b")?;
        let answer = |state: &mut State| {
            let out = Output::checked(out, "out")?;
            // SAFETY: the header states the lengths.
            let poses = unsafe { [array(pose_a, "pose_a")?, array(pose_b, "pose_b")?] };
            let bodies = [a, b];
            action(state, &GivenPair { bodies, poses }, out)
        };
        if a.has_functions() || b.has_functions() {
            // Callbacks may release the bodies during the call.
            let _kept = handle::share::<Body>(body_a, "body_a")?;
            let _kept_too = handle::share::<Body>(body_b, "body_b")?;
            return with_query(query, answer);
        }
        with_borrowed_query(query, answer)
    })
}

/// Writes a distance where the caller wants it.
struct Written(Output<cstk_distance_result>);

impl TakeDistance for Written {
    type Taken = ();

    #[inline(always)]
    fn take(self, distance: Distance) {
        self.0.write((&distance).into());
    }
}

/// Writes the distance of body a at pose_a from body b at pose_b, and the nearest primitive pair. Poses are 12 doubles,
/// row-major [R | t], the body's frame in the world. Distances above `max_distance` are not computed: the result is then
/// CSTK_DISTANCE_BEYOND_MAX. Pass INFINITY for no maximum.
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
            |state, pair, out| {
                let context = &mut state.context;
                Ok(context.take_given_distance(pair, max_distance, Written(out))?)
            },
        )
    }
}

/// Writes whether the two bodies are at most `threshold` apart (not negative; may be INFINITY); with 0, whether they meet.
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
            |state, pair, out| {
                out.write(state.context.given_within(pair, threshold)?);
                Ok(())
            },
        )
    }
}

/// Writes all primitive pairs at most `epsilon` apart, none missing, none twice, and their contacts. Each piece of a body
/// that lies inside the other, a solid, is listed at distance 0 (see `contained`). If there are more than `max_count`, the
/// nearest are listed and `truncated` is set. The arrays stay valid until the next call with this query context.
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
            |state, pair, out| {
                let context = &mut state.context;
                let list = pair.read(|a, b| context.pair_witnesses(a, b, epsilon, max_count))?;
                out.write(state.keep(list));
                Ok(())
            },
        )
    }
}

/// Writes all primitive pairs that meet, none missing, none twice, and their penetration: the shortest translation that
/// separates the two. It separates bodies of one convex primitive each; for bodies of several it separates the two
/// primitives only (see `of_whole_bodies`). Exact to rounding, with radii too. A pair of polyhedra mostly takes some
/// microseconds; where nearly all ways out are as long, as of balls of many corners about one centre, the work grows with the pairs of
/// their edges that face each other. CSTK_ERROR_UNSUPPORTED where a cylinder, cone,
/// ellipsoid or support function meets another primitive. A body wholly inside a solid (cstk_body_builder_set_solid) meets
/// none of its primitives, and is not listed. If there are more than `max_count` pairs, the deepest are listed and
/// `truncated` is set. The array stays valid until the next call with this query context.
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
            |state, pair, out| {
                let context = &mut state.context;
                let list = pair.read(|a, b| context.pair_penetration(a, b, max_count))?;
                out.write(state.keep_penetrations(&list));
                Ok(())
            },
        )
    }
}
