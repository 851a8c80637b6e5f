//! Query contexts.
//!
//! A query context holds one thread's caches and scratch memory, and the lists that its last call wrote. Its caches change
//! how long an answer takes, never the answer (§2.3.4).
//!
//! ```c
//! cstk_query_statistics work;
//! check(cstk_query_create(&query));
//! check(cstk_query_set_limit(query, 1000000));
//! check(cstk_query_get_statistics(query, true, &work));
//! check(cstk_query_release(query));
//! ```

use std::sync::Arc;

use super::boundary::{Failure, guard};
use super::handle;
use super::handle::Noun;
use super::input::{Output, start};
use crate::capi::at_configuration::answers::{
    cstk_contact, cstk_distance_result, cstk_penetration, cstk_penetration_list, cstk_witness,
    cstk_witness_list,
};
use crate::capi::at_configuration::explain::cstk_verdict;
use crate::capi::at_configuration::find_link_pairs::cstk_link_pair;
use crate::capi::depth::cstk_signed_distance;
use crate::capi::environment::environment::cstk_environment;
use crate::capi::motion::path::cstk_path;
use crate::capi::object_pairs::cstk_object_pair;
use crate::capi::status::status::cstk_status;
use crate::environment::Environment;
use crate::error::{Error, ErrorKind};
use crate::exclusive::Exclusive;
use crate::pose::Pose;
use crate::query::{
    ContactsListed, LinkPair, PairVerdict, PenetrationList, QueryContext, WitnessList,
};
use crate::work_meter::Statistics;

/// One thread's caches and scratch memory, and the owner of the arrays in its results. A context serves one thread at a
/// time; other calls meanwhile return CSTK_ERROR_BUSY. Create one per thread. Caches change how long an answer takes, never
/// the answer.
pub struct cstk_query {
    _opaque: [u8; 0],
}

/// A context and the arrays of its last answer.
#[derive(Default)]
pub(super) struct State {
    pub context: QueryContext,
    witnesses: Vec<cstk_witness>,
    contacts: Vec<cstk_contact>,
    pub gradients: Vec<f64>,
    pub signed_distances: Vec<cstk_signed_distance>,
    penetrations: Vec<cstk_penetration>,
    pub verdicts: Vec<cstk_verdict>,
    pub pairs: Vec<cstk_link_pair>,
    pub tested: Vec<u32>,
    path: Vec<f64>,
    pub object_pairs: Vec<cstk_object_pair>,
    pub distances: Vec<cstk_distance_result>,
    /// Memory for a gradient.
    pub row: Vec<f64>,
    /// Memory for the link poses passed to a call.
    pub poses: Vec<Pose>,
}

pub(super) struct Query(Exclusive<State>);

impl Noun for Query {
    type Handle = cstk_query;
    const KIND: u32 = 8;
    const NAME: &'static str = "cstk_query";
}

/// Refills an array, reusing its memory.
pub(super) fn refill<'a, T: 'a, U: From<&'a T>>(array: &mut Vec<U>, items: &'a [T]) {
    array.clear();
    array.extend(items.iter().map(From::from));
}

impl State {
    /// After a panic: drops caches and scratch memory, which may be inconsistent. The settings stay.
    #[cold]
    #[inline(never)]
    fn renew(&mut self) {
        let renewed = self.context.renewed();
        *self = Self {
            context: renewed,
            ..Self::default()
        };
    }

    /// Stores a list, and returns a view of its array.
    pub fn keep_penetrations(&mut self, list: &PenetrationList) -> cstk_penetration_list {
        refill(&mut self.penetrations, &list.penetrations);
        cstk_penetration_list {
            penetrations: start(&self.penetrations),
            count: self.penetrations.len(),
            of_whole_bodies: list.of_whole_bodies,
            truncated: list.truncated,
            reserved_bytes: [0; 6],
            reserved: [0; 5],
        }
    }

