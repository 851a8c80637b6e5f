//! The hierarchy of a body whose vertices have moved while its topology stays.

use std::sync::OnceLock;
use std::time::Instant;

use super::ball::Ball;
use super::build::{BuildTimes, Hierarchy, wrapped_anew};
use super::options::HierarchyOptions;
use super::parallel::Progress;
use crate::error::Result;
use crate::hierarchy::grouping::Groups;
use crate::hierarchy::packed::{PackedTree, refit};
use crate::hierarchy::wrapper::Wrappers;
use crate::primitive::Primitives;

/// The hierarchy over moved primitives with the tree, of `depth` levels, of another; `ball` bounds them. Wrappers that are
/// built with a body are built anew.
pub fn refit_hierarchy(
    primitives: &Primitives,
    wrappers: &Wrappers,
    packed: &PackedTree,
    ball: Ball,
    depth: usize,
) -> Result<Hierarchy> {
    let start = Instant::now();
    let mut depth = depth;
    let (wrappers, packed) = match wrappers {
        Wrappers::Eager(tree) => {
            let options = HierarchyOptions {
                wrapper: tree.kind(),
                ..HierarchyOptions::default()
            };
            let groups = Groups {
                subsets: tree.subsets().clone(),
                pieces: tree.pieces().to_vec(),
            };
            let mut ignored = |_| Ok(());
            let mut progress = Progress::new(&mut ignored);
            wrapped_anew(primitives, groups, &options, &mut progress)?
        }
        Wrappers::OnDemand {
            groups, options, ..
        } => {
            let packed_anew = refit(packed, primitives, ball);
            // A cloud would be grouped anew when its wrappers are asked for, into another tree.
            let groups = groups.clone().unwrap_or_else(|| {
                let subsets = packed.subsets();
                depth = subsets.depth();
                let pieces = Vec::new();
                Groups { subsets, pieces }.into()
            });
            let wrappers = Wrappers::OnDemand {
                groups: Some(groups),
                options: *options,
                tree: OnceLock::new(),
            };
            (wrappers, packed_anew)
        }
    };
    let nodes = wrappers
        .subsets()
        .map_or(0, |(subsets, _)| subsets.nodes.len());
    Ok(Hierarchy {
        wrappers,
        packed,
        nodes,
        depth,
        times: BuildTimes {
            construction: start.elapsed().as_secs_f64(),
            ..BuildTimes::default()
        },
    })
}
