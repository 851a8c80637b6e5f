//! Query contexts, and the queries of a C-object at a configuration.

use std::sync::{Arc, Mutex};

use super::answers::{
    cstk_class, cstk_contact, cstk_distance_result, cstk_penetration, cstk_penetration_list,
    cstk_witness, cstk_witness_list,
};
use super::boundary::{Failure, guard};
use super::cobject::cstk_cobject;
use super::environment::cstk_environment;
use super::exclusive::exclusively;
use super::explain::cstk_verdict;
use super::handle::{self, Noun};
use super::input::{Output, slice};
use super::link_pairs::cstk_link_pair;
use super::robot::link_poses;
use super::status::cstk_status;
use crate::cobject::CObject;
use crate::environment::Environment;
use crate::error::{Error, ErrorKind};
use crate::query::{
    Configuration, LinkPair, PairVerdict, PenetrationList, QueryContext, Shell, WitnessList,
};

/// One thread's caches and scratch memory, and the home of the arrays it answers with. A context serves one thread at a
/// time and answers CSTK_BUSY otherwise; make one per thread. Caches change how long an answer takes, never the answer.
pub struct cstk_query {
    _opaque: [u8; 0],
}

/// A context and the arrays of its last answer.
#[derive(Default)]
pub(super) struct State {
    pub context: QueryContext,
    witnesses: Vec<cstk_witness>,
    contacts: Vec<cstk_contact>,
    gradients: Vec<f64>,
    penetrations: Vec<cstk_penetration>,
    pub verdicts: Vec<cstk_verdict>,
    pub pairs: Vec<cstk_link_pair>,
    pub tested: Vec<u32>,
}

pub(super) struct Query(Mutex<State>);

impl Noun for Query {
    type Handle = cstk_query;
    const KIND: u32 = 8;
    const NAME: &'static str = "cstk_query";
}

/// Where an array is; NULL if it is empty.
pub(super) fn start<T>(items: &[T]) -> *const T {
    if items.is_empty() {
        std::ptr::null()
    } else {
        items.as_ptr()
    }
}

impl State {
    /// Takes over a list and says where its array now is.
    pub fn keep_penetrations(&mut self, list: &PenetrationList) -> cstk_penetration_list {
        self.penetrations = list.penetrations.iter().map(From::from).collect();
        cstk_penetration_list {
            penetrations: start(&self.penetrations),
            count: self.penetrations.len(),
            of_whole_bodies: list.of_whole_bodies,
            truncated: list.truncated,
            reserved_bytes: [0; 6],
            reserved: [0; 5],
        }
    }

    /// Takes over pairs of links, and which of them are to be tested.
    pub fn keep_pairs(&mut self, pairs: &[LinkPair], skip_never: bool) {
        self.pairs = pairs.iter().map(From::from).collect();
        let is_tested = |pair: &&LinkPair| match pair.verdict {
            PairVerdict::Test => true,
            PairVerdict::Never => !skip_never,
            _ => false,
        };
        let tested = pairs.iter().filter(is_tested);
        self.tested = tested
            .flat_map(|pair| pair.links.map(|link| link as u32))
            .collect();
    }

    /// Takes over a list and says where its arrays now are.
    pub fn keep(&mut self, list: WitnessList) -> cstk_witness_list {
        self.witnesses = list.witnesses.iter().map(From::from).collect();
        self.contacts = list.contacts.iter().map(From::from).collect();
        self.gradients = list.gradients;
        cstk_witness_list {
            witnesses: start(&self.witnesses),
            witness_count: self.witnesses.len(),
            contacts: start(&self.contacts),
            contact_count: self.contacts.len(),
            gradients: start(&self.gradients),
            nv: list.nv,
            truncated: list.truncated,
            reserved_bytes: [0; 7],
            environment_version: list.version,
            reserved: [0; 8],
        }
    }
}

/// Runs a query with the context to itself.
pub(super) fn with_query(
    query: *mut cstk_query,
    action: impl FnOnce(&mut State) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let query = handle::share::<Query>(query, "query")?;
    // Caches are dispensable, and scratch memory is only as good as the call that left it.
    let renew = |state: &mut State| *state = State::default();
    exclusively(&query.0, "the query context", renew, action)
}

