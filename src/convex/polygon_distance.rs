//! The distance of two flat polygons, four edges at a time.

use super::closest::Closest;
use crate::lanes::{F64x4, Points64, along64, cross64, dot64, each3, splat64, sub64};
use crate::pose::{Pose, Vec3};
use crate::primitive::Feature;
use crate::tolerance;

/// Polygons of up to so many corners are measured four edges at a time.
pub const MOST_CORNERS: usize = 64;

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

    /// A corner and the edge that leaves it, the same in all lanes.
    #[inline(always)]
    fn edge(&self, i: usize) -> (Points64, Points64) {
        let next = if i + 1 == self.corners { 0 } else { i + 1 };
        let corner = |i: usize| {
            let block = &self.blocks[i / 4];
            each3(|k| F64x4::splat(block[k].0[i % 4]))
        };
        let start = corner(i);
        (start, sub64(&corner(next), &start))
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

    /// How far another polygon is from this one's plane, and on which side; negative where it reaches over to both, less
    /// far to the other side.
    #[inline(always)]
    fn side(&self, other: &Outline) -> Side {
        let (low, high) = other.extent_along(&self.normal.into());
        let (above, below) = (low - self.offset, self.offset - high);
        Side {
            gap: above.max(below),
            extreme: if above > below { low } else { high },
        }
    }

    /// The height of a point over the plane.
    #[inline(always)]
    fn height(&self, point: &Vec3) -> f64 {
        self.normal.dot(&(point - self.corner(0)))
    }

    /// A corner whose product with a direction is as given, one of the extremes.
    #[inline(always)]
    fn corner_with(&self, direction: &[f64; 3], extreme: f64) -> usize {
        for (block, corners) in self.blocks.iter().enumerate() {
            let along = along64(corners, direction);
            for lane in 0..4 {
                if along.0[lane] == extreme {
                    return 4 * block + lane;
                }
            }
        }
        0
    }

    /// The corner nearest to a point.
    #[inline(always)]
    fn corner_near(&self, point: &Vec3) -> usize {
        let point = splat64(&[point.x, point.y, point.z]);
        let (mut best, mut least) = (0, f64::INFINITY);
        for (block, corners) in self.blocks.iter().enumerate() {
            let apart = sub64(corners, &point);
            let squares = dot64(&apart, &apart);
            for lane in 0..4 {
                if squares.0[lane] < least {
                    (best, least) = (4 * block + lane, squares.0[lane]);
                }
            }
        }
        best
    }

    /// Whether the foot of a point is inside.
    #[inline(always)]
    fn is_under(&self, point: &Vec3) -> bool {
        let mut least = F64x4::splat(0.0);
        let normal = splat64(&self.normal.into());
        for (block, starts) in self.blocks.iter().enumerate() {
            let inwards = cross64(&normal, &sub64(&self.following(block), starts));
            let from_start = sub64(&splat64(&[point.x, point.y, point.z]), starts);
            least = least.min(dot64(&from_start, &inwards));
        }
        least.least() >= 0.0
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

/// Where a polygon is of another's plane: how far, and the product of the normal with its nearest corner.
#[derive(Clone, Copy)]
struct Side {
    gap: f64,
    extreme: f64,
}

/// What is known of the distance of two polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PolygonDistance {
    /// More than the cutoff.
    Beyond,
    /// The distance, and where.
    Apart(f64, Nearest),
    /// They surely cross.
    Cross,
    /// They may cross.
    Doubt,
}

/// Where two polygons that do not cross are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nearest {
    /// At a corner of the first, over the second.
    FirstCorner(usize),
    /// At a corner of the second, over the first.
    SecondCorner(usize),
    /// At the best of four pairs of edges, by the squares of their distances. A pair is called
    /// `MOST_CORNERS` * the block of the second's edges + the first's edge; the lane is the second's.
    Edges { squares: F64x4, pairs: F64x4 },
}

