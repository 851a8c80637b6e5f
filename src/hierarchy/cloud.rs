//! The hierarchy of a body of nothing but points, maybe with radii: its boxes are fitted to the points themselves, and its
//! wrappers are made only when they are asked for.

use std::time::Instant;

use super::cover::outwards;
use super::extremes::extremes;
use super::grouping::Groups;
use super::packed_box::{fitted_axes, simply_fitted_axes};
use super::packed_tree::{Ball, PackedTree};
use super::parallel::{self, Progress};
use super::point_groups::{PointGroups, PointSet};
use super::statistics::of_extents;
use super::wide_node::{Held, WideNode};
use super::{BuildTimes, Extent, Grouping, HierarchyOptions, TreeStatistics, WrapperTree};
use crate::error::Result;
use crate::pose::{Mat3, Vec3};
use crate::primitive::Primitives;

/// Wide nodes that a thread makes at a time.
const TASK: usize = 256;

/// Boxes around more points than this are worth a search for the best axes, among few of the points that lie farthest out.
const MANY: usize = 512;

/// What a build of points makes.
pub struct Cloud {
    pub packed: PackedTree,
    /// Of the binary tree.
    pub depth: usize,
    pub times: BuildTimes,
}

/// Whether primitives are built as a cloud: they are all points, and grouping by clusters is not asked for by name.
pub fn is_cloud(primitives: &Primitives, options: &HierarchyOptions) -> bool {
    primitives.are_points() && options.grouping != Grouping::Basic
}

/// Builds the hierarchy of points. `progress` hears the fraction done, on this thread, and may end the work with an error.
pub fn build_cloud(
    primitives: &Primitives,
    options: &HierarchyOptions,
    progress: &mut dyn FnMut(f64) -> Result<()>,
) -> Result<Cloud> {
    options.check()?;
    let mut progress = Progress::new(progress);
    progress.at(0.0)?;
    let start = Instant::now();
    let threads = options.thread_count();
    let groups = groups(primitives, threads, &mut progress.part(0.0, 0.6))?;
    let depth = groups.depth();
    let grouped = start.elapsed().as_secs_f64();
    let packed = pack(primitives, &groups, threads, &mut progress.part(0.6, 1.0))?;
    let times = BuildTimes {
        preparation: 0.0,
        grouping: grouped,
        construction: start.elapsed().as_secs_f64() - grouped,
    };
    Ok(Cloud {
        packed,
        depth,
        times,
    })
}

/// The wrapper tree of points that were built as a cloud.
pub fn wrap_cloud(primitives: &Primitives, options: &HierarchyOptions) -> WrapperTree {
    let subsets = regroup(primitives, options).subsets();
    let groups = Groups {
        subsets,
        pieces: Vec::new(),
    };
    let points_of = |primitive: u32| {
        let point = primitives.get(primitive as usize);
        let corners = point.shape.bounding_points();
        let around: Vec<Vec3> = corners
            .iter()
            .map(|corner| corner + point.vertices[0])
            .collect();
        (around, 0.0)
    };
    let mut unheard = |_| Ok(());
    let tree = WrapperTree::build(groups, points_of, options, &mut Progress::new(&mut unheard));
    tree.expect("nothing ends the work")
}

/// What the hierarchy of points is like, by the boxes of the points along the axes of coordinates, without its wrappers.
pub fn cloud_statistics(primitives: &Primitives, options: &HierarchyOptions) -> TreeStatistics {
    let subsets = regroup(primitives, options).subsets();
    let mut extents = vec![Extent::default(); subsets.nodes.len()];
    for (i, node) in subsets.nodes.iter().enumerate().rev() {
        extents[i] = match *node {
            super::Node::Leaf { primitive } => {
                let (low, high) = primitives.get(primitive as usize).extent();
                Extent { low, high }
            }
            super::Node::Interior { children: [a, b] } => {
                extents[a as usize].union(&extents[b as usize])
            }
        };
    }
    of_extents(&subsets, &extents)
}

/// The ball around points, as [`PackedTree`] keeps it.
pub fn ball_of(primitives: &Primitives) -> Ball {
    let points = primitives.points();
    let center = Extent::of(points).center();
    let squares = points.iter().map(|p| (p - center).norm_squared());
    let farthest = squares.fold(0.0, f64::max).sqrt() + primitives.largest_point_radius();
    Ball {
        center,
        radius: outwards(farthest, &center),
    }
}