    /// Stores link pairs, and which of them to test.
    pub fn keep_pairs(&mut self, pairs: &[LinkPair], skip_never: bool) {
        refill(&mut self.pairs, pairs);
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

    /// Stores a path of a space with `nq` coordinates, and returns a view of it.
    pub fn keep_path(&mut self, points: Vec<f64>, nq: usize) -> cstk_path {
        self.path = points;
        cstk_path {
            points: start(&self.path),
            // Without coordinates there is one configuration, of no numbers.
            count: self.path.len().checked_div(nq).unwrap_or(1),
            nq,
            reserved: [0; 3],
        }
    }

    /// Stores a list, and returns a view of its arrays.
    pub fn keep(&mut self, list: WitnessList) -> cstk_witness_list {
        refill(&mut self.witnesses, &list.witnesses);
        refill(&mut self.contacts, &list.contacts);
        self.gradients = list.gradients;
        cstk_witness_list {
            witnesses: start(&self.witnesses),
            witness_count: self.witnesses.len(),
            contacts: start(&self.contacts),
            contact_count: self.contacts.len(),
            gradients: start(&self.gradients),
            nv: list.nv,
            truncated: list.truncated,
            contacts_left_out: self.context.contacts() != ContactsListed::All,
            reserved_bytes: [0; 6],
            environment_version: list.version,
            reserved: [0; 8],
        }
    }
}

/// Runs a query with exclusive access to the context.
pub(super) fn with_query(
    query: *mut cstk_query,
    action: impl FnOnce(&mut State) -> Result<(), Failure>,
) -> Result<(), Failure> {
    exclusively_with(&*handle::share::<Query>(query, "query")?, action)
}

/// The same for an action that runs no callbacks.
#[inline(always)]
pub(super) fn with_borrowed_query(
    query: *mut cstk_query,
    action: impl FnOnce(&mut State) -> Result<(), Failure>,
) -> Result<(), Failure> {
    exclusively_with(handle::borrowed::<Query>(query, "query")?, action)
}

#[inline(always)]
fn exclusively_with(
    query: &Query,
    action: impl FnOnce(&mut State) -> Result<(), Failure>,
) -> Result<(), Failure> {
    query.0.with("the query context", State::renew, action)
}

/// Creates a query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_create(out: *mut *mut cstk_query) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(Query(Exclusive::default()))));
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

/// Writes the version of an environment that the last query of a C-object, of objects or of a configuration with this context saw, also
/// one that failed after it began to look; queries of two bodies or of a space's link pairs see none and change nothing. CSTK_ERROR_NOT_FOUND
/// if that query's C-object does not refer to the environment, or there was no such query yet.
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

/// Which contacts are computed for each witness of a list (cstk_query_set_contacts). They take most of the time of a
/// witness.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_contacts_listed {
    /// All contacts: parallel features have several. The initial setting of a context.
    CSTK_CONTACTS_ALL = 0,
    /// The contact at the witness points.
    CSTK_CONTACTS_NEAREST = 1,
    /// No contacts and no gradients. Touching and overlapping are then not distinguished: `overlapping` is true at distance
    /// 0.
    CSTK_CONTACTS_NONE = 2,
}

/// Sets which contacts cstk_witnesses, cstk_gradients, cstk_pseudo_normal, cstk_pair_witnesses and their variants compute
/// with this context from now on; `listed` is a cstk_contacts_listed. Witnesses and their distances do not depend on it.
/// cstk_slide ignores it; cstk_slide_step and cstk_spring_step need lists with all contacts. CSTK_ERROR_INVALID_ARGUMENT
/// for another number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_set_contacts(
    query: *mut cstk_query,
    listed: i32,
) -> cstk_status {
    guard(|| {
        let listed = match listed {
            x if x == cstk_contacts_listed::CSTK_CONTACTS_ALL as i32 => ContactsListed::All,
            x if x == cstk_contacts_listed::CSTK_CONTACTS_NEAREST as i32 => ContactsListed::Nearest,
            x if x == cstk_contacts_listed::CSTK_CONTACTS_NONE as i32 => ContactsListed::None,
            other => {
                let message = format!("{other} is none of cstk_contacts_listed");
                return Err(Error::invalid(message).into());
            }
        };
        with_query(query, |state| {
            state.context.set_contacts(listed);
            Ok(())
        })
    })
}

