//! Bounds the depth of clustered trees: no subtree of n leaves has more than 2 log2 n levels.
//!
//! The report's trees mostly keep this bound (§3.3.2), but the cost does not enforce it: a large body with many small
//! neighbours takes them in one by one.

use super::binned_split::{levels_for, split_within};
use super::forest::Forest;

/// Rebuilds every subtree that is too deep by top-down splits. Returns the new forest, and the new body of each old one.
pub fn rebalanced(old: Forest) -> (Forest, Vec<u32>) {
    let leaves = old.leaves;
    let mut forest = Forest::new(old.extents[..leaves].to_vec());
    let mut shapes = vec![
        Shape {
            leaves: 1,
            height: 0
        };
        leaves
    ];
    let mut names: Vec<u32> = (0..leaves as u32).collect();
    for &[a, b] in &old.children {
        let [a, b] = [a, b].map(|child| names[child as usize]);
        let joined = forest.merge(a, b);
        measure(&forest, &mut shapes);
        let shape = shapes[joined as usize];
        names.push(if shape.height > shape.limit() {
            rebuild(&mut forest, &mut shapes, joined)
        } else {
            joined
        });
    }
    (forest, names)
}

#[derive(Clone, Copy)]
struct Shape {
    leaves: u32,
    /// Levels below the root.
    height: u32,
}

impl Shape {
    fn limit(&self) -> u32 {
        levels_for(self.leaves as usize) as u32
    }
}

/// Adds the shapes of the bodies created since the last call.
fn measure(forest: &Forest, shapes: &mut Vec<Shape>) {
    for body in shapes.len()..forest.extents.len() {
        let [a, b] = forest.children[body - forest.leaves].map(|child| shapes[child as usize]);
        shapes.push(Shape {
            leaves: a.leaves + b.leaves,
            height: 1 + a.height.max(b.height),
        });
    }
}

/// Opens the deepest subtrees of a body until a new tree over the parts keeps the limit, and builds that tree.
fn rebuild(forest: &mut Forest, shapes: &mut Vec<Shape>, body: u32) -> u32 {
    let limit = shapes[body as usize].limit();
    let height = |body: u32| shapes[body as usize].height;
    let mut open = std::collections::BinaryHeap::from([(height(body), body)]);
    while let Some(&(deepest, body)) = open.peek() {
        let needed = open.len().next_power_of_two().trailing_zeros();
        if deepest + needed <= limit {
            break;
        }
        open.pop();
        let children = forest.children[body as usize - forest.leaves];
        open.extend(children.map(|child| (height(child), child)));
    }
    let deepest = open.peek().map_or(0, |top| top.0);
    let mut parts: Vec<u32> = open.into_iter().map(|(_, body)| body).collect();
    parts.sort_unstable();
    let root = split_within(forest, parts, (limit - deepest) as usize);
    measure(forest, shapes);
    root
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::Extent;
    use crate::pose::Vec3;

    fn points(n: usize) -> Vec<Extent> {
        let at = |i: usize| Vec3::new((i * 7919 % 101) as f64, (i % 13) as f64, i as f64);
        (0..n).map(|i| Extent::of(&[at(i)])).collect()
    }

    /// A chain is the deepest tree.
    #[test]
    fn a_chain_becomes_a_balanced_tree() {
        for n in [2usize, 3, 4, 5, 7, 8, 9, 100, 5000] {
            let mut forest = Forest::new(points(n));
            let mut root = 0;
            for leaf in 1..n as u32 {
                root = forest.merge(root, leaf);
            }
            let (forest, names) = rebalanced(forest);
            let (tree, bodies) = forest.into_tree(names[root as usize]);
            assert!(tree.is_sound(n), "{n} leaves");
            assert_eq!(bodies.len(), 2 * n - 1);
            let limit = 2.0 * (n as f64).log2();
            assert!(tree.depth() as f64 <= limit + 1e-9, "{n}: {}", tree.depth());
        }
    }
}
