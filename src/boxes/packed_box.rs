//! Oriented boxes in single precision, and how they are fitted to points.

use super::oriented_box::{least_volume_axes, principal_axes, span};
use crate::pose::{Mat3, Vec3};
use crate::primitive::Convex;

/// A box in two meanings, so that it can be relied on whatever rounding did to its axes, which are orthonormal to within
/// 2^-12: the points it holds are center + sum c_i axis_i with |c_i| <= half_i, and for them |axis_i . (x - center)| <=
/// half_i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PackedBox {
    pub axes: [[f32; 3]; 3],
    pub center: [f32; 3],
    pub half: [f32; 3],
}

/// More points than this are worth a search for their axes.
const FEW: usize = 5;

/// The axes of a box of little surface around points, that of its shortest side last: distances are bounded best by such
/// boxes, as those turn away the most of what comes from all sides. `flat` is a polygon among the points.
pub fn fitted_axes(points: &[Vec3], flat: Option<&Convex>) -> Mat3 {
    let searched = (points.len() > FEW).then(|| least_volume_axes(points));
    let natural = flat.and_then(polygon_axes);
    let natural = natural.unwrap_or_else(|| principal_axes(points));
    best_axes(points, searched.into_iter().chain([natural]))
}

/// The same without a search: in time that grows with the points alone.
pub fn simply_fitted_axes(points: &[Vec3]) -> Mat3 {
    best_axes(points, [principal_axes(points)])
}

fn best_axes(points: &[Vec3], offers: impl IntoIterator<Item = Mat3>) -> Mat3 {
    let mut best = (surface(points, &Mat3::identity()), Mat3::identity());
    for axes in offers {
        let size = surface(points, &axes);
        // The axes of coordinates are kept where nothing is gained.
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
    // Made upright once more: what is left of a small remainder leans.
    let y = (y - x * x.dot(&y)).normalize();
    Some(Mat3::from_columns(&[x, y, x.cross(&y)]))
}

fn surface(points: &[Vec3], axes: &Mat3) -> f64 {
    let (low, high) = span(points, axes);
    let [x, y, z]: [f64; 3] = (high - low).into();
    x * y + y * z + z * x
}
