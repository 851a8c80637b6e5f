//! Explains the class of a configuration.

use std::ffi::c_void;

use crate::capi::at_configuration::answers::{cstk_class, cstk_witness_list};
use crate::capi::at_configuration::questions::{StateInput, run_at};
use crate::capi::boundary::Failure;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::input::start;
use crate::capi::query::{State, cstk_query, refill};
use crate::capi::status::status::cstk_status;
use crate::capi::user_data::address;
use crate::cobject::CObject;
use crate::query::{Configuration, Verdict};

/// The class of one leaf of a C-object's tree, and its part in the class of the whole.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_verdict {
    /// The leaf, by its number (cstk_cobject_get_data), and its data.
    pub cobject: u64,
    pub data: *mut c_void,
    /// The class with respect to the leaf itself.
    pub leaf_class: cstk_class,
    /// Whether the tree takes the leaf's complement.
    pub complemented: bool,
    /// Whether the class of the whole rests on this leaf (and on the other decisive ones): from the root to the leaf, each
    /// part has the class of the union or intersection that holds it.
    pub decisive: bool,
    pub reserved_bytes: [u8; 2],
    /// The witnesses of the leaf's class, if it is decisive: `witness_count` entries of the list from `first_witness` on.
    pub first_witness: u32,
    pub witness_count: u32,
    pub reserved: [u64; 2],
}

// SAFETY: the caller's address is only handed back, never followed.
unsafe impl Send for cstk_verdict {}

/// A class and the leaves and witnesses that decide it. The arrays belong to the query context and stay valid until its
/// next call or its release.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_explanation {
    pub point_class: cstk_class,
    pub reserved_word: u32,
    /// Every leaf; twice if both it and its complement are used.
    pub leaves: *const cstk_verdict,
    pub leaf_count: usize,
    /// Pairs that meet where the leaf's class is CSTK_CLASS_INSIDE, or are within its contact epsilon where it is
    /// CSTK_CLASS_CONTACT. As for classes, doubt within rounding counts as within, so that `distance` may exceed the
    /// epsilon by rounding.
    pub list: cstk_witness_list,
    pub reserved: [u64; 4],
}

impl From<&Verdict> for cstk_verdict {
    fn from(verdict: &Verdict) -> Self {
        Self {
            cobject: verdict.leaf.serial,
            data: address(verdict.leaf.data),
            leaf_class: verdict.class.into(),
            complemented: verdict.complemented,
            decisive: verdict.decisive,
            reserved_bytes: [0; 2],
            first_witness: verdict.first_witness as u32,
            witness_count: verdict.witness_count as u32,
            reserved: [0; 2],
        }
    }
}

fn explain(
    state: &mut State,
    cobject: &CObject,
    at: Configuration,
    max_count: usize,
) -> Result<cstk_explanation, Failure> {
    let found = state.context.explain(cobject, at, max_count)?;
    refill(&mut state.verdicts, &found.leaves);
    Ok(cstk_explanation {
        point_class: found.class.into(),
        reserved_word: 0,
        leaves: start(&state.verdicts),
        leaf_count: state.verdicts.len(),
        list: state.keep(found.list),
        reserved: [0; 4],
    })
}

/// Writes the class of q as cstk_classify does without refinement, and what decides it: the leaves of the C-object, and at most `max_count`
/// primitive pairs (§2.2.4, operations 4 and 5). Slower than cstk_classify, since every leaf is tested. `q` has `nq`
/// doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_explain(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    q: *const f64,
    nq: usize,
    max_count: usize,
    out: *mut cstk_explanation,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::Coordinates(q, nq),
            out,
            |state, cobject, at| explain(state, cobject, at, max_count),
        )
    }
}

/// cstk_explain with link poses instead of q; see cstk_classify_at_link_poses.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_explain_at_link_poses(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    link_poses: *const f64,
    link_count: usize,
    max_count: usize,
    out: *mut cstk_explanation,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the length.
    unsafe {
        run_at(
            query,
            cobject,
            StateInput::LinkPoses(link_poses, link_count),
            out,
            |state, cobject, at| explain(state, cobject, at, max_count),
        )
    }
}
