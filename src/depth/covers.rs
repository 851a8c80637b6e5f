//! Convex sets of translations at which two bodies meet: those that a search has come upon, and the deepest of them around a
//! translation.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use super::boundary::boundary;
use super::difference::{Difference, RoundDifference, RoundShape};
use super::inner_balls::{InnerBall, common_balls};
use super::meeting::Meeting;
use super::node::Node;
use crate::body::Body;
use crate::convex::{HalfSpace, nearest_half_spaces, parting_half_spaces};
use crate::pair::{Pairing, RayScratch, Scratch};
use crate::pose::Vec3;
use crate::tolerance::EPSILON;

/// The name of a difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Source {
    Primitives([u32; 2]),
    Balls([u32; 2]),
}

/// A difference that holds a translation, with an estimate of how deep.
pub struct Cover {
    source: Source,
    depth: f64,
}

/// The difference that covers a node, with the parts of it that make the node's children.
pub struct CoverParts {
    pub difference: u32,
    /// The cone that the node lies in, whose parts these are.
    pub old: Option<u32>,
    pub parts: Vec<u32>,
}

/// The differences that a search knows, by number. All are sets of translations in A's centred frame.
#[derive(Default)]
pub struct Covers {
    differences: Vec<Difference>,
    numbers: HashMap<Source, u32, RandomState>,
    /// Balls in A and in B.
    balls: [Vec<InnerBall>; 2],
    rays: RayScratch,
}

/// Balls kept of each body, at most.
const MAX_BALLS: usize = 256;

/// Normals closer than this differ by rounding: what is beyond one half-space and not beyond the other is nearer than the error.
const SAME_NORMAL: f64 = 8.0 * EPSILON;

impl Covers {
    pub fn has_round(&self) -> bool {
        let is_round = |difference: &Difference| matches!(difference, Difference::Round(_));
        self.differences.iter().any(is_round)
    }

    pub fn get(&self, number: u32) -> &Difference {
        &self.differences[number as usize]
    }

    /// The deepest difference known or found around a point, of those that the node is not beyond already. Balls are grown where
    /// none is `enough` deep.
    pub fn around(
        &mut self,
        node: &Node,
        point: &Vec3,
        meeting: &Meeting,
        enough: f64,
        pairing: &Pairing,
        scratch: &mut Scratch,
    ) -> Option<Cover> {
        let mut best = self.deepest_of(node, point, &meeting.places, pairing, scratch);
        if pairing.has_solid() && !pairing.precision.planar {
            let is_deeper = |a: &Option<Cover>, b: &Option<Cover>| {
                let depth = |cover: &Option<Cover>| cover.as_ref().map_or(0.0, |cover| cover.depth);
                depth(a) > depth(b)
            };
            let mut ball = self.deepest_ball(point, pairing);
            let known = [&best, &ball].into_iter().flatten();
            if known.map(|cover| cover.depth).fold(0.0, f64::max) < enough
                && self.balls[0].len() < MAX_BALLS
            {
                self.grow_balls(point, meeting, pairing, scratch);
                ball = self.deepest_ball(point, pairing);
            }
            if is_deeper(&ball, &best) {
                best = ball;
            }
        }
        best.or_else(|| self.deepest_of(node, point, &meeting.flat, pairing, scratch))
    }

    /// The deepest difference of the primitives at some places.
    fn deepest_of(
        &mut self,
        node: &Node,
        point: &Vec3,
        places: &[[u32; 2]],
        pairing: &Pairing,
        scratch: &mut Scratch,
    ) -> Option<Cover> {
        let mut best: Option<Cover> = None;
        for &places in places {
            if scratch.meter().is_exceeded() {
                break;
            }
            let source = Source::Primitives(places);
            let number = self.number(source, pairing, scratch);
            let depth = match self.get(number) {
                Difference::Polytope(spaces) => {
                    // Beyond a face of it already: only rounding says otherwise.
                    if node.faces.iter().any(|face| face.difference == number) {
                        continue;
                    }
                    let depths = spaces
                        .iter()
                        .map(|space| space.offset - space.normal.dot(point));
                    depths.fold(f64::INFINITY, f64::min)
                }
                Difference::Round(_) => round_depth(places, point, pairing, scratch),
            };
            if best.as_ref().is_none_or(|best| depth > best.depth) {
                best = Some(Cover { source, depth });
            }
        }
        best
    }

