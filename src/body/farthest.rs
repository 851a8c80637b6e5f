//! How far a body reaches along a direction.

use super::body::Body;
use crate::boxes::PackedBox;
use crate::hierarchy::packed::NodeRef;
use crate::pose::Vec3;

/// The point of a body that is farthest along a direction, and its primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Farthest {
    /// In the body's own frame.
    pub point: Vec3,
    pub primitive: u32,
    /// How far along the direction.
    pub along: f64,
}

impl Body {
    /// The farthest point along a unit direction of the body's own frame; of several primitives that reach as far, that of
    /// the lowest number. It goes down the tree to what may be farthest.
    pub fn farthest(&self, direction: &Vec3) -> Farthest {
        let tree = self.packed();
        let mut best = Farthest {
            point: Vec3::zeros(),
            primitive: u32::MAX,
            along: f64::NEG_INFINITY,
        };
        let mut open = vec![(f64::INFINITY, tree.root())];
        while let Some((most, unit)) = open.pop() {
            if most < best.along {
                continue;
            }
            if unit.is_leaf() {
                let place = tree.place(unit) as usize;
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
            let index = tree.index(unit);
            let children = tree.children(index);
            let first = open.len();
            let below = |lane: usize| -> (f64, NodeRef) {
                let bound = extent_along(&tree.node(index).get(lane), direction);
                // For the rounding of the point's place.
                let slack = 1e-14 * self.radius();
                (bound * tree.scale() + slack, children.units[lane])
            };
            open.extend((0..children.count).map(below));
            // The farthest goes on top.
            open[first..].sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        best
    }
}

/// No point of a box is farther along a direction.
fn extent_along(given: &PackedBox, direction: &Vec3) -> f64 {
    let along = |v: &[f32; 3]| direction.dot(&Vec3::from(v.map(f64::from)));
    let sides = given.axes.iter().zip(&given.half);
    let sides: f64 = sides
        .map(|(axis, half)| along(axis).abs() * f64::from(*half))
        .sum();
    along(&given.center) + sides
}
