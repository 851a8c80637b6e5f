//! Objects against objects.
//!
//! The objects of an environment, each with each, or with each of a second environment, without a robot: what is near in a
//! simulation of contacts, a scene as it is loaded, a bin of parts. All near pairs are found in one run through the tree over the
//! objects; each answer is that of the pair query of the two bodies. Objects that are attached to links have no place here:
//! CSTK_ERROR_UNSUPPORTED.
//!
//! ```c
//! cstk_object_pair_list near;
//! cstk_witness_list touching;
//! check(cstk_environment_pairs(query, environment, NULL, 0.01, 4096, NULL, &near));
//! check(cstk_environment_witnesses(query, environment, NULL, 0.001, 4096, NULL, &touching));
//! ```

use std::ffi::c_void;

use super::boundary::{Failure, guard};
use super::handle;
use super::input::{OptionsStruct, Output, options_or_default, start, write_defaults};
use super::query::{State, cstk_query, refill, with_query};
use super::user_data::address;
use crate::capi::at_configuration::answers::{cstk_class, cstk_distance_result, cstk_witness_list};
use crate::capi::environment::environment::cstk_environment;
use crate::capi::status::status::cstk_status;
use crate::environment::{Environment, SObject};
use crate::error::{Error, ErrorKind};
use crate::query::{ObjectFilter, ObjectPair, ObjectPairList, ObjectSets};

/// Writes to `out` whether a pair of objects is asked about, by their ids and data. Returns CSTK_OK, or anything else to make the
/// query fail with CSTK_ERROR_CALLBACK_FAILED. It is called on the thread that made the call, for pairs that may be near, in any
/// order and possibly more than once; it must be pure, must not throw, and must not use the query context.
pub type cstk_object_filter_fn = Option<
    unsafe extern "C" fn(
        r_object: u64,
        s_object: u64,
        r_data: *mut c_void,
        s_data: *mut c_void,
        out: *mut bool,
        user: *mut c_void,
    ) -> i32,
>;

/// Options of the queries of objects against objects. Write it with cstk_object_pair_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_object_pair_options {
    pub size: u32,
    pub cookie: u32,
    /// NULL, the default, for all pairs.
    pub filter: cstk_object_filter_fn,
    /// Passed to the filter.
    pub user: *mut c_void,
    /// Nonzero: cstk_environment_pairs measures the distance of each pair that it lists. Default 0.
    pub with_distances: u32,
    pub reserved: u32,
}

// SAFETY: repr(C), two u32, two pointers, two u32: no padding; the function pointer is read as an option.
unsafe impl OptionsStruct for cstk_object_pair_options {
    const COOKIE: u32 = 0x4353_0405;
    const NAME: &'static str = "cstk_object_pair_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            filter: None,
            user: std::ptr::null_mut(),
            with_distances: 0,
            reserved: 0,
        }
    }
}

/// Two objects that are near each other. Within one environment `r_object` is the lower id; of two environments it is the object of
/// the first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_object_pair {
    pub r_object: u64,
    pub s_object: u64,
    /// The data of the objects, or of their bodies if they have none; NULL for none.
    pub r_data: *mut c_void,
    pub s_data: *mut c_void,
    /// CSTK_CLASS_INSIDE if they meet, else CSTK_CLASS_CONTACT.
    pub pair_class: cstk_class,
    pub reserved_word: u32,
    pub reserved: [u64; 2],
}

// SAFETY: the caller's addresses are only handed back, never followed.
unsafe impl Send for cstk_object_pair {}

/// Pairs of objects in order of ids. The arrays belong to the query context and stay valid until its next call or its release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_object_pair_list {
    pub pairs: *const cstk_object_pair,
    pub count: usize,
    /// The distance of each pair, with its witness and contact; NULL unless the options ask for them.
    pub distances: *const cstk_distance_result,
    /// There are more pairs than max_count; these have the lowest ids.
    pub truncated: bool,
    pub reserved_bytes: [u8; 7],
    /// The larger one of two environments.
    pub environment_version: u64,
    pub reserved: [u64; 4],
}

impl From<&ObjectPair> for cstk_object_pair {
    fn from(pair: &ObjectPair) -> Self {
        let [r_object, s_object] = pair.ids;
        Self {
            r_object,
            s_object,
            r_data: address(pair.data[0]),
            s_data: address(pair.data[1]),
            pair_class: pair.class.into(),
            reserved_word: 0,
            reserved: [0; 2],
        }
    }
}

/// Writes the default options: all pairs, without distances. `size` is sizeof(cstk_object_pair_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_object_pair_options_default(
    out: *mut cstk_object_pair_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Calls the caller's filter.
fn ask(options: &cstk_object_pair_options, r: &SObject, s: &SObject) -> Result<bool, Error> {
    let Some(filter) = options.filter else {
        return Ok(true);
    };
    let mut tested = true;
    let (r_data, s_data) = (address(r.data()), address(s.data()));
    // SAFETY: the caller gives a function of this type.
    let status = unsafe { filter(r.id, s.id, r_data, s_data, &mut tested, options.user) };
    if status == cstk_status::CSTK_OK as i32 {
        return Ok(tested);
    }
    Err(Error::new(
        ErrorKind::Callback,
        format!(
            "options->filter returned {status} for s-objects {} and {}",
            r.id, s.id
        ),
    ))
}

