//! The distance of two flat polygons, four edges at a time.

use super::closest::Closest;
use crate::lanes::{F64x4, Points64, along64, cross64, dot64, each3, splat64, sub64};
use crate::pose::{Pose, Vec3};
use crate::primitive::Feature;
use crate::tolerance;

/// A convex polygon in space: its corners in cyclic order, four at a time, the last four filled up with the first corner.
#[derive(Clone, Copy)]
pub struct Outline<'a> {
    pub blocks: &'a [Points64],
    pub corners: usize,
    /// The plane normal . x = offset.
    pub normal: Vec3,
    pub offset: f64,
}

impl Outline<'_> {
    #[inline(always)]
    fn corner(&self, i: usize) -> Vec3 {
        let block = &self.blocks[i / 4];
        Vec3::new(block[0].0[i % 4], block[1].0[i % 4], block[2].0[i % 4])
    }

    /// The point of an edge at a parameter, and the corner or edge that holds it. The edges of filled-up places are corners.
    fn on_edge(&self, edge: usize, parameter: f64, error: f64) -> (Vec3, Feature) {
        let edge = if edge < self.corners { edge } else { 0 };
        let next = if edge + 1 == self.corners {
            0
        } else {
            edge + 1
        };
        let (start, end) = (self.corner(edge), self.corner(next));
        let point = start + (end - start) * parameter;
        if parameter <= 0.0 || (point - start).norm() <= error {
            (start, Feature::vertex(edge as u32))
        } else if parameter >= 1.0 || (point - end).norm() <= error {
            (end, Feature::vertex(next as u32))
        } else {
            (point, Feature::edge(edge as u32))
        }
    }

    /// Corners and the edges that leave them.
    #[inline(always)]
    fn edges(&self) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
        (0..self.corners).map(|i| {
            let next = if i + 1 == self.corners { 0 } else { i + 1 };
            (self.corner(i), self.corner(next) - self.corner(i))
        })
    }

    /// The corners of a block, each with the one after it: pairs of filled-up places have length 0.
    #[inline(always)]
    fn following(&self, block: usize) -> Points64 {
        let next = self.blocks.get(block + 1).unwrap_or(&self.blocks[0]);
        let block = &self.blocks[block];
        each3(|k| {
            let [_, b, c, d] = block[k].0;
            F64x4([b, c, d, next[k].0[0]])
        })
    }

    /// The extremes of direction . x over the polygon.
    #[inline(always)]
    pub fn extent_along(&self, direction: &[f64; 3]) -> (f64, f64) {
        let first = along64(&self.blocks[0], direction);
        let (mut low, mut high) = (first, first);
        for block in &self.blocks[1..] {
            let along = along64(block, direction);
            (low, high) = (low.min(along), high.max(along));
        }
        (low.least(), high.greatest())
    }

    /// How far another polygon is from this one's plane; negative where it reaches over to both sides.
    #[inline(always)]
    fn plane_gap(&self, other: &Outline) -> f64 {
        let (low, high) = other.extent_along(&self.normal.into());
        (low - self.offset).max(self.offset - high)
    }
}

/// Moves the corners of a polygon into the buffer.
#[inline(always)]
pub fn moved<'a>(outline: &Outline, pose: &Pose, buffer: &'a mut [Points64]) -> Outline<'a> {
    let r = &pose.rotation;
    let t = &pose.translation;
    for (to, from) in buffer.iter_mut().zip(outline.blocks) {
        for k in 0..3 {
            let row = [r[(k, 0)], r[(k, 1)], r[(k, 2)]];
            to[k] = along64(from, &row) + F64x4::splat(t[k]);
        }
    }
    let normal = r * outline.normal;
    Outline {
        blocks: &buffer[..outline.blocks.len()],
        corners: outline.corners,
        normal,
        offset: outline.offset + normal.dot(t),
    }
}

/// What is known of the distance of two polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonDistance {
    /// More than the cutoff.
    Beyond,
    /// The distance, 0 where they surely cross.
    Apart(f64),
    /// They may cross.
    Doubt,
}

