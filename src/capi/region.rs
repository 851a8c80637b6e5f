//! Regions.
//!
//! Whole boxes of C-space, proved free or inside, and boxes grown around a configuration until contacts stop them. What is called
//! free is so at every configuration of the box: bounds over parts of the box cover it, no sample decides.
//!
//! ```c
//! cstk_region_result around;
//! double low[6], high[6];
//! check(cstk_region_grow(query, cobject, q, nq, NULL, 0, NULL, low, high, NULL, 0));
//! check(cstk_region_classify(query, cobject, low, high, nq, NULL, NULL, NULL, &around));
//! if (around.outcome == CSTK_REGION_FREE) {
//!     printf("joint 0 may go from %g to %g, whatever the others do in the box\n", low[0], high[0]);
//! }
//! ```

use super::boundary::guard;
use super::handle;
use super::input::{
    OptionsStruct, Output, OutputSlice, optional_slice, options_or_default, slice, write_defaults,
};
use super::query::{cstk_query, with_query};
use crate::capi::at_configuration::answers::cstk_distance_result;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::error::{Error, ErrorKind};
use crate::motion::{GrowthOptions, RegionOptions, RegionOutcome, RegionSide, SideStop};
use crate::query::Distance;

/// Options of cstk_region_classify. Write it with cstk_region_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_region_options {
    pub size: u32,
    pub cookie: u32,
    /// The most parts that the box is halved into, at least 1. Default 1000.
    pub max_boxes: u64,
}

// SAFETY: repr(C), two u32, a u64: no padding.
unsafe impl OptionsStruct for cstk_region_options {
    const COOKIE: u32 = 0x4353_0505;
    const NAME: &'static str = "cstk_region_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            max_boxes: RegionOptions::default().max_boxes as u64,
        }
    }
}

/// Options of cstk_region_grow. Write it with cstk_growth_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_growth_options {
    pub size: u32,
    pub cookie: u32,
    /// A side is stopped when it cannot grow by this times its weight, or by a quarter of what all sides could grow together, if that
    /// is less; above 0. Smaller values take more proofs. Default 0.01.
    pub tolerance: f64,
    /// No side goes farther from q than this times its weight; finite, above 0. Default 4.
    pub max_side: f64,
    /// The most parts that each proof halves its box into, at least 1. Default 200.
    pub max_boxes: u64,
}

// SAFETY: repr(C), two u32, two doubles, a u64: no padding.
unsafe impl OptionsStruct for cstk_growth_options {
    const COOKIE: u32 = 0x4353_0504;
    const NAME: &'static str = "cstk_growth_options";
    fn defaults() -> Self {
        let defaults = GrowthOptions::default();
        Self {
            size: 0,
            cookie: 0,
            tolerance: defaults.tolerance,
            max_side: defaults.max_side,
            max_boxes: defaults.max_boxes as u64,
        }
    }
}

/// What is known of a box. "Inside" is CSTK_CLASS_INSIDE, as cstk_classify says it.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_region_outcome {
    /// Proved: no configuration of the box is inside the C-object.
    CSTK_REGION_FREE = 0,
    /// Proved: every configuration of the box is inside.
    CSTK_REGION_INSIDE = 1,
    /// One configuration of the box is inside, and another is not.
    CSTK_REGION_MIXED = 2,
    /// Neither was found with max_boxes parts, or within the limit of cstk_query_set_limit, or some part is too small to be halved: within
    /// rounding of a contact, where more parts do not help. (Where the class of a single configuration already needs more, the call
    /// ends with CSTK_ERROR_LIMIT.)
    CSTK_REGION_UNDECIDED = 3,
}

/// What was found of a box.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_region_result {
    pub outcome: cstk_region_outcome,
    /// A configuration that is inside is known.
    pub has_inside: bool,
    /// A configuration that is not inside is known.
    pub has_outside: bool,
    pub reserved_bytes: [u8; 2],
    /// The part of the box's volume that is proved to be as its middle is, from 0 to 1; 0 for a mixed box.
    pub proved: f64,
    pub reserved: [u64; 8],
}

