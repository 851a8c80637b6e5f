//! Whether wrappers contain points, proven without rounding: spheres by exact arithmetic, hulls by convex weights whose
//! residual is computed exactly. It knows a wrapper's numbers only; nothing of how the library bounds distances.

use cstk::hierarchy::wrapper::Wrapper;
use cstk::pose::Vec3;

use super::expansion::{Expansion, exact_difference};

/// Rounding of a few operations on positive numbers.
const FEW_ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// Whether `|p - center| <= radius`, exactly.
pub fn in_sphere(p: &Vec3, center: &Vec3, radius: f64) -> bool {
    // Nearly always this decides.
    if (p - center).norm_squared() * (1.0 + FEW_ROUNDINGS) < radius * radius * (1.0 - FEW_ROUNDINGS)
    {
        return true;
    }
    let mut excess = Expansion::default();
    for axis in 0..3 {
        let [high, low] = exact_difference(p[axis], center[axis]);
        excess.add_product(high, high);
        excess.add_product(2.0 * high, low);
        excess.add_product(low, low);
    }
    excess.add_product(radius, -radius);
    excess.sign() <= 0
}

/// Whether `p` is proven to lie within the wrapper's excess, plus `more`, of the hull of its corners.
pub fn in_hull(p: &Vec3, wrapper: &Wrapper, more: f64) -> bool {
    let corners = wrapper.corners;
    let excess = wrapper.excess + more;
    if let [center] = corners {
        return in_sphere(p, center, excess);
    }
    if corners.contains(p) {
        return true;
    }
    if let Some(outside) = outside_aligned_box(p, corners) {
        // Else the weights may still prove it; a box is its own hull either way.
        if outside <= excess {
            return true;
        }
    }
    if let Ok(corners) = <&[Vec3; 8]>::try_from(corners) {
        let weights = box_weights(p, corners);
        if residual(p, corners, &weights) <= excess {
            return true;
        }
    }
    nearest(p, corners, excess) <= excess
}

/// A bound of the distance of `p` from a box of the axes of coordinates, exactly 0 inside; `None` where the corners are
/// not those of such a box.
fn outside_aligned_box(p: &Vec3, corners: &[Vec3]) -> Option<f64> {
    let low = corners.iter().fold(corners[0], |low, c| low.inf(c));
    let high = corners.iter().fold(corners[0], |high, c| high.sup(c));
    let is_corner = |i: usize| {
        let corner = Vec3::from_fn(|axis, _| [low, high][i >> axis & 1][axis]);
        corners.contains(&corner)
    };
    (corners.len() == 8 && (0..8).all(is_corner)).then(|| {
        let outside = (low - p).sup(&(p - high)).sup(&Vec3::zeros());
        outside.norm() * (1.0 + FEW_ROUNDINGS)
    })
}

/// The weights of the corners of a box, the first along x changing fastest, at about `p`.
fn box_weights(p: &Vec3, corners: &[Vec3; 8]) -> Vec<(usize, f64)> {
    let sides = [1, 2, 4].map(|i| corners[i] - corners[0]);
    let shares = least_squares(&sides, &(p - corners[0])).map_or([0.0; 3], |shares| {
        [0, 1, 2].map(|axis| shares[axis].clamp(0.0, 1.0))
    });
    (0..8)
        .map(|i| {
            let factor = |axis: usize| [1.0 - shares[axis], shares[axis]][i >> axis & 1];
            (i, factor(0) * factor(1) * factor(2))
        })
        .collect()
}

/// The distance of `p` from the mean of corners with the given weights, which are not negative; rounded up.
fn residual(p: &Vec3, corners: &[Vec3], weights: &[(usize, f64)]) -> f64 {
    let square: f64 = (0..3)
        .map(|axis| {
            let mut sum = Expansion::default();
            for &(i, weight) in weights {
                for part in exact_difference(corners[i][axis], p[axis]) {
                    sum.add_product(weight, part);
                }
            }
            sum.magnitude().powi(2)
        })
        .sum();
    let total: f64 = weights.iter().map(|(_, weight)| weight).sum();
    square.sqrt() / total * (1.0 + FEW_ROUNDINGS)
}

