//! Best-first search for the shortest translation that parts two bodies.
//!
//! A node is an intersection of half-spaces; its bound is the length of the shortest translation in it. The node with the least
//! bound is taken. If the bodies are apart at its shortest translation, that is a way out. Otherwise a convex set of
//! translations at which they meet holds it: whatever parts the bodies in this node is beyond one of the set's faces, each of
//! which makes a child. The nodes that wait cover all ways out, so that the least of their bounds is a lower bound of the
//! depth; for polytopes the search ends with the depth itself.

use std::collections::{BinaryHeap, HashMap};

use foldhash::fast::RandomState;

use super::answer::{Depth, DepthOptions, ExplainedDepth};
use super::covers::{CoverParts, Covers, has_several_ways};
use super::difference::Difference;
use super::inner_balls::widened;
use super::least::least;
use super::meeting::{is_parted, meeting_at};
use super::node::{Face, Node};
use super::touching::{Touching, WayOut, straightened, touching_at};
use crate::convex::HalfSpace;
use crate::pair::{Pairing, Scratch};
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// The state of a search.
pub struct DepthSearch<'a, 's> {
    /// A's centred frame is the frame of all translations.
    pairing: Pairing<'a>,
    scratch: &'s mut Scratch,
    tolerance: f64,
    max_steps: u64,
    /// Goes on between polytopes until other ways out of the same length are found or excluded: they tell whether the depth has a
    /// derivative.
    seeks_rivals: bool,
    /// Bodies farther apart than this are proved apart, with room for rounding.
    clearance: f64,
    /// How far half-spaces are moved outwards, so that rounding excludes nothing.
    error: f64,
    rounding: f64,
    covers: Covers,
    nodes: BinaryHeap<Node>,
    /// The half-spaces of the nodes made, with the least bound of each. A node that is left out relies on the node of the same
    /// half-spaces, and that one on its children: none of these may come back to the same half-spaces. Children have longer
    /// shortest translations, or, where these stay the same, more half-spaces and narrower cones.
    seen: HashMap<Vec<(u32, u32)>, f64, RandomState>,
    upper: f64,
    way: Vec3,
    /// The least bound of the nodes that are done with.
    floor: f64,
    has_rival: bool,
    steps: u64,
}

/// Nodes waiting, at most: beyond that the search ends with the bounds that it has.
const MAX_NODES: usize = 1 << 17;

/// Halvings of a way out.
const MAX_HALVINGS: usize = 24;

/// Corrections of the way out by what touches after it.
const MAX_CORRECTIONS: usize = 12;

/// Ways out farther apart than this, times their length, are different ones.
const OTHER_WAY: f64 = 1e-2;

impl<'a, 's> DepthSearch<'a, 's> {
    /// A search for the depth of the bodies of a pairing, which meet.
    pub fn new(pairing: &Pairing<'a>, options: &DepthOptions, scratch: &'s mut Scratch) -> Self {
        let (a, b) = (pairing.a.radius(), pairing.b.radius());
        let farthest = a + b + pairing.relative.translation.norm();
        let mut pairing = pairing.shifted(&Vec3::zeros());
        pairing.precision = widened(&pairing.precision, 2.0 * farthest);
        let precision = pairing.precision;
        let tolerance = match options.tolerance {
            0.0 => DepthOptions::RELATIVE * precision.size,
            given => given,
        };
        Self {
            pairing,
            scratch,
            tolerance,
            max_steps: options.max_steps,
            seeks_rivals: false,
            clearance: 4.0 * precision.error,
            error: 2.0 * precision.error,
            rounding: 8.0 * EPSILON * precision.size,
            covers: Covers::default(),
            nodes: BinaryHeap::new(),
            seen: HashMap::default(),
            upper: f64::INFINITY,
            way: Vec3::zeros(),
            floor: f64::INFINITY,
            has_rival: false,
            steps: 0,
        }
    }

    /// Bounds of the depth. Meaningless if the meter's limit is exceeded.
    pub fn bounds(mut self) -> Depth {
        self.find_bounds()
    }