fn groups(primitives: &Primitives, threads: usize, progress: &mut Progress) -> Result<PointGroups> {
    let margin = primitives.largest_point_radius();
    PointGroups::new(primitives.points(), margin, threads, progress)
}

fn regroup(primitives: &Primitives, options: &HierarchyOptions) -> PointGroups {
    let mut unheard = |_| Ok(());
    let made = groups(
        primitives,
        options.thread_count(),
        &mut Progress::new(&mut unheard),
    );
    made.expect("nothing ends the work")
}

/// A wide node to be made: its children, and what they will be called.
struct Plan {
    children: Vec<PointSet>,
    names: [u32; 8],
}

fn pack(
    primitives: &Primitives,
    groups: &PointGroups,
    threads: usize,
    progress: &mut Progress,
) -> Result<PackedTree> {
    let mut packed = PackedTree::empty(ball_of(primitives));
    let unit = 1.0 / packed.scale();
    let in_order = groups.order.iter();
    let points: Vec<Vec3> = in_order
        .map(|&i| primitives.points()[i as usize] * unit)
        .collect();
    let radii = Radii::new(primitives, groups, unit);
    packed.primitives.reserve(groups.order.len());
    for &primitive in &groups.order {
        let shape = primitives.get(primitive as usize).shape;
        packed.primitives.push(primitive, shape);
    }
    let plans = plans(groups);
    progress.at(0.2)?;
    let mut rest = progress.part(0.2, 1.0);
    let made = parallel::map(threads, plans.len().div_ceil(TASK), &mut rest, |t| {
        let tasks = plans[t * TASK..].iter().take(TASK);
        let nodes = tasks.map(|plan| node_of(plan, &points, &radii));
        nodes.collect::<Vec<WideNode>>()
    })?;
    packed.nodes = Vec::with_capacity(plans.len());
    packed.nodes.extend(made.into_iter().flatten());
    packed.finish(ball_of(primitives), primitives.only());
    Ok(packed)
}

/// The wide nodes, each before its children; the first has one child, the root.
fn plans(groups: &PointGroups) -> Vec<Plan> {
    let mut plans: Vec<Plan> = Vec::with_capacity(groups.order.len() / 6 + 2);
    plans.push(Plan {
        children: vec![groups.whole()],
        names: [0; 8],
    });
    let mut open = vec![(groups.whole(), 0, 0)];
    while let Some((set, above, lane)) = open.pop() {
        plans[above].names[lane] = if set.leaves.len() == 1 {
            PackedTree::leaf(set.leaves.start as u32)
        } else {
            let index = plans.len();
            let children = groups.eight_below(&set);
            let named = children.iter().cloned().enumerate();
            open.extend(named.rev().map(|(lane, child)| (child, index, lane)));
            plans.push(Plan {
                children,
                names: [0; 8],
            });
            index as u32
        };
    }
    plans
}

fn node_of(plan: &Plan, points: &[Vec3], radii: &Radii) -> WideNode {
    let held = |set: &PointSet| {
        let points = &points[set.leaves.clone()];
        Held {
            axes: axes_of(points),
            excess: radii.largest(set),
            points: points.into(),
        }
    };
    let held: Vec<Held> = plan.children.iter().map(held).collect();
    let mut node = WideNode::new(&held);
    node.children = plan.names;
    node
}

fn axes_of(points: &[Vec3]) -> Mat3 {
    match points.len() {
        1 => Mat3::identity(),
        count if count > MANY => fitted_axes(&extremes(points), None),
        _ => simply_fitted_axes(points),
    }
}

/// The radii around points, in units of the tree.
enum Radii {
    /// One for all.
    Same(f64),
    /// In the order of the leaves.
    Each(Vec<f64>),
}

impl Radii {
    fn new(primitives: &Primitives, groups: &PointGroups, unit: f64) -> Self {
        let largest = primitives.largest_point_radius();
        match primitives.have_one_radius() {
            true => Self::Same(largest * unit),
            false => {
                let radius = |&i: &u32| primitives.get(i as usize).shape.radius() * unit;
                Self::Each(groups.order.iter().map(radius).collect())
            }
        }
    }

    fn largest(&self, set: &PointSet) -> f64 {
        match self {
            Self::Same(radius) => *radius,
            Self::Each(radii) => radii[set.leaves.clone()]
                .iter()
                .copied()
                .fold(0.0, f64::max),
        }
    }
}
