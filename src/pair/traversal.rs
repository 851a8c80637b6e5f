//! The report's multi-use algorithm (Figure 2): one walk down two trees that serves every query; the visitor says what
//! is worth visiting and when to stop.

use std::ops::ControlFlow;

use super::Pairing;
use crate::convex::{Closest, DistanceScratch, PlacedBuffer};
use crate::hierarchy::Node;

/// What a query wants from the walk.
pub trait Visitor {
    /// Pairs of nodes that are farther apart than this are skipped; those at exactly this distance are not.
    fn bound(&self) -> f64;

    /// Meets a primitive pair with its distance, which is known to `error`.
    fn visit(&mut self, primitives: [u32; 2], closest: &Closest, error: f64) -> ControlFlow<()>;
}

/// Work done, for the user's eyes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Statistics {
    /// Node pairs whose wrappers were tested.
    pub node_pairs: u64,
    /// Primitive pairs whose distance was computed.
    pub primitive_pairs: u64,
    /// Remembered witnesses that were evaluated first.
    pub cache_hits: u64,
}

/// Memory of the walk, reused from query to query.
#[derive(Default)]
pub struct Scratch {
    stack: Vec<(u32, u32, f64)>,
    buffers: [PlacedBuffer; 2],
    distance: DistanceScratch,
    pub statistics: Statistics,
}

impl Scratch {
    /// Shows the visitor one primitive pair.
    pub fn visit_pair(
        &mut self,
        pairing: &Pairing,
        primitives: [u32; 2],
        visitor: &mut impl Visitor,
    ) -> ControlFlow<()> {
        self.statistics.primitive_pairs += 1;
        let closest = pairing.primitive_distance(primitives, &mut self.buffers, &mut self.distance);
        visitor.visit(primitives, &closest, pairing.precision.error)
    }
}

/// Walks both trees from their roots, nearer children first. Breaks as soon as the visitor does.
pub fn traverse(
    pairing: &Pairing,
    scratch: &mut Scratch,
    visitor: &mut impl Visitor,
) -> ControlFlow<()> {
    let (tree_a, tree_b) = (pairing.a.tree(), pairing.b.tree());
    let slack = pairing.slack();
    scratch.stack.clear();
    scratch.stack.push((0, 0, 0.0));
    while let Some((i, j, lower)) = scratch.stack.pop() {
        if lower > visitor.bound() {
            continue;
        }
        let (node_a, node_b) = (tree_a.node(i), tree_b.node(j));
        let longer_a = || tree_a.radius(i) >= tree_b.radius(j);
        let children = match (node_a, node_b) {
            (Node::Leaf { primitive: a }, Node::Leaf { primitive: b }) => {
                scratch.visit_pair(pairing, [a, b], visitor)?;
                continue;
            }
            (Node::Interior { children: [c, d] }, Node::Leaf { .. }) => [(c, j), (d, j)],
            (Node::Interior { children: [c, d] }, _) if longer_a() => [(c, j), (d, j)],
            (_, Node::Interior { children: [c, d] }) => [(i, c), (i, d)],
        };
        let bounds = children.map(|(i, j)| {
            scratch.statistics.node_pairs += 1;
            let (a, b) = (tree_a.wrapper(i), tree_b.wrapper(j));
            let cutoff = visitor.bound() + slack;
            let by_sphere = a.sphere_bound(&b, &pairing.relative);
            let bound = if by_sphere > cutoff {
                by_sphere
            } else {
                by_sphere.max(a.hull_bound(&b, &pairing.relative, cutoff))
            };
            bound - slack
        });
        let nearer = usize::from(bounds[1] < bounds[0]);
        for k in [1 - nearer, nearer] {
            if bounds[k] <= visitor.bound() {
                let (i, j) = children[k];
                scratch.stack.push((i, j, bounds[k]));
            }
        }
    }
    ControlFlow::Continue(())
}
