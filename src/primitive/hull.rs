//! The convex hull of points: parry's proposal, checked against every point and repaired if it lost some.

use std::collections::HashMap;

use super::planar_hull::plane_axes;
use super::point_tree::PointTree;
use crate::gjk::{DistanceLimits, PointCloud, Support, gjk};
use crate::parry_adapter::propose_hull;
use crate::pose::{Mat3, Vec3, rotation_about};

/// A proposed hull and its error.
pub struct CheckedHull {
    /// Indices of the corners into the given points.
    pub vertices: Vec<u32>,
    /// Outward triangles, indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
    /// An upper bound of the distance by which given points lie outside the corners' hull.
    pub excess: f64,
}

/// The best of a few proposals: the first whose excess is at most `accepted`, else the one of least excess. If a proposal lost
/// points, the next one is made of its corners and the lost points. If a third one still lost points, all begins anew in a
/// rotated frame. `None` when a hull has more than `vertex_limit` corners, or when nothing was proposed.
pub fn checked_hull(points: &[Vec3], accepted: f64, vertex_limit: usize) -> Option<CheckedHull> {
    checked_hull_that(points, accepted, vertex_limit, |_| true)
}

/// The same where `fits` says of a proposal that lost no points whether it will do; if not, all begins anew in a rotated frame. A
/// proposal may hold triangles that are no faces of the hull although its corners are the hull's.
pub fn checked_hull_that(
    points: &[Vec3],
    accepted: f64,
    vertex_limit: usize,
    mut fits: impl FnMut(&CheckedHull) -> bool,
) -> Option<CheckedHull> {
    let mut best: Option<CheckedHull> = None;
    let (center, stretch) = frame_of(points);
    for attempt in 0..6 {
        let turn = rotation_about(&Vec3::new(0.36, 0.48, 0.8), 0.7 * f64::from(attempt));
        let map = turn * stretch;
        let mut candidates: Vec<u32> = (0..points.len() as u32).collect();
        for _ in 0..3 {
            let Some((vertices, triangles)) = propose(points, &candidates, &center, &map) else {
                break;
            };
            if vertices.len() > vertex_limit {
                return None;
            }
            let (excess, lost) = excess_over(points, &vertices, accepted);
            let repaired: Vec<u32> = vertices.iter().chain(&lost).copied().collect();
            let hull = CheckedHull {
                vertices,
                triangles,
                excess,
            };
            if excess <= accepted {
                if fits(&hull) {
                    return Some(hull);
                }
                break;
            }
            if best.as_ref().is_none_or(|best| excess < best.excess) {
                best = Some(hull);
            }
            candidates = repaired;
        }
    }
    best
}

/// The largest distance of a point from the hull of the corners, and the points farther out than `accepted`. The time per point
/// grows with the logarithm of the number of corners.
pub fn excess_over(points: &[Vec3], corners: &[u32], accepted: f64) -> (f64, Vec<u32>) {
    let hull: Vec<Vec3> = corners.iter().map(|&i| points[i as usize]).collect();
    let mut is_corner = vec![false; points.len()];
    for &i in corners {
        is_corner[i as usize] = true;
    }
    // Up to this many corners, a linear scan is faster than the tree.
    const MAX_LINEAR: usize = 32;
    if hull.len() <= MAX_LINEAR {
        excess_beside(points, &is_corner, &PointCloud(&hull), accepted)
    } else {
        excess_beside(points, &is_corner, &PointTree::new(&hull), accepted)
    }
}

/// The same for the points that are not corners; the hull is given by its support function.
fn excess_beside(
    points: &[Vec3],
    is_corner: &[bool],
    hull: &impl Support,
    accepted: f64,
) -> (f64, Vec<u32>) {
    let mut excess = 0.0f64;
    let mut lost = Vec::new();
    for (i, point) in points.iter().enumerate() {
        if is_corner[i] {
            continue;
        }
        let outside = gjk(
            hull,
            &PointCloud(&[*point]),
            Vec3::zeros(),
            DistanceLimits::EXACT,
        );
        excess = excess.max(outside.attained);
        if outside.attained > accepted {
            lost.push(i as u32);
        }
    }
    (excess, lost)
}

/// The mean of the points, and a linear map that scales their three extents to unit size. Linear maps preserve hulls; flat and
/// needle-like sets, on which proposals fail, become round.
pub fn frame_of(points: &[Vec3]) -> (Vec3, Mat3) {
    let low = points.iter().fold(points[0], |low, p| low.inf(p));
    let high = points.iter().fold(points[0], |high, p| high.sup(p));
    // A point of the hull: the box's middle may lie far off the plane of a thin set.
    let center = points.iter().map(|p| p - low).sum::<Vec3>() / points.len() as f64 + low;
    let farthest = |part: &dyn Fn(Vec3) -> Vec3| {
        points
            .iter()
            .map(|p| part(p - center))
            .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
            .unwrap_or_else(Vec3::zeros)
    };
    let size = (high - low).amax().max(f64::MIN_POSITIVE);
    let mut rows = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| axis / size);
    let first = farthest(&|p| p);
    if let Some(e1) = first.try_normalize(0.0) {
        let second = farthest(&|p| p - e1 * e1.dot(&p));
        // An extent below this is rounding; scaling it up would only amplify noise.
        let least = 1e-13 * first.norm();
        let e2 = if second.norm() > least {
            // Orthogonalized once more: the width of a thin set carries a rounding error of EPSILON times its length.
            let e2 = second.normalize();
            (e2 - e1 * e1.dot(&e2)).normalize()
        } else {
            plane_axes(&e1).0
        };
        let e3 = e1.cross(&e2).normalize();
        let third = points
            .iter()
            .map(|p| e3.dot(&(p - center)).abs())
            .fold(0.0, f64::max);
        let stretch = |extent: f64| 1.0 / if extent > least { extent } else { first.norm() };
        rows = [
            e1 * stretch(first.norm()),
            e2 * stretch(second.norm()),
            e3 * stretch(third),
        ];
    }
    (center, Mat3::from_rows(&rows.map(|row| row.transpose())))
}

type Proposal = (Vec<u32>, Vec<[u32; 3]>);

/// One proposal of parry's, from the candidates mapped by `map`, as indices into `points`.
fn propose(points: &[Vec3], candidates: &[u32], center: &Vec3, map: &Mat3) -> Option<Proposal> {
    let moved: Vec<Vec3> = candidates
        .iter()
        .map(|&i| map * (points[i as usize] - center))
        .collect();
    let key = |p: &Vec3| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
    let index: HashMap<_, u32> = moved
        .iter()
        .map(key)
        .zip(candidates.iter().copied())
        .collect();
    let (vertices, triangles) = propose_hull(&moved)?;
    let vertices = vertices
        .iter()
        .map(|p| index.get(&key(p)).copied())
        .collect::<Option<Vec<u32>>>()?;
    Some((vertices, triangles))
}
