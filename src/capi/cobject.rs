//! C-objects.

use std::sync::Arc;

use super::boundary::{Failure, guard};
use super::environment::cstk_environment;
use super::handle::{self, Noun};
use super::input::{OptionsStruct, Output, options_or_default, slice, write_defaults};
use super::space::cstk_space;
use super::status::cstk_status;
use crate::cobject::{CObject, InducedOptions, SObjects};
use crate::environment::Environment;
use crate::error::{Error, ErrorKind};
use crate::space::Space;

/// A set in C-space: induced by contact or interference of links with s-objects or links, or a union of such. Immutable
/// (but for the environment it may refer to); threads may share it. It keeps its space and environment.
pub struct cstk_cobject {
    _opaque: [u8; 0],
}

impl Noun for CObject {
    type Handle = cstk_cobject;
    const KIND: u32 = 7;
    const NAME: &'static str = "cstk_cobject";
}

/// How an induced C-object measures. Write it with cstk_cobject_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_cobject_options {
    pub size: u32,
    pub cookie: u32,
    /// Distances above 0 and up to this classify as CSTK_CONTACT. Default 0.
    pub contact_epsilon: f64,
    /// Grows the s-objects by this length: it is taken off every distance of the C-object, so that configurations nearer
    /// than the margin are inside. Points and normals stay those of the real surfaces. Default 0.
    pub margin: f64,
}

// SAFETY: repr(C), two u32 and two doubles.
unsafe impl OptionsStruct for cstk_cobject_options {
    const COOKIE: u32 = 0x4353_0401;
    const NAME: &'static str = "cstk_cobject_options";
    fn defaults() -> Self {
        let defaults = InducedOptions::default();
        Self {
            size: 0,
            cookie: 0,
            contact_epsilon: defaults.contact_epsilon,
            margin: defaults.margin,
        }
    }
}

unsafe fn induced_options(options: *const cstk_cobject_options) -> Result<InducedOptions, Failure> {
    // SAFETY: checked for size and cookie.
    let options = unsafe { options_or_default(options, "options")? };
    Ok(InducedOptions {
        contact_epsilon: options.contact_epsilon,
        margin: options.margin,
    })
}

/// Writes the default options. `size` is sizeof(cstk_cobject_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_options_default(
    out: *mut cstk_cobject_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Makes the set of configurations at which a link meets an s-object.
///
/// `links` holds `link_count` numbers of links of the space that have a body; with `link_count` 0 all such links are
/// meant (CSTK_EMPTY if there is none), those too that no joint moves, such as a base: their gradients are 0, and they may
/// always be nearest. The robot with itself is not meant; see cstk_cobject_induced_links. `ids` holds `id_count` ids of objects of the environment; with `id_count` 0 all its objects are meant, those
/// added later too. An object that is deleted later contributes nothing; one of another dimension than the
/// robots is refused by the queries that meet it. `options` may be NULL for the defaults.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_induced(
    space: *const cstk_space,
    links: *const u32,
    link_count: usize,
    environment: *const cstk_environment,
    ids: *const u64,
    id_count: usize,
    options: *const cstk_cobject_options,
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
        let links: Vec<usize> = links.iter().map(|&link| link as usize).collect();
        let now = environment.snapshot();
        if let Some(missing) = ids.iter().find(|&&id| now.find(id).is_none()) {
            let message = format!("there is no s-object with id {missing}");
            return Err(Error::new(ErrorKind::NotFound, message).into());
        }
        let objects = if ids.is_empty() {
            SObjects::All(environment)
        } else {
            SObjects::Some(environment, ids.to_vec())
        };
        let cobject = CObject::induced(space, &links, objects, options)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Makes the set of configurations at which the two links of some pair meet: one robot with itself, or robots with each
/// other. `pairs` holds 2 * `pair_count` link numbers; the second of a pair is the nominal s-object. Links that are
/// joined touch at every configuration; leave such pairs out.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_induced_links(
    space: *const cstk_space,
    pairs: *const u32,
    pair_count: usize,
    options: *const cstk_cobject_options,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let space = handle::share::<Space>(space, "space")?;
        let out = Output::checked(out, "out")?;
        let numbers = pair_count.saturating_mul(2);
        // SAFETY: checked for NULL, size and cookie; the caller states the length.
        let (pairs, options) =
            unsafe { (slice(pairs, numbers, "pairs")?, induced_options(options)?) };
        let pairs: Vec<[usize; 2]> = pairs
            .chunks_exact(2)
            .map(|pair| [pair[0] as usize, pair[1] as usize])
            .collect();
        let cobject = CObject::induced_links(space, &pairs, options)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Makes the union of `count` C-objects of one space. It keeps what its parts refer to, not the parts themselves. A
/// body pair that several parts hold in one state counts once, with the largest margin; a configuration's class is the
/// largest of those of the parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_union(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let out = Output::checked(out, "out")?;
        // SAFETY: checked for NULL; the caller states the length.
        let parts = unsafe { slice(parts, count, "parts")? };
        let parts = parts
            .iter()
            .enumerate()
            .map(|(i, &part)| handle::share::<CObject>(part, &format!("parts[{i}]")))
            .collect::<Result<Vec<_>, _>>()?;
        let cobject = CObject::union(&parts)?;
        out.write(handle::create(Arc::new(cobject)));
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
