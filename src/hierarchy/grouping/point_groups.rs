//! Groups points by top-down splits with a surface-area heuristic, at counts that make the nodes of eight children full.
//!
//! The nodes of eight children follow from the binary tree. Let a node's set hold more than 8^k points and at most 8^(k + 1).
//! Its children are then found by descending from the set until each set holds at most 8^k. Sets of more than 8 points are
//! split at multiples of 8, so that all but one of the lowest nodes hold eight points.

use std::ops::Range;
use std::sync::Mutex;

use super::binned_split::levels_for;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::{Node, Progress, SubsetTree, parallel};
use crate::pose::Vec3;

/// The number of children of a full node.
const FULL: usize = 8;

/// Number of bins per axis. More find better splits and take longer.
const BINS: usize = 16;

/// The heuristic samples at least this many points of a larger set; the best split hardly changes with more.
const SAMPLE: usize = 1024;

/// Sets larger than this are split on the calling thread; smaller ones are the tasks of the threads. A smaller value shares the
/// work more evenly, but leaves more of it to one thread.
const TASK: usize = 8192;

/// The binary tree over points.
pub struct PointGroups {
    /// The points' indices in the order of the leaves.
    pub order: Vec<u32>,
    /// Per interior node in depth-first order, the number of leaves of its first child.
    splits: Vec<u32>,
}

/// A set of points as a range in leaf order, and the index of its first interior node.
#[derive(Clone, Debug)]
pub struct PointSet {
    pub leaves: Range<usize>,
    splits: usize,
}

#[derive(Clone, Copy)]
struct Entry {
    point: Vec3,
    index: u32,
}

/// A set to be split.
struct Task<'a> {
    entries: &'a mut [Entry],
    limits: Limits,
}

/// The limits on the tree over a set.
#[derive(Clone, Copy)]
struct Limits {
    /// The most levels below the set.
    levels: usize,
    /// The most points in a child of the node of eight that the set belongs to.
    unit: usize,
    /// The set may be divided into at most this many children of that node.
    children: usize,
}

/// One step of the tree over the large sets, in depth-first order: a split, or a set left to a task.
enum Upper {
    Split(u32),
    Task,
}

impl PointGroups {
    /// Groups at least one point, each with the same margin around it. No subtree of n leaves has more than 2 log2 n levels.
    /// The tree does not depend on the number of threads.
    pub fn new(
        points: &[Vec3],
        margin: f64,
        threads: usize,
        progress: &mut Progress,
    ) -> Result<Self> {
        let mut entries: Vec<Entry> = (0..)
            .zip(points)
            .map(|(index, &point)| Entry { point, index })
            .collect();
        let limits = Limits {
            levels: levels_for(points.len()),
            unit: unit_of(points.len()),
            children: FULL,
        };
        progress.at(0.05)?;
        let (mut upper, mut tasks) = (Vec::new(), Vec::new());
        let whole = Task {
            entries: &mut entries,
            limits,
        };
        split_upper(whole, margin, &mut upper, &mut tasks);
        progress.at(0.3)?;
        let done = {
            let tasks: Vec<Mutex<Task>> = tasks.into_iter().map(Mutex::new).collect();
            let mut lower = progress.part(0.3, 0.95);
            parallel::map(threads, tasks.len(), &mut lower, |t| {
                let mut splits = Vec::new();
                // Each task is taken once.
                if let Ok(mut task) = tasks[t].lock() {
                    splits.reserve(task.entries.len());
                    let limits = task.limits;
                    split(&mut *task.entries, limits, margin, &mut splits);
                }
                splits
            })?
        };
        let mut splits = Vec::with_capacity(points.len() - 1);
        let mut done = done.into_iter();
        for step in upper {
            match step {
                Upper::Split(first) => splits.push(first),
                Upper::Task => splits.extend(done.next().into_iter().flatten()),
            }
        }
        let order = entries.iter().map(|entry| entry.index).collect();
        progress.at(1.0)?;
        Ok(Self { order, splits })
    }

