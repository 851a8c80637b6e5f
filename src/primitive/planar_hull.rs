//! The convex hull of points in a plane, by Andrew's monotone chain; it keeps no collinear points.

use std::cmp::Ordering;
use std::collections::HashMap;

use nalgebra::Vector2;
use robust::{Coord, orient2d};

use crate::pose::Vec3;

/// Two unit vectors that form a right-handed frame with the unit vector `normal`.
#[inline(always)]
pub fn plane_axes(normal: &Vec3) -> (Vec3, Vec3) {
    let other = match normal.iamin() {
        0 => Vec3::x(),
        1 => Vec3::y(),
        _ => Vec3::z(),
    };
    let first = normal.cross(&other).normalize();
    (first, normal.cross(&first))
}

/// Indices of the hull's corners, counter-clockwise from the leftmost. Points within `tolerance` of an edge, or of each
/// other, are dropped; so one index is a point, two a segment, more a polygon.
pub fn convex_hull_2d(points: &[Vector2<f64>], tolerance: f64) -> Vec<u32> {
    monotone_chain(points, without_near_points(points, tolerance), tolerance)
}

/// The same for the points of the given indices, which need not be distinct if the tolerance is 0.
///
/// The chains are those of the exact hull: where many points lie on a line up to rounding, a wrong sign would lose the line's end, and
/// with it a corner. Corners are dropped only afterwards.
pub fn monotone_chain(points: &[Vector2<f64>], mut distinct: Vec<u32>, tolerance: f64) -> Vec<u32> {
    let at = |i: u32| points[i as usize];
    distinct.sort_unstable_by(|&i, &j| from_left(&at(i), &at(j)).then(i.cmp(&j)));
    if distinct.len() < 3 {
        return distinct;
    }
    let exact = |i: u32| Coord {
        x: at(i).x,
        y: at(i).y,
    };
    let chain = |indices: &mut dyn Iterator<Item = u32>| {
        let mut hull: Vec<u32> = Vec::with_capacity(8);
        for i in indices {
            while let [.., a, b] = hull[..] {
                if orient2d(exact(a), exact(b), exact(i)) > 0.0 {
                    break;
                }
                hull.pop();
            }
            hull.push(i);
        }
        hull.pop();
        hull
    };
    let mut hull = chain(&mut distinct.iter().copied());
    hull.extend(chain(&mut distinct.iter().rev().copied()));
    if tolerance > 0.0 {
        simplified(points, hull, tolerance)
    } else {
        hull
    }
}

/// From left to right, then upwards. The two zeros are equal, as they are for the signs of areas.
fn from_left(p: &Vector2<f64>, q: &Vector2<f64>) -> Ordering {
    let along = |a: f64, b: f64| (a + 0.0).total_cmp(&(b + 0.0));
    along(p.x, q.x).then(along(p.y, q.y))
}

/// The corners of a strictly convex polygon, counter-clockwise, of which those within `tolerance` of an edge of the rest are left out.
fn simplified(points: &[Vector2<f64>], hull: Vec<u32>, tolerance: f64) -> Vec<u32> {
    let count = hull.len();
    let at = |place: usize| points[hull[place % count] as usize];
    // A corner to begin with that stays: no corner is farther from the first.
    let farthest = (0..count).max_by(|&i, &j| {
        let [p, q] = [i, j].map(|place| (at(place) - at(0)).norm_squared());
        p.total_cmp(&q)
    });
    let start = farthest.unwrap_or(0);
    // The corners from `from` on before `to` lie in the triangle of the edge between the two and the lines along the first and the last
    // edge that it would stand for.
    let is_flat = |from: usize, to: usize| {
        let edge = at(to) - at(from);
        let slopes = [at(from + 1) - at(from), at(to) - at(to - 1)].map(|side| {
            let along = side.dot(&edge);
            (along > 0.0).then(|| side.perp(&edge).abs() / along)
        });
        let [Some(first), Some(last)] = slopes else {
            return false;
        };
        let sum = first + last;
        sum == 0.0 || edge.norm() * (first / sum) * last <= tolerance
    };
    let mut kept = vec![start];
    let mut from = start;
    for place in start + 1..start + count {
        if !is_flat(from, place + 1) {
            kept.push(place);
            from = place;
        }
    }
    let mut kept: Vec<usize> = kept.into_iter().map(|place| place % count).collect();
    // The chains begin at the leftmost.
    kept.sort_unstable();
    kept.into_iter().map(|place| hull[place]).collect()
}

/// The corners of the hull of at least one point, in order; points on its edges are left out. Sorts the points.
pub fn outline(points: &mut [Vector2<f64>], corners: &mut Vec<Vector2<f64>>) {
    points.sort_unstable_by(from_left);
    corners.clear();
    let mut add = |first: usize, point: &Vector2<f64>| {
        while let [.., a, b] = corners[first..] {
            if (b - a).perp(&(point - a)) > 0.0 {
                break;
            }
            corners.pop();
        }
        corners.push(*point);
        corners.len()
    };
    let below = points.iter().map(|point| add(0, point)).last();
    // The last corner of one chain is the first of the other.
    let first = below.unwrap_or(1) - 1;
    for point in points.iter().rev().skip(1) {
        add(first, point);
    }
    if corners.len() > 1 {
        corners.pop();
    }
}

