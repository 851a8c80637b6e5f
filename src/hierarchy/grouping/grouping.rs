//! The grouping phase (§3.2): builds the subset tree whose leaves are parts.

use super::clusters::{Groups, group_by_clusters};
use super::parts::Part;
use super::regions::{REGION, group_by_regions};
use crate::error::Result;
use crate::hierarchy::{Grouping, HierarchyOptions, Pieces, Progress};
use crate::primitive::Convex;

/// Groups at least one part. Each of `pieces` is a set of parts that get a subtree of their own. The same input gives the
/// same tree.
pub fn group(
    primitives: &[Convex],
    parts: &[Part],
    pieces: &[Vec<u32>],
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<Groups> {
    let has_no_pieces = options.pieces == Pieces::Off;
    if parts.len() > REGION && has_no_pieces && options.grouping != Grouping::TopDown {
        let subsets = group_by_regions(primitives, parts, options, progress)?;
        let pieces = Vec::new();
        return Ok(Groups { subsets, pieces });
    }
    let all: Vec<u32> = (0..parts.len() as u32).collect();
    group_by_clusters(primitives, parts, &all, pieces, options, progress)
}
