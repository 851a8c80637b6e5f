//! Both phases: from primitives to their hierarchy.

use std::time::Instant;

use super::grouping::group;
use super::parallel::Progress;
use super::parts::parts;
use super::{HierarchyOptions, WrapperTree};
use crate::error::Result;
use crate::primitive::Convex;

/// Seconds each phase of a build took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildTimes {
    /// Looking for convex pieces and cutting slender primitives.
    pub preparation: f64,
    pub grouping: f64,
    pub construction: f64,
}

/// Builds the hierarchy of primitives, of which there is at least one. `progress` hears the fraction done, on this thread,
/// and may end the work with an error.
pub fn build_hierarchy(
    primitives: &[Convex],
    options: &HierarchyOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<(WrapperTree, BuildTimes)> {
    options.check()?;
    let mut progress = Progress::new(progress);
    progress.at(0.0)?;
    let start = Instant::now();
    let parts = parts(primitives, options.aspect_limit);
    let pieces: Vec<Vec<u32>> = Vec::new();
    let prepared = start.elapsed().as_secs_f64();
    let groups = group(
        primitives,
        &parts,
        &pieces,
        options,
        &mut progress.part(0.1, 0.5),
    )?;
    let grouped = start.elapsed().as_secs_f64();
    let tree = WrapperTree::build(
        groups,
        primitives,
        &parts,
        options,
        &mut progress.part(0.5, 1.0),
    )?;
    progress.at(1.0)?;
    let times = BuildTimes {
        preparation: prepared,
        grouping: grouped - prepared,
        construction: start.elapsed().as_secs_f64() - grouped,
    };
    Ok((tree, times))
}