    /// The same, with what the depth is owed to.
    pub fn explained(mut self) -> ExplainedDepth {
        self.seeks_rivals = true;
        let depth = self.find_bounds();
        let is_open = |node: &Node| {
            node.bound <= self.upper + self.clearance && self.is_elsewhere(&node.point)
        };
        let has_rival = self.has_rival || self.nodes.iter().any(is_open);
        let (out, first) = self.what_touches();
        ExplainedDepth {
            depth,
            out,
            first,
            has_rival,
        }
    }

    fn find_bounds(&mut self) -> Depth {
        let least_depth = self.begin();
        if self.upper - least_depth > self.tolerance {
            self.search(least_depth);
        }
        let lower = match self.nodes.peek() {
            Some(node) => node.bound.min(self.floor),
            None => self.floor,
        };
        let lower = lower.max(least_depth).min(self.upper);
        Depth {
            lower,
            is_tight: self.upper - lower <= self.tolerance.max(4.0 * self.clearance),
            upper: self.upper,
            way: self.way,
            steps: self.steps,
        }
    }

    /// Takes the depths of single primitive pairs, whose largest is a lower bound, and finds a first way out.
    fn begin(&mut self) -> f64 {
        let meeting = meeting_at(&self.pairing, &Vec3::zeros(), self.scratch);
        let mut least_depth: f64 = 0.0;
        let mut deepest = None;
        for &places in meeting.places.iter().chain(&meeting.flat) {
            if self.scratch.meter().is_exceeded() {
                break;
            }
            let meter = self.scratch.meter_mut();
            let Ok(found) = self.pairing.world_penetration(places, meter) else {
                continue;
            };
            let depth = found.depth - self.error;
            if depth > least_depth {
                least_depth = depth;
                deepest = Some(places);
            }
            self.offer(found.direction * (found.depth + self.clearance));
        }
        self.first_ways();
        if self.upper - least_depth <= self.tolerance {
            self.floor = least_depth;
            self.has_rival =
                self.seeks_rivals && deepest.is_none_or(|places| self.has_equal_depths(places));
        }
        least_depth
    }

    /// Whether the primitives at two places have shortest ways out in several directions.
    fn has_equal_depths(&mut self, places: [u32; 2]) -> bool {
        let cores = self
            .pairing
            .closest_at(places, self.scratch.for_primitives());
        if cores.is_some_and(|found| found.cores.distance > self.pairing.precision.error) {
            return false;
        }
        let (pairing, scratch) = (&self.pairing, &mut *self.scratch);
        has_several_ways(places, self.clearance, OTHER_WAY, pairing, scratch)
    }

    /// Tries the axes, the line of the centres, and the ways out of what is nearest, unless a way out is known that is no longer.
    fn first_ways(&mut self) {
        if self.upper < f64::INFINITY {
            return;
        }
        let dimension = if self.pairing.precision.planar { 2 } else { 3 };
        let axes = (0..2 * dimension).map(|i| {
            let mut axis = Vec3::zeros();
            axis[i / 2] = if i % 2 == 0 { 1.0 } else { -1.0 };
            axis
        });
        let between = (-self.pairing.relative.translation).try_normalize(0.0);
        for direction in axes.chain(between) {
            if self.scratch.meter().is_exceeded() {
                return;
            }
            self.descend(&direction, 0.0);
        }
    }

    /// Keeps a way out if it is the shortest so far. Nothing is asked once the meter's limit is exceeded.
    fn offer(&mut self, way: Vec3) -> bool {
        let length = way.norm();
        let is_wanted = length < self.upper && !self.scratch.meter().is_exceeded();
        if is_wanted && is_parted(&self.pairing, &way, self.scratch) {
            (self.upper, self.way) = (length, way);
            return true;
        }
        false
    }

