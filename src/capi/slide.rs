//! Slides.
//!
//! The step that slides along contact, proved free on its whole way, and its two halves for callers who put them together
//! themselves (§2.2.4, Appendix A).
//!
//! ```c
//! cstk_slide_options options;
//! cstk_slide_result slid;
//! check(cstk_slide_options_default(&options, sizeof options));
//! options.max_shell = 0.05;
//! check(cstk_slide(query, cobject, q, nq, step, nv, &options, q, &slid));
//! ```

use super::boundary::{Failure, guard};
use super::handle;
use super::input::{OptionsStruct, Output, OutputSlice, options, slice, write_defaults};
use super::query::{cstk_query, with_query};
use crate::capi::at_configuration::answers::cstk_witness_list;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, require_coordinates};
use crate::motion::{Approach, SlideOptions, SlideOutcome, slide_step, spring_step};

/// How to slide. Write it with cstk_slide_options_default first, then set `max_shell`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_options {
    pub size: u32,
    pub cookie: u32,
    /// The stand-off: contacts up to this distance constrain the step. Must be set, larger than 0;
    /// two or three times as far as a step moves the robot does well. Parts of the C-object may have shells of their own:
    /// see cstk_cobject_with_shell.
    pub max_shell: f64,
    /// The distance at which the robot slides; where it is nearer it is pushed out. Negative, the default, stands for a
    /// tenth of max_shell. Independent of the C-object's contact epsilon. A part with a shell of its own keeps the same
    /// part of that.
    pub desired_distance: f64,
    /// Not 0: lengthens the step along the contact to that of the step asked for, at most fourfold; 0, the default,
    /// leaves what is left of the step. (The report's normalize?)
    pub normalize: u32,
    /// At most this many witnesses are considered, the nearest first. Default 256.
    pub max_witnesses: u32,
    /// A step is halved until it is accepted, or is shorter than this part of the step asked for. Default 1/1024.
    pub floor: f64,
}

// SAFETY: repr(C), two u32, two doubles, two u32, a double: no padding.
unsafe impl OptionsStruct for cstk_slide_options {
    const COOKIE: u32 = 0x4353_0501;
    const NAME: &'static str = "cstk_slide_options";
    const EARLIER_SIZES: &'static [usize] = &[32];
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            max_shell: 0.0,
            desired_distance: -1.0,
            normalize: 0,
            max_witnesses: 256,
            floor: 1.0 / 1024.0,
        }
    }
}

/// How a slide ended.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_slide_outcome {
    /// A step was found, and it keeps clear of the C-object all the way.
    CSTK_SLIDE_MOVED = 0,
    /// The configuration is inside the C-object; nothing was moved.
    CSTK_SLIDE_INSIDE = 1,
    /// No step leads on: contacts, ranges or the world box are in the way, or q itself is out of them (a joint held by a
    /// range of one value must have it to the last bit; see cstk_space_clamp); nothing was moved. Of all steps as long as
    /// the floor none that keeps clear, keeps its distance (or the desired one, if that is less), the ranges and the box
    /// gains more than 1 % of its length along the step asked for, to first order. With a contact_count of 0 the step is
    /// 0, ranges or the world box are in the way, or the shell is so short that even the step of the floor's length
    /// leads beyond it.
    CSTK_SLIDE_BLOCKED = 2,
}

/// What a slide did.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_result {
    pub outcome: cstk_slide_outcome,
    /// How many contacts within the shells there were at q.
    pub contact_count: u32,
    /// The distance at the configuration given, and at the one reached.
    pub distance_before: f64,
    pub distance_after: f64,
    pub reserved: [u64; 8],
}

/// Writes the default options. `size` is sizeof(cstk_slide_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide_options_default(
    out: *mut cstk_slide_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Takes one step from q that slides along contacts instead of running into them (Appendix A): `step` itself where
/// nothing is within the shell; else the nearest step (by the sum of the velocities' squares, as they are) that brings no
/// contact nearer than the desired distance (or than the nearest is, if that is less) and keeps to the ranges and the
/// world box, pushed out where the robot is within that distance, corrected where it leads, and halved until the whole
/// way is proved free. Along a contact only part of the step is left; see `normalize`.
///
/// The proof takes each pair of bodies, and each link with a floor or the world box, for itself: by its own distance, and by
/// how far the joints between the two can move them relative to each other, or a link along the normal of a plane between
/// it and an obstacle. Pairs that no joint of the step moves relative to each other may touch. A pair that touches at q and moves is taken on the word of its contacts' gradients for the
/// first 1e-4 of max_shell (or of the smallest link's radius), and must be apart from there on, unless the whole way is
/// shorter than that. Of two bodies with more than 64 primitive pairs only the nearest constrain a step: at most 8, no more
/// than 1 % of the shell farther apart than the first.
///
/// `slide_options` must not be NULL. `q` and `reached` have `nq` doubles and may be the same; `step`, a velocity for a unit of
/// time, has `nv`. Unless the outcome is CSTK_SLIDE_MOVED, `reached` receives q. A slide may creep, gaining little more
/// than 1 % a step; who wants to stop then looks at what was gained. The C-object is an induced or pure set or a union of
/// such, without predicates: else, and where a custom joint that changes some distance does not state its speeds,
/// CSTK_ERROR_UNSUPPORTED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    step: *const f64,
    nv: usize,
    slide_options: *const cstk_slide_options,
    reached: *mut f64,
    out: *mut cstk_slide_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let reached = OutputSlice::checked(reached, nq, "reached")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (q, step, given) = unsafe {
                (
                    slice(q, nq, "q")?,
                    slice(step, nv, "step")?,
                    options(slide_options, "slide_options")?,
                )
            };
            let mut options = SlideOptions::with_shell(given.max_shell);
            options.normalize = given.normalize != 0;
            options.floor = given.floor;
            options.max_witnesses = given.max_witnesses as usize;
            // NaN must reach the check.
            if given.desired_distance.is_nan() || given.desired_distance >= 0.0 {
                options.desired_distance = given.desired_distance;
            }
            let taken = state.context.slide(&cobject, q, step, &options)?;
            reached.write(&taken.configuration);
            out.write(cstk_slide_result {
                outcome: match taken.outcome {
                    SlideOutcome::Moved => cstk_slide_outcome::CSTK_SLIDE_MOVED,
                    SlideOutcome::Inside => cstk_slide_outcome::CSTK_SLIDE_INSIDE,
                    SlideOutcome::Blocked => cstk_slide_outcome::CSTK_SLIDE_BLOCKED,
                },
                contact_count: taken.contacts as u32,
                distance_before: taken.distance_before,
                distance_after: taken.distance_after,
                reserved: [0; 8],
            });
            Ok(())
        })
    })
}

