//! The construction phase (§3.2.4): a wrapper on every node of a subset tree.

use super::cover::{Cover, by_coordinates, merge_sorted};
use super::grouping::Groups;
use super::parallel::{self, Progress};
use super::parts::Part;
use super::{Extent, HierarchyOptions, Node, SubsetTree, Wrapper, WrapperKind};
use crate::error::Result;
use crate::pose::Vec3;
use crate::primitive::Convex;

/// The subset tree with the wrapper of each node, packed.
#[derive(Clone, Debug, PartialEq)]
pub struct WrapperTree {
    pub(super) subsets: SubsetTree,
    pub(super) frames: Vec<Frame>,
    pub(super) corners: Vec<Vec3>,
    pub(super) kind: WrapperKind,
    /// The nodes that hold maximal convex pieces, in ascending order.
    pub(super) pieces: Vec<u32>,
}

/// A wrapper whose corners lie in the tree's common array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub first_corner: usize,
    pub corner_count: usize,
    pub excess: f64,
    pub center: Vec3,
    pub radius: f64,
}

/// What a finished node hands up to its parent.
struct Finished {
    cover: Cover,
    /// Sorted points that stand for all below, and how far those may lie outside the points' hull.
    points: Vec<Vec3>,
    inherited: f64,
    extent: Extent,
}

impl WrapperTree {
    /// Builds the wrappers from the leaves up, over grouped parts of the primitives.
    pub fn build(
        groups: Groups,
        primitives: &[Convex],
        parts: &[Part],
        options: &HierarchyOptions,
        progress: &mut Progress,
    ) -> Result<Self> {
        let Groups {
            mut subsets,
            pieces,
        } = groups;
        let threads = options.thread_count();
        let sizes = subsets.sizes();
        // Subtrees small enough to be shared out; the nodes above them follow. A node's wrapper depends on its subtree
        // alone, so that the cut does not show.
        let task_size = (subsets.nodes.len() / (16 * threads)).max(512);
        let mut tasks = Vec::new();
        let mut upper = Vec::new();
        let mut node = 0;
        while node < subsets.nodes.len() {
            if sizes[node] as usize <= task_size {
                tasks.push(node);
                node += sizes[node] as usize;
            } else {
                upper.push(node);
                node += 1;
            }
        }
        let finish = |node: usize, children: Option<[Finished; 2]>| {
            let mut options = *options;
            if pieces.binary_search(&(node as u32)).is_ok() {
                // A convex piece is bounded exactly.
                options.hull_vertex_limit = u32::MAX;
            }
            match (subsets.nodes[node], children) {
                (Node::Leaf { primitive: part }, _) => {
                    let (points, doubt) = parts[part as usize].vertices(primitives);
                    wrap_leaf(points.to_vec(), doubt, &options)
                }
                (_, Some(children)) => wrap_children(children, &options),
                (_, None) => unreachable!("an interior node has children"),
            }
        };
        let done = parallel::map(threads, tasks.len(), &mut progress.part(0.0, 0.9), |t| {
            let from = tasks[t];
            let mut stack: Vec<Finished> = Vec::new();
            let mut covers = Vec::new();
            // Backwards, children come before their parents, and the first child last.
            for node in (from..from + sizes[from] as usize).rev() {
                let children = match subsets.nodes[node] {
                    Node::Leaf { .. } => None,
                    Node::Interior { .. } => stack.pop().zip(stack.pop()).map(<[_; 2]>::from),
                };
                let finished = finish(node, children);
                covers.push(finished.cover.clone());
                stack.push(finished);
            }
            (covers, stack.pop())
        })?;
        let mut waiting: Vec<Option<Finished>> = Vec::new();
        waiting.resize_with(subsets.nodes.len(), || None);
        let mut all: Vec<Option<Cover>> = vec![None; subsets.nodes.len()];
        for (&from, (covers, root)) in tasks.iter().zip(done) {
            for (node, cover) in (from..from + covers.len()).rev().zip(covers) {
                all[node] = Some(cover);
            }
            waiting[from] = root;
        }
        let count = upper.len();
        for (i, node) in upper.into_iter().rev().enumerate() {
            let children = match subsets.nodes[node] {
                Node::Leaf { .. } => None,
                Node::Interior { children } => {
                    let [a, b] = children.map(|child| waiting[child as usize].take());
                    a.zip(b).map(<[_; 2]>::from)
                }
            };
            let finished = finish(node, children);
            all[node] = Some(finished.cover.clone());
            waiting[node] = Some(finished);
            progress.at(0.9 + 0.1 * (i + 1) as f64 / count as f64)?;
        }
        for node in &mut subsets.nodes {
            if let Node::Leaf { primitive } = node {
                *primitive = parts[*primitive as usize].primitive;
            }
        }
        drop(waiting);
        let (mut frames, mut corners) = (Vec::with_capacity(all.len()), Vec::new());
        for cover in all.into_iter().flatten() {
            frames.push(Frame {
                first_corner: corners.len(),
                corner_count: cover.corners.len(),
                excess: cover.excess,
                center: cover.center,
                radius: cover.radius,
            });
            corners.extend(cover.corners);
        }
        Ok(Self {
            subsets,
            kind: options.wrapper,
            pieces,
            frames,
            corners,
        })
    }

