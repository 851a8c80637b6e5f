//! Groups large bodies region by region. Clustering a million primitives at once misses the cache; a region fits it, and
//! regions are grouped in parallel.

use super::binned_split::{Branch, Cut, cut, split_within};
use super::clusters::group_by_clusters;
use super::forest::Forest;
use super::parts::Part;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::{HierarchyOptions, Node, Progress, SubsetTree, parallel};
use crate::primitive::Convex;

/// The most parts of a region. A larger one no longer fits the cache; more parts of smaller ones are grouped by the split into
/// regions alone.
pub const REGION: usize = 16_384;

/// Groups at least one part by regions that are split top-down. The same input gives the same tree.
pub fn group_by_regions(
    primitives: &[Convex],
    parts: &[Part],
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<SubsetTree> {
    let extents: Vec<Extent> = parts.iter().map(|part| part.extent(primitives)).collect();
    let forest = Forest::new(extents);
    let mut order: Vec<u32> = (0..parts.len() as u32).collect();
    let regions = cut(&forest, &mut order, REGION);
    progress.at(0.1)?;
    let mut rest = progress.part(0.1, 0.95);
    let grouped = parallel::map(options.thread_count(), regions.sets.len(), &mut rest, |r| {
        let (range, levels) = &regions.sets[r];
        let members = &order[range.clone()];
        let tree = group_region(primitives, parts, members, options);
        if tree.depth() <= levels + 1 {
            return tree;
        }
        // The region's tree is too deep for its place in the whole tree; split top-down instead.
        let extents = members.iter().map(|&part| forest.extents[part as usize]);
        split_region(extents.collect(), members, *levels)
    })?;
    Ok(join(&regions, &grouped))
}

fn group_region(
    primitives: &[Convex],
    parts: &[Part],
    members: &[u32],
    options: &HierarchyOptions,
) -> SubsetTree {
    let one_thread = HierarchyOptions {
        threads: 1,
        ..*options
    };
    let mut ignored = |_| Ok(());
    let mut progress = Progress::new(&mut ignored);
    let groups = group_by_clusters(primitives, parts, members, &[], &one_thread, &mut progress);
    groups.expect("nothing ends the work").subsets
}

/// Builds a tree with at most `levels` levels below its root.
fn split_region(extents: Vec<Extent>, members: &[u32], levels: usize) -> SubsetTree {
    let mut forest = Forest::new(extents);
    let leaves = (0..members.len() as u32).collect();
    let root = split_within(&mut forest, leaves, levels);
    let (mut tree, _) = forest.into_tree(root);
    for node in &mut tree.nodes {
        if let Node::Leaf { primitive } = node {
            *primitive = members[*primitive as usize];
        }
    }
    tree
}

/// Joins the trees of all regions under the tree of the regions.
fn join(regions: &Cut, trees: &[SubsetTree]) -> SubsetTree {
    let count = trees.iter().map(|tree| tree.nodes.len()).sum::<usize>() + regions.pairs.len();
    let mut nodes = Vec::with_capacity(count);
    // A branch and, for second children, their parent.
    let mut open: Vec<(Branch, Option<usize>)> = vec![(regions.root, None)];
    while let Some((branch, parent)) = open.pop() {
        let index = nodes.len() as u32;
        if let Some(Node::Interior { children }) = parent.map(|parent| &mut nodes[parent]) {
            children[1] = index;
        }
        match branch {
            Branch::Body(region) => {
                let moved = trees[region as usize].nodes.iter().map(|node| match *node {
                    Node::Interior { children } => Node::Interior {
                        children: children.map(|child| child + index),
                    },
                    leaf => leaf,
                });
                nodes.extend(moved);
            }
            Branch::Pair(pair) => {
                let [first, second] = regions.pairs[pair as usize];
                nodes.push(Node::Interior {
                    children: [index + 1, index + 1],
                });
                open.push((second, Some(index as usize)));
                open.push((first, None));
            }
        }
    }
    SubsetTree { nodes }
}
