//! The distance of two convex hulls by brute force, with a proof: points of both sets from above, a supporting direction
//! from below. It knows vertices only; no hull, no features, no GJK.

use cstk::pose::{Pose, Vec3};

/// What is known of a distance. Both ends are right to a few roundings of the largest coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The largest gap that a direction proves; negative for sets that overlap, and then minus their depth.
    pub gap: f64,
    /// The distance of two points, one of each set; 0 for sets that overlap.
    pub upper: f64,
}

impl Bounds {
    pub fn lower(&self) -> f64 {
        self.gap.max(0.0)
    }
}

/// The largest projection gap along `n`, from B to A.
pub fn gap_along(a: &[Vec3], b: &[Vec3], n: &Vec3) -> f64 {
    let low = a.iter().map(|p| n.dot(p)).fold(f64::INFINITY, f64::min);
    let high = b.iter().map(|p| n.dot(p)).fold(f64::NEG_INFINITY, f64::max);
    low - high
}

/// Bounds of the distance of the hulls of `a` and `b`.
///
/// The closest points of two hulls lie on a vertex and a triangle, or on two segments; taking all triples and pairs of
/// vertices enumerates more of them than the hulls have, but all of them belong to the hulls. Sets that overlap have no
/// separating direction among the triples' normals, the pairs' cross products and, for flat sets, the outline's normals.
pub fn hull_distance(a: &[Vec3], b: &[Vec3]) -> Bounds {
    // Around one point of A nothing is lost to the frame.
    let origin = a[0];
    let a: Vec<Vec3> = a.iter().map(|p| p - origin).collect();
    let b: Vec<Vec3> = b.iter().map(|p| p - origin).collect();
    let nearest = nearest_points(&a, &b);
    let between = nearest[0] - nearest[1];
    let mut gap = f64::NEG_INFINITY;
    let mut offer = |n: Vec3| {
        if let Some(n) = n.try_normalize(0.0) {
            gap = gap.max(gap_along(&a, &b, &n)).max(gap_along(&a, &b, &-n));
        }
    };
    offer(between);
    let (edges_a, edges_b) = (edges(&a), edges(&b));
    for e in edges_a.iter().chain(&edges_b) {
        // Close points lose the direction's digits, but it stands upright on the edge they lie on.
        offer(between - e * e.dot(&between));
    }
    for e in &edges_a {
        for f in &edges_b {
            offer(e.cross(f));
        }
    }
    for points in [&a, &b] {
        for n in triples(points).map(|[p, q, r]| (q - p).cross(&(r - p))) {
            offer(n);
            if points.len() <= 6 {
                edges(points).iter().for_each(|e| offer(n.cross(e)));
            }
        }
    }
    Bounds {
        gap,
        upper: if gap > 0.0 { between.norm() } else { 0.0 },
    }
}

/// The nearest two points found among vertices over triangles and segments over segments.
fn nearest_points(a: &[Vec3], b: &[Vec3]) -> [Vec3; 2] {
    let mut best = [a[0], b[0]];
    let mut offer = |p: Vec3, q: Vec3| {
        if (p - q).norm_squared() < (best[0] - best[1]).norm_squared() {
            best = [p, q];
        }
    };
    for p in a {
        for t in triples(b) {
            over_triangle(p, &t).into_iter().for_each(|q| offer(*p, q));
        }
    }
    for q in b {
        for t in triples(a) {
            over_triangle(q, &t).into_iter().for_each(|p| offer(p, *q));
        }
    }
    for s in segments(a) {
        for t in segments(b) {
            between_segments(&s, &t, &mut offer);
        }
    }
    best
}

fn segments(points: &[Vec3]) -> Vec<[Vec3; 2]> {
    let n = points.len();
    if n == 1 {
        return vec![[points[0]; 2]];
    }
    (0..n)
        .flat_map(|i| (i + 1..n).map(move |j| [points[i], points[j]]))
        .collect()
}

fn edges(points: &[Vec3]) -> Vec<Vec3> {
    segments(points)
        .iter()
        .filter_map(|[p, q]| (q - p).try_normalize(0.0))
        .collect()
}

fn triples(points: &[Vec3]) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    let n = points.len();
    (0..n).flat_map(move |i| {
        (i + 1..n).flat_map(move |j| (j + 1..n).map(move |k| [points[i], points[j], points[k]]))
    })
}

/// The point of a triangle straight under `p`, if there is one.
fn over_triangle(p: &Vec3, [a, b, c]: &[Vec3; 3]) -> Option<Vec3> {
    let (u, v) = (b - a, c - a);
    let n = u.cross(&v);
    let square = n.norm_squared();
    if square == 0.0 {
        return None;
    }
    // Refined from what is left: the first solution for a sliver has few digits.
    let (mut s, mut t) = (0.0, 0.0);
    for _ in 0..4 {
        let rest = p - (a + u * s + v * t);
        s += rest.cross(&v).dot(&n) / square;
        t += u.cross(&rest).dot(&n) / square;
    }
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then(|| a + u * s + v * t)
}

fn between_segments(p: &[Vec3; 2], q: &[Vec3; 2], offer: &mut impl FnMut(Vec3, Vec3)) {
    for end in p {
        offer(*end, on_segment(end, q));
    }
    for end in q {
        offer(on_segment(end, p), *end);
    }
    let (u, v) = (p[1] - p[0], q[1] - q[0]);
    let n = u.cross(&v);
    let square = n.norm_squared();
    if square == 0.0 {
        return;
    }
    let (mut s, mut t) = (0.0, 0.0);
    for _ in 0..4 {
        let rest = (q[0] + v * t) - (p[0] + u * s);
        s += rest.cross(&v).dot(&n) / square;
        t += rest.cross(&u).dot(&n) / square;
    }
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        offer(p[0] + u * s, q[0] + v * t);
    }
}

fn on_segment(p: &Vec3, [a, b]: &[Vec3; 2]) -> Vec3 {
    let u = b - a;
    let square = u.norm_squared();
    if square == 0.0 {
        return *a;
    }
    let mut s = 0.0f64;
    for _ in 0..3 {
        s = (s + u.dot(&(p - (a + u * s))) / square).clamp(0.0, 1.0);
    }
    if s == 1.0 { *b } else { a + u * s }
}

/// `pose v - origin`, summed in twice the precision and rounded once.
pub fn moved_exactly(v: &Vec3, pose: &Pose, origin: &Vec3) -> Vec3 {
    Vec3::from_fn(|i, _| {
        let (mut high, mut low) = (pose.translation[i], 0.0);
        let mut add = |x: f64| {
            let sum = high + x;
            let part = sum - high;
            low += (high - (sum - part)) + (x - part);
            high = sum;
        };
        add(-origin[i]);
        for j in 0..3 {
            let (r, x) = (pose.rotation[(i, j)], v[j]);
            let product = r * x;
            add(product);
            add(r.mul_add(x, -product));
        }
        high + low
    })
}