    /// The two balls that overlap most after a translation.
    fn deepest_ball(&self, point: &Vec3, pairing: &Pairing) -> Option<Cover> {
        let relative = &pairing.relative;
        let mut best: Option<Cover> = None;
        for (j, in_b) in self.balls[1].iter().enumerate() {
            let middle = relative.transform_point(&in_b.center) - point;
            for (i, in_a) in self.balls[0].iter().enumerate() {
                let depth = in_a.radius + in_b.radius - (in_a.center - middle).norm();
                if depth > best.as_ref().map_or(0.0, |best| best.depth) {
                    let source = Source::Balls([i as u32, j as u32]);
                    best = Some(Cover { source, depth });
                }
            }
        }
        best
    }

    /// Grows balls around common points after a translation.
    fn grow_balls(
        &mut self,
        point: &Vec3,
        meeting: &Meeting,
        pairing: &Pairing,
        scratch: &mut Scratch,
    ) {
        /// Pairs of primitives that meet from where balls are grown.
        const STARTS: usize = 2;
        let shifted = pairing.shifted(point);
        let mut starts = Vec::new();
        let pairs = meeting.places.iter().chain(&meeting.flat);
        for &places in pairs.take(STARTS) {
            let found = shifted.closest_at(places, scratch.for_primitives());
            starts.extend(found.map(|found| found.closest.points[0]));
        }
        if starts.is_empty() {
            starts.push(shifted.relative.translation);
            starts.push(Vec3::zeros());
        }
        for start in starts {
            if let Some([in_a, in_b]) = common_balls(&shifted, &start, scratch, &mut self.rays) {
                self.balls[0].push(in_a);
                self.balls[1].push(in_b);
            }
        }
    }

    /// The number of a difference, which is made when first asked for.
    fn number(&mut self, source: Source, pairing: &Pairing, scratch: &mut Scratch) -> u32 {
        if let Some(&number) = self.numbers.get(&source) {
            return number;
        }
        let is_planar = pairing.precision.planar;
        let difference = match source {
            Source::Primitives(places) => {
                let is_round = {
                    let mut buffer = Default::default();
                    let placed = pairing.placed(places, &mut buffer);
                    placed.iter().any(|placed| placed.shape.curve.is_some())
                };
                if is_round {
                    let middle = middle(places, pairing);
                    let shape = RoundShape::Primitives(places);
                    Difference::Round(RoundDifference::new(middle, shape, is_planar, |ray| {
                        boundary(pairing, &middle, shape, ray, scratch)
                    }))
                } else {
                    Difference::Polytope(parting(places, pairing, scratch))
                }
            }
            Source::Balls([i, j]) => {
                let (in_a, in_b) = (self.balls[0][i as usize], self.balls[1][j as usize]);
                let middle = pairing.relative.transform_point(&in_b.center) - in_a.center;
                let shape = RoundShape::Ball(in_a.radius + in_b.radius);
                Difference::Round(RoundDifference::new(middle, shape, false, |ray| {
                    boundary(pairing, &middle, shape, ray, scratch)
                }))
            }
        };
        let number = self.differences.len() as u32;
        self.differences.push(difference);
        self.numbers.insert(source, number);
        number
    }

