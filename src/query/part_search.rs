//! The search among the parts of two bodies for their nearest ones, where these stand for curved surfaces.
//!
//! Best first: of all pairs of parts that may be the nearest, the one of the least lower bound is looked at. The more curved of its
//! parts is halved, and both halves are measured, until the bounds have met. A part that is a cell of a patch is measured as the convex
//! hull of its corners; no point of either is farther from the other than the cell's deviation (see `body/patch_cell.rs`), so that the
//! distance of two parts is that of their hulls, give or take both deviations.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap, HashSet};

use super::answer::{ContactRecord, Distance, DistanceKind, Witness};
use super::target::Target;
use crate::body::Body;
use crate::body::patch_cell::Cell;
use crate::cobject::Leaf;
use crate::convex::{Core, PlacedBuffer, PlacedPrimitive};
use crate::error::Result;
use crate::gjk::{DistanceLimits, Gjk, PointCloud, Support, gjk};
use crate::pair::{Hit, Pairing, Scratch};
use crate::pose::Vec3;
use foldhash::fast::RandomState;

/// The most cells that a search halves: two surfaces that are about equally near over much of their areas end here, with what is proved
/// by then.
const MAX_HALVINGS: usize = 1 << 14;

/// A primitive of a body, or a part of a patch that it stands for.
struct Part {
    shape: Shape,
    /// No point of the hull or the primitive is farther from what it stands for, and the other way round.
    deviation: f64,
    /// The two halves, once they were asked for.
    halves: Option<[usize; 2]>,
}

/// A primitive, or the number of the curved cell that it is of.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Source {
    Primitive(u32),
    Cell(u32),
}

enum Shape {
    Primitive(u32),
    Cell {
        cell: Box<Cell>,
        /// In the frame of the pair.
        corners: [Vec3; 4],
    },
}

/// Two parts with the bounds of their distance.
struct PartPair {
    /// The distance of the hulls, less margin and deviations.
    clear: f64,
    lower: f64,
    upper: f64,
    /// The numbers of the parts, r first.
    parts: [usize; 2],
    /// Which hit they are parts of.
    hit: usize,
    /// Pairs of the same bounds come in this order.
    number: usize,
}

impl Ord for PartPair {
    /// The greatest is the one of the least lower bound, which a heap gives first. Of several, as where surfaces meet along a curve and all
    /// are 0, it is the one known best: it soon shows how near they are, or that these parts are not.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_lower = other.lower.total_cmp(&self.lower);
        let by_upper = other.upper.total_cmp(&self.upper);
        by_lower.then(by_upper).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for PartPair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for PartPair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for PartPair {}

/// The closest points of two parts, in the frame of the pair, where these were measured here; and which hit they are parts of.
struct Nearest {
    points: Option<[Vec3; 2]>,
    hit: usize,
}

/// The search among the parts of two bodies.
pub(super) struct PartSearch<'t, 'a> {
    target: &'t Target<'a>,
    pairing: Pairing<'a>,
    /// How far apart the bounds may be in the end.
    gap: f64,
    hits: Vec<Hit>,
    parts: Vec<Part>,
    open: BinaryHeap<PartPair>,
    /// A lower bound of the pairs that are not in the search.
    unlisted: f64,
    /// An upper bound of the distance.
    pub upper: f64,
    /// The parts that it is from.
    nearest: Option<Nearest>,
    /// The pair looked at last, which stays in the search: the one of the least lower bound.
    last: Option<PartPair>,
    /// The bounds have met, as near as halving can bring them.
    is_settled: bool,
}

impl<'t, 'a> PartSearch<'t, 'a> {
    /// Among primitive pairs of a target; others are no nearer than `unlisted`. The bounds end at most `gap` apart.
    pub fn new(target: &'t Target<'a>, gap: f64, hits: Vec<Hit>, unlisted: f64) -> Self {
        Self {
            target,
            pairing: target.pairing(),
            gap,
            hits,
            parts: Vec::new(),
            open: BinaryHeap::new(),
            unlisted,
            upper: f64::INFINITY,
            nearest: None,
            last: None,
            is_settled: false,
        }
    }

    /// Puts the pairs of parts of all hits on the heap.
    pub fn begin(&mut self, limit: f64, scratch: &mut Scratch) -> Result<()> {
        let mut known: HashMap<(usize, Source), usize, RandomState> = HashMap::default();
        let mut seen: HashSet<[usize; 2], RandomState> = HashSet::default();
        for number in 0..self.hits.len() {
            let primitives = self.hits[number].key.primitives;
            let parts = [0, 1].map(|side| {
                let source = self.source(side, primitives[side]);
                *known.entry((side, source)).or_insert_with(|| {
                    self.parts.push(self.whole_part(side, source));
                    self.parts.len() - 1
                })
            });
            // Both triangles of a cell are one part.
            if seen.insert(parts) {
                self.open(parts, number, limit, scratch)?;
            }
        }
        Ok(())
    }

