//! A nearly least sphere around points (Bădoiu and Clarkson 2003: steps towards the farthest point).

use crate::boxes::Extent;
use crate::pose::Vec3;

/// The centre of a sphere around the points whose radius is within a few percent of the least.
pub fn bounding_sphere(points: &[Vec3]) -> Vec3 {
    let farthest = |center: &Vec3| -> (f64, Vec3) {
        let measured = points.iter().map(|p| ((p - center).norm_squared(), *p));
        measured.fold(
            (-1.0, *center),
            |best, next| {
                if next.0 > best.0 { next } else { best }
            },
        )
    };
    // The middle of the box is the report's centre; it is the best for many shapes, and never far off.
    let mut center = Extent::of(points).center();
    let mut best = (f64::INFINITY, center);
    let steps = if points.len() > 4096 { 8 } else { 24 };
    for step in 1..=steps {
        let (square, point) = farthest(&center);
        if square < best.0 {
            best = (square, center);
        }
        center += (point - center) / (f64::from(step) + 1.0);
    }
    best.1
}
