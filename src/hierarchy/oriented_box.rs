//! A box along the principal axes of points: the wrapper where a hull has too many vertices (§2.3.4).

use nalgebra::SymmetricEigen;

use crate::pose::{Mat3, Vec3};

/// The eight corners of a box that covers the points, up to rounding.
pub fn oriented_box(points: &[Vec3]) -> Vec<Vec3> {
    let mean = points.iter().sum::<Vec3>() / points.len() as f64;
    let size = points
        .iter()
        .map(|p| (p - mean).amax())
        .fold(f64::MIN_POSITIVE, f64::max);
    let covariance: Mat3 = points
        .iter()
        .map(|p| (p - mean) / size)
        .map(|d| d * d.transpose())
        .sum();
    // The axes of coordinates are the fallback where they give the smaller box.
    let principal = SymmetricEigen::new(covariance).eigenvectors;
    [principal, Mat3::identity()]
        .iter()
        .map(|axes| corners_along(points, axes))
        .min_by(|a, b| surface(a).total_cmp(&surface(b)))
        .unwrap_or_default()
}

fn corners_along(points: &[Vec3], axes: &Mat3) -> Vec<Vec3> {
    let locals = points.iter().map(|p| axes.tr_mul(p));
    let first = axes.tr_mul(&points[0]);
    let (low, high) = locals.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)));
    (0..8)
        .map(|corner| {
            let pick = |axis: usize| {
                if corner >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            };
            axes * Vec3::new(pick(0), pick(1), pick(2))
        })
        .collect()
}

fn surface(corners: &[Vec3]) -> f64 {
    let side = |i: usize| (corners[i] - corners[0]).norm();
    let (x, y, z) = (side(1), side(2), side(4));
    x * y + y * z + z * x
}
