//! Refits the boxes of a packed tree to primitives whose vertices have moved. Nothing is grouped and no axes are searched for:
//! the boxes of polygons follow their polygons, all others keep their axes.

use super::packed_primitives::PackedTriangle;
use super::packed_tree::PackedTree;
use crate::boxes::{AxisSpans, FourSpans, StoredAxes, WideNode};
use crate::hierarchy::Ball;
use crate::lanes::{F64x4, Instructions, Points64, Work, along64, each3, splat64, with_widest};
use crate::pose::Vec3;
use crate::primitive::{Primitive, Primitives};

/// The tree over moved primitives, which are as many and of the same kinds as those of `old`; `ball` bounds them.
pub fn refit(old: &PackedTree, primitives: &Primitives, ball: Ball) -> PackedTree {
    let mut packed = PackedTree::empty(ball);
    packed.primitives.reserve_as(old.primitives());
    for entry in old.primitives().entries() {
        let primitive = primitives.get(entry.primitive as usize);
        packed.primitives.push(entry.primitive, primitive.shape);
    }
    packed.nodes = with_widest(Nodes {
        old,
        packed: &packed,
        primitives,
        unit: 1.0 / packed.scale(),
    });
    packed.finish(ball, primitives);
    packed
}

/// What the nodes are refitted to.
struct Nodes<'a> {
    old: &'a PackedTree,
    /// The new tree, but for its nodes.
    packed: &'a PackedTree,
    primitives: &'a Primitives,
    /// A length of the body in units of the packed tree, a power of two.
    unit: f64,
}

/// A node some of whose children have been refitted.
struct OpenNode {
    index: usize,
    /// The children from this lane on are still to be looked at.
    next: usize,
    /// The boxes of the children so far.
    fours: [FourSpans; 2],
    /// The box of the child that is being refitted, around the primitives so far.
    child: GrowingBox,
}

/// A box whose axes are known, and that grows with each point.
#[derive(Clone, Copy)]
struct GrowingBox {
    axes: StoredAxes,
    /// The lowest and highest coordinates along the axes, of the points in each lane.
    low: Points64,
    high: Points64,
}

impl Work for Nodes<'_> {
    type Output = Vec<WideNode>;

    /// Depth first: the points of a node's primitives are added to the boxes of all nodes around it while they are in the cache.
    #[inline(always)]
    fn run<I: Instructions>(self, lanes: I) -> Vec<WideNode> {
        let old = self.old.nodes();
        let mut nodes = vec![WideNode::default(); old.len()];
        let mut points = Vec::new();
        let mut open = vec![OpenNode::at(0)];
        let mut depth = 0;
        self.set_leaves(lanes, &mut open[0], &mut points);
        loop {
            let here = &mut open[depth];
            let node = &old[here.index];
            let children = node.children();
            while here.next < children.len() && PackedTree::place_of(children[here.next]).is_some()
            {
                here.next += 1;
            }
            if here.next < children.len() {
                let below = children[here.next] as usize;
                here.child = GrowingBox::new(StoredAxes::of(node, here.next));
                depth += 1;
                if depth == open.len() {
                    open.push(OpenNode::at(0));
                }
                let (around, inside) = open.split_at_mut(depth);
                inside[0].index = below;
                inside[0].next = 0;
                points.clear();
                self.set_leaves(lanes, &mut inside[0], &mut points);
                for around in around {
                    around.child.add(&points);
                }
                continue;
            }
            let mut refitted = WideNode::of_fours(&mut here.fours, children.len());
            refitted.children = node.children;
            nodes[here.index] = refitted;
            if depth == 0 {
                return nodes;
            }
            depth -= 1;
            let around = &mut open[depth];
            let lane = around.next;
            around.fours[lane / 4].set(lane % 4, &around.child.spans());
            around.next += 1;
        }
    }
}

