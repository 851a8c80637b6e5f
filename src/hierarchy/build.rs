//! Both phases: from primitives to their hierarchy.

use std::time::Instant;

use super::convex_pieces::convex_pieces;
use super::grouping::group;
use super::parallel::Progress;
use super::parts::{Part, parts};
use super::{HierarchyOptions, Node, WrapperTree};
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

/// Pieces of primitives as pieces of the parts those were cut into.
fn parts_of(parts: &[Part], primitives: usize, pieces: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let mut slabs: Vec<Vec<u32>> = vec![Vec::new(); primitives];
    for (i, part) in parts.iter().enumerate() {
        slabs[part.primitive as usize].push(i as u32);
    }
    let of_piece = |piece: Vec<u32>| {
        let members = piece.into_iter().flat_map(|i| slabs[i as usize].clone());
        members.collect()
    };
    pieces.into_iter().map(of_piece).collect()
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
    let mut pieces = convex_pieces(primitives, options.pieces, &mut progress.part(0.0, 0.1))?;
    if parts.len() > primitives.len() {
        pieces = parts_of(&parts, primitives.len(), pieces);
    }
    let prepared = start.elapsed().as_secs_f64();
    let groups = group(
        primitives,
        &parts,
        &pieces,
        options,
        &mut progress.part(0.1, 0.5),
    )?;
    let grouped = start.elapsed().as_secs_f64();
    let points_of = |part: u32| {
        let (points, doubt) = parts[part as usize].vertices(primitives);
        (points.to_vec(), doubt)
    };
    let mut rest = progress.part(0.5, 1.0);
    let mut tree = WrapperTree::build(groups, points_of, options, &mut rest)?;
    for node in &mut tree.subsets.nodes {
        if let Node::Leaf { primitive } = node {
            *primitive = parts[*primitive as usize].primitive;
        }
    }
    progress.at(1.0)?;
    let times = BuildTimes {
        preparation: prepared,
        grouping: grouped - prepared,
        construction: start.elapsed().as_secs_f64() - grouped,
    };
    Ok((tree, times))
}