/// The report's slide-step: of the contacts of a list with gradients (cstk_gradients, or cstk_pseudo_normal without
/// `normalize`), the step nearest to `step` that brings none nearer than `desired_distance`, nor nearer at all where it
/// is within that already; to first order, and without a look at ranges or the way. `normalize` is that of
/// cstk_slide_options. `step` and `out` have `nv` doubles, that of the list, and may be the same. `found` is false, and
/// `out` zero, where less than 1 % of the step would be left.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_slide_step(
    list: *const cstk_witness_list,
    step: *const f64,
    nv: usize,
    desired_distance: f64,
    normalize: bool,
    out: *mut f64,
    found: *mut bool,
) -> cstk_status {
    guard(|| {
        let out = OutputSlice::checked(out, nv, "out")?;
        let found = Output::checked(found, "found")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (approaches, step) = unsafe { (approaches(list, nv)?, slice(step, nv, "step")?) };
        require_coordinates(step, "step entry")?;
        check_desired(desired_distance)?;
        let left = slide_step(step, &approaches, &[], desired_distance, normalize);
        found.write(left.is_some());
        out.write(&left.unwrap_or_else(|| vec![0.0; nv]));
        Ok(())
    })
}

/// The report's compute-spring-step: the shortest step that takes all contacts of a list out to `desired_distance`, to first
/// order; where they stand against each other, out to the largest distance they can share. `found` is false, and `out` zero,
/// where no contact is nearer or none can be helped. See cstk_slide_step for the list.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_spring_step(
    list: *const cstk_witness_list,
    nv: usize,
    desired_distance: f64,
    out: *mut f64,
    found: *mut bool,
) -> cstk_status {
    guard(|| {
        let out = OutputSlice::checked(out, nv, "out")?;
        let found = Output::checked(found, "found")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let approaches = unsafe { approaches(list, nv)? };
        check_desired(desired_distance)?;
        let adjustment = spring_step(&approaches, &[], desired_distance);
        found.write(adjustment.is_some());
        out.write(&adjustment.unwrap_or_else(|| vec![0.0; nv]));
        Ok(())
    })
}

fn check_desired(desired: f64) -> Result<(), Failure> {
    require_coordinates(&[desired], "desired_distance")?;
    if desired < 0.0 {
        return Err(Error::invalid(format!("desired_distance is negative: {desired}")).into());
    }
    Ok(())
}

/// The contacts of a list with their gradients.
unsafe fn approaches<'a>(
    list: *const cstk_witness_list,
    nv: usize,
) -> Result<Vec<Approach<'a>>, Failure> {
    // SAFETY: checked for NULL; the caller states that it is a list of a query that is still valid.
    let list = unsafe { slice(list, 1, "list")? };
    let list = &list[0];
    if list.contacts_left_out {
        let message = "the list was made without all contacts, see cstk_query_set_contacts";
        return Err(Error::invalid(message).into());
    }
    if list.nv == 0 && list.contact_count > 0 {
        return Err(Error::invalid("the list was made without gradients").into());
    }
    if list.nv != nv && (list.nv > 0 || list.contact_count > 0) {
        return Err(Error::new(
            ErrorKind::WrongSize,
            format!(
                "nv is {nv}, but the list's gradients have {} entries",
                list.nv
            ),
        )
        .into());
    }
    let entries = list.contact_count.saturating_mul(nv);
    // SAFETY: checked for NULL; as above.
    let (contacts, gradients) = unsafe {
        (
            slice(list.contacts, list.contact_count, "list->contacts")?,
            slice(list.gradients, entries, "list->gradients")?,
        )
    };
    for (i, contact) in contacts.iter().enumerate() {
        require_coordinates(&[contact.clearance], "clearance")
            .map_err(|e| e.within(format_args!("list->contacts[{i}]")))?;
    }
    require_coordinates(gradients, "list->gradients entry")?;
    Ok(contacts
        .iter()
        .zip(gradients.chunks_exact(nv.max(1)))
        .map(|(contact, gradient)| Approach {
            gradient,
            clearance: contact.clearance,
        })
        .collect())
}