impl Nearest {
    /// The vector between the closest points, from the second polygon to the first.
    #[inline(always)]
    pub fn across(&self, a: &Outline, b: &Outline) -> Vec3 {
        match *self {
            Self::FirstCorner(corner) => b.normal * b.height(&a.corner(corner)),
            Self::SecondCorner(corner) => a.normal * -a.height(&b.corner(corner)),
            Self::Edges { squares, pairs } => {
                let [on_a, on_b] = edge_points(a, b, &squares, &pairs, 0.0).points;
                on_a - on_b
            }
        }
    }
}

/// The distance of two polygons whose coordinates are at most `size`, unless it is above `cutoff`.
///
/// All points compared belong to the polygons, so the least distance found is too large only by the rounding of the
/// places of the closest points, which moves them by a few EPSILON of `size`. A foot that rounding puts on the wrong side
/// of an edge is as near to that edge.
#[inline(always)]
pub fn polygon_distance(a: &Outline, b: &Outline, cutoff: f64, size: f64) -> PolygonDistance {
    let rounding = tolerance::INSIDE_DOUBT * size;
    let sides = [a.side(b), b.side(a)];
    let apart = sides[0].gap.max(sides[1].gap);
    if apart - rounding > cutoff {
        return PolygonDistance::Beyond;
    }
    if apart < rounding {
        match cross(a, b, size) {
            Some(false) => {}
            Some(true) => return PolygonDistance::Cross,
            None => return PolygonDistance::Doubt,
        }
    }
    let (distance, nearest) = nearest(a, b, &sides, size);
    if distance - rounding > cutoff {
        PolygonDistance::Beyond
    } else {
        PolygonDistance::Apart(distance, nearest)
    }
}

/// The closest points of polygons that do not cross, with the corners, edges and faces that hold them; `None` for those
/// that may. A point no farther than `error` from a corner is held by that.
pub fn polygon_closest(a: &Outline, b: &Outline, size: f64, error: f64) -> Option<Closest> {
    let PolygonDistance::Apart(distance, nearest) = polygon_distance(a, b, f64::INFINITY, size)
    else {
        return None;
    };
    let over = |polygon: &Outline, other: &Outline, corner: usize| {
        let point = other.corner(corner);
        let foot = point - polygon.normal * polygon.height(&point);
        let vertex = if corner < other.corners { corner } else { 0 };
        (
            [foot, point],
            [Feature::face(0), Feature::vertex(vertex as u32)],
        )
    };
    let (points, features) = match nearest {
        Nearest::FirstCorner(corner) => {
            let ([foot, point], [face, vertex]) = over(b, a, corner);
            ([point, foot], [vertex, face])
        }
        Nearest::SecondCorner(corner) => over(a, b, corner),
        Nearest::Edges { squares, pairs } => {
            let found = edge_points(a, b, &squares, &pairs, error);
            (found.points, found.features)
        }
    };
    Some(Closest {
        distance,
        points,
        features,
    })
}

/// The distance of polygons that do not cross, and where they are nearest.
///
/// If that is a corner over the other's inside, the plane there separates the two, and no corner is nearer to it. Of
/// several such corners some are inside, or an edge from one to another passes over the outline as near.
#[inline(always)]
fn nearest(a: &Outline, b: &Outline, sides: &[Side; 2], size: f64) -> (f64, Nearest) {
    let rounding = tolerance::INSIDE_DOUBT * size;
    if sides[0].gap >= rounding {
        let corner = b.corner_with(&a.normal.into(), sides[0].extreme);
        let point = b.corner(corner);
        if a.is_under(&point) {
            return (a.height(&point).abs(), Nearest::SecondCorner(corner));
        }
    }
    if sides[1].gap >= rounding {
        let corner = a.corner_with(&b.normal.into(), sides[1].extreme);
        let point = a.corner(corner);
        if b.is_under(&point) {
            return (b.height(&point).abs(), Nearest::FirstCorner(corner));
        }
    }
    let NearestEdges { squares, pairs } = nearest_edges(a, b, sides, size);
    let by_edges = (squares.least().sqrt(), Nearest::Edges { squares, pairs });
    if sides.iter().any(|side| side.gap.abs() < rounding) {
        nearest_corner(a, b, by_edges)
    } else {
        by_edges
    }
}

