//! One step along contacts, and its two halves.

use crate::capi::at_configuration::answers::cstk_witness_list;
use crate::capi::boundary::{Failure, guard};
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{
    OptionsStruct, Output, OutputSlice, options, require_addressable, slice, write_defaults,
};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind, require_coordinates};
use crate::motion::{Approach, SlideOptions, SlideOutcome, slide_step, spring_step};

/// Options of a slide. Write it with cstk_slide_options_default first, then set `max_shell`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_options {
    pub size: u32,
    pub cookie: u32,
    /// Contacts up to this distance constrain the step. Must be set, larger than 0; two or three times as far as a step
    /// moves the robot works well. Parts of the C-object may have their own shells: see cstk_cobject_with_shell.
    pub max_shell: f64,
    /// The distance at which the robot slides; where it is nearer it is pushed out. Negative, the default, means a tenth of
    /// max_shell. Independent of the C-object's contact epsilon. For a part with its own shell it is scaled with that
    /// shell.
    pub desired_distance: f64,
    /// Nonzero: lengthens the step along the contact to the length of the requested step, at most fourfold. 0, the default,
    /// keeps what is left of the step. (The report's normalize?)
    pub normalize: u32,
    /// The most witnesses considered, the nearest first. Default 256.
    pub max_witnesses: u32,
    /// A step is halved until it is accepted, or shorter than this fraction of the requested step. Default 1/1024.
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

impl From<cstk_slide_options> for SlideOptions {
    fn from(given: cstk_slide_options) -> Self {
        let mut options = Self::with_shell(given.max_shell);
        options.normalize = given.normalize != 0;
        options.floor = given.floor;
        options.max_witnesses = given.max_witnesses as usize;
        // NaN must reach the check.
        if given.desired_distance.is_nan() || given.desired_distance >= 0.0 {
            options.desired_distance = given.desired_distance;
        }
        options
    }
}

/// How a slide ended.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_slide_outcome {
    /// A step was found, and the whole motion is proved free.
    CSTK_SLIDE_MOVED = 0,
    /// The configuration is inside the C-object; it is not moved.
    CSTK_SLIDE_INSIDE = 1,
    /// No step is possible: contacts, ranges or the world box block the way, or q itself violates ranges or box (a joint
    /// held by a range of one value must have it to the last bit; see cstk_space_clamp). The configuration is not moved. To
    /// first order, no step as long as the floor that stays free, keeps its distance (or the desired one, if that is less),
    /// the ranges and the box gains more than 1 % of its length along the requested step. With a contact_count of 0 the
    /// step is 0, or ranges or the world box block it, or the shell is so short that even a step of the floor's length
    /// leads beyond it.
    CSTK_SLIDE_BLOCKED = 2,
}

/// The result of a slide.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_slide_result {
    pub outcome: cstk_slide_outcome,
    /// The number of contacts within the shells at q.
    pub contact_count: u32,
    /// The distance at q, and at the configuration reached.
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

/// Takes one step from q that slides along contacts instead of running into them (Appendix A). Where nothing is within the
/// shell, it is `step` itself. Otherwise it is the nearest step (by the unweighted sum of squared velocities) that brings
/// no contact nearer than the desired distance (or than the nearest contact, if that is nearer) and keeps to the ranges and
/// the world box. A robot within the desired distance is pushed out to it. The step is corrected at its end, and halved
/// until the whole motion is proved free. Along a contact only part of the step is left; see `normalize`.
///
/// The proof is that of cstk_motion: each pair of primitives, and each link with a floor or the world box, is parted by
/// bounds over intervals of the way, so that a robot slides along what is only a rounding error away. The way is the straight one by
/// the velocity that leads to `reached`, a part of `step` and what contacts turned it to: a step of more than half a turn about a circle
/// goes all of it, where cstk_motion from q to `reached` would go the shorter way. Pairs that no joint of
/// the step moves relative to each other may touch. For a pair that touches at q and moves, the gradients of its contacts are
/// trusted for the first 1e-4 of max_shell (or of the radius of the smallest body that a link carries); from there on it must be apart, unless the
/// whole motion is shorter, or a plane separates the two bodies and the motion goes along it. So it is for a pair that is apart at q by
/// no more than rounding (some 1e-11 of its size and place), but its contacts stay apart, to second order. Of two bodies with more than
/// 64 primitive pairs only the nearest constrain a step: at most 8, no more than 1 % of the shell farther apart than the
/// nearest.
///
/// `slide_options` must not be NULL. `q` and `reached` have `nq` doubles and may be the same; `step`, a velocity for a unit
/// of time, has `nv`. Unless the outcome is CSTK_SLIDE_MOVED, `reached` receives q. A slide may creep, gaining little more
/// than 1 % a step: callers who want to stop then should check the gain. The C-object must be an induced set, a pure set
/// other than a predicate, or a union of such: CSTK_ERROR_UNSUPPORTED otherwise, and where a custom joint that changes some
/// distance does not state its speeds.
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
            let taken = state.context.slide(&cobject, q, step, &given.into())?;
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

/// The report's slide-step. From a list with gradients (cstk_gradients, or cstk_pseudo_normal without `normalize`),
/// computes the step nearest to `step` that brings no contact nearer than `desired_distance`, and contacts that are nearer
/// already no nearer still. It is a first-order step: ranges are ignored and the motion is not checked. `normalize` is that
/// of cstk_slide_options. `step` and `out` have `nv` doubles, that of the list, and may be the same. `found` is false, and
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
        require_addressable::<f64>(nv, "out")?;
        let found = Output::checked(found, "found")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let (approaches, step) = unsafe { (approaches(list, nv)?, slice(step, nv, "step")?) };
        require_coordinates(step, "step entry")?;
        check_desired(desired_distance)?;
        let left = slide_step(step, &approaches, &[], desired_distance, normalize);
        write_found(left, out, found);
        Ok(())
    })
}

/// The report's compute-spring-step: the shortest step that takes all contacts of a list out to `desired_distance`, to
/// first order; where contacts oppose each other, out to the largest distance they can share. No step is longer than 1000 times what one
/// contact alone asks for: contacts that oppose each other to within a thousandth count as opposed. `out` has `nv` doubles.
/// `found` is false, and `out` zero, where no contact is nearer or none can move out. See cstk_slide_step for the list.
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
        require_addressable::<f64>(nv, "out")?;
        let found = Output::checked(found, "found")?;
        // SAFETY: checked for NULL; the caller states the lengths.
        let approaches = unsafe { approaches(list, nv)? };
        check_desired(desired_distance)?;
        let adjustment = spring_step(&approaches, &[], desired_distance);
        write_found(adjustment, out, found);
        Ok(())
    })
}

/// Writes a step, or zeros where there is none.
fn write_found(step: Option<Vec<f64>>, out: OutputSlice<f64>, found: Output<bool>) {
    found.write(step.is_some());
    match step {
        Some(step) => out.write(&step),
        None => out.fill(0.0),
    }
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
