//! Motions that a function gives.

use std::ffi::c_void;

use super::motion::{ask_motion, cstk_motion_options, cstk_motion_result};
use super::path::size;
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::input::slice;
use crate::capi::query::cstk_query;
use crate::capi::status::status::cstk_status;
use crate::error::{Error, ErrorKind, Result};
use crate::motion::{MotionBounds, MotionFunction, MotionMoment};

/// Writes a motion's configuration at time `t`, from 0 to 1, into `q`, and the first and second derivatives of its coordinates by the
/// time into `rates` and `accelerations`: `nq` doubles each. Anything but 0 (CSTK_OK) ends the call with
/// CSTK_ERROR_CALLBACK_FAILED. It must give the same at the same time, and must not throw. It is called on the thread that made the
/// call; it may call the library with other query contexts.
pub type cstk_motion_fn = Option<
    unsafe extern "C" fn(
        t: f64,
        q: *mut f64,
        rates: *mut f64,
        accelerations: *mut f64,
        nq: usize,
        user: *mut c_void,
    ) -> i32,
>;

/// Proves that a motion that `function` gives keeps clear of a C-object, or finds its first contact, as cstk_motion does on a segment.
/// `user` is passed to `function`. `max_rates` and `max_accelerations` have `nq` doubles each, at least 0: bounds of the absolute
/// first and second derivatives of every coordinate for all times from 0 to 1. The configuration and its first derivative are
/// continuous; the second may jump. What is proved holds if the rates are the derivatives of q and these bounds hold. Both are
/// compared with what `function` gives wherever it is asked, at times in any order, and CSTK_ERROR_INVALID_ARGUMENT names the time and
/// the coordinate that does not fit.
///
/// Coordinates on circles are not taken the shorter way round. Coordinates of joints with quaternions must not change, and their
/// max_rates be 0: CSTK_ERROR_UNSUPPORTED otherwise. `options`, `reached` and `out` as for cstk_motion. CSTK_ERROR_WRONG_SIZE if `nq`
/// is not that of the space.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_motion_function(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    function: cstk_motion_fn,
    user: *mut c_void,
    max_rates: *const f64,
    max_accelerations: *const f64,
    nq: usize,
    options: *const cstk_motion_options,
    reached: *mut f64,
    out: *mut cstk_motion_result,
) -> cstk_status {
    guard(|| {
        ask_motion(query, cobject, nq, options, reached, out, |asked| {
            let function = Function::checked(function, user)?;
            let numbers = size(asked.cobject, 1, nq)?;
            // SAFETY: checked for NULL; the caller states the lengths.
            let (max_rates, max_accelerations) = unsafe {
                (
                    slice(max_rates, numbers, "max_rates")?,
                    slice(max_accelerations, numbers, "max_accelerations")?,
                )
            };
            let bounds = &MotionBounds {
                max_rates,
                max_accelerations,
            };
            let context = asked.context;
            let answer =
                context.motion_on_function(asked.cobject, &function, bounds, &asked.options)?;
            let result = (&answer).into();
            Ok((answer.configuration, result))
        })
    })
}

/// The caller's function with its data.
struct Function {
    function: unsafe extern "C" fn(f64, *mut f64, *mut f64, *mut f64, usize, *mut c_void) -> i32,
    user: *mut c_void,
}

impl Function {
    fn checked(function: cstk_motion_fn, user: *mut c_void) -> std::result::Result<Self, Failure> {
        let function = function.ok_or_else(|| {
            Failure::new(cstk_status::CSTK_ERROR_NULL_ARGUMENT, "function is NULL")
        })?;
        Ok(Self { function, user })
    }
}

impl MotionFunction for Function {
    fn at(&self, t: f64, moment: &mut MotionMoment) -> Result<()> {
        let (q, rates) = (moment.q.as_mut_ptr(), moment.rates.as_mut_ptr());
        let accelerations = moment.accelerations.as_mut_ptr();
        // SAFETY: the caller gives a function of this type; the lists have as many entries as the space has coordinates.
        let status =
            unsafe { (self.function)(t, q, rates, accelerations, moment.q.len(), self.user) };
        if status == 0 {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::Callback,
            format!("the motion function returned {status} at time {t}"),
        ))
    }
}
