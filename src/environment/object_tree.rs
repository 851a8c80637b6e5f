//! One tree over the bodies of an environment, so that a query asks only those that are near.

use super::SObject;
use crate::body::Body;
use crate::hierarchy::{BOX, BoxTree, Extent, OrientedBox, PackedBox, power_of_two};
use crate::lanes::{Instructions, Work, along64, cross3, each3, with_widest};
use crate::pair::{ROUNDING, bounds};
use crate::pose::{Mat3, Pose, Vec3};
use crate::tolerance;

/// What bounds a body at a pose: a ball, and a box.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    center: Vec3,
    radius: f64,
    box_center: Vec3,
    /// The first two axes, orthonormal to within 2^-12 (see `PackedBox`); the third is their cross product.
    axes: [Vec3; 2],
    half: Vec3,
    /// No corner of the box is farther from its centre.
    box_radius: f64,
    /// How far the body's primitives may be from what their features say (see `Body::deviation`).
    deviation: f64,
    /// No coordinate that went into these is larger: their rounding is in proportion to it.
    reach: f64,
}

/// The objects of one state of an environment, by their places in it.
#[derive(Clone, Debug, Default)]
pub struct ObjectTree {
    tree: BoxTree,
    bounds: Vec<Bounds>,
    deviation: f64,
    /// No corner of a box is farther from the tree's centre.
    radius: f64,
    /// No coordinate of an object, in the world or on its way there, is larger.
    reach: f64,
}

impl Bounds {
    #[inline(always)]
    pub fn of(body: &Body, pose: &Pose) -> Self {
        let whole = body.packed().whole();
        let origin = pose.transform_point(body.center());
        let turned = each3(|k| {
            let row = each3(|j| pose.rotation[(k, j)]);
            along64(&whole.frame, &row).0
        });
        let column = |i: usize| Vec3::new(turned[0][i], turned[1][i], turned[2][i]);
        Self {
            center: origin + column(3),
            radius: whole.ball_radius,
            box_center: origin + column(2),
            axes: [column(0), column(1)],
            half: whole.half,
            box_radius: whole.radius,
            deviation: body.deviation(),
            reach: l1_norm(body.center()) + l1_norm(&pose.translation) + body.radius(),
        }
    }

    /// A safe lower and a safe upper bound of the distance of two bodies, by their balls.
    #[inline(always)]
    pub fn distance(&self, other: &Bounds) -> [f64; 2] {
        let apart = (self.center - other.center).norm();
        let radii = self.radius + other.radius;
        let reach = self.reach.max(other.reach);
        let slack = slack(reach, self.deviation + other.deviation);
        [apart - radii - slack, apart + radii + slack]
    }

    fn oriented_box(&self) -> OrientedBox {
        let whole = Extent {
            low: -self.half,
            high: self.half,
        };
        let [x, y] = self.axes;
        let axes = Mat3::from_columns(&[x, y, x.cross(&y)]);
        let x = x.normalize();
        let y = (y - x * x.dot(&y)).normalize();
        OrientedBox {
            corners: whole.corners().map(|c| self.box_center + axes * c),
            axes: Mat3::from_columns(&[x, y, x.cross(&y)]),
        }
    }
}

#[inline(always)]
fn l1_norm(v: &Vec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

/// What a bound in the world must be lowered by so that nothing it excludes could have mattered: its rounding, and the
/// error of the distances on both sides of a comparison (see `Pairing::slack`).
#[inline(always)]
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
                .max(largest(&mut bounds.iter().map(|b| b.reach))),
            deviation: largest(&mut bounds.iter().map(|b| b.deviation)),
            tree,
            bounds,
        }
    }

    pub fn bounds(&self, place: usize) -> &Bounds {
        &self.bounds[place]
    }

    /// Visits, for each of some bodies, the objects that may be within a limit of it: by the body's name and pose, what
    /// bounds it, the object's place, and a safe lower bound of the distance; nearer parts of the tree first. `visit`
    /// returns the limit from then on.
    pub fn visit_near<'b>(
        &self,
        bodies: impl Iterator<Item = Named<'b>>,
        limit: f64,
        scratch: &mut NearScratch,
        visit: impl FnMut(&Named<'b>, &Bounds, usize, f64) -> f64,
    ) {
        if !self.bounds.is_empty() {
            with_widest(Visit {
                objects: self,
                bodies,
                limit,
                open: &mut scratch.0,
                visit,
            });
        }
    }
}

