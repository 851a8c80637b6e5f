//! Builds a hierarchy from primitives: the grouping phase, then the construction phase.

use std::time::Instant;

use super::ball::Ball;
use super::options::{HierarchyOptions, WrapperKind};
use super::parallel::Progress;
use super::subset_tree::Node;
use crate::error::Result;
use crate::hierarchy::grouping::{Groups, Part, convex_pieces, group, parts};
use crate::hierarchy::packed::{PackedTree, build_cloud, is_cloud, pack_groups, pack_wrappers};
use crate::hierarchy::wrapper::{WrapperTree, Wrappers};
use crate::primitive::{Convex, Primitives};

/// Seconds each phase of a build took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildTimes {
    /// Finding convex pieces and cutting slender primitives.
    pub preparation: f64,
    /// The grouping phase (§3.2).
    pub grouping: f64,
    /// The wrappers, if they are built with the body, and the packed tree.
    pub construction: f64,
}

/// The result of a build.
#[derive(Debug)]
pub struct Hierarchy {
    /// The wrapper tree, or what builds it on first use.
    pub wrappers: Wrappers,
    /// The tree that queries traverse.
    pub packed: PackedTree,
    /// Number of nodes of the binary tree.
    pub nodes: usize,
    /// Number of levels of the binary tree.
    pub depth: usize,
    /// Seconds each phase took.
    pub times: BuildTimes,
}

/// Builds the hierarchy of at least one primitive. `progress` is called on this thread with the fraction done; an error
/// from it cancels the build.
pub fn build_hierarchy(
    primitives: &Primitives,
    options: &HierarchyOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<Hierarchy> {
    options.check()?;
    let mut progress = Progress::new(progress);
    progress.at(0.0)?;
    let built = match is_cloud(primitives, options) {
        true => build_cloud(primitives, options, &mut progress)?,
        false => build_of_shapes(primitives, options, &mut progress)?,
    };
    progress.at(1.0)?;
    Ok(built)
}

fn build_of_shapes(
    primitives: &Primitives,
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<Hierarchy> {
    let start = Instant::now();
    let shapes = primitives.as_shapes();
    let parts = parts(&shapes, options.aspect_limit);
    let mut pieces = convex_pieces(&shapes, options.pieces, &mut progress.part(0.0, 0.1))?;
    if parts.len() > shapes.len() {
        pieces = pieces_of_parts(&parts, shapes.len(), pieces);
    }
    let prepared = start.elapsed().as_secs_f64();
    let mut part = progress.part(0.1, 0.6);
    let groups = group(&shapes, &parts, &pieces, options, &mut part)?;
    let grouped = start.elapsed().as_secs_f64();
    let (nodes, depth) = (groups.subsets.nodes.len(), groups.subsets.depth());
    let threads = options.thread_count();
    let mut rest = progress.part(0.6, 1.0);
    // By default the packed boxes are fitted to the primitives' points, the tightest choice. If the caller asks for another
    // kind of wrapper, queries traverse boxes around those wrappers; so they do for slabs, whose points no primitive has.
    let (wrappers, packed) =
        if options.wrapper == WrapperKind::Hull && parts.len() == primitives.len() {
            let ball = Ball::around(primitives);
            let packed = pack_groups(primitives, &groups.subsets, ball, threads, &mut rest)?;
            (Wrappers::of_groups(groups, options), packed)
        } else {
            let mut part = rest.part(0.0, 0.8);
            let tree = wrap_parts(&shapes, &parts, groups, options, &mut part)?;
            let packed = pack_wrappers(primitives, &tree, threads, &mut rest.part(0.8, 1.0))?;
            (Wrappers::Eager(Box::new(tree)), packed)
        };
    let times = BuildTimes {
        preparation: prepared,
        grouping: grouped - prepared,
        construction: start.elapsed().as_secs_f64() - grouped,
    };
    Ok(Hierarchy {
        wrappers,
        packed,
        nodes,
        depth,
        times,
    })
}

/// Builds the wrapper tree over grouped primitives, and packs it.
pub(super) fn wrapped_anew(
    primitives: &Primitives,
    groups: Groups,
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<(Wrappers, PackedTree)> {
    let points_of = |primitive: u32| {
        let primitive = primitives.get(primitive as usize);
        (primitive.bounding_points().collect(), 0.0)
    };
    let tree = WrapperTree::build(groups, points_of, options, &mut progress.part(0.0, 0.8))?;
    let mut rest = progress.part(0.8, 1.0);
    let packed = pack_wrappers(primitives, &tree, options.thread_count(), &mut rest)?;
    Ok((Wrappers::Eager(Box::new(tree)), packed))
}

/// Builds the wrapper tree over parts; its leaves name the primitives.
fn wrap_parts(
    shapes: &[Convex],
    parts: &[Part],
    groups: Groups,
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<WrapperTree> {
    let points_of = |part: u32| {
        let (points, slack) = parts[part as usize].vertices(shapes);
        (points.to_vec(), slack)
    };
    let mut tree = WrapperTree::build(groups, points_of, options, progress)?;
    for node in &mut tree.subsets.nodes {
        if let Node::Leaf { primitive } = node {
            *primitive = parts[*primitive as usize].primitive;
        }
    }
    Ok(tree)
}

/// Replaces each primitive of a piece by the parts it was cut into.
fn pieces_of_parts(parts: &[Part], primitives: usize, pieces: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
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
