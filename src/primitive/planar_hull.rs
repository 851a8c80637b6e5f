//! The convex hull of points in a plane, by Andrew's monotone chain; it keeps no collinear points.

use std::collections::HashMap;

use nalgebra::Vector2;

use crate::pose::Vec3;

/// Two unit vectors that form a right-handed frame with the unit vector `normal`.
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
pub fn monotone_chain(points: &[Vector2<f64>], mut distinct: Vec<u32>, tolerance: f64) -> Vec<u32> {
    let at = |i: u32| points[i as usize];
    distinct.sort_unstable_by(|&i, &j| {
        let (p, q) = (at(i), at(j));
        p.x.total_cmp(&q.x)
            .then(p.y.total_cmp(&q.y))
            .then(i.cmp(&j))
    });
    if distinct.len() < 3 {
        return distinct;
    }
    let chain = |indices: &mut dyn Iterator<Item = u32>| {
        let mut hull: Vec<u32> = Vec::with_capacity(8);
        for i in indices {
            while let [.., a, b] = hull[..] {
                let (edge, next) = (at(b) - at(a), at(i) - at(a));
                // Keep b only if it lies farther than the tolerance outside the line from a to i.
                if edge.perp(&next) > tolerance * next.norm() {
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
    hull
}

/// The corners of the hull of at least one point, in order; points on its edges are left out. Sorts the points.
pub fn outline(points: &mut [Vector2<f64>], corners: &mut Vec<Vector2<f64>>) {
    points.sort_unstable_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
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

    #[test]
    fn a_line_of_points_is_a_segment() {
        let points: Vec<_> = (0..5)
            .map(|i| Vector2::new(i as f64, 2.0 * i as f64))
            .collect();
        assert_eq!(convex_hull_2d(&points, 1e-12), vec![0, 4]);
    }
}
