//! Pure sets: C-objects given by coordinates, or by functions of the caller.

use std::sync::Arc;

use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::cobject::predicate::{Functions, cstk_predicate};
use crate::capi::handle;
use crate::capi::input::{
    OptionsStruct, Output, collected, options, options_or_default, slice, write_defaults,
};
use crate::capi::space::space::cstk_space;
use crate::capi::status::status::cstk_status;
use crate::cobject::{CObject, PureOptions, PureShape};
use crate::pose::Vec3;
use crate::space::Space;

/// How a pure set measures. Write it with cstk_pure_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_pure_options {
    pub size: u32,
    pub cookie: u32,
    /// Distances above 0 and up to this classify as CSTK_CLASS_CONTACT; in units of C-space, for floors and the world box in
    /// lengths. Default 0.
    pub contact_epsilon: f64,
    /// The length that a unit of C-space stands for. Distances of the set are multiplied by it, and so can be compared with
    /// those of induced sets; 0, the default: they are not, and queries of distance of both together are refused.
    pub scale: f64,
}

// SAFETY: repr(C), two u32 and two doubles.
unsafe impl OptionsStruct for cstk_pure_options {
    const COOKIE: u32 = 0x4353_0402;
    const NAME: &'static str = "cstk_pure_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            contact_epsilon: 0.0,
            scale: 0.0,
        }
    }
}

/// Writes the default options. `size` is sizeof(cstk_pure_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_pure_options_default(
    out: *mut cstk_pure_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

unsafe fn make(
    space: *const cstk_space,
    given: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
    shape: impl FnOnce(&Space) -> Result<PureShape, Failure>,
) -> Result<(), Failure> {
    let space = handle::share::<Space>(space, "space")?;
    let out = Output::checked(out, "out")?;
    // SAFETY: checked for size and cookie.
    let given = unsafe { options_or_default(given, "options")? };
    let options = PureOptions {
        contact_epsilon: given.contact_epsilon,
        scale: (given.scale != 0.0).then_some(given.scale),
    };
    let shape = shape(&space)?;
    let made = CObject::pure(space, shape, options)?;
    out.write(handle::create(Arc::new(made)));
    Ok(())
}

/// One number a coordinate. Their count is checked before they are read.
unsafe fn coordinates(
    space: &Space,
    values: *const f64,
    nq: usize,
    name: &str,
) -> Result<Vec<f64>, Failure> {
    if nq != space.nq() {
        let coordinates = space.nq();
        return Err(Failure::new(
            cstk_status::CSTK_ERROR_WRONG_SIZE,
            format!("{name} has {nq} entries, but the space has {coordinates} coordinates"),
        ));
    }
    // SAFETY: as the caller states.
    Ok(unsafe { slice(values, nq, name)? }.to_vec())
}

/// Makes the set of configurations with a coordinate beyond its range in the space: the joint limits as an obstacle. At a
/// limit the configuration is not inside yet (the set is open). Distances are those from the nearest limit, in units of the
/// coordinates. `options` may be NULL for the defaults, here and below. A space without limits gives an empty set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_beyond_limits(
    space: *const cstk_space,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: as the caller states.
    guard(|| unsafe { make(space, options, out, |_| Ok(PureShape::BeyondLimits)) })
}

/// Makes the set of configurations at which the origin of some link is outside the world box of the space. It measures in
/// lengths, whatever the scale, and answers at link poses too. Open, as cstk_cobject_beyond_limits.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_beyond_world(
    space: *const cstk_space,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: as the caller states.
    guard(|| unsafe {
        make(space, options, out, |space| {
            Ok(PureShape::beyond_world(space))
        })
    })
}

/// Makes the set of configurations at which the body of a link reaches the half-space normal . x <= offset of the world
/// (`normal`: three doubles of any length; in the plane its z is 0): a floor, a wall or a ceiling without end. `links` holds
/// `link_count` numbers of links; with `link_count` 0 all that have a body are meant. Leave out a base that stands on the
/// floor. A margin is had by a larger offset. What links hold is not tested: where they carry something, a large box in the
/// environment sees that.
///
/// Exact, and asked in logarithmic time: it measures in lengths, whatever the scale, to the lowest point of all, and answers
/// at link poses too. Contacts are at that point (see CSTK_MODE_PURE_SET), and have a gradient where it is inside as well. The
/// distance from its complement is not known where it is not 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_below_floor(
    space: *const cstk_space,
    links: *const u32,
    link_count: usize,
    normal: *const f64,
    offset: f64,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the lengths.
    guard(|| unsafe {
        make(space, options, out, |space| {
            let links = slice(links, link_count, "links")?;
            let links = collected(links.iter().map(|&link| link as usize), "links")?;
            let normal = slice(normal, 3, "normal")?;
            let normal = Vec3::new(normal[0], normal[1], normal[2]);
            Ok(PureShape::floor(space, &links, &normal, offset)?)
        })
    })
}

/// Makes the set of configurations whose every coordinate i is from low[i] to high[i] (`nq` doubles each; -INFINITY and
/// INFINITY leave a coordinate free, and must do so for quaternions). On a circle the interval is the arc from low[i]
/// upwards to high[i], which is no less: from 3 to 4, say, past pi; it has two ends or none. The distance is the root of
/// the sum of the squares, angles the shorter way round.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_box(
    space: *const cstk_space,
    low: *const f64,
    high: *const f64,
    nq: usize,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the lengths.
    guard(|| unsafe {
        make(space, options, out, |space| {
            Ok(PureShape::Box {
                low: coordinates(space, low, nq, "low")?,
                high: coordinates(space, high, nq, "high")?,
            })
        })
    })
}

/// Makes the set of configurations with normal . q <= offset (`nq` doubles). Entries for coordinates on circles and of
/// quaternions must be 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_halfspace(
    space: *const cstk_space,
    normal: *const f64,
    nq: usize,
    offset: f64,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    guard(|| unsafe {
        make(space, options, out, |space| {
            let normal = coordinates(space, normal, nq, "normal")?;
            Ok(PureShape::HalfSpace { normal, offset })
        })
    })
}

/// Makes the set of configurations at most `radius` from `center` (`nq` doubles): by the root of the sum of the squares of
/// differences, angles the shorter way round, quaternions by the angle of the turn, free joints by shift and turn.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_ball(
    space: *const cstk_space,
    center: *const f64,
    nq: usize,
    radius: f64,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    guard(|| unsafe {
        make(space, options, out, |space| {
            let center = coordinates(space, center, nq, "center")?;
            Ok(PureShape::Ball { center, radius })
        })
    })
}

/// Makes a set that functions of the caller define. `predicate` is copied; its data are given back when nothing refers to the
/// set any more, and not when this call fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_predicate(
    space: *const cstk_space,
    predicate: *const cstk_predicate,
    options: *const cstk_pure_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        // SAFETY: checked for NULL, size and cookie.
        let given = unsafe { self::options(predicate, "predicate")? };
        let functions = Arc::new(Functions::new(&given)?);
        let shape = PureShape::Predicate(functions.clone());
        // SAFETY: as the caller states.
        unsafe { make(space, options, out, |_| Ok(shape))? };
        functions.take_ownership();
        Ok(())
    })
}
