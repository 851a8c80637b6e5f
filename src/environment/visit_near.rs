//! The traversal to the objects near a body.

use super::object_tree::ObjectTree;
use crate::body::Body;
use crate::body_bounds::{Bounds, BoxFrame, FrameLimits};
use crate::boxes::{EightBoxes, PackedBox, WideNode};
use crate::environment::box_tree::BOX;
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::bounds;
use crate::pose::{Pose, Vec3};
use crate::reused::emptied;

impl ObjectTree {
    /// Visits, for each of some bodies, the objects that may be within `limit` of it, near subtrees first. `visit` gets the
    /// body, the object's place and a safe lower bound of the distance; it returns the limit from then on.
    pub fn visit_near<'b>(
        &self,
        bodies: &[Named<'b>],
        limit: f64,
        scratch: &mut NearScratch,
        visit: impl FnMut(&Named<'b>, usize, f64) -> f64,
    ) {
        if self.is_empty() {
            return;
        }
        with_widest(Visit {
            objects: self,
            bodies,
            limit,
            open: &mut scratch.open,
            boxes: &mut scratch.boxes,
            visit,
        });
    }
}

/// Memory of a traversal, reused from one to the next.
#[derive(Debug, Default)]
pub struct NearScratch {
    open: Vec<QueueEntry>,
    boxes: Vec<PackedBox>,
    /// For the bodies of the next traversal.
    bodies: Vec<Named<'static>>,
}

impl NearScratch {
    /// An empty list for the bodies of a traversal.
    pub fn take_bodies<'b>(&mut self) -> Vec<Named<'b>> {
        emptied(std::mem::take(&mut self.bodies))
    }

    /// Takes the list's memory back.
    pub fn keep_bodies(&mut self, bodies: Vec<Named>) {
        self.bodies = emptied(bodies);
    }
}

/// A node or an object to be visited.
#[derive(Clone, Copy, Debug)]
struct QueueEntry {
    bound: f32,
    /// The index of a node, or [`BOX`] + the place of a stray.
    name: u32,
    /// The bodies to test, one bit each.
    bodies: u64,
}

/// A body by a number, at its pose, with its bounds there.
#[derive(Clone, Copy, Debug)]
pub struct Named<'b> {
    /// What the caller calls the body.
    pub number: usize,
    /// The body.
    pub body: &'b Body,
    /// Where it is.
    pub pose: &'b Pose,
    /// Its bounds there.
    pub bounds: &'b Bounds,
}

/// Number of bodies that traverse the tree together, one per bit of a mask.
const BATCH: usize = u64::BITS as usize;

struct Visit<'a, 'b, V> {
    objects: &'a ObjectTree,
    bodies: &'a [Named<'b>],
    limit: f64,
    open: &'a mut Vec<QueueEntry>,
    boxes: &'a mut Vec<PackedBox>,
    visit: V,
}

impl<'b, V> Work for Visit<'_, 'b, V>
where
    V: FnMut(&Named<'b>, usize, f64) -> f64,
{
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        for batch in self.bodies.chunks(BATCH) {
            self.descend(lanes, batch);
        }
    }
}

