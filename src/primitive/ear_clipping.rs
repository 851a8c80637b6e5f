//! A simple polygon split into triangles by clipping ears. Signs are exact, so that corners in a row, which rounding puts on either side of
//! the line, are where they are given.

use nalgebra::Vector2;
use robust::{Coord, orient2d};

type Point = Vector2<f64>;

/// Triangles that cover a polygon given counter-clockwise, as indices into its corners, with the pointed ones first. Corners may be straight;
/// the outline may touch itself, but `None` where edges cross.
pub fn triangulated(points: &[Point]) -> Option<Vec<[u32; 3]>> {
    if points.len() < 3 || has_crossing(points) {
        return None;
    }
    let mut outline = Outline::new(points);
    let mut triangles = Vec::with_capacity(points.len() - 2);
    for _ in 0..points.len() - 2 {
        let tip = outline.most_pointed_ear().or_else(|| {
            // What stood in the way of an ear may be clipped since.
            outline.find_all_ears();
            outline.most_pointed_ear()
        })?;
        triangles.push(outline.clip(tip));
    }
    Some(triangles)
}

/// Above 0 where c is to the left of the line from a to b.
fn turn(a: &Point, b: &Point, c: &Point) -> f64 {
    let exact = |p: &Point| Coord { x: p.x, y: p.y };
    orient2d(exact(a), exact(b), exact(c))
}

/// Whether two edges pass through each other; to touch is not to cross.
fn has_crossing(points: &[Point]) -> bool {
    let edge = |i: usize| [&points[i], &points[(i + 1) % points.len()]];
    let crosses = |i: usize, j: usize| {
        let ([a, b], [c, d]) = (edge(i), edge(j));
        let is_near =
            (0..2).all(|k| a[k].min(b[k]) <= c[k].max(d[k]) && c[k].min(d[k]) <= a[k].max(b[k]));
        let differ = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
        is_near && differ(turn(a, b, c), turn(a, b, d)) && differ(turn(c, d, a), turn(c, d, b))
    };
    (0..points.len()).any(|i| (i + 2..points.len()).any(|j| crosses(i, j)))
}

/// What is left of a polygon.
struct Outline<'a> {
    points: &'a [Point],
    corners: Vec<Corner>,
    /// The corners that are left.
    left: Vec<usize>,
}

#[derive(Clone, Copy)]
struct Corner {
    before: usize,
    after: usize,
    /// The interior angle is less than 180 degrees.
    is_convex: bool,
    /// It can be clipped. The cosine of its angle then.
    ear: Option<f64>,
}

impl<'a> Outline<'a> {
    fn new(points: &'a [Point]) -> Self {
        let count = points.len();
        let corner = |i: usize| Corner {
            before: (i + count - 1) % count,
            after: (i + 1) % count,
            is_convex: false,
            ear: None,
        };
        let mut outline = Self {
            points,
            corners: (0..count).map(corner).collect(),
            left: (0..count).collect(),
        };
        for i in 0..count {
            outline.corners[i].is_convex = outline.is_convex(i);
        }
        outline.find_all_ears();
        outline
    }

    fn find_all_ears(&mut self) {
        for k in 0..self.left.len() {
            let i = self.left[k];
            self.corners[i].ear = self.ear(i);
        }
    }

    /// A corner with those before and after it.
    fn around(&self, i: usize) -> [usize; 3] {
        [self.corners[i].before, i, self.corners[i].after]
    }

    fn is_convex(&self, i: usize) -> bool {
        let [a, b, c] = self.around(i).map(|k| &self.points[k]);
        turn(a, b, c) > 0.0
    }

    /// The cosine of a corner's angle if it can be clipped: nothing of the rest is in its triangle. If anything is, a corner is that is not
    /// convex: of those in it the one nearest to the tip.
    fn ear(&self, i: usize) -> Option<f64> {
        if !self.corners[i].is_convex {
            return None;
        }
        let around = self.around(i);
        let [a, b, c] = around.map(|k| &self.points[k]);
        let is_in_the_way = |&k: &usize| {
            let p = &self.points[k];
            if around.contains(&k) || self.corners[k].is_convex || p == a || p == c {
                return false;
            }
            if p == b {
                // Its edges may leave the tip through the triangle.
                let [before, _, after] = self.around(k).map(|k| &self.points[k]);
                return [before, after].map(|q| turn(a, b, q) > 0.0 && turn(b, c, q) > 0.0)
                    != [false; 2];
            }
            turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
        };
        if self.left.iter().any(is_in_the_way) {
            return None;
        }
        let cosine = (a - b).normalize().dot(&(c - b).normalize());
        Some(if cosine.is_nan() { -1.0 } else { cosine })
    }

    fn most_pointed_ear(&self) -> Option<usize> {
        let ears = self
            .left
            .iter()
            .filter_map(|&i| Some((i, self.corners[i].ear?)));
        let most = ears.max_by(|(_, a), (_, b)| a.total_cmp(b));
        most.map(|(i, _)| i)
    }