    /// All points.
    pub fn whole(&self) -> PointSet {
        PointSet {
            leaves: 0..self.order.len(),
            splits: 0,
        }
    }

    /// The two children of a set of more than one point.
    fn children(&self, set: &PointSet) -> [PointSet; 2] {
        let first = self.splits[set.splits] as usize;
        let middle = set.leaves.start + first;
        [
            PointSet {
                leaves: set.leaves.start..middle,
                splits: set.splits + 1,
            },
            PointSet {
                leaves: middle..set.leaves.end,
                // The first child's interior nodes come before; there is one fewer of them than leaves.
                splits: set.splits + first,
            },
        ]
    }

    /// The children of a set of more than one point, as a node of eight.
    pub fn eight_below(&self, set: &PointSet) -> Vec<PointSet> {
        let unit = unit_of(set.leaves.len());
        let mut below = Vec::with_capacity(FULL);
        let mut open = vec![set.clone()];
        while let Some(set) = open.pop() {
            if set.leaves.len() <= unit {
                below.push(set);
            } else {
                let [first, second] = self.children(&set);
                open.extend([second, first]);
            }
        }
        below
    }

    /// The binary tree; its leaves name points by their indices.
    pub fn subsets(&self) -> SubsetTree {
        let mut nodes = Vec::with_capacity(2 * self.order.len() - 1);
        let mut open = vec![self.whole()];
        while let Some(set) = open.pop() {
            if set.leaves.len() == 1 {
                let primitive = self.order[set.leaves.start];
                nodes.push(Node::Leaf { primitive });
                continue;
            }
            let first = nodes.len() as u32 + 1;
            let [one, other] = self.children(&set);
            let second = first + 2 * one.leaves.len() as u32 - 1;
            nodes.push(Node::Interior {
                children: [first, second],
            });
            open.extend([other, one]);
        }
        SubsetTree { nodes }
    }

    /// The number of levels.
    pub fn depth(&self) -> usize {
        let mut deepest = 0;
        let mut open = vec![(self.whole(), 1)];
        while let Some((set, level)) = open.pop() {
            deepest = deepest.max(level);
            if set.leaves.len() > 1 {
                open.extend(self.children(&set).map(|child| (child, level + 1)));
            }
        }
        deepest
    }
}

/// The most points that each of the eight children of a node over `count` points holds.
fn unit_of(count: usize) -> usize {
    let mut unit = 1;
    while unit * FULL < count {
        unit *= FULL;
    }
    unit
}

/// The least possible number of levels below a set.
fn least_levels(count: usize) -> usize {
    if count < 2 {
        return 0;
    }
    let unit = unit_of(count);
    ceil_log2(count.div_ceil(unit)) + unit.trailing_zeros() as usize
}

fn ceil_log2(n: usize) -> usize {
    n.next_power_of_two().trailing_zeros() as usize
}

fn split_upper<'a>(task: Task<'a>, margin: f64, upper: &mut Vec<Upper>, tasks: &mut Vec<Task<'a>>) {
    let Task { entries, limits } = task;
    if entries.len() <= TASK {
        upper.push(Upper::Task);
        tasks.push(Task { entries, limits });
        return;
    }
    let (first, below) = partition(entries, limits, margin);
    upper.push(Upper::Split(first as u32));
    let (one, other) = entries.split_at_mut(first);
    for (entries, limits) in [one, other].into_iter().zip(below) {
        split_upper(Task { entries, limits }, margin, upper, tasks);
    }
}

fn split(entries: &mut [Entry], limits: Limits, margin: f64, splits: &mut Vec<u32>) {
    if entries.len() < 2 {
        return;
    }
    let (first, below) = partition(entries, limits, margin);
    splits.push(first as u32);
    let (one, other) = entries.split_at_mut(first);
    split(one, below[0], margin, splits);
    split(other, below[1], margin, splits);
}