/// Where the robot is, as C gave it.
enum Given<'a> {
    Coordinates(&'a [f64]),
    LinkPoses(Vec<crate::pose::Pose>),
}

impl Given<'_> {
    fn configuration(&self) -> Configuration<'_> {
        match self {
            Given::Coordinates(q) => Configuration::Coordinates(q),
            Given::LinkPoses(poses) => Configuration::LinkPoses(poses),
        }
    }
}

unsafe fn coordinates<'a>(q: *const f64, nq: usize) -> Result<Given<'a>, Failure> {
    // SAFETY: as the caller states.
    Ok(Given::Coordinates(unsafe { slice(q, nq, "q")? }))
}

unsafe fn poses<'a>(values: *const f64, count: usize) -> Result<Given<'a>, Failure> {
    // SAFETY: as the caller states.
    Ok(Given::LinkPoses(unsafe {
        link_poses(values, count, "link_poses")?
    }))
}

/// Checks the arguments all queries share, and runs one; `at` reads where the robot is.
fn run<At, T>(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    at: impl FnOnce() -> Result<At, Failure>,
    out: *mut T,
    ask: impl FnOnce(&mut State, &CObject, &At) -> Result<T, Failure>,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            // A share: functions of the caller may release the handle meanwhile.
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            let at = at()?;
            out.write(ask(state, &cobject, &at)?);
            Ok(())
        })
    })
}

fn classify(state: &mut State, cobject: &CObject, at: &Given) -> Result<cstk_class, Failure> {
    Ok(state.context.classify(cobject, at.configuration())?.into())
}

/// Makes a query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_create(out: *mut *mut cstk_query) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(Query(Mutex::default()))));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_retain(query: *mut cstk_query) -> cstk_status {
    guard(|| handle::retain::<Query>(query, "query"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_release(query: *mut cstk_query) -> cstk_status {
    guard(|| handle::release::<Query>(query, "query"))
}

/// Writes the version of an environment that the last query with this context saw: of each environment that its C-object
/// refers to. CSTK_NOT_FOUND if it refers to others only, or nothing was asked yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_get_version(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    out: *mut u64,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let environment = handle::share::<Environment>(environment, "environment")?;
            let out = Output::checked(out, "out")?;
            let version = state.context.version_seen(&environment).ok_or_else(|| {
                let message = "the last query with this context did not look at the environment";
                Error::new(ErrorKind::NotFound, message)
            })?;
            out.write(version);
            Ok(())
        })
    })
}

/// The work a query context has done.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_query_statistics {
    /// Pairs of hierarchy nodes whose wrappers were tested.
    pub node_pairs: u64,
    /// Primitive pairs whose distance was computed.
    pub primitive_pairs: u64,
    /// Witnesses of earlier queries that were evaluated first.
    pub cache_hits: u64,
    pub reserved: [u64; 5],
}

/// Writes the work done since the context was made, or since the last call with `reset`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_get_statistics(
    query: *mut cstk_query,
    reset: bool,
    out: *mut cstk_query_statistics,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let out = Output::checked(out, "out")?;
            let done = state.context.statistics();
            if reset {
                state.context.reset_statistics();
            }
            out.write(cstk_query_statistics {
                node_pairs: done.node_pairs,
                primitive_pairs: done.primitive_pairs,
                cache_hits: done.cache_hits,
                reserved: [0; 5],
            });
            Ok(())
        })
    })
}

/// Writes whether configuration q is inside the C-object, in contact with it, or outside (§2.2.4, operation 4). `q` has
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
    run(
        query,
        cobject,
        || unsafe { coordinates(q, nq) },
        out,
        classify,
    )
}

/// cstk_classify for callers with kinematics of their own: `link_poses` holds the pose of every link of the space in the
/// world, `link_count` runs of 12 doubles. Such callers get a contact's gradient as n^T (J_r - J_s), with their Jacobians of
/// the links' points r_point and s_point.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_classify_at(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    out: *mut cstk_class,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { poses(link_poses, link_count) },
        out,
        classify,
    )
}