/// Indices of the points that are farther than the tolerance from all points kept before them.
fn without_near_points(points: &[Vector2<f64>], tolerance: f64) -> Vec<u32> {
    // Up to this many points, comparing all pairs is faster than hashing.
    const MAX_PAIRWISE: usize = 16;
    if points.len() > MAX_PAIRWISE {
        return without_near_points_of_many(points, tolerance);
    }
    let mut kept: Vec<u32> = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        let near = |other: &u32| (points[*other as usize] - point).norm() <= tolerance;
        if !kept.iter().any(near) {
            kept.push(i as u32);
        }
    }
    kept
}

/// The same by a hash grid with cells of the tolerance's size.
fn without_near_points_of_many(points: &[Vector2<f64>], tolerance: f64) -> Vec<u32> {
    let cell = tolerance.max(f64::MIN_POSITIVE);
    let mut grid: HashMap<(i64, i64), Vec<u32>> = HashMap::new();
    let mut kept = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        // Saturating is safe: points so far apart that cell numbers overflow are distinct anyway.
        let (x, y) = (
            (point.x / cell).floor() as i64,
            (point.y / cell).floor() as i64,
        );
        let near = |other: &u32| (points[*other as usize] - point).norm() <= tolerance;
        let known = (-1..=1).any(|dx| {
            (-1..=1).any(|dy| {
                let key = (x.saturating_add(dx), y.saturating_add(dy));
                grid.get(&key)
                    .is_some_and(|members| members.iter().any(near))
            })
        });
        if !known {
            grid.entry((x, y)).or_default().push(i as u32);
            kept.push(i as u32);
        }
    }
    kept
}

/// Indices of the hull of coplanar points, counter-clockwise around `normal`.
pub fn planar_ring(points: &[Vec3], normal: &Vec3, tolerance: f64) -> Vec<u32> {
    let (x, y) = plane_axes(normal);
    let flat: Vec<_> = points
        .iter()
        .map(|p| p - points[0])
        .map(|p| Vector2::new(x.dot(&p), y.dot(&p)))
        .collect();
    convex_hull_2d(&flat, tolerance)
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;

    #[test]
    fn keeps_corners_only() {
        let points: Vec<_> = [
            (0., 0.),
            (1., 0.),
            (2., 0.),
            (2., 2.),
            (0., 2.),
            (1., 1.),
            (0., 0.),
        ]
        .iter()
        .map(|&(x, y)| Vector2::new(x, y))
        .collect();
        assert_eq!(convex_hull_2d(&points, 1e-12), vec![0, 2, 3, 4]);
    }

    /// Points on a line up to rounding, in any direction and order: none is beyond the hull by more than the tolerance.
    #[test]
    fn no_end_of_a_line_is_lost() {
        let mut random = Random::new(7);
        let mut below = |n: u64| random.bits() % n;
        for case in 0..20_000 {
            // Mostly upright lines, turned by nothing, by rounding or by a little.
            let turn = [0.0, 1e-16, 1e-13, 1e-3, 0.7][case % 5];
            let (sine, cosine) = f64::sin_cos(turn);
            let count = 3 + below(6);
            let mut points: Vec<Vector2<f64>> = (0..count)
                .map(|_| Vector2::new(below(3) as f64, below(4) as f64 - 1.0))
                .map(|p| Vector2::new(cosine * p.x - sine * p.y, sine * p.x + cosine * p.y))
                .collect();
            let rounding = |k: u64| (k as f64 - 2.0) * 1e-16;
            points.iter_mut().for_each(|p| p.x += rounding(below(5)));
            let tolerance = 1e-12;
            let hull = convex_hull_2d(&points, tolerance);
            let corners: Vec<_> = hull.iter().map(|&i| points[i as usize]).collect();
            for p in &points {
                let gap = if corners.len() < 3 {
                    let (a, b) = (corners[0], corners[corners.len() - 1]);
                    let along = (b - a).norm_squared().max(1e-300);
                    let t = ((p - a).dot(&(b - a)) / along).clamp(0.0, 1.0);
                    (a + (b - a) * t - p).norm()
                } else {
                    let beyond = |i: usize| {
                        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                        -(b - a).normalize().perp(&(p - a))
                    };
                    (0..corners.len()).map(beyond).fold(0.0, f64::max)
                };
                assert!(
                    gap <= 3.0 * tolerance,
                    "case {case}: {gap:e} {points:?} {hull:?}"
                );
            }
        }
    }

    #[test]
    fn a_line_of_points_is_a_segment() {
        let points: Vec<_> = (0..5)
            .map(|i| Vector2::new(i as f64, 2.0 * i as f64))
            .collect();
        assert_eq!(convex_hull_2d(&points, 1e-12), vec![0, 4]);
    }
}
