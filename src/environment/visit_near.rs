//! The traversal to the objects near a body.

use super::object_tree::ObjectTree;
use crate::body_bounds::{BoundsByEight, BoxFrame, ChosenBodies, FrameLimits};
use crate::boxes::{BoxesByEight, EightBoxes, PackedBox, WideNode};
use crate::environment::box_tree::BOX;
use crate::index_set::{IndexSet, bits};
use crate::lanes::{Instructions, Work, with_widest};
use crate::pair::bounds;
use crate::pose::Vec3;

impl ObjectTree {
    /// Visits, for each of some bodies, by their numbers, the objects that may be within `limit` of it, near subtrees first. `visit`
    /// gets the body's number, the object's place and a safe lower bound of the distance; it returns the limit from then on.
    pub fn visit_near(
        &self,
        bounds: &BoundsByEight,
        bodies: &IndexSet,
        limit: f64,
        scratch: &mut NearScratch,
        visit: impl FnMut(usize, usize, f64) -> f64,
    ) {
        if self.is_empty() {
            return;
        }
        with_widest(Visit {
            objects: self,
            bounds,
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
    /// The bodies' boxes.
    boxes: BoxesByEight,
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

struct Visit<'a, V> {
    objects: &'a ObjectTree,
    bounds: &'a BoundsByEight,
    bodies: &'a IndexSet,
    limit: f64,
    open: &'a mut Vec<QueueEntry>,
    boxes: &'a mut BoxesByEight,
    visit: V,
}

impl<V: FnMut(usize, usize, f64) -> f64> Work for Visit<'_, V> {
    type Output = ();

    #[inline(always)]
    fn run<I: Instructions>(mut self, lanes: I) {
        for (word, &all) in self.bodies.words().iter().enumerate() {
            if all != 0 {
                self.descend(lanes, word, all);
            }
        }
    }
}

impl<V: FnMut(usize, usize, f64) -> f64> Visit<'_, V> {
    /// Visits the objects near the bodies of a word's bits.
    #[inline(always)]
    fn descend<I: Instructions>(&mut self, lanes: I, word: usize, all: u64) {
        let descent = Descent::new(lanes, self, word, all);
        let objects = self.objects;
        self.open_root_and_strays(all);
        while let Some(next) = self.open.pop() {
            if next.name & BOX != 0 {
                let place = (next.name & !BOX) as usize;
                for body in bits(all) {
                    let lower = f64::NEG_INFINITY;
                    self.limit = (self.visit)(descent.first + body, place, lower);
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
            let near = self.test_bodies(lanes, wide, &eight, &descent, next.bodies);
            self.open_children(wide, &near);
        }
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
            let bounds = bounds(lanes, eight, &self.boxes.get(at));
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
                    self.limit = (self.visit)(descent.first + at, place, lower);
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
    /// The number of the body of the lowest bit.
    first: usize,
    frame: BoxFrame,
    /// A box around all bodies, where there are several and the tree has several nodes.
    around: Option<PackedBox>,
    /// The unit of the tree in units of the frame.
    unit: f32,
}

impl Descent {
    /// Packs the boxes of the bodies of a word's bits.
    #[inline(always)]
    fn new<I: Instructions, V>(lanes: I, visit: &mut Visit<V>, word: usize, all: u64) -> Self {
        let (objects, first) = (visit.objects, 64 * word);
        let tree = objects.tree.frame();
        let chosen = ChosenBodies {
            first: word,
            words: &[all],
        };
        let limits = visit.bounds.limits(lanes, chosen, &tree.center);
        let limits = FrameLimits {
            size: limits.size.max(objects.radius),
            largest_coordinate: limits.largest_coordinate.max(objects.largest_coordinate),
            ..limits
        };
        let deviation = objects.deviation + limits.deviation;
        let frame = BoxFrame::new(tree.center, &limits, deviation);
        visit.bounds.pack(lanes, chosen, &frame, visit.boxes);
        let around = (!all.is_power_of_two() && objects.has_several_nodes()).then(|| {
            let extents = bits(all).map(|body| visit.bounds.get(first + body).extent());
            let whole = extents.reduce(|all, one| all.union(&one));
            let whole = whole.expect("there are bodies");
            frame.pack_box(
                &[Vec3::x(), Vec3::y()],
                &(whole.center() - tree.center),
                &(0.5 * (whole.high - whole.low)),
            )
        });
        Self {
            first,
            around,
            unit: (tree.scale * frame.inverse_scale) as f32,
            frame,
        }
    }
}