    /// A tree from what is in a file. The caller has checked that it is sound.
    pub fn from_parts(
        subsets: SubsetTree,
        frames: Vec<Frame>,
        corners: Vec<Vec3>,
        kind: WrapperKind,
        pieces: Vec<u32>,
    ) -> Self {
        Self {
            subsets,
            frames,
            corners,
            kind,
            pieces,
        }
    }

    /// The kind of its wrappers.
    pub fn kind(&self) -> WrapperKind {
        self.kind
    }

    /// The nodes that hold maximal convex pieces: each wrapper is the hull of a convex part of the body's surface.
    pub fn pieces(&self) -> &[u32] {
        &self.pieces
    }

    pub fn subsets(&self) -> &SubsetTree {
        &self.subsets
    }

    pub fn node(&self, node: u32) -> Node {
        self.subsets.nodes[node as usize]
    }

    pub fn wrapper(&self, node: u32) -> Wrapper<'_> {
        let frame = &self.frames[node as usize];
        Wrapper {
            corners: &self.corners[frame.first_corner..][..frame.corner_count],
            excess: frame.excess,
            center: frame.center,
            radius: frame.radius,
        }
    }

    pub fn radius(&self, node: u32) -> f64 {
        self.frames[node as usize].radius
    }

    /// Bytes of memory the tree takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.subsets.nodes[..])
            + size_of_val(&self.frames[..])
            + size_of_val(&self.corners[..])
    }
}

/// `doubt` says how far the leaf's part may lie outside the points' hull.
fn wrap_leaf(mut points: Vec<Vec3>, doubt: f64, options: &HierarchyOptions) -> Finished {
    points.sort_unstable_by(by_coordinates);
    points.dedup();
    wrap(Extent::of(&points), points, doubt, None, options)
}

fn wrap_children([a, b]: [Finished; 2], options: &HierarchyOptions) -> Finished {
    let extent = a.extent.union(&b.extent);
    let points = merge_sorted(&a.points, &b.points);
    let inherited = a.inherited.max(b.inherited);
    wrap(
        extent,
        points,
        inherited,
        Some([&a.cover, &b.cover]),
        options,
    )
}

fn wrap(
    extent: Extent,
    points: Vec<Vec3>,
    inherited: f64,
    children: Option<[&Cover; 2]>,
    options: &HierarchyOptions,
) -> Finished {
    let finished = |cover, points, inherited| Finished {
        cover,
        points,
        inherited,
        extent,
    };
    match options.wrapper {
        WrapperKind::Hull => {
            let (cover, is_hull) = Cover::hull(&points, options.hull_vertex_limit as usize);
            if is_hull {
                // A hull's vertices stand for all below from here on; a box's corners would loosen the hulls above.
                let excess = inherited + cover.excess;
                finished(cover.clone().grown(inherited), cover.corners, excess)
            } else {
                finished(cover.grown(inherited), points, inherited)
            }
        }
        WrapperKind::OrientedBox => {
            let cover = Cover::oriented_box(&points).grown(inherited);
            finished(cover, points, inherited)
        }
        WrapperKind::TightSphere => {
            let cover = Cover::tight_sphere(&points).grown(inherited);
            finished(cover, points, inherited)
        }
        // These need no points above the leaves.
        WrapperKind::AlignedBox => {
            let cover = Cover::aligned_box(&extent).grown(inherited);
            finished(cover, Vec::new(), inherited)
        }
        WrapperKind::MergedSphere => {
            let cover = match children {
                Some([a, b]) => Cover::merged_sphere(a, b),
                None => Cover::tight_sphere(&points).grown(inherited),
            };
            finished(cover, Vec::new(), 0.0)
        }
    }
}
