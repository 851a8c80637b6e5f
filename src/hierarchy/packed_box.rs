//! An oriented box in single precision that leaves no point out.

use super::oriented_box::{least_volume_axes, principal_axes, span};
use crate::pose::{Mat3, Vec3};
use crate::primitive::Convex;

/// The points x with |axis_i . (x - center)| <= half_i: slabs, so that it holds its points whatever rounding did to the
/// axes, which are orthonormal to within single precision.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct PackedBox {
    pub axes: [[f32; 3]; 3],
    pub center: [f32; 3],
    pub half: [f32; 3],
}

/// More points than this are worth a search for their axes.
const FEW: usize = 12;

/// A box of little surface around points grown by `excess`: distances are bounded best by boxes of little surface, as
/// those turn away the most of what comes from all sides. `flat` is a polygon among the points.
pub fn fit(points: &[Vec3], excess: f64, flat: Option<&Convex>) -> PackedBox {
    let mut best = (surface(points, &Mat3::identity()), Mat3::identity());
    let mut offer = |axes: Mat3| {
        let size = surface(points, &axes);
        // The axes of coordinates are kept where nothing is gained.
        if size < best.0 * (1.0 - 1e-6) {
            best = (size, axes);
        }
    };
    if points.len() > FEW {
        offer(least_volume_axes(points));
    }
    if let Some(axes) = flat.and_then(polygon_axes) {
        offer(axes);
    }
    offer(principal_axes(points));
    along(points, excess, &best.1)
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

fn along(points: &[Vec3], excess: f64, axes: &Mat3) -> PackedBox {
    let (low, high) = span(points, axes);
    let center = axes * ((low + high) * 0.5);
    let center: [f32; 3] = std::array::from_fn(|i| center[i] as f32);
    let axes: [[f32; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|k| axes[(k, i)] as f32));
    let from = Vec3::from(center.map(f64::from));
    let half = axes.map(|axis| {
        let axis = Vec3::from(axis.map(f64::from));
        let farthest = points
            .iter()
            .map(|p| axis.dot(&(p - from)).abs())
            .fold(0.0, f64::max);
        ((farthest + excess * axis.norm()) as f32).next_up()
    });
    PackedBox { axes, center, half }
}