/// Partitions at least two entries into two sets that both keep the limits; returns the size of the first and the limits of
/// both.
fn partition(entries: &mut [Entry], limits: Limits, margin: f64) -> (usize, [Limits; 2]) {
    let count = entries.len();
    let limits = match count <= limits.unit {
        // The set becomes a node of its own.
        true => Limits {
            unit: unit_of(count),
            children: FULL,
            ..limits
        },
        false => limits,
    };
    let extent = extent_of(entries);
    let size = extent.size();
    let longest = size.imax();
    let (axis, first) = match count > FULL {
        true => best_split(entries, &extent, &limits, margin),
        false => None,
    }
    // Fallback: halve the set's whole units along its longest side.
    .unwrap_or_else(|| (longest, count.div_ceil(limits.unit) / 2 * limits.unit));
    entries.select_nth_unstable_by(first, |a, b| {
        let order = a.point[axis].total_cmp(&b.point[axis]);
        order.then(a.index.cmp(&b.index))
    });
    (first, limits.below([first, count - first]))
}

impl Limits {
    /// The least numbers of children that sets of these sizes become.
    fn needed(&self, sizes: [usize; 2]) -> [usize; 2] {
        sizes.map(|size| size.div_ceil(self.unit))
    }

    /// Whether a set may be split into two sets of these sizes.
    fn allow(&self, sizes: [usize; 2]) -> bool {
        let [a, b] = self.needed(sizes);
        a + b <= self.children && sizes.into_iter().all(|n| least_levels(n) < self.levels)
    }

    fn below(&self, sizes: [usize; 2]) -> [Self; 2] {
        let [a, b] = self.needed(sizes);
        let spare = self.children.saturating_sub(a + b);
        let to_first = spare * sizes[0] / (sizes[0] + sizes[1]);
        [a + to_first, b + spare - to_first].map(|children| Self {
            levels: self.levels - 1,
            children,
            ..*self
        })
    }
}

/// The split of the least surface-area cost: its axis and the size of the first set. `None` if all points coincide or no
/// split keeps the limits.
fn best_split(
    entries: &[Entry],
    extent: &Extent,
    limits: &Limits,
    margin: f64,
) -> Option<(usize, usize)> {
    let count = entries.len();
    let size = extent.size();
    // Flat and straight sets have no surface; the margin makes them comparable.
    let margin = margin + 1e-3 * size.amax();
    // Sets are split at multiples of an eighth of a unit, but at least of 8 points, so that the nodes below are full.
    let grain = (limits.unit / FULL).max(FULL);
    let step = (count / SAMPLE).max(1);
    let sampled = count.div_ceil(step);
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in 0..3 {
        if size[axis] <= 0.0 {
            continue;
        }
        let mut bins = [Bin::EMPTY; BINS];
        let scale = BINS as f64 / size[axis];
        for entry in entries.iter().step_by(step) {
            let along = (entry.point[axis] - extent.low[axis]) * scale;
            bins[(along as usize).min(BINS - 1)].add(&entry.point);
        }
        let mut above = [Bin::EMPTY; BINS];
        let mut all = Bin::EMPTY;
        for k in (1..BINS).rev() {
            all = all.joined(&bins[k]);
            above[k] = all;
        }
        all = Bin::EMPTY;
        for k in 1..BINS {
            all = all.joined(&bins[k - 1]);
            let (below, above) = (&all, &above[k]);
            if below.count == 0 || above.count == 0 {
                continue;
            }
            let part = below.count as f64 / sampled as f64 * count as f64;
            let first = ((part / grain as f64).round() as usize).max(1) * grain;
            if first >= count || !limits.allow([first, count - first]) {
                continue;
            }
            let cost = below.cost(margin) + above.cost(margin);
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, first));
            }
        }
    }
    best.map(|(_, axis, first)| (axis, first))
}

