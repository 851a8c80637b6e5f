//! Compound C-objects, and user data of C-objects.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::at_configuration::answers::cstk_class;
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{Output, slice};
use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::{CallerData, address};
use crate::cobject::{CObject, Class};
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

/// Creates the union of `count` C-objects of one space: its class is the largest of theirs. It keeps references to its
/// parts. A body pair that several induced parts hold in the same state counts once, with the largest margin; a pair of links in one
/// part and the same two the other way round in another are two pairs.
///
/// Sets of any kind may be combined, to a depth of 256 (a union in a union adds no level). A union may be grown one part at
/// a time: each call takes time in proportion to `count`, the first query of the result in proportion to all parts. All
/// queries on a union of induced sets are exact; for other compounds cstk_distance reports what is known:
/// - a union is as near as its nearest part;
/// - an intersection is no nearer than its farthest part: CSTK_DISTANCE_LOWER_BOUND, except for 0 where all parts are 0;
/// - a complement is moved down to the leaves, by De Morgan's laws. The distance from the complement of a pure set (other
///   than a predicate) is exact; from that of an induced set it is 0 where nothing meets, otherwise unknown:
///   CSTK_DISTANCE_LOWER_BOUND, from 0.
///
/// cstk_within(t) is true where the lower bound is at most t. (Where surfaces are refined, see cstk_query_set_refinement, it may also be
/// false within `gap` of that: it has proved a higher bound.) cstk_witnesses and cstk_gradients list every pair of every induced leaf
/// within epsilon, and every pure leaf (or its complement), whatever the tree combines them to; rows are the
/// derivatives of those distances. Complements and the sets beyond limits are open: on their boundary the distance is 0,
/// but the class is not CSTK_CLASS_INSIDE. Lengths and C-space units are not compared: CSTK_ERROR_UNSUPPORTED for distances
/// where a pure set without a scale is combined with an induced one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_union(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| combine(parts, count, out, CObject::union))
}

/// Creates the intersection of `count` C-objects of one space: its class is the smallest of theirs. See cstk_cobject_union.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_intersection(
    parts: *const *const cstk_cobject,
    count: usize,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| combine(parts, count, out, CObject::intersection))
}

/// Creates the complement of a C-object: it exchanges CSTK_CLASS_INSIDE and CSTK_CLASS_OUTSIDE; contact stays. Bodies that state a
/// deviation (cstk_body_builder_set_deviation) count as apart in it. See
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

/// Creates the difference `of` without `without`: the intersection of `of` with the complement of `without`. See
/// cstk_cobject_union.
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
        let cobject = CObject::difference(&of, &without)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Creates a copy of a set with user data attached (§2.2.3), under a new number. Witnesses, distances and explanations of
/// every C-object that has the copy as a leaf return `data`. `destroy` may be NULL; it is called once, by the thread that
/// drops the last reference to whatever carries the data, and not if this call fails.
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

/// Creates a copy of an induced or pure set with its own shell for cstk_slide: its contacts constrain a step within `shell`
/// instead of `max_shell` of the slide's options, and the desired distance scales with it: one of a tenth of max_shell
/// becomes a tenth of `shell`. The links of a robot are mostly near each other, so a self-collision set with a shell of one
/// or two steps' motion, in a union with obstacles that have a larger one, makes steps several times faster. `shell` is a
/// length above 0, for a pure set in the unit of its distances. Other queries ignore it. The copy keeps the data and gets a
/// new number (cstk_cobject_get_data). CSTK_ERROR_UNSUPPORTED for a union, an intersection or a complement: give shells to
/// the parts before combining them.
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

/// Creates the C-object `of` with what the caller knows of it: at every configuration in the interior of `within` its class is
/// `known`, a cstk_class: CSTK_CLASS_OUTSIDE or CSTK_CLASS_INSIDE. There queries need not look at geometry (§2.2.3): boxes that cstk_region_grow or
/// cstk_region_classify has proved free are such sets. `within` is a box, a ball or a half-space (cstk_cobject_box, _ball,
/// _halfspace), an intersection of these (a polytope), or a union of those. Its contact epsilons and scales are ignored. Sets are
/// looked at one after the other.
///
/// The library takes the caller's word: it must hold in every state of the environments that the C-object is asked in, and where `of`
/// has a contact epsilon, CSTK_CLASS_OUTSIDE says that there is no contact either, which the proof of a box does not. A wrong word
/// makes wrong answers. What each query does with it:
/// - classes: in the interior of a set the known class; on its boundary, within rounding of it, outside it, and at link poses `of` is
///   asked. cstk_within with threshold 0 does the same, with a threshold above 0 it asks `of`;
/// - motions, paths and shortcuts with threshold 0, boxes of C-space and maps: the parts of a motion or box inside a set are known, the
///   others proved. A straight motion between two configurations of one box, ball or polytope is known without any geometry, but for
///   free joints and rotations that move near its boundary. With a threshold above 0 `of` is asked;
/// - distances, witnesses, gradients, explanations, signed distances, clearances and slides ask `of`, for nothing is known of
///   distances; so do certificates, which take nobody's word: they are those of `of`.
///
/// It may be part of any other set, and counts as one level of its depth. It takes no shell (give it to `of`).
/// CSTK_ERROR_INVALID_ARGUMENT for CSTK_CLASS_CONTACT or sets of two spaces, CSTK_ERROR_UNSUPPORTED for other sets as `within`.
/// Threads may share it, as any C-object.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_cobject_with_known(
    of: *const cstk_cobject,
    within: *const cstk_cobject,
    known: i32,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        let of = handle::share::<CObject>(of, "of")?;
        let within = handle::share::<CObject>(within, "within")?;
        let out = Output::checked(out, "out")?;
        let known = match known {
            _ if known == cstk_class::CSTK_CLASS_OUTSIDE as i32 => Class::Outside,
            _ if known == cstk_class::CSTK_CLASS_INSIDE as i32 => Class::Inside,
            _ => {
                return Err(Failure::new(
                    cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
                    format!("known is {known}, neither CSTK_CLASS_OUTSIDE nor CSTK_CLASS_INSIDE"),
                ));
            }
        };
        let cobject = CObject::with_known(&of, &within, known)?;
        out.write(handle::create(Arc::new(cobject)));
        Ok(())
    })
}

/// Writes the user data of a C-object (or NULL) and its number, by which witnesses and explanations name it as a leaf;
/// either output may be NULL. No two sets of a process share a number; the complement of a complement is the original set,
/// with its number.
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
