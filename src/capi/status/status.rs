//! Status codes, whose numbers never change meaning.

use std::ffi::c_char;

use crate::capi::boundary::last_message;
use crate::error::ErrorKind;

/// The status of a call. Every call that can fail returns one; after any but CSTK_OK, cstk_last_error_message() says which
/// argument, which polygon, which line. A failed call has changed nothing and written no output.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cstk_status {
    /// The call succeeded.
    CSTK_OK = 0,
    /// A pointer that must not be NULL is.
    CSTK_ERROR_NULL_ARGUMENT = 1,
    /// A handle is of another kind, or was released.
    CSTK_ERROR_WRONG_HANDLE = 2,
    /// An options structure was not written by its _default function, or is damaged.
    CSTK_ERROR_NOT_INITIALISED = 3,
    /// An argument is outside its documented range.
    CSTK_ERROR_INVALID_ARGUMENT = 4,
    /// A number is NaN or infinite where a finite one is needed.
    CSTK_ERROR_NOT_FINITE = 5,
    /// An array or structure has the wrong size.
    CSTK_ERROR_WRONG_SIZE = 6,
    /// No item was given where at least one is needed: a body without primitives, a robot without links.
    CSTK_ERROR_EMPTY = 7,
    /// Geometry without extent: a repeated vertex, a polygon without area, an axis of length 0.
    CSTK_ERROR_DEGENERATE = 8,
    /// A polygon that turns inwards, winds more than once, or crosses itself.
    CSTK_ERROR_NOT_CONVEX = 9,
    /// A polygon whose vertices leave its plane, or a planar body that leaves z = 0.
    CSTK_ERROR_NOT_PLANAR = 10,
    /// The 3 x 3 part of a pose is not a rotation.
    CSTK_ERROR_NOT_A_ROTATION = 11,
    /// An id, index or name that does not exist.
    CSTK_ERROR_NOT_FOUND = 12,
    /// Something that the library does not support: an unknown file format, a change to a snapshot.
    CSTK_ERROR_UNSUPPORTED = 13,
    /// The operating system could not read or write a file.
    CSTK_ERROR_IO = 14,
    /// A file's contents cannot be understood; it may be truncated.
    CSTK_ERROR_PARSE = 15,
    /// A result could not be certified.
    CSTK_ERROR_NOT_CONVERGED = 16,
    /// The caller's progress function stopped the call; of an item of a batch: it was not reached.
    CSTK_ERROR_CANCELLED = 17,
    /// The object is in use by another thread, or by the call whose callback makes this one.
    CSTK_ERROR_BUSY = 18,
    /// An internal fault of the library, which was contained; please report it with the message.
    CSTK_ERROR_INTERNAL = 19,
    /// A callback failed; the message names it and what it returned.
    CSTK_ERROR_CALLBACK_FAILED = 20,
    /// A body was declared solid whose surface is not closed; the message names open edges.
    CSTK_ERROR_NOT_CLOSED = 21,
    /// The query needs more work than cstk_query_set_limit allows.
    CSTK_ERROR_LIMIT = 22,
    /// There is not enough memory for the input.
    CSTK_ERROR_OUT_OF_MEMORY = 23,
    /// A certificate does not prove what is asked; the message names the entry.
    CSTK_ERROR_NOT_PROVED = 24,
}

impl From<ErrorKind> for cstk_status {
    fn from(kind: ErrorKind) -> Self {
        match kind {
            ErrorKind::InvalidArgument => Self::CSTK_ERROR_INVALID_ARGUMENT,
            ErrorKind::NotFinite => Self::CSTK_ERROR_NOT_FINITE,
            ErrorKind::WrongSize => Self::CSTK_ERROR_WRONG_SIZE,
            ErrorKind::Empty => Self::CSTK_ERROR_EMPTY,
            ErrorKind::Degenerate => Self::CSTK_ERROR_DEGENERATE,
            ErrorKind::NotConvex => Self::CSTK_ERROR_NOT_CONVEX,
            ErrorKind::NotPlanar => Self::CSTK_ERROR_NOT_PLANAR,
            ErrorKind::NotClosed => Self::CSTK_ERROR_NOT_CLOSED,
            ErrorKind::NotARotation => Self::CSTK_ERROR_NOT_A_ROTATION,
            ErrorKind::NotFound => Self::CSTK_ERROR_NOT_FOUND,
            ErrorKind::Unsupported => Self::CSTK_ERROR_UNSUPPORTED,
            ErrorKind::Io => Self::CSTK_ERROR_IO,
            ErrorKind::Parse => Self::CSTK_ERROR_PARSE,
            ErrorKind::NotConverged => Self::CSTK_ERROR_NOT_CONVERGED,
            ErrorKind::Cancelled => Self::CSTK_ERROR_CANCELLED,
            ErrorKind::Busy => Self::CSTK_ERROR_BUSY,
            ErrorKind::OutOfMemory => Self::CSTK_ERROR_OUT_OF_MEMORY,
            ErrorKind::Callback => Self::CSTK_ERROR_CALLBACK_FAILED,
            ErrorKind::Limit => Self::CSTK_ERROR_LIMIT,
            ErrorKind::NotProved => Self::CSTK_ERROR_NOT_PROVED,
            ErrorKind::Internal => Self::CSTK_ERROR_INTERNAL,
        }
    }
}

/// Returns the name of a status, such as "CSTK_ERROR_NOT_FINITE"; "unknown status" for an unknown number. Never NULL;
/// static.
#[unsafe(no_mangle)]
pub extern "C" fn cstk_status_name(status: i32) -> *const c_char {
    let name = match status {
        0 => c"CSTK_OK",
        1 => c"CSTK_ERROR_NULL_ARGUMENT",
        2 => c"CSTK_ERROR_WRONG_HANDLE",
        3 => c"CSTK_ERROR_NOT_INITIALISED",
        4 => c"CSTK_ERROR_INVALID_ARGUMENT",
        5 => c"CSTK_ERROR_NOT_FINITE",
        6 => c"CSTK_ERROR_WRONG_SIZE",
        7 => c"CSTK_ERROR_EMPTY",
        8 => c"CSTK_ERROR_DEGENERATE",
        9 => c"CSTK_ERROR_NOT_CONVEX",
        10 => c"CSTK_ERROR_NOT_PLANAR",
        11 => c"CSTK_ERROR_NOT_A_ROTATION",
        12 => c"CSTK_ERROR_NOT_FOUND",
        13 => c"CSTK_ERROR_UNSUPPORTED",
        14 => c"CSTK_ERROR_IO",
        15 => c"CSTK_ERROR_PARSE",
        16 => c"CSTK_ERROR_NOT_CONVERGED",
        17 => c"CSTK_ERROR_CANCELLED",
        18 => c"CSTK_ERROR_BUSY",
        19 => c"CSTK_ERROR_INTERNAL",
        20 => c"CSTK_ERROR_CALLBACK_FAILED",
        21 => c"CSTK_ERROR_NOT_CLOSED",
        22 => c"CSTK_ERROR_LIMIT",
        23 => c"CSTK_ERROR_OUT_OF_MEMORY",
        24 => c"CSTK_ERROR_NOT_PROVED",
        _ => c"unknown status",
    };
    name.as_ptr()
}

/// Returns the message of this thread's last failed call; empty if none has failed. Valid until the next failure on this
/// thread. Never NULL; UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn cstk_last_error_message() -> *const c_char {
    last_message()
}
