//! The hierarchy of a body that has other bodies as parts: only the parts are grouped, their own trees are taken over
//! (§3.1.3, component objects that are grouped separately and repeated groups that are copy-moved).

use std::borrow::Cow;
use std::time::Instant;

use smallvec::SmallVec;

use super::ball::Ball;
use super::build::{BuildTimes, Hierarchy, build_hierarchy, wrapped_anew};
use super::options::{HierarchyOptions, WrapperKind};
use super::parallel::Progress;
use super::subset_tree::{Node, SubsetTree};
use crate::error::Result;
use crate::hierarchy::grouping::{Groups, convex_pieces, group, parts};
use crate::hierarchy::packed::{PackedPart, PackedTree, TopLeaf, pack_parts};
use crate::hierarchy::wrapper::Wrappers;
use crate::pose::{Pose, Vec3};
use crate::primitive::{Convex, Primitives, SharedList};

/// Deeper trees are grouped anew. Body files hold trees of up to 63 levels.
const MAX_LEVELS: usize = 56;

/// A body that is part of another.
#[derive(Debug)]
pub struct PartHierarchy<'a> {
    /// The tree that queries traverse.
    pub packed: &'a PackedTree,
    /// Its tree of sets, or what builds it.
    pub wrappers: &'a Wrappers,
    /// From the part's own frame to that of the whole.
    pub pose: Pose,
    /// The number that its first primitive has in the whole.
    pub first: u32,
}

/// Builds the hierarchy of `primitives`, of which those of `parts` have hierarchies already; `single` are the others, in
/// order. `aspect_limit` is not applied.
pub fn compose_hierarchy(
    primitives: &Primitives,
    single: &[u32],
    parts: &[PartHierarchy],
    options: &HierarchyOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<Hierarchy> {
    options.check()?;
    let start = Instant::now();
    let (groups, top) = {
        let mut progress = Progress::new(progress);
        progress.at(0.0)?;
        let top = group_parts(
            primitives,
            single,
            parts,
            options,
            &mut progress.part(0.0, 0.4),
        )?;
        (spliced(&top, single, parts), top)
    };
    if groups.subsets.depth() > MAX_LEVELS {
        return build_hierarchy(primitives, options, progress);
    }
    let grouped = start.elapsed().as_secs_f64();
    let (nodes, depth) = (groups.subsets.nodes.len(), groups.subsets.depth());
    let mut progress = Progress::new(progress);
    let mut rest = progress.part(0.4, 1.0);
    let (wrappers, packed) = if options.wrapper == WrapperKind::Hull {
        let packed = pack(primitives, &top, single, parts, &mut rest)?;
        (Wrappers::of_groups(groups, options), packed)
    } else {
        wrapped_anew(primitives, groups, options, &mut rest)?
    };
    progress.at(1.0)?;
    let times = BuildTimes {
        preparation: 0.0,
        grouping: grouped,
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

/// Groups the single primitives and the boxes of the parts. In the tree, leaf i is single primitive i, or the part after all
/// of them.
fn group_parts(
    primitives: &Primitives,
    single: &[u32],
    parts: &[PartHierarchy],
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<Groups> {
    let of_single = single
        .iter()
        .map(|&i| primitives.get(i as usize).moved(&Vec3::zeros()));
    let mut shapes: Vec<Convex> = of_single.collect();
    let pieces = convex_pieces(&shapes, options.pieces, &mut progress.part(0.0, 0.2))?;
    shapes.extend(parts.iter().map(PartHierarchy::box_shape));
    let leaves = self::parts(&shapes, 0.0);
    group(
        &shapes,
        &leaves,
        &pieces,
        options,
        &mut progress.part(0.2, 1.0),
    )
}

impl PartHierarchy<'_> {
    /// The box of its root, for the grouping alone.
    fn box_shape(&self) -> Convex {
        let whole = self.packed.bounding_box(self.packed.root());
        let scale = self.packed.scale();
        let corner = |k: usize| {
            let mut corner = Vec3::from(whole.center.map(f64::from));
            for i in 0..3 {
                let side = Vec3::from(whole.axes[i].map(f64::from)) * f64::from(whole.half[i]);
                corner += if k >> i & 1 == 0 { -side } else { side };
            }
            self.pose.transform_point(&(corner * scale))
        };
        Convex {
            vertices: (0..8).map(corner).collect(),
            edges: SharedList::default(),
            faces: SmallVec::new(),
            deviation: 0.0,
            curve: None,
        }
    }

    /// Its tree of sets and the pieces.
    fn subsets(&self) -> (Cow<'_, SubsetTree>, &[u32]) {
        match self.wrappers.subsets() {
            Some((subsets, pieces)) => (Cow::Borrowed(subsets), pieces),
            None => (Cow::Owned(self.packed.subsets()), &[]),
        }
    }
}

/// The top tree with the trees of the parts in the place of their leaves.
fn spliced(top: &Groups, single: &[u32], parts: &[PartHierarchy]) -> Groups {
    let count = parts
        .iter()
        .map(|part| 2 * part.packed.primitives().len())
        .sum::<usize>();
    let mut nodes: Vec<Node> = Vec::with_capacity(top.subsets.nodes.len() + count);
    let mut pieces = Vec::new();
    // Where each node of the top tree comes to stand.
    let mut at = Vec::with_capacity(top.subsets.nodes.len());
    for (i, node) in top.subsets.nodes.iter().enumerate() {
        let first = nodes.len() as u32;
        at.push(first);
        if top.pieces.binary_search(&(i as u32)).is_ok() {
            pieces.push(first);
        }
        match *node {
            Node::Interior { .. } => nodes.push(*node),
            Node::Leaf { primitive } => match single.get(primitive as usize) {
                Some(&primitive) => nodes.push(Node::Leaf { primitive }),
                None => {
                    let part = &parts[primitive as usize - single.len()];
                    let (subsets, own) = part.subsets();
                    pieces.extend(own.iter().map(|piece| first + piece));
                    nodes.extend(subsets.nodes.iter().map(|node| match *node {
                        Node::Leaf { primitive } => Node::Leaf {
                            primitive: part.first + primitive,
                        },
                        Node::Interior { children } => Node::Interior {
                            children: children.map(|child| first + child),
                        },
                    }));
                }
            },
        }
    }
    for (node, &at_node) in top.subsets.nodes.iter().zip(&at) {
        if let Node::Interior { children } = *node {
            nodes[at_node as usize] = Node::Interior {
                children: children.map(|child| at[child as usize]),
            };
        }
    }
    Groups {
        subsets: SubsetTree { nodes },
        pieces,
    }
}

fn pack(
    primitives: &Primitives,
    top: &Groups,
    single: &[u32],
    parts: &[PartHierarchy],
    progress: &mut Progress,
) -> Result<PackedTree> {
    let of_node = |node: &Node| match *node {
        Node::Interior { .. } => None,
        Node::Leaf { primitive } => Some(match single.get(primitive as usize) {
            Some(&primitive) => TopLeaf::Primitive(primitive),
            None => TopLeaf::Part(primitive as usize - single.len()),
        }),
    };
    let leaves: Vec<TopLeaf> = top.subsets.nodes.iter().filter_map(of_node).collect();
    let parts: Vec<PackedPart> = parts
        .iter()
        .map(|part| PackedPart {
            tree: part.packed,
            pose: part.pose,
            first: part.first,
        })
        .collect();
    let ball = Ball::around(primitives);
    pack_parts(primitives, &top.subsets, &leaves, &parts, ball, progress)
}
