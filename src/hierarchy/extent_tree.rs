//! A tree over axis-aligned boxes: which of many bodies are near.

use super::binned_split::{levels_for, split_within};
use super::{Extent, Forest, Node};

/// A binary tree over boxes, in depth-first order.
#[derive(Clone, Debug, Default)]
pub struct ExtentTree {
    nodes: Vec<(Extent, Node)>,
}

impl ExtentTree {
    pub fn new(extents: Vec<Extent>) -> Self {
        if extents.is_empty() {
            return Self::default();
        }
        let count = extents.len();
        let mut forest = Forest::new(extents);
        let root = split_within(&mut forest, (0..count as u32).collect(), levels_for(count));
        let all = forest.extents.clone();
        let (tree, at) = forest.into_tree(root);
        let extents = at.into_iter().map(|body| all[body as usize]);
        Self {
            nodes: extents.zip(tree.nodes).collect(),
        }
    }

    /// The box around all of them.
    pub fn extent(&self) -> Option<&Extent> {
        self.nodes.first().map(|(extent, _)| extent)
    }

    /// Visits boxes, by their numbers, whose measure is at most a limit, those of lesser measure first as far as the tree
    /// tells. A box must not measure less than one around it; `visit` returns the limit from then on.
    pub fn visit_nearest_first(
        &self,
        mut limit: f64,
        measure: impl Fn(&Extent) -> f64,
        mut visit: impl FnMut(u32) -> f64,
    ) {
        let Some((extent, _)) = self.nodes.first() else {
            return;
        };
        let mut open = vec![(measure(extent), 0)];
        while let Some((least, node)) = open.pop() {
            if least > limit {
                continue;
            }
            match self.nodes[node as usize].1 {
                Node::Leaf { primitive } => limit = visit(primitive),
                Node::Interior { children } => {
                    let [a, b] =
                        children.map(|child| (measure(&self.nodes[child as usize].0), child));
                    open.extend(if a.0 < b.0 { [b, a] } else { [a, b] });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::Vec3;

    #[test]
    fn the_nearest_and_all_within_are_those_of_all_boxes() {
        let extents: Vec<Extent> = (0..300)
            .map(|i| {
                let place = [7, 11, 13].map(|k| f64::from(i * k % 101));
                let low = Vec3::from(place);
                let size = Vec3::new(f64::from(i % 3), 1.0, f64::from(i % 5));
                Extent {
                    low,
                    high: low + size,
                }
            })
            .collect();
        let tree = ExtentTree::new(extents.clone());
        for i in 0..40 {
            let center = Vec3::new(f64::from(3 * i), f64::from(2 * i), 50.0);
            let measure = |extent: &Extent| extent.distance(&center);
            let mut nearest = f64::INFINITY;
            tree.visit_nearest_first(nearest, measure, |k| {
                nearest = nearest.min(measure(&extents[k as usize]));
                nearest
            });
            let least = extents.iter().map(measure).fold(f64::INFINITY, f64::min);
            assert_eq!(nearest, least);
            let mut within = Vec::new();
            tree.visit_nearest_first(20.0, measure, |k| {
                within.push(k as usize);
                20.0
            });
            within.sort_unstable();
            let all: Vec<usize> = (0..300).filter(|&k| measure(&extents[k]) <= 20.0).collect();
            assert_eq!(within, all);
        }
    }
}
