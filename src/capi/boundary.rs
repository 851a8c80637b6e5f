//! The guard that every exported function runs in: errors and panics become a status and this thread's message.

use std::cell::RefCell;
use std::ffi::{CString, c_char};

use crate::capi::status::status::cstk_status;
use crate::contained::contained;
use crate::error::Error;

/// A failure at the boundary: the status and the message.
#[derive(Debug)]
pub struct Failure {
    pub status: cstk_status,
    pub message: String,
}

impl Failure {
    pub fn new(status: cstk_status, message: impl Into<String>) -> Self {
        Self {
            status,
            message: message.into(),
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::new(error.kind.into(), error.message)
    }
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Runs a call. A failure, or a panic, is recorded as this thread's last error.
pub fn guard(call: impl FnOnce() -> Result<(), Failure>) -> cstk_status {
    let failure = match contained(call) {
        Ok(Ok(())) => return cstk_status::CSTK_OK,
        Ok(Err(failure)) => failure,
        Err(panic) => panic.into(),
    };
    keep_message(failure.message);
    failure.status
}

/// Records this thread's last error.
pub fn keep_message(message: String) {
    let text = CString::new(message.replace('\0', " ")).unwrap_or_default();
    // While a thread exits its message may be gone already; the status remains.
    let _ = MESSAGE.try_with(|message| message.replace(text));
}

/// The message of this thread's last failed call; empty if none has failed.
pub fn last_message() -> *const c_char {
    MESSAGE
        .try_with(|message| message.borrow().as_ptr())
        .unwrap_or(c"".as_ptr())
}
