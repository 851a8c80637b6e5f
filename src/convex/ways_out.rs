//! The translations that part two polytopes which meet: the shortest, or one for each facet of their Minkowski difference.
//!
//! In the plane, for flat differences, and where the nearest facets are not found, the shortest is that of all normals.

use super::extreme_vertex::ExtremeVertex;
use super::facet_normals::visit_normals;
use super::near_ways::near_ways;
use super::placed::{PlacedPrimitive, Precision};
use super::way::{HalfSpace, NO_NUMBER, Way, ways_along};
use crate::pose::Vec3;
use crate::work_meter::WorkMeter;

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
