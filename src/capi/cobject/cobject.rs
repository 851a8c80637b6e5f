//! C-objects.

use std::sync::Arc;

use crate::capi::boundary::{Failure, guard};
use crate::capi::environment::environment::cstk_environment;
use crate::capi::handle;
use crate::capi::handle::Noun;
use crate::capi::input::{
    OptionsStruct, Output, collected, options_or_default, slice, write_defaults,
};
use crate::capi::space::space::cstk_space;
use crate::capi::status::status::cstk_status;
use crate::cobject::{AllowedPair, CObject, InducedOptions, LeftOut, SObjects};
use crate::environment::Environment;
use crate::error::{Error, ErrorKind};
use crate::space::Space;

/// A set in C-space: induced by contact or interference of links with s-objects or links, given by coordinates, or combined
/// from others. Immutable (except for the environments it refers to); threads may share it. It keeps references to its
/// space and environments.
pub struct cstk_cobject {
    _opaque: [u8; 0],
}

impl Noun for CObject {
    type Handle = cstk_cobject;
    const KIND: u32 = 7;
    const NAME: &'static str = "cstk_cobject";
}

/// Options of an induced C-object. Write it with cstk_induced_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_induced_options {
    pub size: u32,
    pub cookie: u32,
    /// Distances above 0 and up to this classify as CSTK_CLASS_CONTACT. Default 0.
    pub contact_epsilon: f64,
    /// Grows the s-objects by this length: it is subtracted from every distance, so that configurations nearer than the
    /// margin are inside. Points and normals remain those of the real surfaces. Default 0.
    pub margin: f64,
    /// Pairs that may meet, left out of a set of links against s-objects: `allowed_count` entries; NULL, the default, for
    /// none. Ids are not checked: an object may be added later. Sets are cheap to create; to allow other pairs, create
    /// another one.
    pub allowed: *const cstk_allowed_pair,
    pub allowed_count: usize,
    /// 1 leaves out, of a set of links against s-objects, the pairs of bodies that no coordinate moves: the base and the table
    /// that it stands on, which else is always the nearest, with a gradient of 0. Whether the robot meets its surroundings where it
    /// stands is then not asked; what is held is tested against the base, and all else. Default 0.
    pub leave_out_unmoved: u32,
    pub reserved: u32,
}

/// A pair that may meet: a link, or an s-object attached to it, and an s-object.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_allowed_pair {
    /// A link, by number in the space.
    pub link: u32,
    pub reserved: u32,
    /// The s-object attached to the link that may meet `object`, or 0 for the link's own body.
    pub attached: u64,
    /// The s-object that it may meet.
    pub object: u64,
}

// SAFETY: repr(C), two u32, two doubles, a pointer, a size, two u32: no padding; the pointer is only read after checks.
unsafe impl OptionsStruct for cstk_induced_options {
    const EARLIER_SIZES: &'static [usize] = &[24, 40];
    const COOKIE: u32 = 0x4353_0401;
    const NAME: &'static str = "cstk_induced_options";
    fn defaults() -> Self {
        let defaults = InducedOptions::default();
        Self {
            size: 0,
            cookie: 0,
            contact_epsilon: defaults.contact_epsilon,
            margin: defaults.margin,
            allowed: std::ptr::null(),
            allowed_count: 0,
            leave_out_unmoved: 0,
            reserved: 0,
        }
    }
}

/// Options of an induced set, read and checked.
struct DecodedInduced {
    measures: InducedOptions,
    allowed: Vec<AllowedPair>,
    /// Pairs that no coordinate moves are left out.
    unmoved: bool,
}

unsafe fn induced_options(options: *const cstk_induced_options) -> Result<DecodedInduced, Failure> {
    // SAFETY: checked for size and cookie.
    let options = unsafe { options_or_default(options, "options")? };
    // SAFETY: checked for NULL; the header states the length.
    let allowed = unsafe { slice(options.allowed, options.allowed_count, "options->allowed")? };
    let allowed = allowed.iter().map(|pair| AllowedPair {
        link: pair.link as usize,
        attached: pair.attached,
        object: pair.object,
    });
    let measures = InducedOptions {
        contact_epsilon: options.contact_epsilon,
        margin: options.margin,
    };
    if options.leave_out_unmoved > 1 {
        let given = options.leave_out_unmoved;
        let message = format!("options->leave_out_unmoved is {given}; it must be 0 or 1");
        return Err(Error::invalid(message).into());
    }
    Ok(DecodedInduced {
        measures,
        allowed: collected(allowed, "options->allowed")?,
        unmoved: options.leave_out_unmoved == 1,
    })
}

