//! One tree over the bodies of an environment, so that a query asks only those that are near.

use super::SObject;
use crate::body::Body;
use crate::hierarchy::{BOX, BoxTree, Extent, OrientedBox, PackedBox, power_of_two};
use crate::lanes::{Instructions, Work, each3, with_widest};
use crate::pair::{ROUNDING, bounds};
use crate::pose::{Mat3, Pose, Vec3, turned_axes};
use crate::tolerance;

/// What bounds a body at a pose: a ball, and a box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    center: Vec3,
    radius: f64,
    box_center: Vec3,
    /// Columns that are orthonormal to within 2^-12 (see `PackedBox`).
    axes: Mat3,
    half: Vec3,
    /// No corner of the box is farther from its centre.
    box_radius: f64,
    /// How far the body's primitives may be from what their features say (see `Body::deviation`).
    deviation: f64,
}

/// The objects of one state of an environment, by their places in it.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    tree: BoxTree,
    bounds: Vec<Bounds>,
    deviation: f64,
    /// No corner of a box is farther from the tree's centre.
    radius: f64,
    /// The largest coordinate in the world.
    reach: f64,
}

impl Bounds {
    pub fn of(body: &Body, pose: &Pose) -> Self {
        let whole = body.packed().whole();
        let ball = body.tree().wrapper(0);
        let placed = |from_center: Vec3| pose.transform_point(&(body.center() + from_center));
        Self {
            center: placed(ball.center),
            radius: ball.radius,
            box_center: placed(whole.center),
            axes: turned_axes(&pose.rotation, &whole.axes),
            half: whole.half,
            box_radius: whole.radius,
            deviation: body.deviation(),
        }
    }

    fn reach(&self) -> f64 {
        self.center.amax() + self.radius
    }

    /// A safe lower and a safe upper bound of the distance of two bodies, by their balls.
    pub fn distance(&self, other: &Bounds) -> [f64; 2] {
        let apart = (self.center - other.center).norm();
        let radii = self.radius + other.radius;
        let reach = self.reach().max(other.reach());
        let slack = slack(reach, self.deviation + other.deviation);
        [apart - radii - slack, apart + radii + slack]
    }

    fn oriented_box(&self) -> OrientedBox {
        let whole = Extent {
            low: -self.half,
            high: self.half,
        };
        let x = self.axes.column(0).normalize();
        let y = self.axes.column(1).into_owned();
        let y = (y - x * x.dot(&y)).normalize();
        OrientedBox {
            corners: whole.corners().map(|c| self.box_center + self.axes * c),
            axes: Mat3::from_columns(&[x, y, x.cross(&y)]),
        }
    }
}

/// What a bound in the world must be lowered by so that nothing it excludes could have mattered: its rounding, and the
/// error of the distances on both sides of a comparison (see `Pairing::slack`).
fn slack(reach: f64, deviation: f64) -> f64 {
    let rounding = tolerance::BOUND_ERROR + 2.0 * tolerance::DISTANCE_ERROR;
    4.0 * rounding * reach + 2.0 * deviation
}

impl ObjectTree {
    pub fn new(objects: &[SObject]) -> Self {
        let bounds: Vec<Bounds> = objects
            .iter()
            .map(|object| Bounds::of(&object.body, &object.pose))
            .collect();
        let boxes: Vec<OrientedBox> = bounds.iter().map(Bounds::oriented_box).collect();
        let tree = BoxTree::new(&boxes);
        let corners = boxes.iter().flat_map(|b| &b.corners);
        let largest = |lengths: &mut dyn Iterator<Item = f64>| lengths.fold(0.0, f64::max);
        Self {
            radius: largest(&mut corners.clone().map(|c| (c - tree.center).norm())),
            reach: largest(&mut corners.map(|c| c.amax()))
                .max(largest(&mut bounds.iter().map(Bounds::reach))),
            deviation: largest(&mut bounds.iter().map(|b| b.deviation)),
            tree,
            bounds,
        }
    }

    pub fn bounds(&self, place: usize) -> &Bounds {
        &self.bounds[place]
    }

    /// Visits the objects that may be within a limit of a body, by their places and with a safe lower bound of the
    /// distance, nearer parts of the tree first. `visit` returns the limit from then on.
    pub fn visit_near(
        &self,
        body: &Bounds,
        limit: f64,
        scratch: &mut NearScratch,
        visit: impl FnMut(usize, f64) -> f64,
    ) {
        if !self.bounds.is_empty() {
            with_widest(Descent::new(self, body, limit, &mut scratch.0, visit));
        }
    }
}

/// Memory of a descent, reused from one to the next.
#[derive(Debug, Default)]
pub struct NearScratch(Vec<(f32, u32)>);

/// A body's way down the tree. Lengths in single precision are in units of a power of two next above the size of the two.
struct Descent<'a, F> {
    tree: &'a BoxTree,
    /// The body's box, from the tree's centre.
    one: PackedBox,
    /// The unit of the tree, and that of the descent.
    unit: f32,
    scale: f64,
    inverse_scale: f64,
    /// Bounds are lowered by this.
    slack: f64,
    limit: f64,
    open: &'a mut Vec<(f32, u32)>,
    visit: F,
}

impl<'a, F: FnMut(usize, f64) -> f64> Descent<'a, F> {
    fn new(
        objects: &'a ObjectTree,
        body: &Bounds,
        limit: f64,
        open: &'a mut Vec<(f32, u32)>,
        visit: F,
    ) -> Self {
        let tree = &objects.tree;
        let from_center = body.box_center - tree.center;
        let size = objects.radius.max(from_center.norm() + body.box_radius);
        let scale = power_of_two(size);
        let inverse_scale = 1.0 / scale;
        let reach = objects.reach.max(body.reach());
        Self {
            one: PackedBox {
                axes: each3(|i| each3(|k| body.axes[(k, i)] as f32)),
                center: each3(|k| (from_center[k] * inverse_scale) as f32),
                half: each3(|i| ((body.half[i] * inverse_scale) as f32).next_up()),
            },
            unit: (tree.scale * inverse_scale) as f32,
            scale,
            inverse_scale,
            slack: slack(reach, objects.deviation + body.deviation) + ROUNDING * size,
            tree,
            limit,
            open,
            visit,
        }
    }

    #[inline(always)]
    fn cutoff(&self) -> f32 {
        (((self.limit + self.slack) * self.inverse_scale) as f32).next_up()
    }
}

impl<F: FnMut(usize, f64) -> f64> Work for Descent<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        self.open.clear();
        self.open.push((f32::NEG_INFINITY, 0));
        while let Some((bound, child)) = self.open.pop() {
            if bound > self.cutoff() {
                continue;
            }
            if child & BOX != 0 {
                let lower = f64::from(bound) * self.scale - self.slack;
                self.limit = (self.visit)((child & !BOX) as usize, lower);
                continue;
            }
            let node = &self.tree.nodes[child as usize];
            let eight = node.boxes(lanes, self.unit);
            let bounds = lanes.array(bounds(lanes, &eight, &self.one, false));
            let (first, cutoff) = (self.open.len(), self.cutoff());
            let children = node.children.into_iter().zip(bounds);
            for (child, bound) in children.take(node.count as usize) {
                if bound <= cutoff {
                    let mut place = self.open.len();
                    self.open.push((bound, child));
                    // The nearest goes on top.
                    while place > first && self.open[place - 1].0 < bound {
                        self.open.swap(place - 1, place);
                        place -= 1;
                    }
                }
            }
        }
    }
}
