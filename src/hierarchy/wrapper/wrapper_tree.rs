//! The construction phase (§3.2.4): a wrapper on every node of a subset tree.

use std::collections::HashMap;

use super::cover::{Corners, Cover, by_coordinates, merge_sorted};
use super::wrapper::Wrapper;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::grouping::Groups;
use crate::hierarchy::{Ball, HierarchyOptions, Node, Progress, SubsetTree, WrapperKind, parallel};
use crate::pose::Vec3;

/// The subset tree with the wrapper of each node, packed.
#[derive(Clone, Debug, PartialEq)]
pub struct WrapperTree {
    pub(crate) subsets: SubsetTree,
    pub(crate) frames: Vec<Frame>,
    pub(crate) corners: Vec<Vec3>,
    pub(crate) kind: WrapperKind,
    /// The nodes that hold maximal convex pieces, in ascending order.
    pub(crate) pieces: Vec<u32>,
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

/// A run of consecutive wrappers.
#[derive(Default)]
struct Packed {
    frames: Vec<Frame>,
    corners: Vec<Vec3>,
}

impl Packed {
    fn push(&mut self, cover: &Cover, corners: &[Vec3]) {
        self.frames.push(Frame {
            first_corner: self.corners.len(),
            corner_count: corners.len(),
            excess: cover.excess,
            center: cover.center,
            radius: cover.radius,
        });
        self.corners.extend_from_slice(corners);
    }

    /// Appends the wrappers of another run, last first.
    fn append_backwards(&mut self, other: &Packed) {
        for frame in other.frames.iter().rev() {
            let cover = Cover {
                excess: frame.excess,
                center: frame.center,
                radius: frame.radius,
            };
            self.push(
                &cover,
                &other.corners[frame.first_corner..][..frame.corner_count],
            );
        }
    }
}

/// What the wrapper of a parent needs from a child.
struct FinishedNode {
    cover: Cover,
    /// Sorted points whose hull, grown by `inherited`, bounds the subtree.
    points: Vec<Vec3>,
    inherited: f64,
    extent: Extent,
}

impl WrapperTree {
    /// Builds the wrappers bottom-up. `points_of` gives the points whose hull bounds a leaf's part, and how far rounding may
    /// leave the part outside that hull.
    pub fn build(
        groups: Groups,
        points_of: impl Fn(u32) -> (Vec<Vec3>, f64) + Sync,
        options: &HierarchyOptions,
        progress: &mut Progress,
    ) -> Result<Self> {
        let Groups { subsets, pieces } = groups;
        let builder = WrapperBuilder {
            sizes: subsets.sizes(),
            subsets: &subsets,
            pieces: &pieces,
            points_of,
            options,
        };
        let packed = builder.build(progress)?;
        Ok(Self {
            subsets,
            kind: options.wrapper,
            pieces,
            frames: packed.frames,
            corners: packed.corners,
        })
    }

    /// Assembles a tree that was read from a file. The caller has checked that it is valid.
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

