//! The translations that part two polytopes which meet, each along the normal of a facet of their Minkowski difference.
//!
//! The facets nearest to the origin are found by a polytope that expands within the difference, which proves that all others are
//! farther. In the plane, for flat differences, and where that search gives up, all normals are tried.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::expanding_polytope::nearest_facets;
use super::extreme_vertex::ExtremeVertex;
use super::facet_normals::visit_normals;
use super::placed::{PlacedPrimitive, Precision};
use crate::pose::Vec3;
use crate::primitive::{Feature, FeatureKind};
use crate::work_meter::WorkMeter;

/// A translation of r after which it is clear of s.
#[derive(Clone, Copy)]
pub struct Way {
    pub depth: f64,
    /// A unit vector from s to r.
    pub direction: Vec3,
    /// The number of the direction's line, and whether it is the opposite of its normal. Ties of the depth go to the lowest
    /// rank.
    rank: (u64, bool),
}

impl Way {
    fn order(&self, other: &Self) -> Ordering {
        let by_depth = self.depth.total_cmp(&other.depth);
        by_depth.then(self.rank.cmp(&other.rank))
    }
}

/// Lines without a number come after all others.
const NO_NUMBER: u64 = u64::MAX;

/// The ways along a unit normal and against it.
fn ways_along([r, s]: [&PlacedPrimitive; 2], number: u64, normal: &Vec3) -> [Way; 2] {
    let [(low_r, high_r), (low_s, high_s)] = [r, s].map(|placed| placed.extent_along(normal));
    let ways = [(high_s - low_r, *normal), (high_r - low_s, -normal)];
    let way = |i: usize| Way {
        depth: ways[i].0,
        direction: ways[i].1,
        rank: (number, i == 1),
    };
    [way(0), way(1)]
}