/// The distance of two polygons whose coordinates are at most `size`, unless it is above `cutoff`.
///
/// All points compared belong to the polygons, so the least distance found is too large only by the rounding of the
/// places of the closest points, which moves them by a few EPSILON of `size`. A foot that rounding puts on the wrong side
/// of an edge is as near to that edge.
#[inline(always)]
pub fn polygon_distance(a: &Outline, b: &Outline, cutoff: f64, size: f64) -> PolygonDistance {
    let rounding = tolerance::INSIDE_DOUBT * size;
    if a.plane_gap(b).max(b.plane_gap(a)) - rounding > cutoff {
        return PolygonDistance::Beyond;
    }
    match cross(a, b, size) {
        Some(false) => {}
        Some(true) => return PolygonDistance::Apart(0.0),
        None => return PolygonDistance::Doubt,
    }
    let mut least = F64x4::splat(f64::INFINITY);
    for block in 0..b.blocks.len() {
        let starts = &b.blocks[block];
        let along = sub64(&b.following(block), starts);
        for (start, edge) in a.edges() {
            least = least.min(edge_distances(&start, &edge, starts, &along));
        }
        least = least.min(heights_over(a, starts));
    }
    for block in a.blocks {
        least = least.min(heights_over(b, block));
    }
    let distance = least.least().sqrt();
    if distance - rounding > cutoff {
        PolygonDistance::Beyond
    } else {
        PolygonDistance::Apart(distance)
    }
}

/// The closest points of polygons that do not cross, with the corners, edges and faces that hold them; `None` for those
/// that may. A point no farther than `error` from a corner is held by that.
pub fn polygon_closest(a: &Outline, b: &Outline, size: f64, error: f64) -> Option<Closest> {
    if cross(a, b, size) != Some(false) {
        return None;
    }
    let mut best = Closest {
        distance: f64::INFINITY,
        points: [Vec3::zeros(); 2],
        features: [Feature::interior(); 2],
    };
    let mut least = f64::INFINITY;
    for (i, (start, edge)) in a.edges().enumerate() {
        for (block, starts) in b.blocks.iter().enumerate() {
            let along = sub64(&b.following(block), starts);
            let (s, t, squares) = edge_places(&start, &edge, starts, &along);
            for lane in 0..4 {
                if squares.0[lane] < least {
                    least = squares.0[lane];
                    let j = 4 * block + lane;
                    let places = [
                        a.on_edge(i, s.0[lane], error),
                        b.on_edge(j, t.0[lane], error),
                    ];
                    best.points = places.map(|place| place.0);
                    best.features = places.map(|place| place.1);
                }
            }
        }
    }
    for (swapped, polygon, other) in [(false, a, b), (true, b, a)] {
        for (block, corners) in other.blocks.iter().enumerate() {
            let squares = heights_over(polygon, corners);
            for lane in 0..4 {
                if squares.0[lane] < least {
                    least = squares.0[lane];
                    let j = 4 * block + lane;
                    let corner = other.corner(j);
                    let height = polygon.normal.dot(&corner) - polygon.offset;
                    let vertex = Feature::vertex(if j < other.corners { j as u32 } else { 0 });
                    best.points = [corner - polygon.normal * height, corner];
                    best.features = [Feature::face(0), vertex];
                    if swapped {
                        best.points.swap(0, 1);
                        best.features.swap(0, 1);
                    }
                }
            }
        }
    }
    best.distance = least.sqrt();
    Some(best)
}

/// The squared distances of an edge and of four others.
#[inline(always)]
fn edge_distances(p: &Vec3, dp: &Vec3, q: &Points64, dq: &Points64) -> F64x4 {
    edge_places(p, dp, q, dq).2
}

/// Where an edge and each of four others are closest, as parameters along them, and how far apart, squared.
///
/// The places along the lines are formed with the cross product of the directions, see `closest_parameters`.
#[inline(always)]
fn edge_places(p: &Vec3, dp: &Vec3, q: &Points64, dq: &Points64) -> (F64x4, F64x4, F64x4) {
    let p = splat64(&[p.x, p.y, p.z]);
    let dp = splat64(&[dp.x, dp.y, dp.z]);
    let between = sub64(q, &p);
    let cross = cross64(&dp, dq);
    let square = dot64(&cross, &cross);
    let s = quotient(dot64(&cross64(&between, dq), &cross), square);
    let (a, b, e) = (dot64(&dp, &dp), dot64(&dp, dq), dot64(dq, dq));
    let (c, f) = (dot64(&dp, &between), dot64(dq, &between));
    // The best place on the other edge for s, then the best place on this one for that.
    let t = unit(quotient(b * unit(s) - f, e));
    let s = unit(quotient(b * t + c, a));
    let apart = each3(|k| between[k] + dq[k] * t - dp[k] * s);
    (s, t, dot64(&apart, &apart))
}

/// The squared heights of four points over a polygon, infinite for those whose feet are outside.
#[inline(always)]
fn heights_over(polygon: &Outline, points: &Points64) -> F64x4 {
    let normal: [f64; 3] = polygon.normal.into();
    let origin: [f64; 3] = polygon.corner(0).into();
    let height = along64(&sub64(points, &splat64(&origin)), &normal);
    let inside = innermost(polygon, points);
    (height * height).zip(
        inside,
        |square, inside| {
            if inside >= 0.0 { square } else { f64::INFINITY }
        },
    )
}

