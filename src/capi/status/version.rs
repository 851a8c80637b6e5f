//! The version of the library.

use std::ffi::c_char;

/// The version this header belongs to.
pub const CSTK_VERSION_MAJOR: u32 = 0;
pub const CSTK_VERSION_MINOR: u32 = 1;
pub const CSTK_VERSION_PATCH: u32 = 0;

/// Returns the version of the library that is linked, as "major.minor.patch"; static.
#[unsafe(no_mangle)]
pub extern "C" fn cstk_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}
