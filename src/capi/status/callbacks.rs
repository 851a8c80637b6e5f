//! The callbacks that several sections take.

use std::ffi::c_void;

use crate::error::{Error, ErrorKind};

/// Releases user data: called once, when nothing refers to them any more. It may call the
/// library; it must not throw.
pub type cstk_destroy_fn = Option<unsafe extern "C" fn(user: *mut c_void)>;

/// Receives the progress of a long call, from 0 to 1. Anything but 0 (CSTK_OK) ends the call with CSTK_ERROR_CANCELLED. It
/// is called on the thread that made the call; it must not throw.
pub type cstk_progress_fn = Option<unsafe extern "C" fn(fraction: f64, user: *mut c_void) -> i32>;

/// Wraps the caller's progress function, if there is one.
pub(crate) fn reporter(
    progress: cstk_progress_fn,
    user: *mut c_void,
) -> impl FnMut(f64) -> Result<(), Error> {
    move |fraction| match progress {
        // SAFETY: the caller gives a function of this type.
        Some(progress) if unsafe { progress(fraction, user) } != 0 => Err(Error::new(
            ErrorKind::Cancelled,
            "the progress function ended the work",
        )),
        _ => Ok(()),
    }
}
