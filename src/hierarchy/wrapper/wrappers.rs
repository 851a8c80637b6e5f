//! The wrapper tree of a body, for drawing, covers and access to single nodes; queries use the packed tree.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use super::wrapper_tree::WrapperTree;
use crate::boxes::Extent;
use crate::hierarchy::grouping::Groups;
use crate::hierarchy::packed::regroup;
use crate::hierarchy::{
    Ball, HierarchyOptions, Node, Progress, SubsetTree, TreeStatistics, WrapperKind, of_extents,
};
use crate::primitive::Primitives;

/// The wrappers of a body. If the packed boxes are fitted to them they are built with the body, otherwise on first use:
/// queries do not need them, and they take several times the time and memory of everything else.
#[derive(Debug)]
pub enum Wrappers {
    /// Built with the body.
    Eager(Box<WrapperTree>),
    /// Built on first use.
    OnDemand {
        /// Shared with the bodies that were refitted to other vertices. `None` for a point cloud, whose groups are recomputed.
        groups: Option<Arc<Groups>>,
        options: HierarchyOptions,
        tree: OnceLock<Box<WrapperTree>>,
    },
}

impl Wrappers {
    pub(crate) fn on_demand(groups: Option<Groups>, options: &HierarchyOptions) -> Self {
        Self::OnDemand {
            groups: groups.map(Arc::new),
            options: *options,
            tree: OnceLock::new(),
        }
    }

    /// The wrappers of a point cloud, built on first use.
    pub fn of_cloud(options: &HierarchyOptions) -> Self {
        Self::on_demand(None, options)
    }

    /// Hulls over a valid tree whose leaves are primitives, built on first use.
    pub fn of_groups(groups: Groups, options: &HierarchyOptions) -> Self {
        Self::on_demand(Some(groups), options)
    }

    /// The tree over the body's primitives; built here if this is the first use.
    pub fn tree(&self, primitives: &Primitives) -> &WrapperTree {
        match self {
            Self::Eager(tree) => tree,
            Self::OnDemand {
                groups,
                options,
                tree,
            } => tree.get_or_init(|| {
                let groups = groups_of(groups.as_deref(), primitives, options).into_owned();
                Box::new(wrap(groups, primitives, options))
            }),
        }
    }

    pub fn kind(&self) -> WrapperKind {
        match self {
            Self::Eager(tree) => tree.kind(),
            Self::OnDemand { options, .. } => options.wrapper,
        }
    }

    /// The tree of sets and its pieces, unless they are computed anew when they are needed.
    pub fn subsets(&self) -> Option<(&SubsetTree, &[u32])> {
        match self {
            Self::Eager(tree) => Some((tree.subsets(), tree.pieces())),
            Self::OnDemand { groups, .. } => {
                let groups = groups.as_ref()?;
                Some((&groups.subsets, &groups.pieces))
            }
        }
    }

    /// The ball around the body's primitives.
    pub fn ball(&self, primitives: &Primitives) -> Ball {
        match self {
            Self::Eager(tree) => tree.ball(),
            Self::OnDemand { .. } => Ball::around(primitives),
        }
    }

    /// The statistics of the hierarchy; if its wrappers are built on demand, from axis-aligned boxes of the primitives. The
    /// bytes are those of the groups and of the wrappers built so far.
    pub fn statistics(&self, primitives: &Primitives) -> TreeStatistics {
        match self {
            Self::Eager(tree) => tree.statistics(),
            Self::OnDemand {
                groups,
                options,
                tree,
            } => {
                let group_bytes = groups.as_deref().map_or(0, Groups::bytes);
                let groups = groups_of(groups.as_deref(), primitives, options);
                TreeStatistics {
                    pieces: groups.pieces.len() as u64,
                    bytes: (group_bytes + tree.get().map_or(0, |tree| tree.bytes())) as u64,
                    ..of_extents(&groups.subsets, &extents(&groups, primitives))
                }
            }
        }
    }
}

fn groups_of<'a>(
    known: Option<&'a Groups>,
    primitives: &Primitives,
    options: &HierarchyOptions,
) -> Cow<'a, Groups> {
    match known {
        Some(groups) => Cow::Borrowed(groups),
        None => Cow::Owned(regroup(primitives, options)),
    }
}

fn wrap(groups: Groups, primitives: &Primitives, options: &HierarchyOptions) -> WrapperTree {
    let points_of = |primitive: u32| {
        let primitive = primitives.get(primitive as usize);
        (primitive.bounding_points().collect(), 0.0)
    };
    let mut ignored = |_| Ok(());
    let tree = WrapperTree::build(groups, points_of, options, &mut Progress::new(&mut ignored));
    tree.expect("nothing ends the work")
}

/// The axis-aligned boxes of all nodes.
fn extents(groups: &Groups, primitives: &Primitives) -> Vec<Extent> {
    let nodes = &groups.subsets.nodes;
    let mut extents = vec![Extent::default(); nodes.len()];
    for (i, node) in nodes.iter().enumerate().rev() {
        extents[i] = match *node {
            Node::Leaf { primitive } => {
                Extent::of_points(primitives.get(primitive as usize).bounding_points())
            }
            Node::Interior { children: [a, b] } => extents[a as usize].union(&extents[b as usize]),
        };
    }
    extents
}