/// Writes whether the distance at q is at most `threshold` (not negative; may be INFINITY). Doubt within rounding counts
/// as within. Of unions of induced sets and closed pure sets it is true with threshold 0 where cstk_classify says
/// CSTK_INSIDE. At the boundary of an open set (at a joint limit, say), and where of an intersection or a complement only a
/// lower bound of the distance is known, it is true where the class is less: ask cstk_classify whether a configuration is
/// allowed. Cheaper than a distance.
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
    run(
        query,
        cobject,
        || unsafe { coordinates(q, nq) },
        out,
        |state, cobject, at| {
            Ok(state
                .context
                .within(cobject, at.configuration(), threshold)?)
        },
    )
}

/// cstk_within with the pose of every link, as in cstk_classify_at.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_within_at(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    threshold: f64,
    out: *mut bool,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { poses(link_poses, link_count) },
        out,
        |state, cobject, at| {
            Ok(state
                .context
                .within(cobject, at.configuration(), threshold)?)
        },
    )
}

/// Writes the distance at q from contact, and the nearest pair of primitives (§2.2.4, operation 6). Distances beyond
/// `max_distance` (INFINITY to have them all) are not computed, which saves time; the answer is then CSTK_BEYOND_MAX.
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
    run(
        query,
        cobject,
        || unsafe { coordinates(q, nq) },
        out,
        |state, cobject, at| {
            Ok((&state
                .context
                .distance(cobject, at.configuration(), max_distance)?)
                .into())
        },
    )
}

/// cstk_distance with the pose of every link, as in cstk_classify_at.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_distance_at(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    max_distance: f64,
    out: *mut cstk_distance_result,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { poses(link_poses, link_count) },
        out,
        |state, cobject, at| {
            Ok((&state
                .context
                .distance(cobject, at.configuration(), max_distance)?)
                .into())
        },
    )
}

/// Writes all pairs of primitives at most `epsilon` apart at q, none missing, none twice (§2.2.4, operation 7), and their
/// contacts. Within rounding of epsilon, cstk_within may hold where no witness is given. Of more than `max_count` pairs, the
/// nearest are given and `truncated` is set. Neighbouring faces of a mesh share edges and vertices, so that one physical
/// contact may have several witnesses. Each piece of a body that lies inside another, a solid, is a witness too, at distance
/// 0 (see `contained`). The arrays stay valid until the next call with this query context.
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
    run(
        query,
        cobject,
        || unsafe { coordinates(q, nq) },
        out,
        |state, cobject, at| {
            let list = state
                .context
                .witnesses(cobject, at.configuration(), epsilon, max_count)?;
            Ok(state.keep(list))
        },
    )
}

/// cstk_witnesses with the pose of every link, as in cstk_classify_at.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_witnesses_at(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    epsilon: f64,
    max_count: usize,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    run(
        query,
        cobject,
        || unsafe { poses(link_poses, link_count) },
        out,
        |state, cobject, at| {
            let list = state
                .context
                .witnesses(cobject, at.configuration(), epsilon, max_count)?;
            Ok(state.keep(list))
        },
    )
}

/// cstk_witnesses, and for each contact the gradient of its distance (§2.2.4, operation 8; §4.4): by how much it grows
/// per unit of each velocity of cstk_space_step, the way out in joint space. For the nearest pair alone ask cstk_distance
/// first and give its `upper` as epsilon where that is finite: a large epsilon visits every pair, whatever max_count. Row
/// i, at gradients + i * nv, is that of contacts[i]; overlapping witnesses have no contact and no row. The arrays stay
/// valid until the next call with this query context.
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

/// Everything about one configuration: Appendix A's cstk-pseudo-normal.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_pseudo_normal_result {
    pub point_class: cstk_class,
    pub reserved: u32,
    pub distance: cstk_distance_result,
    /// Witnesses, contacts and gradients within the shell.
    pub list: cstk_witness_list,
}

/// Writes class, distance, and the witnesses and gradients within `max_shell` at q. With `normalize`, gradients have
/// length 1 (those of length 0 stay). The list's arrays stay valid until the next call with this query context.
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