    /// Takes a corner away; its triangle.
    fn clip(&mut self, tip: usize) -> [u32; 3] {
        let triangle = self.around(tip);
        let [before, _, after] = triangle;
        self.left.retain(|&i| i != tip);
        self.corners[before].after = after;
        self.corners[after].before = before;
        for i in [before, after] {
            self.corners[i].is_convex = self.is_convex(i);
        }
        for i in [before, after] {
            self.corners[i].ear = self.ear(i);
        }
        triangle.map(|i| i as u32)
    }
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;

    fn below(random: &mut Random, n: u64) -> usize {
        (random.bits() % n) as usize
    }

    fn area(points: &[Point], corners: impl Iterator<Item = usize> + Clone) -> f64 {
        let ends = corners.clone().zip(corners.cycle().skip(1));
        0.5 * ends.map(|(i, j)| points[i].perp(&points[j])).sum::<f64>()
    }

    /// Whether a point is inside the outline, by the edges above it.
    fn is_inside(points: &[Point], p: &Point) -> bool {
        let above = (0..points.len()).filter(|&i| {
            let [a, b] = [&points[i], &points[(i + 1) % points.len()]];
            let is_over = (a.x > p.x) != (b.x > p.x);
            is_over && a.y + (b.y - a.y) * (p.x - a.x) / (b.x - a.x) > p.y
        });
        above.count() % 2 == 1
    }

    /// Checks that the triangles cover the polygon and nothing else, once.
    fn check(points: &[Point], random: &mut Random) {
        let triangles = triangulated(points).unwrap_or_else(|| panic!("{points:?}"));
        assert_eq!(triangles.len(), points.len() - 2);
        let corners = |t: &[u32; 3]| t.map(|i| points[i as usize]);
        for triangle in &triangles {
            let [a, b, c] = corners(triangle);
            assert!(turn(&a, &b, &c) > 0.0, "{triangle:?} of {points:?}");
        }
        let covered = triangles
            .iter()
            .map(|t| area(points, t.map(|i| i as usize).into_iter()));
        let whole = area(points, 0..points.len());
        assert!((covered.sum::<f64>() - whole).abs() < 1e-12 * whole.max(1.0));
        for _ in 0..100 {
            let p = Point::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0));
            let holding = triangles.iter().filter(|t| is_inside(&corners(t), &p));
            assert_eq!(
                holding.count(),
                usize::from(is_inside(points, &p)),
                "{p} {points:?}"
            );
        }
    }

    /// Around a point, with corners in a row on many edges, which rounding puts on either side of these.
    #[test]
    fn corners_in_a_row_are_no_crossing() {
        let mut random = Random::new(5);
        for _ in 0..2000 {
            let count = 3 + below(&mut random, 8);
            let angle = |i: usize| std::f64::consts::TAU * i as f64 / count as f64;
            let corners: Vec<Point> = (0..count)
                .map(|i| Point::new(angle(i).cos(), angle(i).sin()) * random.within(0.1, 1.0))
                .collect();
            let mut points = Vec::new();
            for i in 0..count {
                let (from, to) = (corners[i], corners[(i + 1) % count]);
                let parts = 1 + below(&mut random, 4);
                points.extend((0..parts).map(|k| from + (to - from) * (k as f64 / parts as f64)));
            }
            if points.len() > 3 {
                check(&points, &mut random);
            }
        }
    }

    #[test]
    fn a_stair_of_any_size_is_split() {
        let mut random = Random::new(6);
        let stair = [
            (2., 4.),
            (2., 3.),
            (3., 2.),
            (4., 1.),
            (5., 0.),
            (2.5, 0.),
            (1., 4.),
        ];
        for k in 1..2000 {
            let scale = 0.137 * f64::from(k);
            let points = stair.map(|(x, y)| Point::new(x, y) * scale / (5.0 * scale));
            let backwards: Vec<Point> = points.into_iter().rev().collect();
            check(&backwards, &mut random);
        }
    }

    /// A hole, joined to the outline by a bridge that is passed in both directions.
    #[test]
    fn a_hole_behind_a_bridge_stays_open() {
        let mut random = Random::new(7);
        for _ in 0..300 {
            let turn = random.within(0.0, 6.0);
            let ring = |radius: f64, count: usize, way: f64| -> Vec<Point> {
                let angle = |i: usize| turn + way * std::f64::consts::TAU * i as f64 / count as f64;
                let at = |i: usize| Point::new(angle(i).cos(), angle(i).sin()) * radius;
                (0..count).chain([0]).map(at).collect()
            };
            let (outer, inner) = (3 + below(&mut random, 7), 3 + below(&mut random, 7));
            let points = [ring(0.9, outer, 1.0), ring(0.3, inner, -1.0)].concat();
            check(&points, &mut random);
        }
    }

    #[test]
    fn edges_that_cross_are_told() {
        let star = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(2 * i) / 5.0;
            Point::new(angle.cos(), angle.sin())
        };
        let points: Vec<Point> = (0..5).map(star).collect();
        assert_eq!(triangulated(&points), None);
        let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| Point::new(x, y));
        assert_eq!(triangulated(&square).unwrap().len(), 2);
        let clockwise: Vec<Point> = square.into_iter().rev().collect();
        assert_eq!(triangulated(&clockwise), None);
    }
}
