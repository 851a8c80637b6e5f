//! The nearest edges of two polygons, four pairs at a time.

use super::closest::Closest;
use super::outline::{MAX_CORNERS, Outline, Side};
use crate::lanes::{DoubleTriple, Doubles, F64x4, Instructions, at64, cross64, dot64, sub64};
use crate::pose::Vec3;
use crate::tolerance;

/// The nearest pair of edges found so far in each lane, by squared distance. A pair is stored as `MAX_CORNERS` * the block of
/// B's edge + A's edge; the lane is that of B's edge within its block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestEdges {
    squares: F64x4,
    pairs: F64x4,
}

impl NearestEdges {
    #[inline(always)]
    pub fn distance(&self) -> f64 {
        self.squares.least().sqrt()
    }

    /// The vector between the closest points, from B to A.
    #[inline(always)]
    pub fn across<I: Instructions>(&self, a: &Outline<I>, b: &Outline<I>) -> Vec3 {
        let (i, block, lane) = self.best();
        let ((start, edge), (starts, along)) = (a.edge(i), b.edges(block));
        let inverse_square = dot64(&edge, &edge).inverse();
        let (s, t, _) = edge_places(&start, &edge, inverse_square, &starts, &along);
        let [x, y, z] = sub64(&at64(&start, &edge, s), &at64(&starts, &along, t));
        Vec3::new(x.array().0[lane], y.array().0[lane], z.array().0[lane])
    }

    /// The nearest pair: A's edge, then the block and the lane of B's edge.
    #[inline(always)]
    fn best(&self) -> (usize, usize, usize) {
        let mut lane = 0;
        for other in 1..4 {
            if self.squares.0[other] < self.squares.0[lane] {
                lane = other;
            }
        }
        let pair = self.pairs.0[lane] as usize;
        (pair % MAX_CORNERS, pair / MAX_CORNERS, lane)
    }

    /// The closest points. A point within `error` of a corner counts as that corner.
    #[inline(always)]
    pub fn points<I: Instructions>(&self, a: &Outline<I>, b: &Outline<I>, error: f64) -> Closest {
        let (i, block, lane) = self.best();
        let ((start, edge), (starts, along)) = (a.edge(i), b.edges(block));
        let inverse_square = dot64(&edge, &edge).inverse();
        let (s, t, _) = edge_places(&start, &edge, inverse_square, &starts, &along);
        let places = [
            a.on_edge(i, s.array().0[lane], error),
            b.on_edge(4 * block + lane, t.array().0[lane], error),
        ];
        Closest {
            distance: self.squares.0[lane].sqrt(),
            points: places.map(|place| place.0),
            features: places.map(|place| place.1),
            doubt: 0.0,
            depth: 0.0,
        }
    }
}

/// The search for the nearest edges, in registers.
struct Search<'a, I: Instructions> {
    a: &'a Outline<'a, I>,
    b: &'a Outline<'a, I>,
    squares: Doubles<I>,
    pairs: Doubles<I>,
}

impl<I: Instructions> Search<'_, I> {
    /// Compares an edge of A with all of B's.
    #[inline(always)]
    fn offer(&mut self, i: usize) {
        let (start, edge) = self.a.edge(i);
        let inverse_square = dot64(&edge, &edge).inverse();
        for block in 0..self.b.blocks.len() {
            let (starts, along) = self.b.edges(block);
            let (_, _, squares) = edge_places(&start, &edge, inverse_square, &starts, &along);
            let pair = self.a.splat((MAX_CORNERS * block + i) as f64);
            self.pairs = squares.chosen(self.squares, pair, self.pairs);
            self.squares = squares.min(self.squares);
        }
    }

    #[inline(always)]
    fn found(&self) -> NearestEdges {
        NearestEdges {
            squares: self.squares.array(),
            pairs: self.pairs.array(),
        }
    }
}

/// The nearest edges of two polygons, given the side of each other's plane on which they lie.
#[inline(always)]
pub fn nearest_edges<I: Instructions>(
    a: &Outline<I>,
    b: &Outline<I>,
    sides: &[Side; 2],
    size: f64,
) -> NearestEdges {
    let mut search = Search {
        a,
        b,
        squares: a.splat(f64::INFINITY),
        pairs: a.splat(0.0),
    };
    if a.corners <= 4 || !search_edges(&mut search, sides, size) {
        for i in 0..a.corners {
            search.offer(i);
        }
    }
    search.found()
}

/// Compares only A's edges at its nearest-looking corners, with all of B's. Returns true once a separating plane proves that no
/// other edge is nearer.
#[inline(always)]
fn search_edges<I: Instructions>(search: &mut Search<I>, sides: &[Side; 2], size: f64) -> bool {
    const TRIES: usize = 4;
    let (a, b) = (search.a, search.b);
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
                search.offer(edge);
            }
        }
        let closest = search.found().points(a, b, 0.0);
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

/// The closest points of one edge, the same in all lanes, and each of four others: their parameters, and the squared distance.
/// `inverse_square` is 1 / the squared length of the first edge.
///
/// The lines' parameters are computed from the cross product of the directions, see `closest_parameters`.
#[inline(always)]
fn edge_places<I: Instructions>(
    p: &DoubleTriple<I>,
    dp: &DoubleTriple<I>,
    inverse_square: Doubles<I>,
    q: &DoubleTriple<I>,
    dq: &DoubleTriple<I>,
) -> (Doubles<I>, Doubles<I>, Doubles<I>) {
    let between = sub64(q, p);
    let cross = cross64(dp, dq);
    let square = dot64(&cross, &cross);
    let s = dot64(&cross64(&between, dq), &cross).quotient(square);
    let (b, e) = (dot64(dp, dq), dot64(dq, dq));
    let (c, f) = (dot64(dp, &between), dot64(dq, &between));
    // The nearest point of the other edge for s, then the nearest point of this edge for that.
    let t = (b * s.unit() - f).quotient(e).unit();
    let s = ((b * t + c) * inverse_square).unit();
    let [x, y, z] = at64(&between, dq, t);
    let apart = [x - dp[0] * s, y - dp[1] * s, z - dp[2] * s];
    (s, t, dot64(&apart, &apart))
}