/// The nearest pairs of edges so far, lane by lane (see `Nearest::Edges`).
struct NearestEdges {
    squares: F64x4,
    pairs: F64x4,
}

impl NearestEdges {
    /// Compares an edge of A with all of B's.
    #[inline(always)]
    fn offer(&mut self, a: &Outline, i: usize, b: &Outline) {
        let (start, edge) = a.edge(i);
        let inverse_square = inverse(dot64(&edge, &edge));
        for block in 0..b.blocks.len() {
            let starts = &b.blocks[block];
            let along = sub64(&b.following(block), starts);
            let (_, _, squares) = edge_places(&start, &edge, inverse_square, starts, &along);
            let pair = F64x4::splat((MOST_CORNERS * block + i) as f64);
            for lane in 0..4 {
                let is_less = squares.0[lane] < self.squares.0[lane];
                self.pairs.0[lane] = if is_less {
                    pair.0[lane]
                } else {
                    self.pairs.0[lane]
                };
            }
            self.squares = squares.min(self.squares);
        }
    }
}

/// The nearest edges of two polygons. `sides` are as for `nearest`.
#[inline(always)]
fn nearest_edges(a: &Outline, b: &Outline, sides: &[Side; 2], size: f64) -> NearestEdges {
    let mut found = NearestEdges {
        squares: F64x4::splat(f64::INFINITY),
        pairs: F64x4::splat(0.0),
    };
    if a.corners <= 4 || !search_edges(a, b, sides, size, &mut found) {
        for i in 0..a.corners {
            found.offer(a, i, b);
        }
    }
    found
}

/// Compares those edges of A that meet in corners which look nearest, until a plane proves that no others are nearer.
#[inline(always)]
fn search_edges(
    a: &Outline,
    b: &Outline,
    sides: &[Side; 2],
    size: f64,
    found: &mut NearestEdges,
) -> bool {
    const TRIES: usize = 4;
    let mut corner = if sides[1].gap > sides[0].gap {
        a.corner_with(&b.normal.into(), sides[1].extreme)
    } else {
        let nearest = b.corner(b.corner_with(&a.normal.into(), sides[0].extreme));
        a.corner_near(&nearest)
    };
    let mut compared = 0u64;
    for _ in 0..TRIES {
        let corner_in = if corner < a.corners { corner } else { 0 };
        let before = if corner_in == 0 { a.corners } else { corner_in } - 1;
        for edge in [before, corner_in] {
            if compared >> edge & 1 == 0 {
                compared |= 1 << edge;
                found.offer(a, edge, b);
            }
        }
        let closest = edge_points(a, b, &found.squares, &found.pairs, 0.0);
        let across = closest.points[0] - closest.points[1];
        let direction: [f64; 3] = across.into();
        let nearest = a.extent_along(&direction).0;
        let gap = nearest - b.extent_along(&direction).1;
        let error = tolerance::CERTIFIED_GAP * size * closest.distance;
        if gap >= across.norm_squared() - error {
            return true;
        }
        corner = a.corner_with(&direction, nearest);
    }
    false
}

/// The nearer of what edges gave and of the corners over insides, when neither plane separates the polygons.
#[inline(never)]
fn nearest_corner(a: &Outline, b: &Outline, by_edges: (f64, Nearest)) -> (f64, Nearest) {
    let (mut distance, mut found) = by_edges;
    for (is_first, polygon, other) in [(false, a, b), (true, b, a)] {
        for (block, corners) in other.blocks.iter().enumerate() {
            let inside = innermost(polygon, corners);
            for lane in 0..4 {
                let corner = 4 * block + lane;
                let height = polygon.height(&other.corner(corner)).abs();
                if inside.0[lane] >= 0.0 && height < distance {
                    distance = height;
                    found = if is_first {
                        Nearest::FirstCorner(corner)
                    } else {
                        Nearest::SecondCorner(corner)
                    };
                }
            }
        }
    }
    (distance, found)
}