/// What stops a side of a grown box.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_side_stop {
    /// It was not to grow: its weight is 0, or it belongs to a quaternion or to the rotation of a free joint.
    CSTK_SIDE_FIXED = 0,
    /// The end of the coordinate's range; on a circle half a turn from q.
    CSTK_SIDE_RANGE = 1,
    /// max_side of the options.
    CSTK_SIDE_MAX = 2,
    /// There is contact at a configuration that the tolerance would add: `distance` says of what.
    CSTK_SIDE_CONTACT = 3,
    /// What the tolerance would add could not be proved free with max_boxes parts; `distance` is that in the part looked at
    /// last.
    CSTK_SIDE_UNPROVED = 4,
    /// The limit of cstk_query_set_limit ended the growth.
    CSTK_SIDE_LIMITED = 5,
}

/// A side of a grown box.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_region_side {
    pub stop: cstk_side_stop,
    /// `distance` is set: for contacts and what is unproved, unless lengths and units of C-space mix in the C-object.
    pub has_distance: bool,
    pub reserved_bytes: [u8; 3],
    /// The distance, with its witness, at a configuration that stops the side.
    pub distance: cstk_distance_result,
    pub reserved: [u64; 4],
}

/// Writes the default options. `size` is sizeof(cstk_region_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_region_options_default(
    out: *mut cstk_region_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Writes the default options. `size` is sizeof(cstk_growth_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_growth_options_default(
    out: *mut cstk_growth_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Proves that no configuration of a box is inside a C-object, or that all are, or finds one of each. `low` and `high` have `nq`
/// doubles in the units of configurations, none of `low` above its partner; coordinates may be equal. On a circle the box is the arc
/// from `low` upwards to `high`, which may pass the place where angles wrap. `options` may be NULL for the defaults; `inside` and
/// `outside` may be NULL, or receive configurations of the box, `nq` doubles, where the result says that they are known.
///
/// The entries of a quaternion must be equal in `low` and `high`, and no custom joint may move that does not state its speeds:
/// CSTK_ERROR_UNSUPPORTED otherwise. The cost grows with the number of parts: a part takes some microseconds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_region_classify(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    low: *const f64,
    high: *const f64,
    nq: usize,
    options: *const cstk_region_options,
    inside: *mut f64,
    outside: *mut f64,
    out: *mut cstk_region_result,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (low, high, given) = unsafe {
                (
                    slice(low, nq, "low")?,
                    slice(high, nq, "high")?,
                    options_or_default(options, "options")?,
                )
            };
            let options = RegionOptions {
                max_boxes: usize::try_from(given.max_boxes).unwrap_or(usize::MAX),
            };
            let optional = |items: *mut f64, name: &str| {
                let given = (!items.is_null()).then(|| OutputSlice::checked(items, nq, name));
                given.transpose()
            };
            let places = [optional(inside, "inside")?, optional(outside, "outside")?];
            let answer = state
                .context
                .classify_region(&cobject, low, high, &options)?;
            let found = [&answer.inside, &answer.outside];
            for (place, q) in places.into_iter().zip(found) {
                if let (Some(place), Some(q)) = (place, q) {
                    place.write(q);
                }
            }
            out.write(cstk_region_result {
                outcome: match answer.outcome {
                    RegionOutcome::Free => cstk_region_outcome::CSTK_REGION_FREE,
                    RegionOutcome::Inside => cstk_region_outcome::CSTK_REGION_INSIDE,
                    RegionOutcome::Mixed => cstk_region_outcome::CSTK_REGION_MIXED,
                    RegionOutcome::Undecided => cstk_region_outcome::CSTK_REGION_UNDECIDED,
                },
                has_inside: answer.inside.is_some(),
                has_outside: answer.outside.is_some(),
                reserved_bytes: [0; 2],
                proved: answer.proved,
                reserved: [0; 8],
            });
            Ok(())
        })
    })
}