impl Nodes<'_> {
    /// Sets the boxes of a node's primitives, and appends the points of these. The boxes of polygons follow them, others keep
    /// their axes. The lanes of other children are set to anything.
    #[inline(always)]
    fn set_leaves<I: Instructions>(&self, _: I, here: &mut OpenNode, points: &mut Vec<Points64>) {
        let node = &self.old.nodes()[here.index];
        for (i, children) in node.children().chunks(4).enumerate() {
            let four = &mut here.fours[i];
            let mut triangles: [Option<&PackedTriangle>; 4] = [None; 4];
            for (triangle, &child) in triangles.iter_mut().zip(children) {
                let place = PackedTree::place_of(child);
                *triangle =
                    place.and_then(|place| self.packed.primitives().triangle(place as usize));
            }
            let mut is_set = [false; 4];
            if let Some(any) = triangles.iter().flatten().next() {
                let filled = triangles.map(|triangle| triangle.unwrap_or(any));
                let (corners, normal) = in_lanes(filled, self.unit);
                let has_axes = four.set_triangles(&corners, &normal);
                points.extend_from_slice(&corners);
                for lane in 0..4 {
                    is_set[lane] = has_axes[lane] && triangles[lane].is_some();
                }
            }
            for (lane, &child) in children.iter().enumerate() {
                if !is_set[lane]
                    && let Some(place) = PackedTree::place_of(child)
                {
                    let entry = self.packed.primitives().entry(place as usize);
                    let primitive = self.primitives.get(entry.primitive as usize);
                    let axes = polygon_axes(&primitive);
                    let first = points.len();
                    append(&primitive, self.unit, points);
                    let axes = axes.unwrap_or_else(|| StoredAxes::of(node, 4 * i + lane));
                    let mut own = GrowingBox::new(axes);
                    own.add(&points[first..]);
                    four.set(lane, &own.spans());
                }
            }
        }
    }
}

impl OpenNode {
    fn at(index: usize) -> Self {
        Self {
            index,
            next: 0,
            fours: [FourSpans::default(); 2],
            child: GrowingBox::new(StoredAxes::rounded(&Vec3::x(), &Vec3::y())),
        }
    }
}

impl GrowingBox {
    #[inline(always)]
    fn new(axes: StoredAxes) -> Self {
        Self {
            axes,
            low: splat64(&[f64::INFINITY; 3]),
            high: splat64(&[f64::NEG_INFINITY; 3]),
        }
    }

    #[inline(always)]
    fn add(&mut self, points: &[Points64]) {
        let axes: [[f64; 3]; 3] = each3(|i| each3(|k| self.axes.axes[(k, i)]));
        let (mut low, mut high) = (self.low, self.high);
        for four in points {
            // Unrolled: of a loop over the axes compilers made gathers and scatters, which took 40 % of a refit.
            let along = each3(|i| along64(four, &axes[i]));
            low = each3(|i| low[i].min(along[i]));
            high = each3(|i| high[i].max(along[i]));
        }
        (self.low, self.high) = (low, high);
    }

    #[inline(always)]
    fn spans(&self) -> AxisSpans {
        AxisSpans {
            axes: self.axes,
            low: each3(|i| self.low[i].least()).into(),
            high: each3(|i| self.high[i].greatest()).into(),
        }
    }
}

/// The corners of four triangles, whose lengths are multiplied by `unit`, and their normals.
#[inline(always)]
fn in_lanes(triangles: [&PackedTriangle; 4], unit: f64) -> ([Points64; 3], Points64) {
    let [a, b, c, d] = triangles;
    let lanes = |row: usize, i: usize| F64x4([a[row].0[i], b[row].0[i], c[row].0[i], d[row].0[i]]);
    let corners = each3(|corner| each3(|k| lanes(1 + k, corner) * unit));
    (corners, each3(|k| lanes(0, k)))
}

/// Appends a primitive's bounding points, whose lengths are multiplied by `unit`; the last is repeated to fill the lanes.
#[inline(always)]
fn append(primitive: &Primitive, unit: f64, to: &mut Vec<Points64>) {
    let mut points = primitive.bounding_points();
    while let Some(first) = points.next() {
        let mut four = [first; 4];
        for i in 1..4 {
            four[i] = points.next().unwrap_or(four[i - 1]);
        }
        to.push(each3(|k| F64x4(four.map(|point| point[k] * unit))));
    }
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