/// Limits the work of each later query with this context to `node_and_primitive_pairs`: of every call that takes the
/// context and answers, or slides, from cstk_pair_within to cstk_find_link_pairs. A query that needs more returns
/// CSTK_ERROR_LIMIT and writes nothing; those that have an outcome for it, as motions, boxes of C-space and slides, end with that, and
/// write what they have proved. The context can be used again at once. 0, the initial setting, means no limit.
///
/// Work is what cstk_query_statistics counts as `node_pairs` and `primitive_pairs`: a million takes from 10 milliseconds
/// (nodes of meshes) to a second (primitives other than polygons). Penetrations of polyhedra also count each two edges that
/// are compared. The work depends on the query and on what the context remembers of earlier ones, not on the thread or on
/// the machine's load: contexts that run the same queries from creation on reach the limit at the same call. Fixed costs of
/// a call do not count: kinematics, callbacks, and pure sets but where a proof looks at one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_set_limit(
    query: *mut cstk_query,
    node_and_primitive_pairs: u64,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let limit = (node_and_primitive_pairs > 0).then_some(node_and_primitive_pairs);
            state.context.set_limit(limit);
            Ok(())
        })
    })
}

/// Has later queries with this context refine the curved surfaces that bodies stand for (cstk_body_builder_add_bezier_patch and
/// cstk_body_builder_add_nurbs_surface) until their answers are known to `gap`, in your unit; INFINITY, the initial setting, for never.
///
/// Without it an answer knows a curved surface up to the deviation that its body states. With it
///
/// - the bounds of a distance are at most `gap` apart (cstk_distance, cstk_pair_distance and their variants),
/// - thresholds and classes are decided unless the distance is within `gap` of the threshold; doubt counts as within
///   (cstk_classify, cstk_within, cstk_pair_within and their variants).
///
/// Witness points and normals are those of the refined parts, features and tags those of the triangles. What is about equally near
/// over much of a surface ends after 16384 steps, with the bounds that are proved by then: the distance is CSTK_DISTANCE_LOWER_BOUND
/// where they are farther apart than `gap`. Each step counts as one of `node_pairs` (cstk_query_set_limit).
///
/// Not refined are lists of witnesses, verdicts (cstk_explain: its class too), the class and distance of cstk_pseudo_normal, queries of all pairs of objects, motions, regions, slides, maps, batches (they have
/// contexts of their own), depths and signed distances; bodies whose builder was told of a deviation (cstk_body_builder_set_deviation), bodies read from files, refitted
/// bodies, and surfaces with more than 2^20 control points once knots are inserted: they are answered for as without it. Bodies made of others (cstk_body_builder_add_body) are refined as these are.
///
/// CSTK_ERROR_INVALID_ARGUMENT for a gap that is not above 0, CSTK_ERROR_NOT_FINITE for NaN.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_query_set_refinement(
    query: *mut cstk_query,
    gap: f64,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let gap = (gap != f64::INFINITY).then_some(gap);
            Ok(state.context.set_refinement(gap)?)
        })
    })
}

/// The work done by a query context.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_query_statistics {
    /// Pairs of hierarchy nodes whose wrappers were tested, including pairs of bodies; for rays into solids, the nodes; for motions and
    /// regions, what is decided without nodes too: a look each.
    pub node_pairs: u64,
    /// Primitive pairs tested; for rays, the faces.
    pub primitive_pairs: u64,
    /// Witnesses of earlier queries that were tested first.
    pub cache_hits: u64,
    /// Those of `primitive_pairs` whose distance was computed, not polygons that a remembered direction separates.
    pub primitive_distances: u64,
    pub reserved: [u64; 4],
}

/// Writes the work done since the context was created, or since the last call with `reset`; `reset` sets the counts to 0.
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
            out.write(done.into());
            Ok(())
        })
    })
}

impl From<Statistics> for cstk_query_statistics {
    fn from(done: Statistics) -> Self {
        Self {
            node_pairs: done.node_pairs,
            primitive_pairs: done.primitive_pairs,
            cache_hits: done.cache_hits,
            primitive_distances: done.primitive_distances,
            reserved: [0; 4],
        }
    }
}