    /// Shortens a way out along a unit direction, from what parts the bodies down to `low`, where they meet.
    fn descend(&mut self, direction: &Vec3, low: f64) {
        let mut high = if self.upper < f64::INFINITY {
            self.upper - 0.5 * self.tolerance
        } else {
            let b = self.pairing.relative.rotation.tr_mul(direction);
            let far = self
                .pairing
                .relative
                .transform_point(&self.pairing.b.farthest(&b).point);
            let near = self.pairing.a.farthest(&-direction).point;
            direction.dot(&(far - near)) + 2.0 * self.clearance
        };
        if high <= low || !self.offer(direction * high) {
            return;
        }
        let mut low = low;
        for _ in 0..MAX_HALVINGS {
            if high - low <= 0.25 * self.tolerance || self.scratch.meter().is_exceeded() {
                return;
            }
            let middle = 0.5 * (low + high);
            match self.offer(direction * middle) {
                true => high = middle,
                false => low = middle,
            }
        }
    }

    fn search(&mut self, least_depth: f64) {
        self.nodes.push(Node {
            bound: 0.0,
            least: 0.0,
            point: Vec3::zeros(),
            faces: Vec::new(),
        });
        while let Some(node) = self.nodes.peek() {
            let is_close = self.upper - node.bound.max(least_depth) <= self.tolerance;
            let is_enough = is_close && (!self.seeks_rivals || self.covers.has_round());
            let is_done = is_enough || node.bound > self.upper + self.clearance;
            let is_full = self.steps >= self.max_steps || self.nodes.len() > MAX_NODES;
            if is_done || is_full || self.scratch.meter().is_exceeded() {
                break;
            }
            let node = self.nodes.pop().expect("it was there");
            self.steps += 1;
            self.take(&node);
        }
        self.correct();
    }

    /// Takes a node: offers a way out, or makes its children.
    fn take(&mut self, node: &Node) {
        let spaces: Vec<HalfSpace> = node.faces.iter().map(|face| face.space).collect();
        let clear = least(&spaces, self.error + self.clearance, self.rounding);
        let point = if clear.is_inside {
            clear.point
        } else {
            node.point
        };
        let meeting = meeting_at(&self.pairing, &point, self.scratch);
        if self.scratch.meter().is_exceeded() {
            self.floor = self.floor.min(node.bound);
            return;
        }
        if !meeting.meets {
            self.floor = self.floor.min(node.bound);
            self.take_way(point);
            return;
        }
        let enough = 0.25 * (self.upper - node.bound);
        let (pairing, scratch) = (&self.pairing, &mut *self.scratch);
        let cover = self
            .covers
            .around(node, &point, &meeting, enough, pairing, scratch);
        match cover.and_then(|cover| self.covers.parts(node, &cover, pairing, scratch)) {
            Some(parts) => self.branch(node, &parts),
            None => self.floor = self.floor.min(node.bound),
        }
        let is_turn = self.steps < 16 || self.steps.is_multiple_of(8);
        if let Some(direction) = point.try_normalize(0.0).filter(|_| is_turn) {
            self.descend(&direction, point.norm());
        }
    }

    /// Notes a way out at the end of a node.
    fn take_way(&mut self, way: Vec3) {
        let length = way.norm();
        let (old, upper) = (self.way, self.upper);
        if length < self.upper {
            (self.upper, self.way) = (length, way);
        }
        let is_equal = (length - upper).abs() <= self.clearance;
        self.has_rival = match is_equal {
            true => self.has_rival || self.is_elsewhere(&old) || self.is_elsewhere(&way),
            false => self.has_rival && length > upper,
        };
    }

    /// Whether a translation is not near the way out.
    fn is_elsewhere(&self, point: &Vec3) -> bool {
        (point - self.way).norm() > OTHER_WAY * self.upper
    }