/// The least of the areas that points span with the edges of a polygon, negative outside.
#[inline(always)]
fn innermost(polygon: &Outline, points: &Points64) -> F64x4 {
    let mut least = F64x4::splat(f64::INFINITY);
    for (start, edge) in polygon.edges() {
        let inwards: [f64; 3] = polygon.normal.cross(&edge).into();
        let from_start = sub64(points, &splat64(&start.into()));
        least = least.min(along64(&from_start, &inwards));
    }
    least
}

/// Whether an edge of B passes through A: `None` where it may but rounding decides.
#[inline(always)]
fn pierces(a: &Outline, b: &Outline, doubt: f64, rounding: f64) -> Option<bool> {
    let normal: [f64; 3] = a.normal.into();
    let (mut maybe, mut surely) = (false, false);
    for block in 0..b.blocks.len() {
        let (starts, ends) = (&b.blocks[block], &b.following(block));
        let from = along64(starts, &normal) - F64x4::splat(a.offset);
        let to = along64(ends, &normal) - F64x4::splat(a.offset);
        let at = unit(quotient(from, from - to));
        let along = sub64(ends, starts);
        let point = each3(|k| starts[k] + along[k] * at);
        let inside = innermost(a, &point);
        for lane in 0..4 {
            let low = from.0[lane].min(to.0[lane]);
            let high = from.0[lane].max(to.0[lane]);
            maybe |= (low <= rounding) & (high >= -rounding) & (inside.0[lane] >= doubt);
            surely |= (low < -rounding) & (high > rounding) & (inside.0[lane] > -doubt);
        }
    }
    if surely {
        Some(true)
    } else if maybe {
        None
    } else {
        Some(false)
    }
}

/// Whether two polygons cross, as far as `pierces` can tell.
#[inline(always)]
fn cross(a: &Outline, b: &Outline, size: f64) -> Option<bool> {
    let rounding = tolerance::INSIDE_DOUBT * size;
    if a.plane_gap(b) >= rounding || b.plane_gap(a) >= rounding {
        return Some(false);
    }
    // An area, because the error of a short edge's direction grows with what it is compared to.
    let doubt = -rounding * size;
    match pierces(a, b, doubt, rounding) {
        Some(true) => Some(true),
        first => match (first, pierces(b, a, doubt, rounding)) {
            (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        },
    }
}

/// a / b, and 0 where b is 0.
#[inline(always)]
fn quotient(a: F64x4, b: F64x4) -> F64x4 {
    a.zip(b, |a, b| if b != 0.0 { a / b } else { 0.0 })
}

#[inline(always)]
fn unit(x: F64x4) -> F64x4 {
    x.min(F64x4::splat(1.0)).max(F64x4::splat(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Work, with_widest};

    struct Measure<'a>(Outline<'a>, Outline<'a>);

    impl Work for Measure<'_> {
        type Output = PolygonDistance;

        #[inline(always)]
        fn run(self) -> PolygonDistance {
            polygon_distance(&self.0, &self.1, f64::INFINITY, 4.0)
        }
    }

    /// A square about a point, turned about two axes.
    fn square(center: Vec3, turns: [f64; 2]) -> (Points64, Vec3) {
        let [(s, c), (t, d)] = turns.map(f64::sin_cos);
        let (x, y) = (Vec3::new(c, s, 0.0), Vec3::new(-s * d, c * d, t));
        let corners = [-x - y, x - y, x + y, y - x].map(|corner| center + corner);
        let block = each3(|k| F64x4([0, 1, 2, 3].map(|i: usize| corners[i][k])));
        (block, x.cross(&y))
    }

    #[test]
    fn every_instruction_set_gives_the_same_bits() {
        let mut distances = Vec::new();
        for step in 0..200 {
            let s = f64::from(step);
            let (a, normal_a) = square(Vec3::zeros(), [0.0, 0.3]);
            let center = Vec3::new(0.02 * s, (0.7 * s).sin(), (0.3 * s).cos());
            let (b, normal_b) = square(center, [0.1 * s, 0.37 * s]);
            let outline = |block: &'static [Points64], normal: Vec3| Outline {
                blocks: block,
                corners: 4,
                normal,
                offset: normal.dot(&Vec3::new(
                    block[0][0].0[0],
                    block[0][1].0[0],
                    block[0][2].0[0],
                )),
            };
            let (a, b) = (
                outline(Vec::leak(vec![a]), normal_a),
                outline(Vec::leak(vec![b]), normal_b),
            );
            let plain = Measure(a, b).run();
            assert_eq!(plain, with_widest(Measure(a, b)), "step {step}");
            distances.push(plain);
        }
        assert!(distances.contains(&PolygonDistance::Apart(0.0)));
        assert!(
            distances
                .iter()
                .any(|d| matches!(d, PolygonDistance::Apart(x) if *x > 1.0))
        );
    }
}
