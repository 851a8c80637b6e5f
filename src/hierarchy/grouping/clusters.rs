//! Groups a body as one: by clustering, or by splitting it top-down.

use super::adjacent::{Adjacent, sibling_pairs};
use super::binned_split::{levels_for, split, split_within};
use super::forest::Forest;
use super::greedy_clustering::{Limits, cluster};
use super::nearby::{MortonCurve, Nearby};
use super::parts::Part;
use super::rebalancing::rebalanced;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::{Grouping, HierarchyOptions, Node, Progress, SubsetTree};
use crate::primitive::Convex;

/// The subset tree over parts (its leaves name parts by index), and the nodes that hold the given convex pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct Groups {
    pub subsets: SubsetTree,
    /// Nodes in ascending order. A piece that was split up to bound the tree's depth has none.
    pub pieces: Vec<u32>,
}

impl Groups {
    /// Bytes of memory they take.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.subsets.nodes[..]) + size_of_val(&self.pieces[..])
    }
}

/// Groups the parts in `members`, without cutting them into regions.
pub fn group_by_clusters(
    primitives: &[Convex],
    parts: &[Part],
    members: &[u32],
    pieces: &[Vec<u32>],
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<Groups> {
    let extent = |&part: &u32| parts[part as usize].extent(primitives);
    let extents: Vec<Extent> = members.iter().map(extent).collect();
    let bounds = extents
        .iter()
        .fold(extents[0], |all, extent| all.union(extent));
    // Leaves in Morton order: neighbours in space are neighbours in memory, and ties are broken between neighbours.
    let curve = MortonCurve::new(&bounds);
    let mut order: Vec<u32> = (0..extents.len() as u32).collect();
    order.sort_by_cached_key(|&i| (curve.code(&extents[i as usize].center()), i));
    let mut forest = Forest::new(order.iter().map(|&i| extents[i as usize]).collect());
    let order: Vec<u32> = order.iter().map(|&i| members[i as usize]).collect();
    let (bodies, holders, piece_roots) = join_pieces(&mut forest, pieces, &order);
    let threads = options.thread_count();
    progress.at(0.05)?;
    let mut progress = progress.part(0.05, 1.0);
    let root = match options.grouping {
        Grouping::TopDown => split(&mut forest, bodies, threads, &mut progress)?,
        Grouping::Basic => basic(&mut forest, bodies, &bounds, options, &mut progress)?,
        Grouping::Hybrid => {
            let mut siblings = sibling_pairs(order.iter().copied(), |part, visit| {
                parts[part as usize].edges(primitives, visit);
            });
            for pair in &mut siblings {
                *pair = pair.map(|leaf| holders[leaf as usize]);
            }
            siblings.retain(|[a, b]| a != b);
            let mut adjacent = Adjacent::new(options.cost, forest.extents.len(), &siblings);
            drop(siblings);
            progress.at(0.1)?;
            let first = first_limits(&forest, &bodies, options);
            let chunks = cluster(
                &mut forest,
                bodies,
                &mut adjacent,
                first,
                bounds.diameter(),
                threads,
                &mut progress.part(0.1, 0.6),
            )?;
            drop(adjacent);
            let mut rest = progress.part(0.6, 1.0);
            basic(&mut forest, chunks, &bounds, options, &mut rest)?
        }
    };
    let (forest, names) = rebalanced(forest);
    let mut piece_roots: Vec<u32> = piece_roots.iter().map(|&i| names[i as usize]).collect();
    piece_roots.sort_unstable();
    let (mut subsets, at) = forest.into_tree(names[root as usize]);
    for node in &mut subsets.nodes {
        if let Node::Leaf { primitive } = node {
            *primitive = order[*primitive as usize];
        }
    }
    let pieces = (0..at.len() as u32)
        .filter(|&node| piece_roots.binary_search(&at[node as usize]).is_ok())
        .collect();
    Ok(Groups { subsets, pieces })
}

/// Builds a tree for each piece. Returns the parentless bodies, the parentless body that holds each leaf, and the pieces'
/// roots.
fn join_pieces(
    forest: &mut Forest,
    pieces: &[Vec<u32>],
    order: &[u32],
) -> (Vec<u32>, Vec<u32>, Vec<u32>) {
    let mut holders: Vec<u32> = (0..order.len() as u32).collect();
    if pieces.is_empty() {
        return (holders.clone(), holders, Vec::new());
    }
    let mut roots = Vec::new();
    let mut leaf_of = vec![0; order.len()];
    for (leaf, &part) in order.iter().enumerate() {
        leaf_of[part as usize] = leaf as u32;
    }
    for piece in pieces.iter().filter(|piece| piece.len() > 1) {
        let leaves: Vec<u32> = piece.iter().map(|&part| leaf_of[part as usize]).collect();
        let root = split_within(forest, leaves.clone(), levels_for(leaves.len()));
        for leaf in leaves {
            holders[leaf as usize] = root;
        }
        roots.push(root);
    }
    let mut bodies = holders.clone();
    bodies.sort_unstable();
    bodies.dedup();
    (bodies, holders, roots)
}

/// Runs the basic clustering algorithm; returns the root.
fn basic(
    forest: &mut Forest,
    bodies: Vec<u32>,
    bounds: &Extent,
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<u32> {
    let mut rule = Nearby::new(options.cost, bounds);
    let first = first_limits(forest, &bodies, options);
    let last = bounds.diameter();
    let threads = options.thread_count();
    let parentless = cluster(forest, bodies, &mut rule, first, last, threads, progress)?;
    Ok(parentless[0])
}

fn first_limits(forest: &Forest, bodies: &[u32], options: &HierarchyOptions) -> Limits {
    let diameters = bodies.iter().map(|&i| forest.diameters[i as usize]);
    // A floor, so that doubling the limit ends and does not round to 0.
    let limit_or = |value: f64, automatic: f64| {
        let limit = if value > 0.0 { value } else { automatic };
        limit.max(forest.smallest)
    };
    let diameter = limit_or(
        options.diameter_limit,
        2.0 * diameters.fold(f64::INFINITY, f64::min),
    );
    Limits {
        diameter,
        gap: limit_or(options.gap_limit, 0.25 * diameter),
    }
}