/// Memory of a descent, reused from one to the next.
#[derive(Debug, Default)]
pub struct NearScratch(Vec<(f32, u32)>);

/// A name, a body and its pose.
pub type Named<'b> = (usize, &'b Body, &'b Pose);

struct Visit<'a, B, V> {
    objects: &'a ObjectTree,
    bodies: B,
    limit: f64,
    open: &'a mut Vec<(f32, u32)>,
    visit: V,
}

impl<'b, B, V> Work for Visit<'_, B, V>
where
    B: Iterator<Item = Named<'b>>,
    V: FnMut(&Named<'b>, &Bounds, usize, f64) -> f64,
{
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        let tree = &self.objects.tree;
        for named in self.bodies {
            let (_, body, pose) = named;
            let body = Bounds::of(body, pose);
            let descent = Descent::new(self.objects, &body);
            self.open.clear();
            self.open.push((f32::NEG_INFINITY, 0));
            while let Some((bound, child)) = self.open.pop() {
                let cutoff = descent.cutoff(self.limit);
                if bound > cutoff {
                    continue;
                }
                if child & BOX != 0 {
                    let place = (child & !BOX) as usize;
                    self.limit = (self.visit)(&named, &body, place, descent.lower(bound));
                    continue;
                }
                let node = &tree.nodes[child as usize];
                let eight = node.boxes(lanes, descent.unit);
                let bounds = bounds(lanes, &eight, &descent.one, false);
                let mut near = lanes.at_most(bounds, cutoff) & ((1 << node.count) - 1);
                let bounds = lanes.array(bounds);
                let first = self.open.len();
                while near != 0 {
                    let lane = near.trailing_zeros() as usize & 7;
                    near &= near - 1;
                    let bound = bounds[lane];
                    let mut place = self.open.len();
                    self.open.push((bound, node.children[lane]));
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

/// A body as it goes down the tree. Lengths in single precision are in units of a power of two next above the size of the
/// two.
struct Descent {
    /// The body's box, from the tree's centre.
    one: PackedBox,
    /// The unit of the tree, and that of the descent.
    unit: f32,
    scale: f64,
    inverse_scale: f64,
    /// Bounds are lowered by this.
    slack: f64,
}

impl Descent {
    #[inline(always)]
    fn new(objects: &ObjectTree, body: &Bounds) -> Self {
        let tree = &objects.tree;
        let from_center = body.box_center - tree.center;
        let size = objects.radius.max(from_center.norm() + body.box_radius);
        let scale = power_of_two(size);
        let inverse_scale = 1.0 / scale;
        let reach = objects.reach.max(body.reach);
        let [x, y] = [&body.axes[0], &body.axes[1]];
        let (x, y) = (each3(|k| x[k] as f32), each3(|k| y[k] as f32));
        Self {
            one: PackedBox {
                axes: [x, y, cross3(&x, &y)],
                center: each3(|k| (from_center[k] * inverse_scale) as f32),
                half: each3(|i| ((body.half[i] * inverse_scale) as f32).next_up()),
            },
            unit: (tree.scale * inverse_scale) as f32,
            scale,
            inverse_scale,
            slack: slack(reach, objects.deviation + body.deviation) + ROUNDING * size,
        }
    }

    /// Bounds above this tell that a distance is above a limit.
    #[inline(always)]
    fn cutoff(&self, limit: f64) -> f32 {
        (((limit + self.slack) * self.inverse_scale) as f32).next_up()
    }

    /// The distance that a bound tells of, at least.
    #[inline(always)]
    fn lower(&self, bound: f32) -> f64 {
        f64::from(bound) * self.scale - self.slack
    }
}