    /// Makes the children of a node: beyond each part of a difference.
    fn branch(&mut self, node: &Node, children: &CoverParts) {
        let CoverParts {
            difference,
            old,
            ref parts,
        } = *children;
        for &part in parts {
            let spaces = match self.covers.get(difference) {
                Difference::Polytope(spaces) => {
                    let HalfSpace { normal, offset } = spaces[part as usize];
                    vec![HalfSpace {
                        normal,
                        offset: offset - self.error,
                    }]
                }
                Difference::Round(round) => round.half_spaces(part, self.error),
            };
            // Too long a way by this half-space alone.
            if spaces.len() == 1 && spaces[0].offset > self.upper + self.clearance {
                continue;
            }
            let is_kept = |face: &&Face| old.is_none() || face.difference != difference;
            let mut faces: Vec<Face> = node.faces.iter().filter(is_kept).copied().collect();
            faces.extend(spaces.into_iter().map(|space| Face {
                space,
                difference,
                part,
            }));
            let spaces: Vec<HalfSpace> = faces.iter().map(|face| face.space).collect();
            let found = least(&spaces, 0.0, self.rounding);
            let bound = found.bound.max(node.bound);
            if bound > self.upper + self.clearance {
                continue;
            }
            // Only then is what a node leaves to its children nearer to the end than it was: see `seen`.
            if found.is_inside && found.bound > node.least + self.error {
                self.keep_active(&mut faces, &found.point);
            }
            let mut key: Vec<(u32, u32)> = faces
                .iter()
                .map(|face| (face.difference, face.part))
                .collect();
            key.sort_unstable();
            key.dedup();
            // A node of the same half-spaces covers this one only if its bound claims no more.
            let known = self.seen.entry(key).or_insert(f64::INFINITY);
            if bound < *known {
                *known = bound;
                self.nodes.push(Node {
                    bound,
                    least: found.bound,
                    point: found.point,
                    faces,
                });
            }
        }
    }

    /// Leaves out the half-spaces that do not hold the point of a node back: the others have the same shortest translation. Nodes
    /// that were reached on several ways are then equal. What was left out may be taken again further on.
    fn keep_active(&self, faces: &mut Vec<Face>, point: &Vec3) {
        let slack = 4.0 * (self.clearance + self.error);
        let is_active = |face: &Face| face.space.normal.dot(point) - face.space.offset <= slack;
        let active: Vec<(u32, u32)> = faces
            .iter()
            .filter(|face| is_active(face))
            .map(|face| (face.difference, face.part))
            .collect();
        // A cone stays whole.
        faces.retain(|face| active.contains(&(face.difference, face.part)));
    }

    /// Shortens the way out by what touches after it, as long as that helps.
    fn correct(&mut self) {
        let mut cutoff = 1e-3 * self.upper + 2.0 * self.tolerance;
        for _ in 0..MAX_CORRECTIONS {
            if self.scratch.meter().is_exceeded() || self.upper == f64::INFINITY {
                return;
            }
            let (touching, _) = touching_at(&self.pairing, &self.way, cutoff, self.scratch);
            let next = straightened(&touching, &self.way, 1.5 * self.clearance, self.rounding);
            let moved = (next - self.way).norm();
            let before = self.upper;
            if !(self.offer(next) || self.offer(0.5 * (next + self.way)))
                || before - self.upper <= self.rounding
            {
                return;
            }
            cutoff = cutoff
                .min(moved + 4.0 * self.clearance)
                .max(4.0 * self.clearance);
        }
    }

    /// What touches after the way out.
    fn what_touches(&mut self) -> (WayOut, Option<Touching>) {
        if self.upper == f64::INFINITY || self.scratch.meter().is_exceeded() {
            return Default::default();
        }
        let near = 8.0 * (self.clearance + self.error);
        let (touching, is_all) = touching_at(&self.pairing, &self.way, near, self.scratch);
        let mut out = WayOut::of(&touching, &self.way, near, self.rounding);
        out.is_regular &= is_all;
        let by_gap = |a: &&Touching, b: &&Touching| a.gap.total_cmp(&b.gap);
        let first = out.terms.first().and_then(|(_, contacts)| contacts.first());
        let first = first.or_else(|| touching.iter().min_by(by_gap)).copied();
        (out, first)
    }
}