/// The number and the box of the points in one bin.
#[derive(Clone, Copy)]
struct Bin {
    count: usize,
    low: Vec3,
    high: Vec3,
}

impl Bin {
    const EMPTY: Self = Self {
        count: 0,
        low: Vec3::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Vec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    fn add(&mut self, point: &Vec3) {
        self.count += 1;
        self.low = lower(&self.low, point);
        self.high = higher(&self.high, point);
    }

    fn joined(&self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            low: lower(&self.low, &other.low),
            high: higher(&self.high, &other.high),
        }
    }

    /// Half the surface of its box, grown by a margin, times the number of its points.
    fn cost(&self, margin: f64) -> f64 {
        let size = (self.high - self.low).add_scalar(2.0 * margin);
        (size.x * size.y + size.y * size.z + size.z * size.x) * self.count as f64
    }
}

fn extent_of(entries: &[Entry]) -> Extent {
    let mut all = Bin::EMPTY;
    for entry in entries {
        all.low = lower(&all.low, &entry.point);
        all.high = higher(&all.high, &entry.point);
    }
    Extent {
        low: all.low,
        high: all.high,
    }
}

/// `inf` without its treatment of NaN; coordinates are finite.
#[inline(always)]
fn lower(a: &Vec3, b: &Vec3) -> Vec3 {
    let less = |a: f64, b: f64| if b < a { b } else { a };
    Vec3::new(less(a.x, b.x), less(a.y, b.y), less(a.z, b.z))
}

#[inline(always)]
fn higher(a: &Vec3, b: &Vec3) -> Vec3 {
    let more = |a: f64, b: f64| if b > a { b } else { a };
    Vec3::new(more(a.x, b.x), more(a.y, b.y), more(a.z, b.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn groups(points: &[Vec3], threads: usize) -> PointGroups {
        let mut report = |_| Ok(());
        PointGroups::new(points, 0.0, threads, &mut Progress::new(&mut report)).unwrap()
    }

    /// Points in a slab, on a line, coincident, and with far outliers.
    fn point(i: usize, sort: usize) -> Vec3 {
        let x = (i * 7919 % 1009) as f64;
        match sort {
            0 => Vec3::new(x, (i * 31 % 17) as f64, (i % 5) as f64),
            1 => Vec3::new(x, 0.0, 0.0),
            2 => Vec3::zeros(),
            _ => Vec3::new((0.1 * x).exp(), 1.0, 0.0),
        }
    }

    #[test]
    fn trees_are_sound_shallow_and_full() {
        for n in (1..=200).chain([511, 512, 513, 1000, 4095, 20_000]) {
            for sort in 0..4 {
                let points: Vec<Vec3> = (0..n).map(|i| point(i, sort)).collect();
                let groups = groups(&points, 1);
                let tree = groups.subsets();
                assert!(tree.is_sound(n), "{n} points of sort {sort}");
                assert_eq!(tree.depth(), groups.depth());
                let limit = (2.0 * (n as f64).log2() + 1e-9).floor().max(1.0) as usize;
                assert!(
                    tree.depth() <= limit,
                    "{n}, {sort}: {} levels",
                    tree.depth()
                );
                let mut nodes = 0;
                let mut open = vec![groups.whole()];
                while let Some(set) = open.pop() {
                    if set.leaves.len() > 1 {
                        let below = groups.eight_below(&set);
                        assert!((2..=8).contains(&below.len()), "{n}, {sort}: {below:?}");
                        nodes += 1;
                        open.extend(below);
                    }
                }
                assert!(
                    nodes <= 3 + n / 5,
                    "{n} points of sort {sort}: {nodes} nodes"
                );
            }
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_groups() {
        let points: Vec<Vec3> = (0..30_000).map(|i| point(i, 0)).collect();
        let [one, three] = [1, 3].map(|threads| groups(&points, threads));
        assert!(one.order == three.order && one.splits == three.splits);
    }
}
