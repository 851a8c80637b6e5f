//! The grouping phase (§3.2): from the parts that stand as leaves to the subset tree.

use super::adjacent::{Adjacent, sibling_pairs};
use super::binned_split::split;
use super::greedy_clustering::{Limits, cluster};
use super::nearby::{Curve, Nearby};
use super::parallel::Progress;
use super::{Extent, Forest, Grouping, HierarchyOptions, SubsetTree};
use crate::error::Result;
use crate::pose::Vec3;

/// Groups parts with the given boxes and edges (`edges` tells those of a part); there must be at least one. The same input gives the same tree.
pub fn group(
    extents: &[Extent],
    edges: impl Fn(u32, &mut dyn FnMut([Vec3; 2])),
    options: &HierarchyOptions,
    progress: &mut Progress,
) -> Result<SubsetTree> {
    // Along a curve, so that neighbours in space are neighbours in memory, and ties are broken between neighbours.
    let bounds = extents
        .iter()
        .fold(extents[0], |all, extent| all.union(extent));
    let curve = Curve::new(&bounds);
    let mut order: Vec<u32> = (0..extents.len() as u32).collect();
    order.sort_by_cached_key(|&i| (curve.code(&extents[i as usize].center()), i));
    let mut forest = Forest::new(order.iter().map(|&i| extents[i as usize]).collect());
    let bodies: Vec<u32> = (0..extents.len() as u32).collect();
    let threads = options.thread_count();
    let root = match options.grouping {
        Grouping::TopDown => split(&mut forest, bodies, threads, progress)?,
        Grouping::Basic => basic(&mut forest, bodies, &bounds, options, progress)?,
        Grouping::Hybrid => {
            let siblings = sibling_pairs(order.iter().copied(), edges);
            let mut adjacent = Adjacent::new(options.cost, bodies.len(), &siblings);
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
            basic(
                &mut forest,
                chunks,
                &bounds,
                options,
                &mut progress.part(0.6, 1.0),
            )?
        }
    };
    Ok(forest.into_tree(root, &order))
}

/// The basic clustering algorithm; returns the root.
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
    let left = cluster(forest, bodies, &mut rule, first, last, threads, progress)?;
    Ok(left[0])
}

fn first_limits(forest: &Forest, bodies: &[u32], options: &HierarchyOptions) -> Limits {
    let diameters = bodies.iter().map(|&i| forest.diameters[i as usize]);
    let given = |value: f64, automatic: f64| if value > 0.0 { value } else { automatic };
    let diameter = given(
        options.diameter_limit,
        2.0 * diameters.fold(f64::INFINITY, f64::min),
    );
    Limits {
        diameter,
        gap: given(options.gap_limit, 0.25 * diameter),
    }
}
