//! C-objects made of others, and data attached to them.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{Output, slice};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::{CallerData, address};
use crate::cobject::CObject;
use crate::error::Result as CoreResult;
use crate::user_data::value_of;

fn combine(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
    make: impl FnOnce(&[Arc<CObject>]) -> CoreResult<CObject>,
) -> Result<(), Failure> {
    let out = Output::checked(out, "out")?;
    // SAFETY: checked for NULL; the caller states the length.
    let parts = unsafe { slice(parts, count, "parts")? };
    let parts = parts
        .iter()
        .enumerate()
        .map(|(i, &part)| handle::share::<CObject>(part, &format!("parts[{i}]")))
        .collect::<Result<Vec<_>, _>>()?;
    out.write(handle::create(Arc::new(make(&parts)?)));
    Ok(())
}

/// Makes the union of `count` C-objects of one space: its class is the largest of theirs. It keeps its parts. A
/// body pair that several induced parts hold in one state counts once, with the largest margin.
///
/// Sets of any kind may be combined, to a depth of 256 (unions in unions count as one). A union may be grown one part at a
/// time: a call takes time in proportion to `count`, the first query of the whole in proportion to all parts. Of a union of induced sets every
/// query is exact; of other compounds cstk_distance says what it knows:
/// - a union is as near as its nearest part;
/// - an intersection is no nearer than its farthest part: CSTK_DISTANCE_LOWER_BOUND, but for 0 where all parts are 0;
/// - a complement is taken of the leaves, by De Morgan's laws. From the complement of a pure set (no predicate) the distance
///   is exact; from that of an induced set it is 0 where nothing meets, and not known inside: CSTK_DISTANCE_LOWER_BOUND, from 0.
///
/// cstk_within(t) holds where the lower bound is at most t. cstk_witnesses and cstk_gradients list every pair of every
/// induced leaf within epsilon, and every pure leaf (or its complement), whatever the tree makes of them; rows are the
/// derivatives of those distances. Complements and the sets beyond limits are open: on their boundary the distance is 0,
/// but the class is not CSTK_CLASS_INSIDE. Lengths and units of C-space are not compared: CSTK_ERROR_UNSUPPORTED for distances where
/// a pure set without a scale meets an induced one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_union(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| combine(parts, count, out, CObject::union))
}

/// Makes the intersection of `count` C-objects of one space: its class is the smallest of theirs. See cstk_cobject_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_intersection(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| combine(parts, count, out, CObject::intersection))
}

/// Makes the complement of a C-object: CSTK_CLASS_INSIDE where that is CSTK_CLASS_OUTSIDE, and the other way round; contact stays. See
/// cstk_cobject_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_complement(
    part: *const cstk_cobject,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let part = handle::share::<CObject>(part, "part")?;
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(CObject::complement(&part)?)));
        Ok(())
    })
}

/// Makes the set of what is in `of` and not in `without`: the intersection with the complement. See cstk_cobject_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_difference(
    of: *const cstk_cobject,
    without: *const cstk_cobject,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let of = handle::share::<CObject>(of, "of")?;
        let without = handle::share::<CObject>(without, "without")?;
        let out = Output::checked(out, "out")?;
        let made = CObject::difference(&of, &without)?;
        out.write(handle::create(Arc::new(made)));
        Ok(())
    })
}

/// Makes the same set with data of the caller's attached (§2.2.3). Witnesses, distances and explanations of every C-object
/// that has the new one as a leaf hand `data` back. `destroy` may be NULL; it is called once, by whichever thread drops the
/// last reference to what carries the data, and not when this call fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_with_data(
    cobject: *const cstk_cobject,
    data: *mut c_void,
    destroy: cstk_destroy_fn,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let cobject = &*handle::share::<CObject>(cobject, "cobject")?;
        let out = Output::checked(out, "out")?;
        let kept = CallerData::new(data, destroy);
        let made = match kept.as_user_data() {
            Some(data) => cobject.with_data(data),
            None => cobject.with_data(crate::user_data::UserData::new(0, None)),
        };
        kept.take_ownership();
        out.write(handle::create(Arc::new(made)));
        Ok(())
    })
}

/// Makes the same induced or pure set with a shell of its own for cstk_slide: its contacts constrain a step up to that distance,
/// instead of `max_shell` of the slide's options, and it is kept at the same part of it: with a desired distance of a tenth of
/// max_shell, at a tenth of `shell`. Links of a robot are mostly near each other: a self-collision set with a shell of one or
/// two steps' motion, in a union with obstacles that are looked for from afar, makes steps several times faster. `shell` is a
/// length, for a pure set in the unit of its distances, larger than 0. Other queries do not look at it. The set keeps its data
/// and takes a number of its own (cstk_cobject_get_data). A union, an intersection or a complement is refused:
/// CSTK_ERROR_UNSUPPORTED; its parts take shells before they are combined.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_with_shell(
    cobject: *const cstk_cobject,
    shell: f64,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let cobject = &*handle::share::<CObject>(cobject, "cobject")?;
        let out = Output::checked(out, "out")?;
        out.write(handle::create(Arc::new(cobject.with_shell(shell)?)));
        Ok(())
    })
}

/// Writes the data attached to a C-object (or NULL) and its number, by which witnesses and explanations name it as a leaf;
/// either may be NULL. No two sets of a process have one number; the
/// complement of a complement is the set itself, and so has its number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_get_data(
    cobject: *const cstk_cobject,
    data: *mut *mut c_void,
    number: *mut u64,
) -> cstk_status {
    guard(|| {
        let cobject = &*handle::share::<CObject>(cobject, "cobject")?;
        let data = Output::optional(data, "data")?;
        let number = Output::optional(number, "number")?;
        data.write(address(value_of(&cobject.data().cloned())));
        number.write(cobject.serial());
        Ok(())
    })
}
