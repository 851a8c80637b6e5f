//! A body that moves among objects that rest: the boxes around them are looked at eight at a time before any pair is.

use std::collections::HashMap;
use std::ptr;

use foldhash::fast::RandomState;

use super::moving_pair::MovingPair;
use super::over_piece::TwistLists;
use super::piece::Piece;
use crate::body::Body;
use crate::boxes::{BoxesByEight, PackedBox};
use crate::convex::Extension;
use crate::hierarchy::packed::power_of_two_above;
use crate::lanes::each3;
use crate::pair::{ROUNDING, SingleUnits, Twist32, sum_factor};
use crate::pose::{Pose, Vec3, turned};
use crate::tolerance;

/// The pairs of one body that moves with objects that rest in the world.
pub(super) struct Crowd {
    /// The numbers of the pairs are consecutive.
    pub first_pair: u32,
    /// The pair whose object's frame is farthest from the origin of the world: it loses most by rounding.
    farthest_pair: u32,
    boxes: BoxesByEight,
    /// Boxes are given relative to this point of the world: single precision is for nearby places.
    origin: Vec3,
    /// They are given in units of 1 over this, so that their squares neither underflow nor overflow.
    inverse: f64,
    /// No point of an object is farther from the origin.
    size: f64,
    /// The largest deviation of an object from its primitives.
    deviation: f64,
}

/// In units of the first object the others are no larger than this, or they are put in anew. Squares are far from overflow here.
const MAX_SIZE: f64 = 1e6;

/// The body over a piece.
pub(super) struct CrowdOver<L: TwistLists> {
    pub one: PackedBox,
    pub twists: L::Of<Twist32>,
    pub extension: Extension,
    /// What acceleration may take off, along axes that rest with the objects and along those of the body.
    pub bends: [f32; 2],
    /// Boxes with a larger gap do not meet.
    pub cutoff: f32,
}

impl Crowd {
    /// Of pairs whose numbers begin at `first_pair`; all have the same body A, and Bs that rest.
    pub fn new(
        first_pair: u32,
        pairs: &[MovingPair],
        origin: Vec3,
        memory: &mut CrowdMemory,
    ) -> Self {
        let mut boxes = memory.boxes.pop().unwrap_or_default();
        boxes.clear();
        let mut crowd = Self {
            first_pair,
            farthest_pair: first_pair,
            boxes,
            origin,
            inverse: 1.0,
            size: 0.0,
            deviation: 0.0,
        };
        crowd.fill(&pairs[..pairs.len().min(1)], &mut memory.at_rest, 1.0);
        crowd.fill(pairs, &mut memory.at_rest, crowd.size);
        if crowd.size * crowd.inverse > MAX_SIZE {
            crowd.fill(pairs, &mut memory.at_rest, crowd.size);
        }
        crowd
    }

    /// Puts the boxes in, in units of about `unit`.
    fn fill(&mut self, pairs: &[MovingPair], at_rest: &mut BodiesAtRest, unit: f64) {
        self.boxes.clear();
        self.inverse = 1.0 / power_of_two_above(unit);
        let mut farthest = 0.0;
        for (number, pair) in (self.first_pair..).zip(pairs) {
            let [_, b] = pair.bodies();
            let away = pair.pose_of_b().translation.norm();
            if away > farthest {
                (farthest, self.farthest_pair) = (away, number);
            }
            let at_rest = at_rest.of(b, pair.pose_of_b());
            let center = at_rest.center - self.origin;
            self.size = self.size.max(center.norm() + b.radius());
            self.deviation = self.deviation.max(b.deviation());
            let seen = at_rest.root.seen_from(&self.origin, self.inverse);
            self.boxes.push(&seen);
        }
    }

    /// The memory of the boxes, for another crowd.
    pub fn into_boxes(self) -> BoxesByEight {
        self.boxes
    }

