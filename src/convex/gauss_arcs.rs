//! The Gauss map of a polytope's edges: each maps to the arc of the directions in which it supports, from the normal of the
//! face on one side of it to that on the other.
//!
//! An edge of r and one of s make a facet of the Minkowski difference s - r where the arc of the one, reversed, crosses the arc
//! of the other. Boxes around the arcs, in a tree, tell which may. They hold all directions in which the edge supports to
//! within a slack, so that rounding takes no pair away.

use std::collections::HashMap;
use std::ops::Range;

use foldhash::fast::RandomState;

use super::placed::PlacedPrimitive;
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

/// The edges of a polytope with their arcs.
pub struct GaussArcs {
    edges: Vec<Edge>,
    /// For each edge, from it to a corner of each face beside it.
    wings: Vec<Vec3>,
    /// Numbers of edges, those of a leaf together.
    order: Vec<u32>,
    /// The arcs' boxes, in that order.
    boxes: Vec<Bounds>,
    /// The root is the last.
    nodes: Vec<Node>,
}

struct Edge {
    along: Vec3,
    /// Where its wings are.
    wings: Range<usize>,
}

struct Node {
    bounds: Bounds,
    kind: NodeKind,
}

enum NodeKind {
    Leaf { first: usize, count: usize },
    Interior { children: [usize; 2] },
}

/// Edges to a leaf.
const LEAF: usize = 8;

/// What is added to boxes for the rounding of the arcs they hold.
const ROUNDING: f64 = 1e-9;

impl GaussArcs {
    /// The arcs of a polytope in space, or the arcs reversed. `slack` is the length by which a vertex may reach beyond what
    /// supports.
    pub fn new(placed: &PlacedPrimitive, is_reversed: bool, slack: f64) -> Self {
        let beside = EdgeNeighbours::of(placed);
        let count = placed.shape.edges.len();
        let (mut edges, mut boxes) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut wings = Vec::with_capacity(2 * count);
        for &[a, b] in &placed.shape.edges {
            let from = placed.vertex(a);
            let along = placed.vertex(b) - from;
            let first = wings.len();
            let faces = beside.faces(a, b);
            wings.extend(
                faces
                    .iter()
                    .map(|&(_, corner)| placed.vertex(corner) - from),
            );
            let arc = arc_bounds(&along, &wings[first..], slack, |side| {
                placed.normal(faces[side].0 as usize)
            });
            boxes.push(if is_reversed { arc.reversed() } else { arc });
            edges.push(Edge {
                along,
                wings: first..wings.len(),
            });
        }
        // An edge without length has no direction: a point's stands for the point.
        let has_length = |&i: &u32| edges[i as usize].along != Vec3::zeros();
        let mut order: Vec<u32> = (0..edges.len() as u32).filter(has_length).collect();
        let mut nodes = Vec::new();
        if !order.is_empty() {
            build(&boxes, &mut order, 0, &mut nodes);
        }
        Self {
            boxes: order.iter().map(|&i| boxes[i as usize]).collect(),
            edges,
            wings,
            order,
            nodes,
        }
    }

    pub fn len(&self) -> usize {
        self.edges.len()
    }

    pub fn along(&self, edge: u32) -> &Vec3 {
        &self.edges[edge as usize].along
    }