/// Writes the default options. `size` is sizeof(cstk_induced_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_induced_options_default(
    out: *mut cstk_induced_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Creates the set of configurations at which a link meets an s-object.
///
/// `links` holds `link_count` link numbers of the space; `link_count` 0 means all links (CSTK_ERROR_EMPTY if none has a
/// body). That includes links that no joint moves, such as a base: their gradients are 0, and they may always be the
/// nearest. Objects attached to these links are tested with them (see CSTK_CHANGE_ATTACH): a frame without a body, such as
/// a tool frame, must be among `links` for that. The robot is not tested against itself; see cstk_cobject_induced_links.
/// `ids` holds `id_count` ids of objects of the environment; `id_count` 0 means all its objects, including those added
/// later. An object that is deleted later contributes nothing. An object of another dimension than the robots makes queries
/// fail. `options` may be NULL for the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_induced(
    space: *const cstk_space,
    links: *const u32,
    link_count: usize,
    environment: *const cstk_environment,
    ids: *const u64,
    id_count: usize,
    options: *const cstk_induced_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let space = handle::share::<Space>(space, "space")?;
        let environment = handle::share::<Environment>(environment, "environment")?;
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
        let (links, ids, options) = unsafe {
            (
                slice(links, link_count, "links")?,
                slice(ids, id_count, "ids")?,
                induced_options(options)?,
            )
        };
        let links = collected(links.iter().map(|&link| link as usize), "links")?;
        let now = environment.snapshot();
        if let Some(missing) = ids.iter().find(|&&id| now.find(id).is_none()) {
            let message = format!("there is no s-object with id {missing}");
            return Err(Error::new(ErrorKind::NotFound, message).into());
        }
        let objects = if ids.is_empty() {
            SObjects::All(environment)
        } else {
            SObjects::Some(environment, collected(ids.iter().copied(), "ids")?)
        };
        let left_out = LeftOut {
            allowed: &options.allowed,
            unmoved: options.unmoved,
        };
        let cobject = CObject::induced(space, &links, objects, left_out, options.measures)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Creates the set of configurations at which the two links of some pair meet: one robot with itself, or robots with each
/// other. `pairs` holds 2 * `pair_count` link numbers; the second of a pair is the nominal s-object. Joined links touch at
/// every configuration: leave such pairs out (see cstk_find_link_pairs). Without any pair the set is empty. CSTK_ERROR_EMPTY for a
/// link without a body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_induced_links(
    space: *const cstk_space,
    pairs: *const u32,
    pair_count: usize,
    options: *const cstk_induced_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let space = handle::share::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let numbers = pair_count.saturating_mul(2);
        // SAFETY: checked for NULL, size and cookie; the caller states the length.
        let (pairs, options) =
            unsafe { (slice(pairs, numbers, "pairs")?, induced_options(options)?) };
        if !options.allowed.is_empty() {
            let message =
                "options->allowed names s-objects, but this set is of links: leave the pairs out";
            return Err(Error::new(ErrorKind::Unsupported, message).into());
        }
        if options.unmoved {
            let message = "options->leave_out_unmoved is for links against s-objects, but this set is of links: leave the pairs out";
            return Err(Error::new(ErrorKind::Unsupported, message).into());
        }
        let pairs = pairs.chunks_exact(2);
        let pairs = collected(
            pairs.map(|pair| [pair[0] as usize, pair[1] as usize]),
            "pairs",
        )?;
        let cobject = CObject::induced_links(space, &pairs, options.measures)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Writes a reference to the space that the set is in, to be released with cstk_space_release.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_get_space(
    cobject: *const cstk_cobject,
    out: *mut *mut cstk_space,
) -> cstk_status {
    guard(|| {
        let cobject = handle::share::<CObject>(cobject, "cobject")?;
        let out = Output::checked(out, "out")?;
        out.write(handle::create(cobject.space().clone()));
        Ok(())
    })
}

/// Adds a reference.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_retain(cobject: *mut cstk_cobject) -> cstk_status {
    guard(|| handle::retain::<CObject>(cobject, "cobject"))
}

/// Drops a reference. NULL is a no-op.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_release(cobject: *mut cstk_cobject) -> cstk_status {
    guard(|| handle::release::<CObject>(cobject, "cobject"))
}