    /// What a primitive stands for.
    fn source(&self, side: usize, primitive: u32) -> Source {
        let curved = self.body(side).curved();
        match curved.and_then(|curved| curved.of(primitive)) {
            Some(cell) => Source::Cell(cell),
            None => Source::Primitive(primitive),
        }
    }

    fn whole_part(&self, side: usize, source: Source) -> Part {
        let body = self.body(side);
        match (source, body.curved()) {
            (Source::Cell(number), Some(curved)) => self.part_of(side, curved.cell(number)),
            (Source::Cell(number) | Source::Primitive(number), _) => Part {
                shape: Shape::Primitive(number),
                deviation: body.flat_deviation(),
                halves: None,
            },
        }
    }

    fn body(&self, side: usize) -> &'a Body {
        [self.pairing.a, self.pairing.b][side]
    }

    fn part_of(&self, side: usize, cell: Cell) -> Part {
        let corners = cell.corners().map(|corner| match side {
            0 => corner,
            _ => self.pairing.relative.transform_point(&corner),
        });
        Part {
            deviation: cell.deviation(),
            shape: Shape::Cell {
                cell: Box::new(cell),
                corners,
            },
            halves: None,
        }
    }

    /// Looks at pairs, the least lower bound first, until the bounds have met or `ends` says so. Pairs beyond `limit` are left out.
    pub fn run(
        &mut self,
        limit: f64,
        ends: impl Fn(&Self) -> bool,
        scratch: &mut Scratch,
    ) -> Result<()> {
        let mut halvings = 0;
        loop {
            if let Some(last) = self.last.take() {
                self.open.push(last);
            }
            self.last = self.open.pop();
            let Some(pair) = &self.last else {
                return Ok(());
            };
            self.is_settled = self.upper - self.lower() <= self.gap;
            if self.is_settled || ends(self) || halvings == MAX_HALVINGS {
                return Ok(());
            }
            let deviations = pair.parts.map(|part| self.parts[part].deviation);
            let curved = pair.parts.map(|part| self.parts[part].has_halves());
            // What halving gains is no more than the deviations of what can be halved.
            let gains = [0, 1].map(|side| match curved[side] {
                true => deviations[side],
                false => 0.0,
            });
            if gains[0] + gains[1] <= 0.125 * self.gap {
                // A cell that cannot be halved any more leaves bounds wider apart than was asked for; nothing else does but rounding.
                let is_stuck = pair.parts.map(|part| self.parts[part].is_smallest_cell());
                self.is_settled = pair.lower <= self.unlisted && is_stuck == [false; 2];
                return Ok(());
            }
            let side = usize::from(gains[1] > gains[0]);
            let (parts, hit) = (pair.parts, pair.hit);
            self.last = None;
            halvings += 1;
            for half in self.halves(side, parts[side]) {
                let mut parts = parts;
                parts[side] = half;
                self.open(parts, hit, limit, scratch)?;
            }
        }
    }

    /// The numbers of a cell's halves.
    fn halves(&mut self, side: usize, part: usize) -> [usize; 2] {
        if let Some(halves) = self.parts[part].halves {
            return halves;
        }
        let Shape::Cell { cell, .. } = &self.parts[part].shape else {
            unreachable!("only cells have halves");
        };
        let halves = cell.as_ref().clone().halves(cell.bent_along());
        let first = self.parts.len();
        for half in halves {
            let half = self.part_of(side, half);
            self.parts.push(half);
        }
        let numbers = [first, first + 1];
        self.parts[part].halves = Some(numbers);
        numbers
    }