    /// The boxes around the objects.
    pub fn boxes(&self) -> &BoxesByEight {
        &self.boxes
    }

    /// The body over a piece, in the crowd's units, given all pairs.
    pub fn over<P: Piece>(&self, pairs: &[MovingPair], piece: &mut P) -> CrowdOver<P::Lists> {
        let pair = &pairs[self.farthest_pair as usize];
        let moved = piece.moved(pair);
        let [a, _] = pair.bodies();
        let [pose, _] = &moved.poses;
        let center = pose.transform_point(a.center()) - self.origin;
        // What all boxes are near to, and how far their points are taken to move.
        let size = self.size.max(center.norm() + a.radius());
        let mut shift = 0.0;
        for by in moved.displacements.as_ref() {
            shift += by.linear.norm() + by.angular.norm() * (size + center.norm());
        }
        shift *= sum_factor(moved.displacements.as_ref().len());
        let error = tolerance::DISTANCE_ERROR * 2.0 * size + a.deviation() + self.deviation;
        let slack = tolerance::BOUND_ERROR * 2.0 * size + 2.0 * error + moved.kinematics_error;
        let lowered = slack * (1.0 + shift / size) + ROUNDING * (size + shift);
        let units = SingleUnits {
            inverse: self.inverse,
        };
        let [with_a, with_b] = units.bends(moved.bends);
        CrowdOver {
            one: RootBox::new(a, pose).seen_from(&self.origin, self.inverse),
            twists: P::Lists::map(&moved.displacements, |by| {
                let at_origin = by.linear - by.angular.cross(&center);
                units.twist(&at_origin, &by.angular)
            }),
            extension: moved.extension,
            bends: [with_b, with_a],
            cutoff: units.above(pair.threshold + lowered),
        }
    }
}

/// The box around a body at a pose.
#[derive(Clone, Copy)]
struct RootBox {
    axes: [[f32; 3]; 3],
    half: Vec3,
    /// In the world.
    center: Vec3,
}

impl RootBox {
    fn new(body: &Body, pose: &Pose) -> Self {
        let tree = body.packed();
        let at_home = tree.bounding_box(tree.root());
        let vector = |v: &[f32; 3]| Vec3::from(v.map(f64::from));
        let center = body.center() + vector(&at_home.center) * tree.scale();
        Self {
            axes: each3(|k| {
                let axis = turned(&pose.rotation, &vector(&at_home.axes[k]));
                each3(|i| axis[i] as f32)
            }),
            half: vector(&at_home.half) * tree.scale(),
            center: pose.transform_point(&center),
        }
    }

    /// Relative to an origin, in units of 1 over `inverse`.
    fn seen_from(&self, origin: &Vec3, inverse: f64) -> PackedBox {
        let center = (self.center - origin) * inverse;
        PackedBox {
            axes: self.axes,
            center: each3(|k| center[k] as f32),
            half: each3(|k| ((self.half[k] * inverse) as f32).next_up()),
        }
    }
}

/// A body that rests, in the world.
#[derive(Clone, Copy)]
struct AtRest {
    center: Vec3,
    root: RootBox,
}

/// The bodies that rest in one scene, computed once for all that move among them. By the addresses of their poses.
#[derive(Default)]
pub(super) struct BodiesAtRest(HashMap<usize, AtRest, RandomState>);

impl BodiesAtRest {
    /// Begins another scene.
    pub fn start(&mut self) {
        self.0.clear();
    }

    fn of(&mut self, body: &Body, pose: &Pose) -> &AtRest {
        self.0
            .entry(ptr::from_ref(pose).addr())
            .or_insert_with(|| AtRest {
                center: pose.transform_point(body.center()),
                root: RootBox::new(body, pose),
            })
    }
}

/// Memory of crowds, used again by the next proof.
#[derive(Default)]
pub(super) struct CrowdMemory {
    pub boxes: Vec<BoxesByEight>,
    pub at_rest: BodiesAtRest,
}