impl<'b, V> Visit<'_, 'b, V>
where
    V: FnMut(&Named<'b>, usize, f64) -> f64,
{
    /// Visits the objects near a batch of bodies.
    #[inline(always)]
    fn descend<I: Instructions>(&mut self, lanes: I, bodies: &[Named<'b>]) {
        let descent = Descent::new(self.objects, bodies, std::mem::take(self.boxes));
        let objects = self.objects;
        let all = u64::MAX >> (BATCH - bodies.len());
        self.open_root_and_strays(all);
        while let Some(next) = self.open.pop() {
            if next.name & BOX != 0 {
                let place = (next.name & !BOX) as usize;
                for named in bodies {
                    let lower = f64::NEG_INFINITY;
                    self.limit = (self.visit)(named, place, lower);
                }
                continue;
            }
            let cutoff = descent.frame.cutoff(self.limit);
            if next.bound > cutoff {
                continue;
            }
            let wide = &objects.tree.node(next.name).wide;
            let eight = wide.boxes(lanes, descent.unit);
            if next.bodies == all
                && let Some(around) = &descent.around
            {
                // Far from the bodies, one test of the box around all of them often prunes the node or leaves one child.
                match near_all(lanes, wide, &eight, around, cutoff) {
                    NearAll::None => continue,
                    NearAll::Node { bound, name } => {
                        self.open.push(QueueEntry {
                            bound,
                            name,
                            ..next
                        });
                        continue;
                    }
                    NearAll::Several => {}
                }
            }
            let near = self.test_bodies(lanes, wide, &eight, &descent, bodies, next.bodies);
            self.open_children(wide, &near);
        }
        *self.boxes = descent.bodies;
    }

    /// Puts the root and the strays on the stack, for all bodies.
    #[inline(always)]
    fn open_root_and_strays(&mut self, all: u64) {
        let first = |name| QueueEntry {
            bound: f32::NEG_INFINITY,
            name,
            bodies: all,
        };
        self.open.clear();
        // Strays go on top and are visited first: their distances may lower the limit for the tree.
        let root = self.objects.tree.root();
        self.open.extend(root.map(first));
        let strays = self.objects.strays.iter();
        self.open.extend(strays.map(|&place| first(place | BOX)));
    }

    /// Tests the bodies of a mask against a node's children. Visits the objects among the children that are near a body, and
    /// returns the bodies that are near the nodes among them.
    #[inline(always)]
    fn test_bodies<I: Instructions>(
        &mut self,
        lanes: I,
        wide: &WideNode,
        eight: &EightBoxes<I>,
        descent: &Descent,
        bodies: &[Named<'b>],
        mask: u64,
    ) -> NearNodes {
        let mut cutoff = descent.frame.cutoff(self.limit);
        let children = (1 << wide.count) - 1;
        let mut found = NearNodes {
            lanes: 0,
            nearest: [f32::INFINITY; 8],
            bodies: [0; 8],
        };
        let mut rest = mask;
        while rest != 0 {
            let at = rest.trailing_zeros() as usize;
            let bit = rest & rest.wrapping_neg();
            rest ^= bit;
            let bounds = bounds(lanes, eight, &descent.bodies[at]);
            let mut near = lanes.at_most(bounds, cutoff) & children;
            let bounds = lanes.array(bounds);
            while near != 0 {
                let lane = near.trailing_zeros() as usize & 7;
                near &= near - 1;
                let child = wide.children[lane];
                if child & BOX == 0 {
                    found.lanes |= 1 << lane;
                    found.bodies[lane] |= bit;
                    found.nearest[lane] = found.nearest[lane].min(bounds[lane]);
                } else if bounds[lane] <= cutoff {
                    let place = (child & !BOX) as usize;
                    let lower = descent.frame.lower(bounds[lane]);
                    self.limit = (self.visit)(&bodies[at], place, lower);
                    cutoff = descent.frame.cutoff(self.limit);
                }
            }
        }
        found
    }

    /// Puts the child nodes that are near a body on the stack, the nearest on top.
    #[inline(always)]
    fn open_children(&mut self, wide: &WideNode, near: &NearNodes) {
        let first = self.open.len();
        let mut rest = near.lanes;
        while rest != 0 {
            let lane = rest.trailing_zeros() as usize & 7;
            rest &= rest - 1;
            let bound = near.nearest[lane];
            let mut at = self.open.len();
            self.open.push(QueueEntry {
                bound,
                name: wide.children[lane],
                bodies: near.bodies[lane],
            });
            while at > first && self.open[at - 1].bound < bound {
                self.open.swap(at - 1, at);
                at -= 1;
            }
        }
    }
}

/// The bodies near each child node of a node, one bit each, and the least of their bounds.
struct NearNodes {
    /// The children that a body is near, one bit each.
    lanes: u32,
    nearest: [f32; 8],
    bodies: [u64; 8],
}

/// The children of a node that are near the box around all bodies.
enum NearAll {
    None,
    /// One child, which is a node.
    Node {
        bound: f32,
        name: u32,
    },
    /// One object, or several children.
    Several,
}

#[inline(always)]
fn near_all<I: Instructions>(
    lanes: I,
    wide: &WideNode,
    eight: &EightBoxes<I>,
    around: &PackedBox,
    cutoff: f32,
) -> NearAll {
    let bounds = bounds(lanes, eight, around);
    let near = lanes.at_most(bounds, cutoff) & ((1 << wide.count) - 1);
    if near == 0 {
        return NearAll::None;
    }
    let lane = near.trailing_zeros() as usize & 7;
    let name = wide.children[lane];
    if near.is_power_of_two() && name & BOX == 0 {
        let bound = lanes.array(bounds)[lane];
        return NearAll::Node { bound, name };
    }
    NearAll::Several
}

/// The bodies of one traversal.
struct Descent {
    frame: BoxFrame,
    /// The bodies' boxes.
    bodies: Vec<PackedBox>,
    /// A box around all of them, where there are several and the tree has several nodes.
    around: Option<PackedBox>,
    /// The unit of the tree in units of the frame.
    unit: f32,
}

impl Descent {
    #[inline(always)]
    fn new(objects: &ObjectTree, bodies: &[Named], mut boxes: Vec<PackedBox>) -> Self {
        let tree = objects.tree.frame();
        let mut limits = FrameLimits {
            size: objects.radius,
            largest_coordinate: objects.largest_coordinate,
            deviation: 0.0,
        };
        for named in bodies {
            limits.take_in(&tree.center, named.bounds);
        }
        let deviation = objects.deviation + limits.deviation;
        let frame = BoxFrame::new(tree.center, &limits, deviation);
        boxes.clear();
        for named in bodies {
            boxes.push(frame.pack(named.bounds));
        }
        let around = (bodies.len() > 1 && objects.has_several_nodes()).then(|| {
            let extents = bodies.iter().map(|named| named.bounds.extent());
            let whole = extents.reduce(|all, one| all.union(&one));
            let whole = whole.expect("there are bodies");
            frame.pack_box(
                &[Vec3::x(), Vec3::y()],
                &(whole.center() - tree.center),
                &(0.5 * (whole.high - whole.low)),
            )
        });
        Self {
            bodies: boxes,
            around,
            unit: (tree.scale * frame.inverse_scale) as f32,
            frame,
        }
    }
}
