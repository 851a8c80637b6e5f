//! Refits the boxes of a packed tree to primitives whose vertices have moved. Nothing is grouped and no axes are searched for:
//! the boxes of polygons follow their polygons, all others keep their axes.

use super::packed_tree::PackedTree;
use crate::boxes::{AxisSpans, StoredAxes, WideNode};
use crate::hierarchy::Ball;
use crate::lanes::{F64x4, Instructions, Work, along64, each3, with_widest};
use crate::pose::{Mat3, Vec3};
use crate::primitive::{Primitive, Primitives};

/// The tree over moved primitives, which are as many and of the same kinds as those of `old`; `ball` bounds them.
pub fn refit(old: &PackedTree, primitives: &Primitives, ball: Ball) -> PackedTree {
    let mut packed = PackedTree::empty(ball);
    packed.primitives.reserve(old.primitives().len());
    for entry in old.primitives().entries() {
        let shape = primitives.get(entry.primitive as usize).shape;
        packed.primitives.push(entry.primitive, shape);
    }
    let points = LeafCoordinates::new(&packed, primitives);
    packed.nodes = with_widest(Nodes {
        old,
        packed: &packed,
        primitives,
        points,
        below: places_below(old),
    });
    packed.finish(ball, primitives.only());
    packed
}

/// What the nodes are refitted to.
struct Nodes<'a> {
    old: &'a PackedTree,
    /// The new tree, but for its nodes.
    packed: &'a PackedTree,
    primitives: &'a Primitives,
    points: LeafCoordinates,
    /// Of each node, the lowest and highest place below it.
    below: Vec<[u32; 2]>,
}

impl Work for Nodes<'_> {
    type Output = Vec<WideNode>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Vec<WideNode> {
        let mut nodes = Vec::with_capacity(self.old.nodes().len());
        let mut boxes = Vec::with_capacity(8);
        for node in self.old.nodes() {
            boxes.clear();
            for (lane, &child) in node.children().iter().enumerate() {
                boxes.push(self.spans(lanes, node, lane, child));
            }
            let mut refitted = WideNode::of_spans(&boxes);
            refitted.children = node.children;
            nodes.push(refitted);
        }
        nodes
    }
}

impl Nodes<'_> {
    /// The spans of a child of a node. The boxes of polygons follow them, others keep their axes.
    #[inline(always)]
    fn spans<I: Instructions>(
        &self,
        lanes: I,
        node: &WideNode,
        lane: usize,
        child: u32,
    ) -> AxisSpans {
        let Some(place) = PackedTree::place_of(child) else {
            let axes = StoredAxes::of(node, lane);
            return self.points.spans(lanes, axes, self.below[child as usize]);
        };
        let entry = self.packed.primitives().entry(place as usize);
        let primitive = self.primitives.get(entry.primitive as usize);
        let axes = polygon_axes(&primitive).unwrap_or_else(|| StoredAxes::of(node, lane));
        self.points.spans(lanes, axes, [place, place])
    }
}

/// The lowest and highest place below each node. Between them are no places of other nodes, except in files that the library
/// did not write.
fn places_below(tree: &PackedTree) -> Vec<[u32; 2]> {
    let mut below = vec![[u32::MAX, 0]; tree.nodes().len()];
    // Children come after their parents.
    for index in (0..below.len()).rev() {
        let mut whole = below[index];
        for &child in tree.nodes()[index].children() {
            let [low, high] = match PackedTree::place_of(child) {
                Some(place) => [place, place],
                None => below[child as usize],
            };
            whole = [whole[0].min(low), whole[1].max(high)];
        }
        below[index] = whole;
    }
    below
}

/// The axes along a polygon's longest edge and its normal.
#[inline(always)]
fn polygon_axes(primitive: &Primitive) -> Option<StoredAxes> {
    let [face] = &primitive.shape.faces[..] else {
        return None;
    };
    let vertices = primitive.vertices;
    let mut longest = (0.0, Vec3::zeros());
    let mut last = vertices[vertices.len() - 1];
    for &vertex in vertices {
        let edge = vertex - last;
        let square = edge.norm_squared();
        if square > longest.0 {
            longest = (square, edge);
        }
        last = vertex;
    }
    let normal = face.normal;
    let along = (longest.1 - normal * normal.dot(&longest.1)).try_normalize(0.0)?;
    Some(StoredAxes::rounded(&along, &normal.cross(&along)))
}

/// The coordinates of the primitives' bounding points, leaf after leaf, in units of the packed tree.
struct LeafCoordinates {
    coordinates: [Vec<f64>; 3],
    /// Index of each leaf's first point, then the number of all points.
    first: Vec<u32>,
}

impl LeafCoordinates {
    fn new(packed: &PackedTree, primitives: &Primitives) -> Self {
        let unit = 1.0 / packed.scale();
        let leaves = packed.primitives().entries();
        let mut all = Self {
            coordinates: each3(|_| Vec::with_capacity(4 * leaves.len())),
            first: Vec::with_capacity(leaves.len() + 1),
        };
        all.first.push(0);
        for leaf in leaves {
            let primitive = primitives.get(leaf.primitive as usize);
            for point in primitive.bounding_points() {
                for (coordinates, &x) in all.coordinates.iter_mut().zip(&point) {
                    coordinates.push(x * unit);
                }
            }
            all.first.push(all.coordinates[0].len() as u32);
        }
        all
    }

    /// The spans of the leaves from one place to another.
    #[inline(always)]
    fn spans<I: Instructions>(&self, _: I, axes: StoredAxes, [low, high]: [u32; 2]) -> AxisSpans {
        let [from, to] = [self.first[low as usize], self.first[high as usize + 1]];
        let [x, y, z] = &self.coordinates;
        let range = from as usize..to as usize;
        let coordinates = [&x[range.clone()], &y[range.clone()], &z[range]];
        if coordinates[0].len() < 8 {
            let [x, y, z] = coordinates;
            let points = (0..x.len()).map(|i| Vec3::new(x[i], y[i], z[i]));
            return AxisSpans::of_points(axes, points);
        }
        let (low, high) = spans(&axes.axes, coordinates);
        AxisSpans { axes, low, high }
    }
}

/// The lowest and highest coordinates of at least four points along axes.
#[inline(always)]
fn spans(axes: &Mat3, [x, y, z]: [&[f64]; 3]) -> (Vec3, Vec3) {
    let axes: [[f64; 3]; 3] = each3(|i| each3(|k| axes[(k, i)]));
    let mut low = [F64x4::splat(f64::INFINITY); 3];
    let mut high = [F64x4::splat(f64::NEG_INFINITY); 3];
    let count = x.len().min(y.len()).min(z.len());
    // The last four overlap those before.
    for first in (0..count - 4).step_by(4).chain([count - 4]) {
        let four = |from: &[f64]| F64x4(std::array::from_fn(|i| from[first + i]));
        let points = [four(x), four(y), four(z)];
        for i in 0..3 {
            let along = along64(&points, &axes[i]);
            low[i] = low[i].min(along);
            high[i] = high[i].max(along);
        }
    }
    let low = each3(|i| low[i].least());
    let high = each3(|i| high[i].greatest());
    (low.into(), high.into())
}