    /// Measures two parts, and puts them on the heap unless they are beyond the limit.
    fn open(
        &mut self,
        parts: [usize; 2],
        hit: usize,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Result<()> {
        let meter = scratch.meter_mut();
        meter.count_nodes(1);
        meter.check()?;
        let deviation = self.parts[parts[0]].deviation + self.parts[parts[1]].deviation;
        let margin = self.target.options.margin + deviation;
        let error = self.pairing.precision.error;
        let limit = limit.min(self.upper);
        let (apart, points) = match parts.map(|part| &self.parts[part].shape) {
            [Shape::Primitive(_), Shape::Primitive(_)] => {
                let apart = self.hits[hit].apart;
                ([apart; 2], None)
            }
            shapes => {
                let (apart, points) = self.measured(shapes, limit + margin + error);
                (apart, Some(points))
            }
        };
        let clear = apart[0] - margin;
        let lower = (clear - error).max(0.0);
        if lower > limit {
            // Nothing nearer than the limit is left out.
            self.unlisted = self.unlisted.min(lower);
            return Ok(());
        }
        let upper = (apart[1] - self.target.options.margin + deviation + error).max(0.0);
        if upper < self.upper {
            self.upper = upper;
            self.nearest = Some(Nearest { points, hit });
        }
        let number = self.open.len() + self.parts.len();
        self.open.push(PartPair {
            clear,
            lower,
            upper,
            parts,
            hit,
            number,
        });
        Ok(())
    }

    /// A lower and an upper bound of the distance of two shapes, up to the error of the pair, and points that are about the closest.
    /// Beyond `cutoff` the lower bound alone is known.
    fn measured(&self, shapes: [&Shape; 2], cutoff: f64) -> ([f64; 2], [Vec3; 2]) {
        let primitives = |side: usize, primitive: u32| {
            let primitives = self.body(side).primitives();
            primitives.get(primitive as usize)
        };
        let mut buffer = PlacedBuffer::default();
        match shapes {
            [
                Shape::Cell { corners: a, .. },
                Shape::Cell { corners: b, .. },
            ] => measured(&PointCloud(a), &PointCloud(b), [0.0; 2], cutoff),
            [Shape::Primitive(a), Shape::Cell { corners, .. }] => {
                let a = PlacedPrimitive::at_home(primitives(0, *a), None);
                let radii = [a.shape.radius(), 0.0];
                measured(&Core::of(&a), &PointCloud(corners), radii, cutoff)
            }
            [Shape::Cell { corners, .. }, Shape::Primitive(b)] => {
                let b = buffer.place(primitives(1, *b), None, &self.pairing.relative);
                let radii = [0.0, b.shape.radius()];
                measured(&PointCloud(corners), &Core::of(&b), radii, cutoff)
            }
            [Shape::Primitive(_), Shape::Primitive(_)] => unreachable!("hits are measured"),
        }
    }

    /// A lower bound of the distance.
    pub fn lower(&self) -> f64 {
        let last = self.last.as_ref().map_or(f64::INFINITY, |last| last.lower);
        last.min(self.unlisted)
    }

    /// The distance where it may be within `limit`; `whole` is that of the bodies as they are. Only bounds of it where the search has ended
    /// before they met: pairs were left out of it, or too many are equally near.
    pub fn answer(
        &self,
        limit: f64,
        whole: Distance,
        leaf: Leaf,
        scratch: &mut Scratch,
    ) -> Distance {
        let lower = self.lower();
        let last = self.last.as_ref().filter(|last| last.clear <= limit);
        let (Some(last), Some(nearest), true) = (last, &self.nearest, self.is_settled) else {
            let upper = self.upper.min(whole.upper);
            return Distance {
                kind: DistanceKind::LowerBound,
                distance: lower,
                lower,
                upper,
                excess: (upper - whole.upper_of_grown()).max(0.0),
                ..whole
            };
        };
        let error = self.pairing.precision.error;
        let distance = if last.clear > error { last.clear } else { 0.0 };
        let hit = Hit {
            distance,
            ..self.hits[nearest.hit]
        };
        let scratch = scratch.for_primitives();
        let closest = self.pairing.closest(&hit, scratch);
        let contact = self
            .pairing
            .first_world_contact(hit.key.primitives, &closest, scratch);
        let frame = &self.pairing.frame;
        let points = nearest.points.unwrap_or(closest.closest.points);
        let points = points.map(|point| frame.transform_point(&point));
        // Features are those of the primitives, the rest is of their parts.
        let across = (points[0] - points[1]).try_normalize(0.0);
        let contact = contact.map(|contact| ContactRecord {
            points,
            normal: across.unwrap_or(contact.normal),
            distance,
            clearance: last.clear,
            mode: contact.contact.mode,
            features: contact.contact.features,
        });
        Distance {
            kind: DistanceKind::Exact,
            distance,
            lower,
            upper: self.upper.max(distance),
            witness: Some(Witness {
                contact_count: usize::from(contact.is_some()),
                overlapping: contact.is_none() && distance == 0.0,
                ..Witness::of(&self.target.parties(), &hit, leaf)
            }),
            points,
            contact,
            excess: (self.upper - distance - error).max(0.0),
            version: 0,
        }
    }
}

impl Part {
    fn is_smallest_cell(&self) -> bool {
        matches!(&self.shape, Shape::Cell { cell, .. } if !cell.has_halves())
    }

    fn has_halves(&self) -> bool {
        match &self.shape {
            Shape::Primitive(_) => false,
            Shape::Cell { cell, .. } => cell.has_halves(),
        }
    }
}

/// Bounds of the distance of two cores less their radii, and about the closest points.
fn measured(
    a: &impl Support,
    b: &impl Support,
    radii: [f64; 2],
    cutoff: f64,
) -> ([f64; 2], [Vec3; 2]) {
    let limits = DistanceLimits {
        cutoff: cutoff + radii[0] + radii[1],
        ..DistanceLimits::EXACT
    };
    let start = a.support(&Vec3::x()) - b.support(&Vec3::x());
    let found: Gjk = gjk(a, b, start, limits);
    let apart = [found.lower, found.attained].map(|bound| (bound - radii[0] - radii[1]).max(0.0));
    let nearest = found.nearest.map(|nearest| nearest.points);
    let [on_a, on_b] = found.near.or(nearest).unwrap_or([found.common; 2]);
    let across = (on_a - on_b).try_normalize(0.0).unwrap_or_default();
    let points = match (on_a - on_b).norm() >= radii[0] + radii[1] {
        true => [on_a - across * radii[0], on_b + across * radii[1]],
        false => [0.5 * (on_a + on_b); 2],
    };
    (apart, points)
}
