//! A top-down builder: halves the primitives at the median of their centres along the longest extent of those centres.
//! Structurally balanced, O(N log N) on any input, and the same tree for the same input.

use super::{Node, SubsetTree};
use crate::pose::Vec3;

/// The tree over primitives with the given centres; there must be at least one.
pub fn split_by_median(centers: &[Vec3]) -> SubsetTree {
    let mut tree = SubsetTree {
        nodes: Vec::with_capacity(2 * centers.len()),
    };
    let mut order: Vec<u32> = (0..centers.len() as u32).collect();
    split(&mut tree, centers, &mut order);
    tree
}

/// Appends the subtree over `members`; returns its root.
fn split(tree: &mut SubsetTree, centers: &[Vec3], members: &mut [u32]) -> u32 {
    let root = tree.nodes.len() as u32;
    if let [primitive] = *members {
        tree.nodes.push(Node::Leaf { primitive });
        return root;
    }
    let center = |i: u32| centers[i as usize];
    let low = members
        .iter()
        .fold(center(members[0]), |low, &i| low.inf(&center(i)));
    let high = members
        .iter()
        .fold(center(members[0]), |high, &i| high.sup(&center(i)));
    let axis = (high - low).imax();
    let middle = members.len() / 2;
    members.select_nth_unstable_by(middle, |&i, &j| {
        center(i)[axis].total_cmp(&center(j)[axis]).then(i.cmp(&j))
    });
    tree.nodes.push(Node::Interior { children: [0; 2] });
    let (left, right) = members.split_at_mut(middle);
    let children = [split(tree, centers, left), split(tree, centers, right)];
    tree.nodes[root as usize] = Node::Interior { children };
    root
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_primitive_has_one_leaf() {
        let centers: Vec<_> = (0..1000)
            .map(|i| Vec3::new((i * 7919 % 1000) as f64, (i % 10) as f64, 0.0))
            .collect();
        let tree = split_by_median(&centers);
        let mut seen = vec![0; centers.len()];
        for node in &tree.nodes {
            if let Node::Leaf { primitive } = node {
                seen[*primitive as usize] += 1;
            }
        }
        assert!(seen.iter().all(|&n| n == 1));
        assert_eq!(tree.nodes.len(), 1999);
        assert_eq!(tree.depth(), 11);
    }

    #[test]
    fn coincident_centers_do_not_recurse_deeply() {
        let tree = split_by_median(&vec![Vec3::zeros(); 4096]);
        assert_eq!(tree.depth(), 13);
    }
}