    /// The parts of the difference that covers a node; `None` if the node is beyond all of it already.
    pub fn parts(
        &mut self,
        node: &Node,
        cover: &Cover,
        pairing: &Pairing,
        scratch: &mut Scratch,
    ) -> Option<CoverParts> {
        let difference = self.number(cover.source, pairing, scratch);
        let own = node.faces.iter().find(|face| face.difference == difference);
        let old = own.map(|face| face.part);
        let parts = match (&mut self.differences[difference as usize], old) {
            (Difference::Polytope(_), Some(_)) => return None,
            (Difference::Polytope(spaces), None) => (0..spaces.len() as u32).collect(),
            (Difference::Round(round), None) => round.roots().collect(),
            (Difference::Round(round), Some(cone)) => {
                let (middle, shape) = (round.middle, round.shape);
                let parts =
                    round.parts(cone, |ray| boundary(pairing, &middle, shape, ray, scratch));
                parts.collect()
            }
        };
        Some(CoverParts {
            difference,
            old,
            parts,
        })
    }
}

/// The half-spaces that part the primitives at two places, each once.
fn parting(places: [u32; 2], pairing: &Pairing, scratch: &mut Scratch) -> Vec<HalfSpace> {
    let mut buffer = Default::default();
    let [a, b] = pairing.placed(places, &mut buffer);
    let found = parting_half_spaces(&a, &b, &pairing.precision, scratch.meter_mut());
    let mut kept: Vec<HalfSpace> = Vec::with_capacity(found.len());
    for space in found {
        // Parallel faces of both have the same normal up to its rounding; the wider half-space covers both.
        let is_same = |other: &&mut HalfSpace| {
            (other.normal - space.normal).norm_squared() <= SAME_NORMAL * SAME_NORMAL
        };
        match kept.iter_mut().find(is_same) {
            Some(other) => other.offset = other.offset.min(space.offset),
            None => kept.push(space),
        }
    }
    kept
}

/// Whether the primitives at two places, polytopes, have several shortest ways out, or nearly: none longer than the least by more than
/// `within`, and their directions farther apart than `apart`.
pub fn has_several_ways(
    places: [u32; 2],
    within: f64,
    apart: f64,
    pairing: &Pairing,
    scratch: &mut Scratch,
) -> bool {
    let mut buffer = Default::default();
    let [a, b] = pairing.placed(places, &mut buffer);
    let spaces = nearest_half_spaces(&a, &b, &pairing.precision, within, scratch.meter_mut());
    let Some(first) = spaces.first() else {
        return true;
    };
    let is_elsewhere = |space: &HalfSpace| (space.normal - first.normal).norm() > apart;
    spaces.iter().any(is_elsewhere)
}

/// An estimate of how deep a translation is in the difference of two round primitives.
fn round_depth(places: [u32; 2], point: &Vec3, pairing: &Pairing, scratch: &mut Scratch) -> f64 {
    let shifted = pairing.shifted(point);
    let radii = radii(places, pairing);
    let found = shifted.closest_at(places, scratch.for_primitives());
    found.map_or(0.0, |found| match found.cores.distance {
        0.0 => found.cores.depth + radii,
        apart => radii - apart,
    })
}

fn radii(places: [u32; 2], pairing: &Pairing) -> f64 {
    let radius = |place: u32, body: &Body| {
        let primitive = body.packed().primitives().entry(place as usize).primitive;
        body.primitives().get(primitive as usize).shape.radius()
    };
    radius(places[0], pairing.a) + radius(places[1], pairing.b)
}

/// A translation well inside the difference of the primitives at two places.
fn middle(places: [u32; 2], pairing: &Pairing) -> Vec3 {
    let [in_a, in_b] = [(places[0], pairing.a), (places[1], pairing.b)].map(|(place, body)| {
        let primitive = body.packed().primitives().entry(place as usize).primitive;
        let primitive = body.primitives().get(primitive as usize);
        let ends = (0..6).map(|i| {
            let mut way = Vec3::zeros();
            way[i % 3] = if i < 3 { 1.0 } else { -1.0 };
            primitive.farthest(&way)
        });
        ends.sum::<Vec3>() / 6.0
    });
    pairing.relative.transform_point(&in_b) - in_a
}
