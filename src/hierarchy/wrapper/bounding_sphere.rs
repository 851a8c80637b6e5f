//! A nearly smallest enclosing sphere of points, by steps towards the farthest point (Bădoiu and Clarkson 2003).

use crate::boxes::Extent;
use crate::pose::Vec3;

/// The centre of an enclosing sphere whose radius is within a few percent of the smallest.
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
    // The centre of the box is the report's choice; it is the best for many shapes, and never far off.
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