/// Grows a box around q that is proved free: no configuration of it is inside the C-object, which q must not be. First all sides grow
/// together, then each as far as it can, in turn. `low` and `high` receive its ends, `nq` doubles each; one of them may be q. Angles
/// do not wrap: on a circle the box is the arc from `low` upwards to `high`. Quaternions stay as they are. The box is within the
/// coordinates' ranges unless q is not. The same call has the same answer.
///
/// `weights` has `nv` doubles, at least 0: a side of weight 2 grows twice as far as one of weight 1, one of weight 0 not at all.
/// It may be NULL with an `nv` of 0: then each is 1, a radian or a length. `options` may be NULL for the defaults. `sides` may be
/// NULL with a `side_count` of 0; else it receives what stops each side, twice as many as the space has velocities: the lower side of
/// the first, its upper side, the lower side of the second, and so on; of a free joint's position, those of x, y and z stand with its
/// linear velocities.
///
/// CSTK_ERROR_INVALID_ARGUMENT where q is inside, CSTK_ERROR_UNSUPPORTED where a custom joint would move that does not state its
/// speeds. The cost is that of some hundred calls of cstk_region_classify; sides of many turns of a joint take as many times more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_region_grow(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    weights: *const f64,
    nv: usize,
    options: *const cstk_growth_options,
    low: *mut f64,
    high: *mut f64,
    sides: *mut cstk_region_side,
    side_count: usize,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = handle::share::<CObject>(cobject, "cobject")?;
            // SAFETY: checked for NULL, size and cookie; the caller states the lengths.
            let (q, given) =
                unsafe { (slice(q, nq, "q")?, options_or_default(options, "options")?) };
            // SAFETY: checked for NULL; the caller states the length.
            let weights = unsafe { optional_slice(weights, nv, "weights")? };
            let low = OutputSlice::checked(low, nq, "low")?;
            let high = OutputSlice::checked(high, nq, "high")?;
            let places = OutputSlice::checked(sides, side_count, "sides")?;
            let needed = 2 * cobject.space().nv();
            if side_count != 0 && side_count != needed {
                return Err(Error::new(
                    ErrorKind::WrongSize,
                    format!("sides has {side_count} entries, but the box has {needed} sides"),
                )
                .into());
            }
            let options = GrowthOptions {
                tolerance: given.tolerance,
                max_side: given.max_side,
                max_boxes: usize::try_from(given.max_boxes).unwrap_or(usize::MAX),
            };
            let grown = state.context.grow_region(&cobject, q, weights, &options)?;
            let sides: Vec<cstk_region_side> = grown.sides.iter().map(Into::into).collect();
            low.write(&grown.low);
            high.write(&grown.high);
            places.write(&sides);
            Ok(())
        })
    })
}

impl From<&RegionSide> for cstk_region_side {
    fn from(side: &RegionSide) -> Self {
        let nothing = Distance::unknown();
        Self {
            stop: match side.stop {
                SideStop::Fixed => cstk_side_stop::CSTK_SIDE_FIXED,
                SideStop::Range => cstk_side_stop::CSTK_SIDE_RANGE,
                SideStop::MaxSide => cstk_side_stop::CSTK_SIDE_MAX,
                SideStop::Contact => cstk_side_stop::CSTK_SIDE_CONTACT,
                SideStop::Unproved => cstk_side_stop::CSTK_SIDE_UNPROVED,
                SideStop::Limited => cstk_side_stop::CSTK_SIDE_LIMITED,
            },
            has_distance: side.distance.is_some(),
            reserved_bytes: [0; 3],
            distance: side.distance.as_ref().unwrap_or(&nothing).into(),
            reserved: [0; 4],
        }
    }
}
