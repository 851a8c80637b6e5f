//! Pictures.
//!
//! Robots among obstacles as glTF files.
//!
//! ```c
//! check(cstk_show(cobject, q, nq, "cell.glb"));
//! ```

use std::ffi::c_char;

use super::boundary::guard;
use super::handle;
use super::input::{path, slice};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::show::show;

/// Writes the scene at q to a .glb file (glTF; the report's show-c-object): links, s-objects, the nearest pair of points
/// and the contacts within the contact epsilon (red), each contact's normal (green) and the direction in which its point
/// moves along the gradient (blue). Distances and gradients are in the nodes' extras. `q` has `nq` doubles. The name must
/// end in .glb (CSTK_ERROR_UNSUPPORTED otherwise). The file is written whole or not at all; CSTK_ERROR_IO if that fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_show(
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    file: *const c_char,
) -> cstk_status {
    guard(|| {
        let cobject = handle::share::<CObject>(cobject, "cobject")?;
        // SAFETY: checked for NULL; the caller states the length and the terminator.
        let (q, file) = unsafe { (slice(q, nq, "q")?, path(file, "file")?) };
        Ok(show(&cobject, q, file)?)
    })
}