    /// How far the corners beside an edge reach along a normal of it.
    pub fn extent_at(&self, edge: u32, normal: &Vec3) -> [f64; 2] {
        let wings = &self.wings[self.edges[edge as usize].wings.clone()];
        let heights = wings.iter().map(|wing| normal.dot(wing));
        heights.fold([0.0f64; 2], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Shows the pairs of edges whose arcs may cross, until the call has done enough: each pair compared is counted.
    pub fn visit_crossing(
        &self,
        other: &Self,
        meter: &mut WorkMeter,
        mut visit: impl FnMut(u32, u32),
    ) {
        let mut open = Vec::new();
        if !self.nodes.is_empty() && !other.nodes.is_empty() {
            open.push([self.nodes.len() - 1, other.nodes.len() - 1]);
        }
        while let Some([a, b]) = open.pop() {
            meter.charge(1);
            if meter.is_exceeded() {
                return;
            }
            let [node_a, node_b] = [&self.nodes[a], &other.nodes[b]];
            if !node_a.bounds.meets(&node_b.bounds) {
                continue;
            }
            match (&node_a.kind, &node_b.kind) {
                (NodeKind::Interior { children }, NodeKind::Leaf { .. }) => {
                    open.extend(children.map(|child| [child, b]));
                }
                (NodeKind::Interior { children }, NodeKind::Interior { .. })
                    if node_a.bounds.size() >= node_b.bounds.size() =>
                {
                    open.extend(children.map(|child| [child, b]));
                }
                (_, NodeKind::Interior { children }) => {
                    open.extend(children.map(|child| [a, child]));
                }
                (
                    &NodeKind::Leaf { first, count },
                    &NodeKind::Leaf {
                        first: first_b,
                        count: count_b,
                    },
                ) => {
                    meter.charge((count * count_b) as u64);
                    for i in first..first + count {
                        for j in first_b..first_b + count_b {
                            if self.boxes[i].meets(&other.boxes[j]) {
                                visit(self.order[i], other.order[j]);
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The faces beside each edge, each with the corner of the face that follows the edge.
struct EdgeNeighbours(HashMap<[u32; 2], Vec<(u32, u32)>, RandomState>);

impl EdgeNeighbours {
    fn of(placed: &PlacedPrimitive) -> Self {
        let mut found: HashMap<_, Vec<_>, _> = HashMap::default();
        for (face, number) in placed.shape.faces.iter().zip(0..) {
            let ring = &face.vertices;
            for i in 0..ring.len() {
                let at = |k: usize| ring[(i + k) % ring.len()];
                let edge = Self::key(at(0), at(1));
                found.entry(edge).or_default().push((number, at(2)));
            }
        }
        Self(found)
    }

    fn key(a: u32, b: u32) -> [u32; 2] {
        [a.min(b), a.max(b)]
    }

    fn faces(&self, a: u32, b: u32) -> &[(u32, u32)] {
        self.0.get(&Self::key(a, b)).map_or(&[], |faces| faces)
    }
}

/// A box around the directions in which an edge supports to within the slack, given a corner of each face beside it and the
/// normals of these.
fn arc_bounds(along: &Vec3, wings: &[Vec3], slack: f64, normal: impl Fn(usize) -> Vec3) -> Bounds {
    let Some(along) = along.try_normalize(0.0) else {
        return Bounds::default();
    };
    let end = |side: usize| ArcEnd::of(&along, &wings[side], &normal(side), slack);
    let ends = match wings.len() {
        // Beside a lone face the arc goes on to the normal of its other side.
        1 => end(0).map(|end| [end, end.turned()]),
        2 => end(0).zip(end(1)).map(|(a, b)| [a, b]),
        _ => None,
    };
    let arc = ends.and_then(|ends| Bounds::of_arc(&ends));
    arc.unwrap_or_else(|| Bounds::of_circle(&along))
}

/// Where an arc ends: at the normal of a face.
#[derive(Clone, Copy)]
struct ArcEnd {
    normal: Vec3,
    /// From the edge into the face: a unit vector upright to the edge.
    inwards: Vec3,
    /// How far beyond the normal the edge supports to within the slack, at most.
    beyond: f64,
}

impl ArcEnd {
    /// None for a face so narrow beside the edge that its normal says too little.
    fn of(along: &Vec3, wing: &Vec3, face_normal: &Vec3, slack: f64) -> Option<Self> {
        let across = wing - along * along.dot(wing);
        let width = across.norm();
        // The angle's sine; the angle is at most pi / 2 times that.
        let sine = slack / width;
        if sine.is_nan() || sine > 0.5 {
            return None;
        }
        let inwards = across / width;
        let upright = along.cross(&inwards);
        let cosine = upright.dot(face_normal);
        (cosine.abs() > 0.5).then(|| Self {
            normal: upright * cosine.signum(),
            inwards,
            beyond: 2.0 * sine,
        })
    }

    /// The same face from its other side.
    fn turned(self) -> Self {
        Self {
            normal: -self.normal,
            ..self
        }
    }
}

/// A box of directions.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Default for Bounds {
    /// Holds nothing.
    fn default() -> Self {
        Self {
            low: Vec3::repeat(f64::INFINITY),
            high: Vec3::repeat(f64::NEG_INFINITY),
        }
    }
}

impl Bounds {
    /// Around an arc of a great circle, of half a turn at most. None if its ends contradict one another.
    fn of_arc([a, b]: &[ArcEnd; 2]) -> Option<Self> {
        // Normals and what points outwards lie on one side; of flat and of sharp edges one of the two sums is about 0.
        let outwards = (a.normal + b.normal) - (a.inwards + b.inwards);
        let middle = outwards.try_normalize(1.0)?;
        let mut bounds = Self {
            low: middle,
            high: middle,
        };
        let mut bulge = 0.0f64;
        for end in [a, b] {
            bounds = bounds.union(&Self {
                low: end.normal,
                high: end.normal,
            });
            // How far the arc lies from its chord.
            let half_chord = 0.5 * (end.normal - middle).norm();
            bulge = bulge.max(1.0 - (1.0 - half_chord * half_chord).max(0.0).sqrt());
        }
        Some(bounds.grown(bulge + a.beyond.max(b.beyond) + ROUNDING))
    }

    /// Around all directions upright to a unit vector.
    fn of_circle(along: &Vec3) -> Self {
        let high = along.map(|x| (1.0 - x * x).max(0.0).sqrt());
        Self { low: -high, high }.grown(ROUNDING)
    }

    fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low.add_scalar(-by),
            high: self.high.add_scalar(by),
        }
    }

    fn reversed(&self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }

    fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.inf(&other.low),
            high: self.high.sup(&other.high),
        }
    }

    fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    /// The length of its diagonal.
    fn size(&self) -> f64 {
        (self.high - self.low).norm()
    }
}

/// A tree over some of the boxes, halved at the middle one along the longest axis; returns its root. `first` is the place of
/// the first of them.
fn build(boxes: &[Bounds], order: &mut [u32], first: usize, nodes: &mut Vec<Node>) -> usize {
    let around = |order: &[u32]| {
        let all = order.iter().map(|&i| &boxes[i as usize]);
        all.fold(Bounds::default(), |around, next| around.union(next))
    };
    let bounds = around(order);
    let count = order.len();
    let kind = if count <= LEAF {
        NodeKind::Leaf { first, count }
    } else {
        let middle = |i: u32| boxes[i as usize].low + boxes[i as usize].high;
        let middles = order.iter().map(|&i| middle(i));
        let extent = middles.fold(Bounds::default(), |around, next| {
            around.union(&Bounds {
                low: next,
                high: next,
            })
        });
        let axis = (extent.high - extent.low).imax();
        let half = count / 2;
        let along_axis = |&i: &u32, &j: &u32| middle(i)[axis].total_cmp(&middle(j)[axis]);
        order.select_nth_unstable_by(half, along_axis);
        let (low, high) = order.split_at_mut(half);
        let low = build(boxes, low, first, nodes);
        let high = build(boxes, high, first + half, nodes);
        NodeKind::Interior {
            children: [low, high],
        }
    };
    nodes.push(Node { bounds, kind });
    nodes.len() - 1
}