/// Checks the arguments that these queries share, and runs one.
unsafe fn run<T>(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    other: *const cstk_environment,
    options: *const cstk_object_pair_options,
    out: *mut T,
    action: impl FnOnce(
        &mut State,
        &mut ObjectSets,
        &cstk_object_pair_options,
        Output<T>,
    ) -> Result<(), Failure>,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let first = handle::share::<Environment>(environment, "environment")?;
            let second = if other.is_null() {
                None
            } else {
                Some(handle::share::<Environment>(other, "other")?)
            };
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for size and cookie.
            let options = unsafe { options_or_default(options, "options")? };
            let mut filter = |r: &SObject, s: &SObject| ask(&options, r, s);
            let filter: Option<&mut ObjectFilter> = match options.filter {
                Some(_) => Some(&mut filter),
                None => None,
            };
            let mut sets = ObjectSets::new(&first, second.as_deref(), filter)?;
            action(state, &mut sets, &options, out)
        })
    })
}

/// Writes the pairs of objects at most `distance` apart (not negative; may be INFINITY), with 0 those that meet, in order of ids:
/// of `environment` with `other`, or, where `other` is NULL, within `environment`, each pair once. Doubt within rounding counts as
/// within. If there are more than `max_count`, those with the lowest ids are listed and `truncated` is set. `options` may be NULL
/// for the defaults. The arrays stay valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_pairs(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    other: *const cstk_environment,
    distance: f64,
    max_count: usize,
    options: *const cstk_object_pair_options,
    out: *mut cstk_object_pair_list,
) -> cstk_status {
    // SAFETY: the caller states the sizes.
    unsafe {
        run(
            query,
            environment,
            other,
            options,
            out,
            |state, sets, options, out| {
                let measured = options.with_distances != 0;
                let context = &mut state.context;
                let list = context.environment_pairs(sets, distance, max_count, measured)?;
                out.write(state.keep_object_pairs(&list));
                Ok(())
            },
        )
    }
}

/// Writes whether any pair of objects is at most `threshold` apart (not negative; may be INFINITY); with 0, whether any two meet:
/// of `environment` with `other`, or, where `other` is NULL, within `environment`. Doubt within rounding counts as within. It stops
/// at the first pair. `options` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_within(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    other: *const cstk_environment,
    threshold: f64,
    options: *const cstk_object_pair_options,
    out: *mut bool,
) -> cstk_status {
    // SAFETY: the caller states the sizes.
    unsafe {
        run(
            query,
            environment,
            other,
            options,
            out,
            |state, sets, _, out| {
                out.write(state.context.environment_within(sets, threshold)?);
                Ok(())
            },
        )
    }
}

/// Writes the distance of the nearest pair of objects, their witness points and contact: of `environment` with `other`, or, where
/// `other` is NULL, within `environment`. Ties go to the lowest ids. The witness names the two as `r_object` and `s_object`.
/// Distances above `max_distance` are not computed: the result is then CSTK_DISTANCE_BEYOND_MAX. Without any pair it is
/// CSTK_DISTANCE_EMPTY. `options` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_distance(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    other: *const cstk_environment,
    max_distance: f64,
    options: *const cstk_object_pair_options,
    out: *mut cstk_distance_result,
) -> cstk_status {
    // SAFETY: the caller states the sizes.
    unsafe {
        run(
            query,
            environment,
            other,
            options,
            out,
            |state, sets, _, out| {
                let nearest = state.context.environment_distance(sets, max_distance)?;
                out.write((&nearest).into());
                Ok(())
            },
        )
    }
}

/// Writes all pairs of primitives of two objects at most `epsilon` apart, none missing, none twice, nearest first, and their
/// contacts: of `environment` with `other`, or, where `other` is NULL, within `environment`. They name the objects as `r_object`
/// and `s_object`. If there are more than `max_count`, the nearest are listed and `truncated` is set. `options` may be NULL. The
/// arrays stay valid until the next call with this query context.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_environment_witnesses(
    query: *mut cstk_query,
    environment: *const cstk_environment,
    other: *const cstk_environment,
    epsilon: f64,
    max_count: usize,
    options: *const cstk_object_pair_options,
    out: *mut cstk_witness_list,
) -> cstk_status {
    // SAFETY: the caller states the sizes.
    unsafe {
        run(
            query,
            environment,
            other,
            options,
            out,
            |state, sets, _, out| {
                let context = &mut state.context;
                let list = context.environment_witnesses(sets, epsilon, max_count)?;
                out.write(state.keep(list));
                Ok(())
            },
        )
    }
}

impl State {
    /// Stores a list, and returns a view of its arrays.
    fn keep_object_pairs(&mut self, list: &ObjectPairList) -> cstk_object_pair_list {
        refill(&mut self.object_pairs, &list.pairs);
        refill(&mut self.distances, &list.distances);
        cstk_object_pair_list {
            pairs: start(&self.object_pairs),
            count: self.object_pairs.len(),
            distances: start(&self.distances),
            truncated: list.truncated,
            reserved_bytes: [0; 7],
            environment_version: list.version,
            reserved: [0; 4],
        }
    }
}
