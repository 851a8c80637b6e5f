//! The descent to the objects that are near a body.

use super::bounds::{Bounds, slack};
use super::object_tree::ObjectTree;
use crate::body::Body;
use crate::hierarchy::{BOX, BoxNode, PackedBox, power_of_two};
use crate::lanes::{Instructions, Work, cross3, each3, with_widest};
use crate::pair::{ROUNDING, bounds};
use crate::pose::Pose;

impl ObjectTree {
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
        if self.is_empty() {
            return;
        }
        let mut open: Vec<Open> = std::mem::take(&mut scratch.0);
        with_widest(Visit {
            objects: self,
            bodies,
            limit,
            open: &mut open,
            visit,
        });
        open.clear();
        // No entry is left that could not live so long: only the memory goes back.
        scratch.0 = open.into_iter().map(|_| Open::default()).collect();
    }
}

/// Memory of a descent, reused from one to the next.
#[derive(Debug, Default)]
pub struct NearScratch(Vec<Open<'static>>);

/// A node or an object to be visited.
#[derive(Clone, Copy, Debug, Default)]
struct Open<'a> {
    bound: f32,
    /// An object by its place, if it is no node.
    place: u32,
    node: Option<&'a BoxNode>,
}

/// A name, a body and its pose.
pub type Named<'b> = (usize, &'b Body, &'b Pose);

struct Visit<'a, 'o, B, V> {
    objects: &'o ObjectTree,
    bodies: B,
    limit: f64,
    open: &'a mut Vec<Open<'o>>,
    visit: V,
}

impl<'b, B, V> Work for Visit<'_, '_, B, V>
where
    B: Iterator<Item = Named<'b>>,
    V: FnMut(&Named<'b>, &Bounds, usize, f64) -> f64,
{
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        let root = self.objects.tree.root();
        for named in self.bodies {
            let (_, body, pose) = named;
            let body = Bounds::of(body, pose);
            let descent = Descent::new(self.objects, &body);
            let first = |node, place| Open {
                bound: f32::NEG_INFINITY,
                place,
                node,
            };
            self.open.clear();
            // Those that are not in the tree come last.
            let strays = self.objects.strays.iter();
            self.open.extend(strays.map(|&place| first(None, place)));
            self.open.extend(root.map(|root| first(Some(root), 0)));
            while let Some(Open { bound, place, node }) = self.open.pop() {
                let cutoff = descent.cutoff(self.limit);
                if bound > cutoff {
                    continue;
                }
                let Some(node) = node else {
                    let at_least = descent.lower(bound);
                    self.limit = (self.visit)(&named, &body, place as usize, at_least);
                    continue;
                };
                let wide = &node.wide;
                let eight = wide.boxes(lanes, descent.unit);
                let bounds = bounds(lanes, &eight, &descent.one, false);
                let mut near = lanes.at_most(bounds, cutoff) & ((1 << wide.count) - 1);
                let bounds = lanes.array(bounds);
                let first = self.open.len();
                while near != 0 {
                    let lane = near.trailing_zeros() as usize & 7;
                    near &= near - 1;
                    let bound = bounds[lane];
                    let mut at = self.open.len();
                    self.open.push(Open {
                        bound,
                        place: wide.children[lane] & !BOX,
                        node: node.below[lane].as_deref(),
                    });
                    // The nearest goes on top.
                    while at > first && self.open[at - 1].bound < bound {
                        self.open.swap(at - 1, at);
                        at -= 1;
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
        let frame = objects.tree.frame();
        let from_center = body.box_center - frame.center;
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
            unit: (frame.scale * inverse_scale) as f32,
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
