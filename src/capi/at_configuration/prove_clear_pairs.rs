//! Proves where pairs of links are apart, once and for all queries.

use std::ffi::c_void;
use std::sync::Arc;

use crate::capi::boundary::guard;
use crate::capi::cobject::cobject::cstk_cobject;
use crate::capi::handle;
use crate::capi::input::{OptionsStruct, Output, options_or_default, write_defaults};
use crate::capi::query::{cstk_query, with_query};
use crate::capi::status::callbacks::{cstk_progress_fn, reporter};
use crate::capi::status::status::cstk_status;
use crate::cobject::CObject;
use crate::motion::ClearPairOptions;

/// Options of cstk_prove_clear_pairs. Write it with cstk_clear_pair_options_default first.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_clear_pair_options {
    pub size: u32,
    pub cookie: u32,
    /// The most blocks of cells that are tried for a pair, at least 1. More prove more, and take longer. Default 20000.
    pub max_blocks: u64,
}

// SAFETY: repr(C), two u32, a u64: no padding.
unsafe impl OptionsStruct for cstk_clear_pair_options {
    const COOKIE: u32 = 0x4353_0407;
    const NAME: &'static str = "cstk_clear_pair_options";
    fn defaults() -> Self {
        Self {
            size: 0,
            cookie: 0,
            max_blocks: ClearPairOptions::default().max_blocks as u64,
        }
    }
}

/// What cstk_prove_clear_pairs has proved.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct cstk_clear_pair_summary {
    /// The pairs of the set.
    pub pair_count: usize,
    /// Those of them that have cells which are proved.
    pub proved_count: usize,
    /// The mean of the part of their cells that is proved, from 0 to 1; 0 without such pairs.
    pub proved_share: f64,
    /// The memory that the cells take.
    pub bytes: usize,
    pub reserved: [u64; 4],
}

/// Writes the default options. `size` is sizeof(cstk_clear_pair_options).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_clear_pair_options_default(
    out: *mut cstk_clear_pair_options,
    size: usize,
) -> cstk_status {
    // SAFETY: checked for NULL; the caller states the size.
    guard(|| unsafe { write_defaults(out, size) })
}

/// Creates a copy of a set of link pairs (cstk_cobject_induced_links) that knows by proof where its links are apart. How two links stand
/// to each other depends on the joints between them alone: for each pair that up to three coordinates move so, the space of these
/// coordinates is divided into cells, and cells are proved free of contact as boxes of C-space are (cstk_region_classify). It is done once for
/// a robot, takes from some milliseconds to some seconds, and needs no environment.
///
/// The copy has the same class at every configuration, up to rounding. What only asks for contact need not look at a pair inside a proved
/// cell: cstk_classify, cstk_within with a threshold up to the contact epsilon, lists of contacts, batches, maps, and straight motions with a
/// threshold up to it, where the whole motion stays in proved cells, and what is made of such motions: paths, shortcuts and slides. Motions
/// that are not free may end at times that differ, within their tolerance, from those of the set without proofs, and slides may go
/// farther. Distances ignore the proofs; so do queries at link poses, which do not know coordinates, and certificates, which take
/// nobody's word. The whole call counts as one query for cstk_query_set_limit.
///
/// The joints between must be revolute or prismatic, with limits or whole turns; other pairs are asked as before. The copy keeps the data
/// and the shell, and gets a new number (cstk_cobject_get_data). CSTK_ERROR_UNSUPPORTED for all other C-objects: prove pairs before a set
/// is combined. `options` may be NULL for the defaults; `progress` may be NULL; `user` is passed to it. `summary` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cstk_prove_clear_pairs(
    query: *mut cstk_query,
    cobject: *const cstk_cobject,
    options: *const cstk_clear_pair_options,
    progress: cstk_progress_fn,
    user: *mut c_void,
    summary: *mut cstk_clear_pair_summary,
    out: *mut *mut cstk_cobject,
) -> cstk_status {
    guard(|| {
        with_query(query, |state| {
            let cobject = &*handle::share::<CObject>(cobject, "cobject")?;
            let out = Output::checked(out, "out")?;
            let summary = (!summary.is_null()).then(|| Output::checked(summary, "summary"));
            let summary = summary.transpose()?;
            // SAFETY: checked for size and cookie.
            let given = unsafe { options_or_default(options, "options")? };
            let options = ClearPairOptions {
                max_blocks: usize::try_from(given.max_blocks).unwrap_or(usize::MAX),
            };
            let mut report = reporter(progress, user);
            let proved = state
                .context
                .prove_clear_pairs(cobject, &options, &mut report)?;
            if let Some(summary) = summary {
                let grids = proved.clear_grids();
                let shares = grids.iter().map(|grid| grid.proved_share());
                summary.write(cstk_clear_pair_summary {
                    pair_count: proved.link_pairs().map_or(0, |(_, pairs)| pairs.len()),
                    proved_count: grids.len(),
                    proved_share: shares.sum::<f64>() / grids.len().max(1) as f64,
                    bytes: grids.iter().map(|grid| grid.bytes()).sum(),
                    reserved: [0; 4],
                });
            }
            out.write(handle::create(Arc::new(proved)));
            Ok(())
        })
    })
}
