//! Refits the boxes of a packed tree to primitives whose vertices have moved. Nothing is grouped and no axes are searched for:
//! the boxes of polygons follow their polygons, all others keep their axes.

use super::packed_primitives::PackedTriangle;
use super::packed_tree::PackedTree;
use crate::boxes::{AxisSpans, FourSpans, StoredAxes, WideNode};
use crate::hierarchy::Ball;
use crate::lanes::{F64x4, Instructions, Work, along64, each3, with_widest};
use crate::pose::{Mat3, Vec3};
use crate::primitive::{Primitive, Primitives};

/// The tree over moved primitives, which are as many and of the same kinds as those of `old`; `ball` bounds them.
pub fn refit(old: &PackedTree, primitives: &Primitives, ball: Ball) -> PackedTree {
    let mut packed = PackedTree::empty(ball);
    packed.primitives.reserve_as(old.primitives());
    let mut points = LeafCoordinates::for_points(primitives.vertex_count(), old.primitives().len());
    let unit = 1.0 / packed.scale();
    for entry in old.primitives().entries() {
        let primitive = primitives.get(entry.primitive as usize);
        packed.primitives.push(entry.primitive, primitive.shape);
        points.push(&primitive, unit);
    }
    packed.nodes = with_widest(Nodes {
        old,
        packed: &packed,
        primitives,
        points,
        unit,
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
    /// A length of the body in units of the packed tree.
    unit: f64,
    /// Of each node, the lowest and highest place below it.
    below: Vec<[u32; 2]>,
}

impl Work for Nodes<'_> {
    type Output = Vec<WideNode>;

    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Vec<WideNode> {
        let mut nodes = Vec::with_capacity(self.old.nodes().len());
        let mut fours = [FourSpans::default(); 2];
        for node in self.old.nodes() {
            let count = node.children().len();
            for (i, four) in fours[..count.div_ceil(4)].iter_mut().enumerate() {
                self.set_four(lanes, four, node, 4 * i);
            }
            let mut refitted = WideNode::of_fours(&fours, count);
            refitted.children = node.children;
            nodes.push(refitted);
        }
        nodes
    }
}

impl Nodes<'_> {
    /// Sets the spans of up to four children of a node, from a lane on. Lanes without a child become those of another.
    #[inline(always)]
    fn set_four<I: Instructions>(
        &self,
        lanes: I,
        four: &mut FourSpans,
        node: &WideNode,
        first: usize,
    ) {
        let children = &node.children()[first..];
        let mut triangles: [Option<&PackedTriangle>; 4] = [None; 4];
        for (triangle, &child) in triangles.iter_mut().zip(children) {
            let place = PackedTree::place_of(child);
            *triangle = place.and_then(|place| self.packed.primitives().triangle(place as usize));
        }
        let mut is_set = [false; 4];
        if let Some(any) = triangles.iter().flatten().next() {
            let filled = triangles.map(|triangle| triangle.unwrap_or(any));
            let has_axes = set_triangles(four, filled, self.unit);
            for lane in 0..4 {
                let is_other = triangles[lane].is_none() && lane < children.len();
                is_set[lane] = has_axes[lane] && !is_other;
            }
        }
        for (lane, is_set) in is_set.into_iter().enumerate() {
            if !is_set {
                // Children, if there are fewer than four, are repeated.
                let child = if lane < children.len() { lane } else { 0 };
                four.set(lane, &self.spans(lanes, node, first + child));
            }
        }
    }

    /// The spans of a child of a node. The boxes of polygons follow them, others keep their axes.
    #[inline(always)]
    fn spans<I: Instructions>(&self, lanes: I, node: &WideNode, lane: usize) -> AxisSpans {
        let child = node.children[lane];
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

/// Sets the spans of four triangles (see [`FourSpans::set_triangles`]), whose lengths are multiplied by `unit`.
#[inline(always)]
fn set_triangles(four: &mut FourSpans, triangles: [&PackedTriangle; 4], unit: f64) -> [bool; 4] {
    let [a, b, c, d] = triangles;
    let lanes = |row: usize, i: usize| F64x4([a[row].0[i], b[row].0[i], c[row].0[i], d[row].0[i]]);
    let normal = each3(|k| lanes(0, k));
    let corners = each3(|corner| each3(|k| lanes(1 + k, corner) * unit));
    four.set_triangles(&corners, &normal)
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
    /// No leaves, with memory for so many points of so many leaves.
    fn for_points(points: usize, leaves: usize) -> Self {
        let mut first = Vec::with_capacity(leaves + 1);
        first.push(0);
        Self {
            coordinates: each3(|_| Vec::with_capacity(points)),
            first,
        }
    }

    /// Adds a leaf, whose lengths are multiplied by `unit`.
    #[inline(always)]
    fn push(&mut self, leaf: &Primitive, unit: f64) {
        for (k, coordinates) in self.coordinates.iter_mut().enumerate() {
            match leaf.hull_vertices() {
                Some(vertices) => coordinates.extend(vertices.iter().map(|p| p[k] * unit)),
                None => coordinates.extend(leaf.bounding_points().map(|p| p[k] * unit)),
            }
        }
        self.first.push(self.coordinates[0].len() as u32);
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
    let [x, y, z] = [&x[..count], &y[..count], &z[..count]];
    let mut first = 0;
    while first < count {
        // The last four overlap those before.
        let at = first.min(count - 4);
        first += 4;
        let four = |from: &[f64]| F64x4([from[at], from[at + 1], from[at + 2], from[at + 3]]);
        let points = [four(x), four(y), four(z)];
        // Unrolled: of a loop over the axes, compilers for AVX-512 make gathers and scatters, which took 40 % of a refit.
        let along = each3(|i| along64(&points, &axes[i]));
        low = each3(|i| low[i].min(along[i]));
        high = each3(|i| high[i].max(along[i]));
    }
    let low = each3(|i| low[i].least());
    let high = each3(|i| high[i].greatest());
    (low.into(), high.into())
}