/// The least residual found: the point of the corners' hull nearest to `p`, by support points and the best of all
/// simplices of the last ones. Ends as soon as it is at most `enough`.
fn nearest(p: &Vec3, corners: &[Vec3], enough: f64) -> f64 {
    let seen: Vec<Vec3> = corners.iter().map(|c| c - p).collect();
    let first = (0..seen.len()).min_by(|&i, &j| seen[i].norm().total_cmp(&seen[j].norm()));
    let mut simplex = vec![first.unwrap_or(0)];
    let mut best = f64::INFINITY;
    for _ in 0..100 {
        let (weights, point) = nearest_of_simplex(&seen, &simplex);
        best = best.min(residual(p, corners, &weights));
        if best <= enough {
            break;
        }
        simplex = weights.iter().map(|(i, _)| *i).collect();
        let along = |i: &usize| seen[*i].dot(&point);
        let support = (0..seen.len()).min_by(|i, j| along(i).total_cmp(&along(j)));
        let Some(support) = support.filter(|i| !simplex.contains(i)) else {
            break;
        };
        if simplex.len() == 4 {
            break;
        }
        simplex.push(support);
    }
    best
}

/// The nearest point to the origin of the hull of up to four points, with the positive weights that give it.
fn nearest_of_simplex(points: &[Vec3], simplex: &[usize]) -> (Vec<(usize, f64)>, Vec3) {
    let mut best = (Vec::new(), Vec3::repeat(f64::INFINITY));
    for set in 1..1usize << simplex.len() {
        let members: Vec<usize> = (0..simplex.len())
            .filter(|k| set >> k & 1 == 1)
            .map(|k| simplex[k])
            .collect();
        let base = points[members[0]];
        let sides: Vec<Vec3> = members[1..].iter().map(|&i| points[i] - base).collect();
        let Some(shares) = least_squares(&sides, &-base) else {
            continue;
        };
        let mut weights: Vec<f64> = vec![1.0 - shares.iter().sum::<f64>()];
        weights.extend(shares);
        if weights.iter().any(|weight| *weight < -1e-9) {
            continue;
        }
        let weights: Vec<(usize, f64)> = members
            .into_iter()
            .zip(weights)
            .filter(|(_, weight)| *weight > 0.0)
            .collect();
        let point: Vec3 = weights.iter().map(|(i, weight)| points[*i] * *weight).sum();
        if point.norm() < best.1.norm() {
            best = (weights, point);
        }
    }
    best
}

/// The multiples of up to three vectors whose sum comes nearest to `target`; refined, so that thin sets have it too.
/// `None` where they are not finite.
fn least_squares(vectors: &[Vec3], target: &Vec3) -> Option<Vec<f64>> {
    // The directions of short vectors are known worst.
    let mut order: Vec<usize> = (0..vectors.len()).collect();
    order.sort_by(|&i, &j| vectors[j].norm().total_cmp(&vectors[i].norm()));
    let mut upright: Vec<Vec3> = vec![Vec3::zeros(); vectors.len()];
    for (k, &i) in order.iter().enumerate() {
        let mut rest = vectors[i];
        for _ in 0..2 {
            for &j in &order[..k] {
                rest -= upright[j] * upright[j].dot(&rest);
            }
        }
        upright[i] = rest.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
    }
    let mut shares = vec![0.0; vectors.len()];
    for _ in 0..3 {
        let taken: Vec3 = vectors.iter().zip(&shares).map(|(v, s)| v * *s).sum();
        let mut rest = target - taken;
        for &i in order.iter().rev() {
            let along = upright[i].dot(&vectors[i]);
            let step = if along == 0.0 {
                0.0
            } else {
                upright[i].dot(&rest) / along
            };
            shares[i] += step;
            rest -= vectors[i] * step;
        }
    }
    shares.iter().all(|s| s.is_finite()).then_some(shares)
}
