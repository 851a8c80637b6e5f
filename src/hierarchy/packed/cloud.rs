//! The hierarchy of a point cloud, maybe with radii. Its boxes are fitted to the points themselves; its wrappers are built
//! on first use.

use std::time::Instant;

use super::packed_tree::PackedTree;
use super::wide_plans::{LeafSets, wide_nodes};
use crate::boxes::{ChildPoints, fitted_axes, simply_fitted_axes};
use crate::error::Result;
use crate::hierarchy::grouping::{Groups, PointGroups, PointSet};
use crate::hierarchy::wrapper::Wrappers;
use crate::hierarchy::{
    Ball, BuildTimes, Grouping, Hierarchy, HierarchyOptions, Progress, extremes,
};
use crate::pose::{Mat3, Vec3};
use crate::primitive::Primitives;

/// Above this many points the axes of a box are searched for over the extreme points; below, the principal axes do. A smaller
/// value makes boxes tighter and takes longer to build.
const MIN_SEARCHED: usize = 512;

/// Whether primitives are built as a cloud: all are points, and `Grouping::Basic` is not asked for.
pub fn is_cloud(primitives: &Primitives, options: &HierarchyOptions) -> bool {
    primitives.are_points() && options.grouping != Grouping::Basic
}

/// Builds the hierarchy of a point cloud.
pub fn build_cloud(
    primitives: &Primitives,
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<Hierarchy> {
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
    Ok(Hierarchy {
        wrappers: Wrappers::of_cloud(options),
        packed,
        nodes: 2 * primitives.len() - 1,
        depth,
        times,
    })
}

fn groups(primitives: &Primitives, threads: usize, progress: &mut Progress) -> Result<PointGroups> {
    let margin = primitives.largest_point_radius();
    PointGroups::new(primitives.points(), margin, threads, progress)
}

/// Recomputes the groups of a body that was built as a cloud.
pub fn regroup(primitives: &Primitives, options: &HierarchyOptions) -> Groups {
    let mut ignored = |_| Ok(());
    let groups = groups(
        primitives,
        options.thread_count(),
        &mut Progress::new(&mut ignored),
    );
    Groups {
        subsets: groups.expect("nothing ends the work").subsets(),
        pieces: Vec::new(),
    }
}

fn pack(
    primitives: &Primitives,
    groups: &PointGroups,
    threads: usize,
    progress: &mut Progress,
) -> Result<PackedTree> {
    let mut packed = PackedTree::empty(Ball::around(primitives));
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
    progress.at(0.1)?;
    let cloud = CloudSets {
        groups,
        points,
        radii,
    };
    packed.nodes = wide_nodes(&cloud, threads, &mut progress.part(0.1, 1.0))?;
    packed.finish(Ball::around(primitives), primitives);
    Ok(packed)
}

/// The set tree of a cloud. Points are in leaf order, lengths in units of the packed tree.
struct CloudSets<'a> {
    groups: &'a PointGroups,
    points: Vec<Vec3>,
    radii: Radii,
}

impl LeafSets for CloudSets<'_> {
    type Set = PointSet;

    fn whole(&self) -> PointSet {
        self.groups.whole()
    }

    fn is_leaf(&self, set: &PointSet) -> bool {
        set.leaves.len() == 1
    }

    fn below(&self, set: &PointSet) -> Vec<PointSet> {
        self.groups.eight_below(set)
    }

    fn child_points(&self, set: &PointSet) -> ChildPoints<'_> {
        let points = &self.points[set.leaves.clone()];
        ChildPoints {
            axes: axes_of(points),
            excess: self.radii.largest(set),
            points: points.into(),
        }
    }
}

fn axes_of(points: &[Vec3]) -> Mat3 {
    match points.len() {
        1 => Mat3::identity(),
        count if count > MIN_SEARCHED => fitted_axes(&extremes(points), None),
        _ => simply_fitted_axes(points),
    }
}

/// The radii of the points, in units of the packed tree.
enum Radii {
    /// One for all.
    Same(f64),
    /// One per point, in leaf order.
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