/// The closest points of the best of four pairs of edges.
#[inline(always)]
fn edge_points(a: &Outline, b: &Outline, squares: &F64x4, pairs: &F64x4, error: f64) -> Closest {
    let mut lane = 0;
    for other in 1..4 {
        if squares.0[other] < squares.0[lane] {
            lane = other;
        }
    }
    let pair = pairs.0[lane] as usize;
    let (block, i) = (pair / MOST_CORNERS, pair % MOST_CORNERS);
    let starts = &b.blocks[block];
    let along = sub64(&b.following(block), starts);
    let (start, edge) = a.edge(i);
    let inverse_square = inverse(dot64(&edge, &edge));
    let (s, t, _) = edge_places(&start, &edge, inverse_square, starts, &along);
    let places = [
        a.on_edge(i, s.0[lane], error),
        b.on_edge(4 * block + lane, t.0[lane], error),
    ];
    Closest {
        distance: squares.0[lane].sqrt(),
        points: places.map(|place| place.0),
        features: places.map(|place| place.1),
    }
}

/// Where an edge, the same in all lanes, and each of four others are closest, as parameters along them, and how far apart,
/// squared. `inverse_square` is of the first one's length.
///
/// The places along the lines are formed with the cross product of the directions, see `closest_parameters`.
#[inline(always)]
fn edge_places(
    p: &Points64,
    dp: &Points64,
    inverse_square: F64x4,
    q: &Points64,
    dq: &Points64,
) -> (F64x4, F64x4, F64x4) {
    let between = sub64(q, p);
    let cross = cross64(dp, dq);
    let square = dot64(&cross, &cross);
    let s = quotient(dot64(&cross64(&between, dq), &cross), square);
    let (b, e) = (dot64(dp, dq), dot64(dq, dq));
    let (c, f) = (dot64(dp, &between), dot64(dq, &between));
    // The best place on the other edge for s, then the best place on this one for that.
    let t = unit(quotient(b * unit(s) - f, e));
    let s = unit((b * t + c) * inverse_square);
    let apart = each3(|k| between[k] + dq[k] * t - dp[k] * s);
    (s, t, dot64(&apart, &apart))
}

/// The least of the areas that points span with the edges of a polygon, negative outside.
#[inline(always)]
fn innermost(polygon: &Outline, points: &Points64) -> F64x4 {
    let mut least = F64x4::splat(f64::INFINITY);
    let normal = splat64(&polygon.normal.into());
    for (block, starts) in polygon.blocks.iter().enumerate() {
        let inwards = cross64(&normal, &sub64(&polygon.following(block), starts));
        for lane in 0..(polygon.corners - 4 * block).min(4) {
            let start = each3(|k| F64x4::splat(starts[k].0[lane]));
            let inward = each3(|k| F64x4::splat(inwards[k].0[lane]));
            least = least.min(dot64(&sub64(points, &start), &inward));
        }
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

/// Whether two polygons cross that neither plane separates, as far as `pierces` can tell.
#[inline(always)]
fn cross(a: &Outline, b: &Outline, size: f64) -> Option<bool> {
    let rounding = tolerance::INSIDE_DOUBT * size;
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

/// 1 / a, and 0 where a is 0.
#[inline(always)]
fn inverse(a: F64x4) -> F64x4 {
    quotient(F64x4::splat(1.0), a)
}

#[inline(always)]
fn unit(x: F64x4) -> F64x4 {
    x.min(F64x4::splat(1.0)).max(F64x4::splat(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{Instructions, Plain, Work, with_widest};

    struct Measure<'a>(Outline<'a>, Outline<'a>);

    impl Work for Measure<'_> {
        type Output = PolygonDistance;

        #[inline(always)]
        fn run<I: Instructions>(self, _: I) -> PolygonDistance {
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
            let plain = Measure(a, b).run(Plain);
            assert_eq!(plain, with_widest(Measure(a, b)), "step {step}");
            distances.push(plain);
        }
        assert!(distances.contains(&PolygonDistance::Cross));
        assert!(
            distances
                .iter()
                .any(|d| matches!(d, PolygonDistance::Apart(x, _) if *x > 1.0))
        );
    }
}
