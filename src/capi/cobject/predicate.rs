//! Pure sets defined by callbacks.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::at_configuration::answers::cstk_class;
use crate::capi::boundary::{Failure, guard};
use crate::capi::input::{OptionsStruct, write_defaults};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::CallerData;
use crate::cobject::{Class, Predicate};
use crate::error::{Error, ErrorKind, Result};

/// Writes the class of configuration q (`nq` doubles), a cstk_class. Returns CSTK_OK, or anything else to make the query
/// fail with CSTK_ERROR_CALLBACK_FAILED.
pub type cstk_predicate_class_fn =
    Option<unsafe extern "C" fn(q: *const f64, nq: usize, out: *mut i32, user: *mut c_void) -> i32>;

/// Writes the signed distance of q from the set, in C-space units: positive where the class is not CSTK_CLASS_INSIDE,
/// otherwise 0 or minus the depth.
pub type cstk_predicate_distance_fn =
    Option<unsafe extern "C" fn(q: *const f64, nq: usize, out: *mut f64, user: *mut c_void) -> i32>;

/// Writes the derivative of that distance to `row`: `nv` doubles, one per velocity of cstk_space_step.
pub type cstk_predicate_gradient_fn = Option<
    unsafe extern "C" fn(
        q: *const f64,
        nq: usize,
        row: *mut f64,
        nv: usize,
        user: *mut c_void,
    ) -> i32,
>;

/// A set defined by callbacks. Write it with cstk_predicate_default first. The functions are called from any thread that
/// queries the set, concurrently, and from within queries; they must be pure, must not throw, and must not call back into
/// the running query. Slides refuse sets with predicates. Results are checked: a number that is not finite, an unknown
/// class, or a distance that contradicts the class is CSTK_ERROR_CALLBACK_FAILED.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_predicate {
    pub size: u32,
    pub cookie: u32,
    /// Must be set. It alone decides what is in contact; contact_epsilon of the options is ignored.
    pub classify: cstk_predicate_class_fn,
    /// May be NULL: then distances are unknown outside the set (CSTK_DISTANCE_LOWER_BOUND, from 0), as are distances from
    /// its complement where the class is not CSTK_CLASS_OUTSIDE, and the set has witnesses only where it holds q. Distances
    /// are at most 1e50.
    pub distance: cstk_predicate_distance_fn,
    /// May be NULL: then cstk_gradients and cstk_pseudo_normal are CSTK_ERROR_UNSUPPORTED within epsilon of the set. If
    /// `distance` is NULL too, the set has no gradients: no witness outside, one without a contact inside.
    pub gradient: cstk_predicate_gradient_fn,
    /// Passed to the functions.
    pub user: *mut c_void,
    /// May be NULL. Called once, by the thread that drops the last reference to whatever uses the functions.
    pub destroy: cstk_destroy_fn,
    /// 1 if the distance function gives lower bounds outside the set, 0 (the default) if it gives distances.
    pub distance_is_bound: u32,
    /// 1 if the distance function gives minus the depth inside (the exact distance from the complement). Default 0: what it gives
    /// below 0 then counts as 0.
    pub knows_depth: u32,
}

// SAFETY: repr(C), two u32, five pointers, two u32: no padding; function pointers are read as options.
unsafe impl OptionsStruct for cstk_predicate {
    const COOKIE: u32 = 0x4353_0403;
    const NAME: &'static str = "cstk_predicate";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            classify: None,
            distance: None,
            gradient: None,
            user: std::ptr::null_mut(),
            destroy: None,
            distance_is_bound: 0,
            knows_depth: 0,
        }
    }
}

/// Writes the defaults: no functions. `size` is sizeof(cstk_predicate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_predicate_default(
    out: *mut cstk_predicate,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// The caller's functions and their user data.
pub(crate) struct Functions {
    given: cstk_predicate,
    kept: Arc<CallerData>,
}

// SAFETY: the header asks that the functions may be called by any thread, several at once.
unsafe impl Send for Functions {}
// SAFETY: as above.
unsafe impl Sync for Functions {}

impl Functions {
    pub fn new(given: &cstk_predicate) -> std::result::Result<Self, Failure> {
        if given.classify.is_none() {
            return Err(Failure::new(
                cstk_status::CSTK_ERROR_NULL_ARGUMENT,
                "predicate->classify is NULL",
            ));
        }
        for (flag, name) in [
            (given.distance_is_bound, "distance_is_bound"),
            (given.knows_depth, "knows_depth"),
        ] {
            if flag > 1 {
                return Err(
                    Error::invalid(format!("predicate->{name} is {flag}, not 0 or 1")).into(),
                );
            }
        }
        Ok(Self {
            given: *given,
            kept: CallerData::new(given.user, given.destroy),
        })
    }

    /// From now on the data are released when nothing refers to them.
    pub fn take_ownership(&self) {
        self.kept.take_ownership();
    }
}

fn failed(name: &str, what: impl std::fmt::Display) -> Error {
    Error::new(
        ErrorKind::Callback,
        format!("the predicate's {name} function {what}"),
    )
}

fn check(status: i32, name: &str) -> Result<()> {
    if status != 0 {
        return Err(failed(name, format_args!("returned {status}")));
    }
    Ok(())
}

impl Predicate for Functions {
    fn classify(&self, q: &[f64]) -> Result<Class> {
        let Some(function) = self.given.classify else {
            return Ok(Class::Outside);
        };
        let mut class = -1;
        // SAFETY: the header states the lengths.
        let status = unsafe { function(q.as_ptr(), q.len(), &raw mut class, self.given.user) };
        check(status, "class")?;
        let is = |known: cstk_class| class == known as i32;
        if is(cstk_class::CSTK_CLASS_INSIDE) {
            Ok(Class::Inside)
        } else if is(cstk_class::CSTK_CLASS_CONTACT) {
            Ok(Class::Contact)
        } else if is(cstk_class::CSTK_CLASS_OUTSIDE) {
            Ok(Class::Outside)
        } else {
            Err(failed(
                "class",
                format_args!("wrote {class}, no cstk_class"),
            ))
        }
    }

    fn distance(&self, q: &[f64]) -> Result<Option<f64>> {
        let Some(function) = self.given.distance else {
            return Ok(None);
        };
        let mut distance = f64::NAN;
        // SAFETY: the header states the lengths.
        let status = unsafe { function(q.as_ptr(), q.len(), &raw mut distance, self.given.user) };
        check(status, "distance")?;
        if !distance.is_finite() {
            return Err(failed("distance", format_args!("wrote {distance}")));
        }
        Ok(Some(distance))
    }

    fn measures(&self) -> bool {
        self.given.distance.is_some()
    }

    fn is_exact(&self) -> bool {
        self.given.distance_is_bound == 0
    }

    fn knows_depth(&self) -> bool {
        self.given.knows_depth == 1
    }

    fn gradient(&self, q: &[f64], row: &mut [f64]) -> Result<bool> {
        let Some(function) = self.given.gradient else {
            return Ok(false);
        };
        let (out, nv) = (row.as_mut_ptr(), row.len());
        // SAFETY: the header states the lengths.
        let status = unsafe { function(q.as_ptr(), q.len(), out, nv, self.given.user) };
        check(status, "gradient")?;
        Ok(true)
    }
}
