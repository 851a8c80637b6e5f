//! A wrapper on every node of a subset tree, each covering its leaves' vertices directly (§3.2.4).

use super::{Node, SubsetTree, Wrapper, cover};
use crate::error::Result;
use crate::pose::Vec3;
use crate::primitive::Convex;

/// The subset tree with the wrapper of each node.
#[derive(Clone, Debug)]
pub struct WrapperTree {
    pub subsets: SubsetTree,
    pub wrappers: Vec<Wrapper>,
}

impl WrapperTree {
    /// Builds the wrappers from the leaves up. `progress` hears the fraction done and may end the work with an error.
    pub fn build(
        subsets: SubsetTree,
        primitives: &[Convex],
        vertex_limit: usize,
        progress: &mut dyn FnMut(f64) -> Result<()>,
    ) -> Result<Self> {
        let count = subsets.nodes.len();
        let mut wrappers: Vec<Option<Wrapper>> = vec![None; count];
        // The points under each node not yet merged into its parent. Children follow their parents, so going backwards
        // meets them first. A hull's vertices stand for the points they cover; their excess adds up to the parent's.
        let mut pending: Vec<(Vec<Vec3>, f64)> = vec![Default::default(); count];
        for i in (0..count).rev() {
            let (points, inherited) = match subsets.nodes[i] {
                Node::Leaf { primitive } => (primitives[primitive as usize].vertices.clone(), 0.0),
                Node::Interior { children } => {
                    let [(mut points, left), (others, right)] =
                        children.map(|child| std::mem::take(&mut pending[child as usize]));
                    points.extend(others);
                    sort_and_deduplicate(&mut points);
                    (points, left.max(right))
                }
            };
            let (mut wrapper, is_hull) = cover(&points, vertex_limit);
            wrapper.excess += inherited;
            wrapper.radius += inherited;
            // Only hull vertices can be vertices of a hull above; a box's corners would loosen it.
            pending[i] = if is_hull {
                (wrapper.corners.clone(), wrapper.excess)
            } else {
                (points, inherited)
            };
            wrappers[i] = Some(wrapper);
            if i % 256 == 0 {
                progress((count - i) as f64 / count as f64)?;
            }
        }
        Ok(Self {
            subsets,
            wrappers: wrappers.into_iter().flatten().collect(),
        })
    }
}

fn sort_and_deduplicate(points: &mut Vec<Vec3>) {
    points.sort_by(|p, q| {
        let by_x = p.x.total_cmp(&q.x);
        by_x.then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z))
    });
    points.dedup();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gjk::{PointCloud, gjk};
    use crate::hierarchy::split_by_median;
    use crate::primitive::convex_polygon;

    /// Triangles on a bumpy sphere: hulls of all sizes, boxes where they have many vertices.
    fn bumpy(count: usize) -> Vec<Convex> {
        (0..count)
            .map(|i| {
                let at = |k: usize| {
                    let j = (3 * i + k) as f64;
                    let (azimuth, height) = (2.4 * j, 1.0 - 2.0 * (i as f64 + 0.5) / count as f64);
                    let r = (1.0 - height * height).sqrt() * (1.0 + 0.1 * (7.0 * j).sin());
                    Vec3::new(
                        r * azimuth.cos(),
                        r * azimuth.sin(),
                        height + 0.02 * k as f64,
                    )
                };
                convex_polygon(&[at(0), at(1), at(2)]).unwrap()
            })
            .collect()
    }

    #[test]
    fn no_leaf_vertex_lies_outside_its_ancestors() {
        let primitives = bumpy(300);
        let centers: Vec<_> = primitives.iter().map(|p| p.vertices[0]).collect();
        let tree = WrapperTree::build(split_by_median(&centers), &primitives, 16, &mut |_| Ok(()))
            .unwrap();
        let mut stack = vec![(0u32, Vec::new())];
        let mut checked = 0;
        while let Some((i, mut above)) = stack.pop() {
            above.push(i);
            match tree.subsets.nodes[i as usize] {
                Node::Interior { children } => {
                    stack.extend(children.map(|child| (child, above.clone())));
                }
                Node::Leaf { primitive } => {
                    for vertex in &primitives[primitive as usize].vertices {
                        for &node in &above {
                            let wrapper = &tree.wrappers[node as usize];
                            let outside = gjk(
                                &PointCloud(&wrapper.corners),
                                &PointCloud(&[*vertex]),
                                Vec3::zeros(),
                                f64::INFINITY,
                            );
                            assert!(outside.lower <= wrapper.excess + 1e-15);
                            assert!((vertex - wrapper.center).norm() <= wrapper.radius + 1e-15);
                            checked += 1;
                        }
                    }
                }
            }
        }
        assert!(checked > 6000);
    }
}
