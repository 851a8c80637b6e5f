//! Oriented boxes in single precision, and the choice of their axes for points.

use super::oriented_box::{least_volume_axes, principal_axes, span};
use crate::pose::{Mat3, Vec3};
use crate::primitive::Convex;

/// An oriented box whose axes are orthonormal to within 2^-12. It bounds its points in two senses, so that both are safe in
/// spite of rounding: a point x is center + sum c_i axis_i with |c_i| <= half_i, and |axis_i . (x - center)| <= half_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedBox {
    pub axes: [[f32; 3]; 3],
    pub center: [f32; 3],
    pub half: [f32; 3],
}

/// Above this many points the axes of least volume are searched for too. Searching from 6 points on instead of from 13 saved
/// 3 % of the boxes that queries test (`scripts/bench.sh kernel`; the table of axes in docs/benchmarks.md).
const MAX_UNSEARCHED: usize = 5;

/// The axes of a bounding box of small surface, the axis of its shortest side last. A small surface gives the best lower
/// bounds of distance over all directions. `flat` is the polygon that the points bound, if they bound one.
pub fn fitted_axes(points: &[Vec3], flat: Option<&Convex>) -> Mat3 {
    let searched = (points.len() > MAX_UNSEARCHED).then(|| least_volume_axes(points));
    let natural = flat.and_then(polygon_axes);
    let natural = natural.unwrap_or_else(|| principal_axes(points));
    best_axes(points, searched.into_iter().chain([natural]))
}

/// The same without a search, in linear time.
pub fn simply_fitted_axes(points: &[Vec3]) -> Mat3 {
    best_axes(points, [principal_axes(points)])
}

fn best_axes(points: &[Vec3], candidates: impl IntoIterator<Item = Mat3>) -> Mat3 {
    let mut best = (surface(points, &Mat3::identity()), Mat3::identity());
    for axes in candidates {
        let size = surface(points, &axes);
        // The coordinate axes are kept unless others gain.
        if size < best.0 * (1.0 - 1e-6) {
            best = (size, axes);
        }
    }
    shortest_last(points, &best.1)
}

fn shortest_last(points: &[Vec3], axes: &Mat3) -> Mat3 {
    let (low, high) = span(points, axes);
    let shortest = (high - low).imin();
    let [first, second] =
        [(shortest + 1) % 3, (shortest + 2) % 3].map(|i| axes.column(i).into_owned());
    Mat3::from_columns(&[first, second, first.cross(&second)])
}

/// The frame of a polygon's longest edge and normal.
fn polygon_axes(polygon: &Convex) -> Option<Mat3> {
    let normal = polygon.faces.first()?.normal;
    let edge = polygon
        .edges
        .iter()
        .map(|&[i, j]| polygon.vertices[j as usize] - polygon.vertices[i as usize])
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
    frame(&normal, &edge)
}

/// The frame whose first axis is `first`, and whose second lies in the plane of both.
fn frame(first: &Vec3, second: &Vec3) -> Option<Mat3> {
    let x = first.try_normalize(0.0)?;
    let y = (second - x * x.dot(second)).try_normalize(0.0)?;
    // Orthogonalized once more: a small remainder still has a component along x.
    let y = (y - x * x.dot(&y)).normalize();
    Some(Mat3::from_columns(&[x, y, x.cross(&y)]))
}

fn surface(points: &[Vec3], axes: &Mat3) -> f64 {
    let (low, high) = span(points, axes);
    let [x, y, z]: [f64; 3] = (high - low).into();
    x * y + y * z + z * x
}
