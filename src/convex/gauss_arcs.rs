//! The Gauss map of a polytope's edges: each edge maps to the arc of directions along which it is the supporting feature, from
//! the normal of one adjacent face to that of the other.
//!
//! An edge of r and one of s make a facet of the Minkowski difference s - r where the reversed arc of the one crosses the arc
//! of the other. Candidates are found by a tree of boxes around the arcs. A box holds all directions along which its edge
//! supports to within a slack, so that rounding loses no pair.

use std::collections::HashMap;
use std::ops::Range;

use foldhash::fast::RandomState;

use super::placed::PlacedPrimitive;
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

/// The edges of a polytope with their arcs.
pub struct GaussArcs {
    /// The vectors from an edge to a corner of each adjacent face, edge after edge.
    wings: Vec<Vec3>,
    /// For each edge, its range in `wings`.
    ranges: Vec<Range<usize>>,
    /// Edge indices, grouped by leaf.
    order: Vec<u32>,
    /// The arcs' boxes, in that order.
    boxes: Vec<Bounds>,
    /// The root is the last.
    nodes: Vec<Node>,
}

struct Node {
    bounds: Bounds,
    kind: NodeKind,
}

enum NodeKind {
    Leaf { first: usize, count: usize },
    Interior { children: [usize; 2] },
}

/// Edges per leaf, at most.
const MAX_LEAF: usize = 8;

/// The slack added to the boxes for the rounding of their arcs.
const ARC_ROUNDING: f64 = 1e-9;

impl GaussArcs {
    /// The arcs of a polytope in space, or the reversed arcs. `slack` is the length by which a vertex may lie beyond a
    /// supporting edge.
    pub fn new(placed: &PlacedPrimitive, is_reversed: bool, slack: f64) -> Self {
        let beside = EdgeNeighbours::of(placed);
        let count = placed.shape.edges.len();
        let (mut ranges, mut boxes) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut wings = Vec::with_capacity(2 * count);
        let mut order: Vec<u32> = Vec::with_capacity(count);
        for (edge, &[a, b]) in (0..).zip(&placed.shape.edges) {
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
            ranges.push(first..wings.len());
            // An edge of length 0 has no direction; a point has one such edge.
            if along != Vec3::zeros() {
                order.push(edge);
            }
        }
        let mut nodes = Vec::new();
        if !order.is_empty() {
            build(&boxes, &mut order, 0, &mut nodes);
        }
        Self {
            boxes: order.iter().map(|&i| boxes[i as usize]).collect(),
            wings,
            ranges,
            order,
            nodes,
        }
    }

    /// The lowest and highest projection of the corners beside an edge on a normal of it, relative to the edge.
    pub fn extent_at(&self, edge: u32, normal: &Vec3) -> [f64; 2] {
        let wings = &self.wings[self.ranges[edge as usize].clone()];
        let heights = wings.iter().map(|wing| normal.dot(wing));
        heights.fold([0.0f64; 2], |[low, high], x| [low.min(x), high.max(x)])
    }

    /// Visits the pairs of edges whose arcs may cross. Each pair compared is charged to the meter; stops when its limit is
    /// exceeded.
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

/// The faces adjacent to each edge, each with its corner after the edge.
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

/// A box around the directions along which an edge supports to within the slack, given a corner and the normal of each adjacent
/// face.
fn arc_bounds(along: &Vec3, wings: &[Vec3], slack: f64, normal: impl Fn(usize) -> Vec3) -> Bounds {
    let Some(along) = along.try_normalize(0.0) else {
        return Bounds::default();
    };
    let end = |side: usize| ArcEnd::of(&along, &wings[side], &normal(side), slack);
    let ends = match wings.len() {
        // An edge with one face: the arc goes on to the normal of the face's other side.
        1 => end(0).map(|end| [end, end.turned()]),
        2 => end(0).zip(end(1)).map(|(a, b)| [a, b]),
        _ => None,
    };
    let arc = ends.and_then(|ends| Bounds::of_arc(&ends));
    arc.unwrap_or_else(|| Bounds::of_circle(&along))
}

/// One end of an arc: the normal of a face.
#[derive(Clone, Copy)]
struct ArcEnd {
    normal: Vec3,
    /// The unit vector from the edge into the face, perpendicular to the edge.
    inwards: Vec3,
    /// An upper bound of the angle beyond the normal, in radians, up to which the edge supports to within the slack.
    beyond: f64,
}

impl ArcEnd {
    /// `None` for a face too narrow beside the edge for its normal to be reliable.
    fn of(along: &Vec3, wing: &Vec3, face_normal: &Vec3, slack: f64) -> Option<Self> {
        let across = wing - along * along.dot(wing);
        let width = across.norm();
        // The sine of that angle; the angle is at most pi / 2 times the sine.
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
    /// The empty box.
    fn default() -> Self {
        Self {
            low: Vec3::repeat(f64::INFINITY),
            high: Vec3::repeat(f64::NEG_INFINITY),
        }
    }
}

impl Bounds {
    /// The box of an arc of a great circle, of at most half a turn. `None` if its ends are inconsistent.
    fn of_arc([a, b]: &[ArcEnd; 2]) -> Option<Self> {
        // Both sums point to the middle of the arc; at flat or at sharp edges one of them is about 0.
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
            // The distance of the arc from its chord.
            let half_chord = 0.5 * (end.normal - middle).norm();
            bulge = bulge.max(1.0 - (1.0 - half_chord * half_chord).max(0.0).sqrt());
        }
        Some(bounds.grown(bulge + a.beyond.max(b.beyond) + ARC_ROUNDING))
    }

    /// The box of all directions perpendicular to a unit vector.
    fn of_circle(along: &Vec3) -> Self {
        let high = along.map(|x| (1.0 - x * x).max(0.0).sqrt());
        Self { low: -high, high }.grown(ARC_ROUNDING)
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

/// Builds a tree over the boxes of `order`, split at the median along the longest axis, and returns its root. `first` is the
/// position of `order` in the whole order.
fn build(boxes: &[Bounds], order: &mut [u32], first: usize, nodes: &mut Vec<Node>) -> usize {
    let around = |order: &[u32]| {
        let all = order.iter().map(|&i| &boxes[i as usize]);
        all.fold(Bounds::default(), |around, next| around.union(next))
    };
    let bounds = around(order);
    let count = order.len();
    let kind = if count <= MAX_LEAF {
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
