//! Finds the link pairs that a self-collision set should test.

use std::ffi::c_void;

use crate::capi::boundary::{Failure, guard};
use crate::capi::handle;
use crate::capi::input::{OptionsStruct, Output, options_or_default, slice, start, write_defaults};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::space::space::cstk_space;
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::query::{LinkPair, LinkPairOptions, PairVerdict};
use crate::space::Space;

/// Options of cstk_find_link_pairs. Write it with cstk_link_pair_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_pair_options {
    pub size: u32,
    pub cookie: u32,
    /// The number of configurations sampled; default 1000.
    pub samples: u64,
    /// The seed of the sampling; default 0. Equal seeds give equal answers.
    pub seed: u64,
    /// The configuration at rest, nq doubles of the space; NULL, the default, for all coordinates 0, clamped to their
    /// ranges. Coordinates without bounds are not sampled: they stay at rest.
    pub rest: *const f64,
    /// Links within this distance count as touching; default 0.
    pub margin: f64,
    /// Pairs that touch in at least this fraction of the samples count as always touching; default 0.95.
    pub always: f64,
    /// Nonzero: leaves out pairs that touched in no sample. Sampling does not prove that they cannot touch. Default 0.
    pub skip_never: u32,
    pub reserved: u32,
}

// SAFETY: repr(C), two u32, two u64, a pointer, two doubles, two u32: no padding; the pointer is only read after checks.
unsafe impl OptionsStruct for cstk_link_pair_options {
    const COOKIE: u32 = 0x4353_0404;
    const NAME: &'static str = "cstk_link_pair_options";
    fn defaults() -> Self {
        let defaults = LinkPairOptions::default();
        Self {
            size: 0,
            cookie: 0,
            samples: defaults.samples as u64,
            seed: defaults.seed,
            rest: std::ptr::null(),
            margin: defaults.margin,
            always: defaults.always,
            skip_never: 0,
            reserved: 0,
        }
    }
}

/// The verdict on a pair of links.
#[repr(i32)]
#[derive(Clone, Copy)]
pub enum cstk_pair_verdict {
    /// The pair should be tested: it touched in some samples, or belongs to different robots.
    CSTK_PAIR_TEST = 0,
    /// The links are joined, with no body in between, or fixed to each other.
    CSTK_PAIR_ADJACENT = 1,
    /// The links touch at rest.
    CSTK_PAIR_AT_REST = 2,
    /// The links touch in all samples, or almost all.
    CSTK_PAIR_ALWAYS = 3,
    /// The links touched in no sample; still tested unless skip_never is set.
    CSTK_PAIR_NEVER = 4,
    /// The robot's SRDF file, or cstk_robot_builder_disable_pair, rules the pair out.
    CSTK_PAIR_DISABLED = 5,
}

/// A pair of links with bodies, the lower number first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_pair {
    pub r_link: u32,
    pub s_link: u32,
    pub verdict: cstk_pair_verdict,
    /// The robots of the two links, in the order of the space.
    pub r_robot: u32,
    pub s_robot: u32,
    pub reserved: u32,
    /// The fraction of the samples in which the links touch; 0 where the verdict needed no samples.
    pub share: f64,
}

/// All pairs of links with bodies. The arrays belong to the query context and stay valid until its next call or its
/// release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_link_pair_list {
    pub pairs: *const cstk_link_pair,
    pub count: usize,
    /// The pairs to test, two link numbers each, as cstk_cobject_induced_links takes them; NULL if there are none.
    pub tested: *const u32,
    pub tested_count: usize,
    pub reserved: [u64; 4],
}

/// Writes the default options. `size` is sizeof(cstk_link_pair_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_link_pair_options_default(
    out: *mut cstk_link_pair_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Writes which pairs of links of the space to test for self-collision, and why the others are left out: links that are
/// joined, that touch at rest, that touch in at least `always` of the sampled configurations, or that an SRDF file rules out
/// (cstk_space_get_enabled_pairs tells these without sampling). Links of different robots
/// are always tested. Pass `tested` to cstk_cobject_induced_links (it may be empty); to allow further pairs, leave them
/// out. Set `margin` to at least the margin plus the contact epsilon of that set; otherwise pairs that are always in
/// contact are tested. `options` may be NULL for the defaults; `progress` may be NULL; `user` is passed to it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_find_link_pairs(
    query: *mut cstk_query,
    space: *const cstk_space,
    options: *const cstk_link_pair_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    out: *mut cstk_link_pair_list,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let space = &*handle::share::<Space>(space, "space")?;
            let out = Output::checked(out, "out")?;
            // SAFETY: checked for size and cookie.
            let given = unsafe { options_or_default(options, "options")? };
            // SAFETY: checked for NULL; the header states the length.
            let options = unsafe { read(&given, space)? };
            let mut report = reporter(progress, user);
            let pairs = state
                .context
                .find_link_pairs(space, &options, &mut report)?;
            state.keep_pairs(&pairs, given.skip_never != 0);
            out.write(cstk_link_pair_list {
                pairs: start(&state.pairs),
                count: state.pairs.len(),
                tested: start(&state.tested),
                tested_count: state.tested.len() / 2,
                reserved: [0; 4],
            });
            Ok(())
        })
    })
}

unsafe fn read(given: &cstk_link_pair_options, space: &Space) -> Result<LinkPairOptions, Failure> {
    let rest = if given.rest.is_null() {
        None
    } else {
        // SAFETY: as the caller states.
        Some(unsafe { slice(given.rest, space.nq(), "options->rest")? }.to_vec())
    };
    Ok(LinkPairOptions {
        samples: usize::try_from(given.samples).unwrap_or(usize::MAX),
        seed: given.seed,
        rest,
        margin: given.margin,
        always: given.always,
    })
}

impl From<&LinkPair> for cstk_link_pair {
    fn from(pair: &LinkPair) -> Self {
        Self {
            r_link: pair.links[0] as u32,
            s_link: pair.links[1] as u32,
            verdict: match pair.verdict {
                PairVerdict::Test => cstk_pair_verdict::CSTK_PAIR_TEST,
                PairVerdict::Adjacent => cstk_pair_verdict::CSTK_PAIR_ADJACENT,
                PairVerdict::AtRest => cstk_pair_verdict::CSTK_PAIR_AT_REST,
                PairVerdict::Always => cstk_pair_verdict::CSTK_PAIR_ALWAYS,
                PairVerdict::Never => cstk_pair_verdict::CSTK_PAIR_NEVER,
                PairVerdict::Disabled => cstk_pair_verdict::CSTK_PAIR_DISABLED,
            },
            r_robot: pair.robots[0] as u32,
            s_robot: pair.robots[1] as u32,
            reserved: 0,
            share: pair.share,
        }
    }
}
