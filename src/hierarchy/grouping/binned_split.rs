//! The top-down builder: splits by a binned surface-area heuristic (Goldsmith and Salmon 1987; Wald 2007).

use std::ops::Range;

use super::forest::Forest;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::{Progress, parallel};
use crate::pose::Vec3;

/// Number of bins per axis. More find better splits and take longer.
const BINS: usize = 16;

/// Sets larger than this are split on the calling thread; smaller ones are the tasks of the threads. A smaller value shares the
/// work more evenly, but leaves more of it to one thread.
const TASK: usize = 4096;

/// A subtree not yet in the forest: a body, or the index of a pair of branches.
#[derive(Clone, Copy)]
pub enum Branch {
    Body(u32),
    Pair(u32),
}

/// Sets of bodies, and the tree over them.
pub struct Cut {
    /// The range of each set in the list of bodies, and how many levels are left for the tree below it.
    pub sets: Vec<(Range<usize>, usize)>,
    /// The root; a `Body` is here the index of a set.
    pub root: Branch,
    /// Pairs of branches, children before parents.
    pub pairs: Vec<[Branch; 2]>,
}

/// Orders bodies into sets of at most `largest`, such that the tree over all bodies has at most 2 log2 N levels.
pub fn cut(forest: &Forest, bodies: &mut [u32], largest: usize) -> Cut {
    let levels = levels_for(bodies.len());
    let (mut sets, mut pairs) = (Vec::new(), Vec::new());
    let mut cutter = Cutter {
        forest,
        largest,
        pairs: &mut pairs,
        sets: &mut sets,
    };
    let root = cutter.cut(bodies, 0, levels);
    Cut { sets, root, pairs }
}

/// Builds a tree over the bodies top-down; returns its root.
///
/// The tree has at most 2 log2 N levels: where the heuristic would exceed that, sets are split at the median.
pub fn split(
    forest: &mut Forest,
    mut bodies: Vec<u32>,
    threads: usize,
    progress: &mut Progress,
) -> Result<u32> {
    // Large sets first; the sets that remain are split in parallel.
    let upper = cut(forest, &mut bodies, TASK);
    progress.at(0.3)?;
    let shared = &*forest;
    let bodies = &bodies;
    let sets = &upper.sets;
    let lower = parallel::map(threads, sets.len(), &mut progress.part(0.3, 0.9), |t| {
        let (range, levels) = &sets[t];
        let mut members = bodies[range.clone()].to_vec();
        let mut pairs = Vec::new();
        let root = split_whole(shared, &mut members, *levels, &mut pairs);
        (root, pairs)
    })?;
    let roots: Vec<u32> = lower
        .iter()
        .map(|(root, pairs)| merge_all(forest, *root, pairs, &|body| body))
        .collect();
    Ok(merge_all(forest, upper.root, &upper.pairs, &|set| {
        roots[set as usize]
    }))
}

/// The same on one thread, with at most `levels` levels below the root, which must be enough.
pub fn split_within(forest: &mut Forest, mut bodies: Vec<u32>, levels: usize) -> u32 {
    let mut pairs = Vec::new();
    let root = split_whole(forest, &mut bodies, levels, &mut pairs);
    merge_all(forest, root, &pairs, &|body| body)
}

/// Adds the pairs to the forest and returns the root; `body_of` maps the index in a `Branch::Body` to a body.
fn merge_all(
    forest: &mut Forest,
    root: Branch,
    pairs: &[[Branch; 2]],
    body_of: &dyn Fn(u32) -> u32,
) -> u32 {
    let mut merged: Vec<u32> = Vec::with_capacity(pairs.len());
    let body = |branch: Branch, merged: &[u32]| match branch {
        Branch::Body(body) => body_of(body),
        Branch::Pair(i) => merged[i as usize],
    };
    for pair in pairs {
        let [a, b] = pair.map(|branch| body(branch, &merged));
        merged.push(forest.merge(a, b));
    }
    body(root, &merged)
}

struct Cutter<'a> {
    forest: &'a Forest,
    largest: usize,
    pairs: &'a mut Vec<[Branch; 2]>,
    sets: &'a mut Vec<(Range<usize>, usize)>,
}