    /// The bounding ball of the body.
    pub fn ball(&self) -> Ball {
        let root = self.wrapper(0);
        Ball {
            center: root.center,
            radius: root.radius,
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

/// Builds the wrappers of a subset tree.
struct WrapperBuilder<'a, F> {
    subsets: &'a SubsetTree,
    /// The number of nodes of each subtree.
    sizes: Vec<u32>,
    pieces: &'a [u32],
    points_of: F,
    options: &'a HierarchyOptions,
}

impl<F: Fn(u32) -> (Vec<Vec3>, f64) + Sync> WrapperBuilder<'_, F> {
    /// The wrappers of all nodes, in the order of the nodes. The threads share the small subtrees; the nodes above these
    /// follow. A node's wrapper depends on its subtree alone, so the result does not depend on the split into tasks.
    fn build(&self, progress: &mut Progress) -> Result<Packed> {
        let threads = self.options.thread_count();
        let (tasks, upper) = self.split(threads);
        let subtrees = parallel::map(threads, tasks.len(), &mut progress.part(0.0, 0.9), |t| {
            self.wrap_subtree(tasks[t])
        })?;
        let mut parentless: HashMap<usize, FinishedNode> = HashMap::new();
        let mut runs: Vec<(usize, Packed)> = Vec::new();
        for (&from, (wrappers, root)) in tasks.iter().zip(subtrees) {
            runs.push((from, wrappers));
            parentless.extend(root.map(|root| (from, root)));
        }
        let count = upper.len();
        for (i, node) in upper.into_iter().rev().enumerate() {
            let children = match self.subsets.nodes[node] {
                Node::Leaf { .. } => None,
                Node::Interior { children } => {
                    let [a, b] = children.map(|child| parentless.remove(&(child as usize)));
                    a.zip(b).map(<[_; 2]>::from)
                }
            };
            let mut one = Packed::default();
            parentless.insert(node, self.wrap_node(node, children, &mut one));
            runs.push((node, one));
            progress.at(0.9 + 0.1 * (i + 1) as f64 / count as f64)?;
        }
        drop(parentless);
        Ok(in_node_order(runs, self.subsets.nodes.len()))
    }

    /// The roots of the small subtrees, which are the tasks of the threads, and the nodes above them.
    fn split(&self, threads: usize) -> (Vec<usize>, Vec<usize>) {
        let count = self.subsets.nodes.len();
        let task_size = (count / (16 * threads)).max(512);
        let (mut tasks, mut upper) = (Vec::new(), Vec::new());
        let mut node = 0;
        while node < count {
            if self.sizes[node] as usize <= task_size {
                tasks.push(node);
                node += self.sizes[node] as usize;
            } else {
                upper.push(node);
                node += 1;
            }
        }
        (tasks, upper)
    }

    /// The wrappers of a subtree, last node first, and what its parent needs of it.
    fn wrap_subtree(&self, from: usize) -> (Packed, Option<FinishedNode>) {
        let mut stack: Vec<FinishedNode> = Vec::new();
        let mut packed = Packed::default();
        // In reverse order children come before their parents, the first child last.
        for node in (from..from + self.sizes[from] as usize).rev() {
            let children = match self.subsets.nodes[node] {
                Node::Leaf { .. } => None,
                Node::Interior { .. } => stack.pop().zip(stack.pop()).map(<[_; 2]>::from),
            };
            stack.push(self.wrap_node(node, children, &mut packed));
        }
        (packed, stack.pop())
    }

    fn wrap_node(
        &self,
        node: usize,
        children: Option<[FinishedNode; 2]>,
        packed: &mut Packed,
    ) -> FinishedNode {
        let mut options = *self.options;
        if self.pieces.binary_search(&(node as u32)).is_ok() {
            // A convex piece is bounded exactly.
            options.hull_vertex_limit = u32::MAX;
        }
        match (self.subsets.nodes[node], children) {
            (Node::Leaf { primitive }, _) => {
                let (points, slack) = (self.points_of)(primitive);
                wrap_leaf(points, slack, &options, packed)
            }
            (_, Some(children)) => wrap_children(children, &options, packed),
            (_, None) => unreachable!("an interior node has children"),
        }
    }
}

/// Joins runs of wrappers, each from its last node back to its first, which is given, into the wrappers of all nodes in order.
fn in_node_order(mut runs: Vec<(usize, Packed)>, node_count: usize) -> Packed {
    runs.sort_unstable_by_key(|(first, _)| *first);
    let mut all = Packed::default();
    all.frames.reserve_exact(node_count);
    all.corners
        .reserve_exact(runs.iter().map(|(_, run)| run.corners.len()).sum());
    for (_, run) in runs {
        all.append_backwards(&run);
    }
    all
}

/// `slack` is how far the leaf's part may lie outside the points' hull.
fn wrap_leaf(
    mut points: Vec<Vec3>,
    slack: f64,
    options: &HierarchyOptions,
    packed: &mut Packed,
) -> FinishedNode {
    points.sort_unstable_by(by_coordinates);
    points.dedup();
    wrap(Extent::of(&points), points, slack, None, options, packed)
}

fn wrap_children(
    [a, b]: [FinishedNode; 2],
    options: &HierarchyOptions,
    packed: &mut Packed,
) -> FinishedNode {
    let extent = a.extent.union(&b.extent);
    let points = merge_sorted(&a.points, &b.points);
    let inherited = a.inherited.max(b.inherited);
    let covers = Some([&a.cover, &b.cover]);
    wrap(extent, points, inherited, covers, options, packed)
}

/// Wraps the geometry of a node, which lies within `inherited` of the points' hull.
fn wrap(
    extent: Extent,
    mut points: Vec<Vec3>,
    mut inherited: f64,
    children: Option<[&Cover; 2]>,
    options: &HierarchyOptions,
    packed: &mut Packed,
) -> FinishedNode {
    let (cover, corners) = match (options.wrapper, children) {
        (WrapperKind::Hull, _) => Cover::hull(&points, &extent, options.hull_vertex_limit as usize),
        (WrapperKind::OrientedBox, _) => Cover::oriented_box(&points, &extent),
        (WrapperKind::AlignedBox, _) => Cover::aligned_box(&extent),
        (WrapperKind::MergedSphere, Some([a, b])) => Cover::merged_sphere(a, b),
        (WrapperKind::TightSphere | WrapperKind::MergedSphere, _) => Cover::tight_sphere(&points),
    };
    // The children's spheres have been grown already.
    let merged = options.wrapper == WrapperKind::MergedSphere && children.is_some();
    let cover = cover.grown(if merged { 0.0 } else { inherited });
    match corners {
        Corners::Points => packed.push(&cover, &points),
        // The nodes above take the hull's vertices for its points. A box's corners would not do: they loosen the hulls above.
        Corners::Hull(corners) => {
            packed.push(&cover, &corners);
            points = corners;
            points.sort_unstable_by(by_coordinates);
            inherited = cover.excess;
        }
        Corners::New(corners) => packed.push(&cover, &corners),
    }
    if matches!(
        options.wrapper,
        WrapperKind::AlignedBox | WrapperKind::MergedSphere
    ) {
        // These wrappers need no points above the leaves.
        points = Vec::new();
    }
    FinishedNode {
        cover,
        points,
        inherited,
        extent,
    }
}