/// The shortest way.
pub fn shortest_way(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Way {
    let near = near_ways(r, s, precision, 0.0, meter);
    let shortest = near.and_then(|ways| ways.into_iter().min_by(Way::order));
    shortest.unwrap_or_else(|| shortest_of_all(r, s, precision, meter))
}

/// The ways along the normals of the facets whose depth exceeds the least by no more than `within`, and some others; `None` where the
/// facets are not found.
fn near_ways(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    within: f64,
    meter: &mut WorkMeter,
) -> Option<Vec<Way>> {
    if precision.planar {
        return None;
    }
    let facets = nearest_facets(r, s, precision.size, within, meter)?;
    let mut found = Vec::with_capacity(2 * facets.len());
    for facet in facets {
        let exact = exact_line(r, s, &facet.corners);
        if let Some((number, normal)) = exact {
            // Facets of more than three corners are made of several triangles.
            if found.iter().any(|way: &Way| way.rank.0 == number) {
                continue;
            }
            found.extend(ways_along([r, s], number, &normal));
        }
        let is_as_short = |way: &Way| way.depth <= facet.height;
        if !found.iter().any(is_as_short) {
            found.extend(ways_along([r, s], NO_NUMBER, &facet.normal));
        }
    }
    Some(found)
}

/// The line of a facet of the difference by the features of both sets that make it, with its number.
fn exact_line(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    corners: &[[u32; 2]; 3],
) -> Option<(u64, Vec3)> {
    let names = [0, 1].map(|side| {
        let mut names: SmallVec<[u32; 3]> = corners.iter().map(|of| of[side]).collect();
        names.sort_unstable();
        names.dedup();
        names
    });
    let sets = [r, s];
    let features = [0, 1].map(|side| sets[side].feature_of(&names[side]));
    let mut before = 0;
    for (placed, feature) in sets.iter().zip(&features) {
        if let Some(Feature {
            kind: FeatureKind::Face,
            index,
        }) = feature
        {
            return Some((before + u64::from(*index), placed.normal(*index as usize)));
        }
        before += placed.shape.faces.len() as u64;
    }
    let [
        Some(Feature {
            kind: FeatureKind::Edge,
            index: edge_r,
        }),
        Some(Feature {
            kind: FeatureKind::Edge,
            index: edge_s,
        }),
    ] = features
    else {
        return None;
    };
    let [along_r, along_s] = [(r, edge_r), (s, edge_s)].map(|(placed, edge)| {
        let (from, to) = placed.edge_ends(placed.shape.edges[edge as usize]);
        to - from
    });
    let pair = u64::from(edge_r) * s.shape.edges.len() as u64 + u64::from(edge_s);
    let normal = along_r.cross(&along_s).try_normalize(0.0)?;
    Some((before + pair, normal))
}

/// The shortest way along any of the normals that facets of the difference can have.
fn shortest_of_all(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Way {
    let mut shortest = ShortestWay::new(r, s);
    visit_normals(r, s, precision, meter, |number, normal| {
        shortest.offer(number, normal);
    });
    shortest.measure_waiting();
    // Sets without faces and without candidate normals: a direction perpendicular to their longest edge.
    if shortest.way.depth == f64::INFINITY {
        let along = [r, s]
            .iter()
            .flat_map(|placed| {
                placed
                    .shape
                    .edges
                    .iter()
                    .map(|&edge| placed.edge_ends(edge))
            })
            .map(|(from, to)| to - from)
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
            .unwrap_or_else(Vec3::zeros);
        let across = if along.x.abs() <= along.y.abs() {
            Vec3::x()
        } else {
            Vec3::y()
        };
        let upright = if along == Vec3::zeros() {
            across
        } else {
            along.cross(&across)
        };
        shortest.offer(NO_NUMBER, &upright);
        shortest.measure_waiting();
    }
    shortest.way
}

/// A half-space { t : normal . t >= offset } of translations t of r that keep r clear of s. `normal` is a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    pub normal: Vec3,
    pub offset: f64,
}

impl From<Way> for HalfSpace {
    fn from(way: Way) -> Self {
        Self {
            normal: way.direction,
            offset: way.depth,
        }
    }
}

/// The translations of r that part the hulls of two primitives' vertices: the union of these half-spaces. Their complements
/// are the half-spaces of the Minkowski difference s - r, some of them redundant. The result is incomplete if the meter's
/// limit is exceeded.
pub fn parting_half_spaces(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    meter: &mut WorkMeter,
) -> Vec<HalfSpace> {
    let mut found = Vec::new();
    visit_normals(r, s, precision, meter, |_, line| {
        let Some(normal) = line.try_normalize(0.0) else {
            return;
        };
        found.extend(ways_along([r, s], NO_NUMBER, &normal).map(HalfSpace::from));
    });
    found
}

/// The half-spaces among these whose offset exceeds the least by no more than `within`. Incomplete likewise.
pub fn nearest_half_spaces(
    r: &PlacedPrimitive,
    s: &PlacedPrimitive,
    precision: &Precision,
    within: f64,
    meter: &mut WorkMeter,
) -> Vec<HalfSpace> {
    let mut found = match near_ways(r, s, precision, within, meter) {
        Some(ways) => ways.into_iter().map(HalfSpace::from).collect(),
        None => parting_half_spaces(r, s, precision, meter),
    };
    let offsets = found.iter().map(|space| space.offset);
    let least = offsets.fold(f64::INFINITY, f64::min);
    found.retain(|space| space.offset <= least + within);
    found
}

/// The shortest way out among the candidate lines tried so far.
struct ShortestWay<'a> {
    sets: [&'a PlacedPrimitive<'a>; 2],
    extremes: [ExtremeVertex<'a>; 2],
    way: Way,
    /// Lines that may be the shortest, not yet measured with all vertices.
    waiting: Vec<Line>,
}

struct Line {
    number: u64,
    normal: Vec3,
    /// A lower bound of the depth along the line, either way.
    lower: f64,
}

/// Lines are measured in batches of this many, in the order of their lower bounds: mostly the first then proves the others
/// longer. A smaller batch measures more lines that a later one would have ruled out.
const BATCH: usize = 64;

impl<'a> ShortestWay<'a> {
    fn new(r: &'a PlacedPrimitive<'a>, s: &'a PlacedPrimitive<'a>) -> Self {
        Self {
            sets: [r, s],
            extremes: [r, s]
                .map(|placed| ExtremeVertex::new(placed.vertices(), &placed.shape.edges)),
            way: Way {
                depth: f64::INFINITY,
                direction: Vec3::x(),
                rank: (NO_NUMBER, true),
            },
            waiting: Vec::new(),
        }
    }

    /// Tries the directions of a vector of any length and of its opposite, as the line of the given number.
    fn offer(&mut self, number: u64, line: &Vec3) {
        let Some(normal) = line.try_normalize(0.0) else {
            return;
        };
        // The projections of any vertices bound the extent from within, also in rounded arithmetic.
        let [(low_r, high_r), (low_s, high_s)] =
            [0, 1].map(|i| self.extremes[i].extent_within(&normal));
        let lower = (high_s - low_r).min(high_r - low_s);
        if lower > self.way.depth {
            return;
        }
        self.waiting.push(Line {
            number,
            normal,
            lower,
        });
        if self.waiting.len() >= BATCH {
            self.measure_waiting();
        }
    }

    /// Measures the waiting lines.
    fn measure_waiting(&mut self) {
        let mut waiting = std::mem::take(&mut self.waiting);
        waiting.sort_unstable_by(|a, b| {
            let by_bound = a.lower.total_cmp(&b.lower);
            by_bound.then(a.number.cmp(&b.number))
        });
        for line in waiting.drain(..) {
            if line.lower > self.way.depth {
                break;
            }
            for way in ways_along(self.sets, line.number, &line.normal) {
                if way.order(&self.way).is_lt() {
                    self.way = way;
                }
            }
        }
        self.waiting = waiting;
    }
}
