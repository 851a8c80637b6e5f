//! Splits the boxes of a full node and one more between two nodes.

use crate::boxes::Extent;

/// The most children a node has.
pub const FULL: usize = 8;

/// The fewest boxes of a node after a split, so that nodes are rarely split again soon and the tree stays shallow.
const MIN_CHILDREN: usize = 3;

/// Chooses which of nine boxes move to a new node: the smaller side of the split along an axis with the least surface-area
/// cost.
pub fn split(extents: &[Extent]) -> [bool; FULL + 1] {
    let mut best = f64::INFINITY;
    let mut goes = [true, true, true, true, false, false, false, false, false];
    for axis in 0..3 {
        let mut order: [usize; FULL + 1] = std::array::from_fn(|i| i);
        let middle = |i: usize| extents[i].low[axis] + extents[i].high[axis];
        order.sort_by(|&i, &j| middle(i).total_cmp(&middle(j)));
        for first in MIN_CHILDREN..=FULL + 1 - MIN_CHILDREN {
            let (left, right) = order.split_at(first);
            let cost = cost(extents, left) + cost(extents, right);
            if cost < best {
                best = cost;
                goes = [false; FULL + 1];
                let fewer = if left.len() < right.len() {
                    left
                } else {
                    right
                };
                fewer.iter().for_each(|&i| goes[i] = true);
            }
        }
    }
    goes
}

fn cost(extents: &[Extent], members: &[usize]) -> f64 {
    let all = members
        .iter()
        .fold(extents[members[0]], |all, &i| all.union(&extents[i]));
    all.half_surface() * members.len() as f64
}
