//! The support point of a body along a direction.

use smallvec::{SmallVec, smallvec};

use super::body::Body;
use crate::boxes::PackedBox;
use crate::hierarchy::packed::NodeRef;
use crate::pose::Vec3;

/// The support point of a body: the point farthest along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Farthest {
    /// In the body's own frame.
    pub point: Vec3,
    /// The primitive that the point belongs to.
    pub primitive: u32,
    /// The point's coordinate along the direction.
    pub along: f64,
}

impl Body {
    /// The farthest point along a unit direction of the body's own frame; among primitives that tie, that of the lowest
    /// index. Traverses the packed tree, farthest boxes first.
    pub fn farthest(&self, direction: &Vec3) -> Farthest {
        let tree = self.packed();
        let mut best = Farthest {
            point: Vec3::zeros(),
            primitive: u32::MAX,
            along: f64::NEG_INFINITY,
        };
        let mut open: SmallVec<[(f64, NodeRef); 64]> = smallvec![(f64::INFINITY, tree.root())];
        while let Some((bound, node)) = open.pop() {
            if bound < best.along {
                continue;
            }
            if node.is_leaf() {
                let place = tree.place(node) as usize;
                let primitive = tree.primitives().entry(place).primitive;
                let point = self
                    .primitives()
                    .get(primitive as usize)
                    .farthest(direction);
                let along = direction.dot(&point);
                let is_better =
                    along > best.along || along == best.along && primitive < best.primitive;
                if is_better {
                    best = Farthest {
                        point,
                        primitive,
                        along,
                    };
                }
                continue;
            }
            let index = tree.index(node);
            let first = open.len();
            let below = |lane: usize| -> (f64, NodeRef) {
                let bound = extent_along(&tree.node(index).get(lane), direction);
                // For the rounding of the point's coordinates.
                let slack = 1e-14 * self.radius();
                (bound * tree.scale() + slack, tree.child(index, lane))
            };
            open.extend((0..tree.node(index).count as usize).map(below));
            // The farthest goes on top of the stack.
            open[first..].sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        best
    }
}

/// The largest coordinate of a box along a direction.
fn extent_along(bounding_box: &PackedBox, direction: &Vec3) -> f64 {
    let along = |v: &[f32; 3]| direction.dot(&Vec3::from(v.map(f64::from)));
    let sides = bounding_box.axes.iter().zip(&bounding_box.half);
    let sides: f64 = sides
        .map(|(axis, half)| along(axis).abs() * f64::from(*half))
        .sum();
    along(&bounding_box.center) + sides
}