impl Cutter<'_> {
    fn cut(&mut self, members: &mut [u32], start: usize, levels: usize) -> Branch {
        if members.len() <= self.largest {
            self.sets.push((start..start + members.len(), levels));
            return Branch::Body((self.sets.len() - 1) as u32);
        }
        let middle = partition(self.forest, members, levels);
        let (left, right) = members.split_at_mut(middle);
        let left = self.cut(left, start, levels - 1);
        let right = self.cut(right, start + middle, levels - 1);
        self.pairs.push([left, right]);
        Branch::Pair((self.pairs.len() - 1) as u32)
    }
}

fn split_whole(
    forest: &Forest,
    members: &mut [u32],
    levels: usize,
    pairs: &mut Vec<[Branch; 2]>,
) -> Branch {
    if let [body] = *members {
        return Branch::Body(body);
    }
    let middle = partition(forest, members, levels);
    let (left, right) = members.split_at_mut(middle);
    let left = split_whole(forest, left, levels - 1, pairs);
    let right = split_whole(forest, right, levels - 1, pairs);
    pairs.push([left, right]);
    Branch::Pair((pairs.len() - 1) as u32)
}

/// Partitions the members into two sets, each of which fits into one level fewer than `levels`; returns the size of the
/// first.
fn partition(forest: &Forest, members: &mut [u32], levels: usize) -> usize {
    let centers = Extent::of(&[forest.center(members[0])]);
    let centers = members.iter().fold(centers, |all, &i| {
        let center = forest.center(i);
        all.union(&Extent {
            low: center,
            high: center,
        })
    });
    let size = centers.size();
    let bin = |axis: usize, center: &Vec3| -> usize {
        let along = (center[axis] - centers.low[axis]) / size[axis];
        ((along * BINS as f64) as usize).min(BINS - 1)
    };
    let mut all = [[(0, None); BINS]; 3];
    for &body in members.iter() {
        let own = forest.extents[body as usize];
        let center = own.center();
        for (axis, bins) in all.iter_mut().enumerate() {
            if size[axis] > 0.0 {
                let bin = &mut bins[bin(axis, &center)];
                *bin = joined(*bin, (1, Some(own)));
            }
        }
    }
    let mut best: Option<(f64, usize, usize, usize)> = None;
    for (axis, bins) in all.iter().enumerate() {
        if size[axis] <= 0.0 {
            continue;
        }
        let mut above = [(0, 0.0); BINS];
        let mut sum: (usize, Option<Extent>) = (0, None);
        for k in (1..BINS).rev() {
            sum = joined(sum, bins[k]);
            above[k] = (sum.0, sum.1.map_or(0.0, |e| e.half_surface()));
        }
        sum = (0, None);
        for k in 1..BINS {
            sum = joined(sum, bins[k - 1]);
            let (left, right) = (sum.0, above[k].0);
            if left == 0 || right == 0 || ceil_log2(left.max(right)) + 1 > levels {
                continue;
            }
            let surface = sum.1.map_or(0.0, |e| e.half_surface());
            let cost = surface * left as f64 + above[k].1 * right as f64;
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, k, left));
            }
        }
    }
    match best {
        Some((_, axis, k, left)) => {
            // A stable partition, so that the order is the same on every machine.
            let goes_right = |&body: &u32| bin(axis, &forest.center(body)) >= k;
            let (first, second): (Vec<u32>, Vec<u32>) =
                members.iter().partition(|&body| !goes_right(body));
            members[..left].copy_from_slice(&first);
            members[left..].copy_from_slice(&second);
            left
        }
        None => {
            let axis = centers.size().imax();
            let middle = members.len() / 2;
            members.select_nth_unstable_by(middle, |&i, &j| {
                let order = forest.center(i)[axis].total_cmp(&forest.center(j)[axis]);
                order.then(i.cmp(&j))
            });
            middle
        }
    }
}

fn joined(a: (usize, Option<Extent>), b: (usize, Option<Extent>)) -> (usize, Option<Extent>) {
    let extent = match (a.1, b.1) {
        (Some(a), Some(b)) => Some(a.union(&b)),
        (a, b) => a.or(b),
    };
    (a.0 + b.0, extent)
}

/// The largest number of levels below the root in a tree of at most 2 log2 n levels.
pub fn levels_for(bodies: usize) -> usize {
    (2.0 * (bodies as f64).log2() - 1.0 + 1e-9).max(0.0) as usize
}

fn ceil_log2(n: usize) -> usize {
    n.next_power_of_two().trailing_zeros() as usize
}
