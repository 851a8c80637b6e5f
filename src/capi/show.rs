//! Pictures.
//!
//! Robots among obstacles as glTF files, at a configuration or on a path.
//!
//! ```c
//! check(cstk_show(cobject, q, nq, "cell.glb"));
//! check(cstk_show_path(cobject, q, 1, nq, 8, "path.glb"));
//! ```

use std::ffi::c_char;

use super::boundary::guard;
use super::handle;
use super::input::{path, slice};
use super::motion::path::size;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::show::{show, show_path};

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

/// Writes a .glb file in which the robots move along a path among the s-objects: links and what is attached to them have a pose at every
/// point of the path, and at moments between that are at most 1/240 of the path apart. It takes `seconds`, larger than 0, at constant
/// speed, as cstk_space_distance measures without weights. `points` has count * nq doubles, one configuration after the other; `count`
/// is at least 1 and at most 10000. Whether the path is free is not asked. The name must end in .glb (CSTK_ERROR_UNSUPPORTED
/// otherwise). The file is written whole or not at all; CSTK_ERROR_IO if that fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_show_path(
    cobject: *const cstk_cobject,
    points: *const f64,
    count: usize,
    nq: usize,
    seconds: f64,
    file: *const c_char,
) -> cstk_status {
    guard(|| {
        let cobject = handle::share::<CObject>(cobject, "cobject")?;
        let numbers = size(&cobject, count, nq)?;
        // SAFETY: checked for NULL; the caller states the lengths and the terminator.
        let (points, file) = unsafe { (slice(points, numbers, "points")?, path(file, "file")?) };
        Ok(show_path(&cobject, points, seconds, file)?)
    })
}
