//! Pure sets: C-objects given by coordinates, or by callbacks.

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

/// Options of a pure set. Write it with cstk_pure_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_pure_options {
    pub size: u32,
    pub cookie: u32,
    /// Distances above 0 and up to this classify as CSTK_CLASS_CONTACT; in C-space units, for floors and the world box in
    /// lengths. Default 0.
    pub contact_epsilon: f64,
    /// The length that a C-space unit stands for. Distances of the set are multiplied by it, which makes them comparable
    /// with those of induced sets. With 0, the default, they are not comparable, and distance queries on a set that mixes
    /// both are refused.
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
    let cobject = CObject::pure(space, shape, options)?;
    out.write(handle::create(Arc::new(cobject)));
    Ok(())
}

/// One number per coordinate; the count is checked before they are read.
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

/// Creates the set of configurations with a coordinate outside its range in the space: the joint limits as an obstacle. The
/// set is open: a configuration at a limit is not inside. Distances are measured to the nearest limit, in units of the
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

/// Creates the set of configurations at which the origin of some link is outside the world box of the space. It measures in
/// lengths, whatever the scale, and can be queried at link poses. Open, as cstk_cobject_beyond_limits.
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

/// Creates the set of configurations at which the body of a link meets the half-space normal . x <= offset of the world: an
/// unbounded floor, wall or ceiling. `normal` has three doubles and any length above 0; in the plane its z is 0. `links`
/// holds `link_count` link numbers; `link_count` 0 means all links with a body. Leave out a base that stands on the floor.
/// For a margin, increase the offset. Objects attached to links are not tested; a large box in the environment can test
/// them.
///
/// Queries are exact and take logarithmic time. The set measures in lengths, whatever the scale, to the lowest point of
/// all, and can be queried at link poses. Contacts are at that point (see CSTK_MODE_PURE_SET), and have a gradient inside
/// as well. The distance from the complement is unknown where it is not 0.
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

/// Creates the set of configurations with every coordinate i in [low[i], high[i]] (`nq` doubles each). -INFINITY and
/// INFINITY leave a coordinate free; for quaternions both are required. On a circle the interval is the arc from low[i]
/// upwards to high[i], which must not be less: from 3 to 4, say, past pi; it has two ends or none. The distance is the root
/// of the sum of squares, with angles the shorter way round.
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

/// Creates the set of configurations with normal . q <= offset (`normal` has `nq` doubles). Entries for coordinates on
/// circles and of quaternions must be 0.
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
            Ok(PureShape::HalfSpace {
                normal,
                offset,
                is_open: false,
            })
        })
    })
}

/// Creates the set of configurations within `radius` of `center` (`nq` doubles). The distance is the root of the sum of
/// squared differences: angles the shorter way round, quaternions by the angle of rotation, free joints by translation and
/// rotation.
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

/// Creates a set defined by callbacks. `predicate` is copied; its user data are released by `destroy` when nothing refers
/// to the set any more, and not if this call fails.
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
