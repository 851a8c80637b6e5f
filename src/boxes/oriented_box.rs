//! A box of about the least volume around points: the wrapper where a hull has too many vertices (§2.3.4).

use nalgebra::{SymmetricEigen, Vector2};

use crate::pose::{Mat3, Vec3};
use crate::primitive::outline;

/// The eight corners of a box that covers the points, up to rounding.
///
/// Starts from the axes of coordinates and from the principal axes of few points that lie farthest out; each is turned
/// about its own three axes to the least rectangle (whose side lies along an edge of the projection's hull), twice.
pub fn oriented_box(points: &[Vec3], few: &[Vec3]) -> Vec<Vec3> {
    corners_along(points, &least_volume_axes(few))
}

/// The axes of that box.
pub fn least_volume_axes(few: &[Vec3]) -> Mat3 {
    let mut best = (f64::INFINITY, Mat3::identity());
    let mut turner = Turner::default();
    for start in [Mat3::identity(), principal_axes(few)] {
        let mut axes = shortest_first(few, &start);
        let mut size = measure(few, &axes);
        let (mut fruitless, mut enough) = (0, 3);
        for turn in 0..6 {
            let turned = turner.least_rectangle(few, &axes, turn % 3);
            let smaller = measure(few, &turned);
            if smaller < size {
                (size, axes) = (smaller, turned);
                // About the same axis nothing is left to be gained.
                (fruitless, enough) = (0, 2);
            } else {
                fruitless += 1;
            }
            if fruitless == enough {
                break;
            }
        }
        // The axes of coordinates are kept where nothing is gained: their boxes are exact.
        if size < best.0 * (1.0 - 1e-9) {
            best = (size, axes);
        }
    }
    best.1
}

/// The same axes, that along which points reach least first: turns about it gain most.
fn shortest_first(points: &[Vec3], axes: &Mat3) -> Mat3 {
    let (low, high) = span(points, axes);
    let shortest = (high - low).imin();
    let [first, second] =
        [(shortest + 1) % 3, (shortest + 2) % 3].map(|i| axes.column(i).into_owned());
    Mat3::from_columns(&[first.cross(&second), first, second])
}

pub fn principal_axes(points: &[Vec3]) -> Mat3 {
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
    SymmetricEigen::new(covariance).eigenvectors
}

/// Turns axes; its memory is used again and again.
#[derive(Default)]
struct Turner {
    flat: Vec<Vector2<f64>>,
    outline: Vec<Vector2<f64>>,
}

impl Turner {
    /// The axes turned about one of them so that the projection along it fills the least rectangle.
    fn least_rectangle(&mut self, points: &[Vec3], axes: &Mat3, about: usize) -> Mat3 {
        let (w, u, v) = (
            axes.column(about).into_owned(),
            axes.column((about + 1) % 3).into_owned(),
            axes.column((about + 2) % 3).into_owned(),
        );
        self.flat.clear();
        let flat = points.iter().map(|p| Vector2::new(u.dot(p), v.dot(p)));
        self.flat.extend(flat);
        outline(&mut self.flat, &mut self.outline);
        let along = self.side_of_least_rectangle();
        // Made upright again: errors would add up over the turns.
        let first = (u * along.x + v * along.y).normalize();
        let w = (w - first * first.dot(&w)).normalize();
        let mut turned = Mat3::zeros();
        turned.set_column(about, &w);
        turned.set_column((about + 1) % 3, &first);
        turned.set_column((about + 2) % 3, &w.cross(&first));
        turned
    }

    /// The direction of an edge of the outline along which the rectangle around it is least.
    fn side_of_least_rectangle(&self) -> Vector2<f64> {
        let mut best = (f64::INFINITY, Vector2::x());
        let mut from = self.outline[self.outline.len() - 1];
        for &to in &self.outline {
            let along = to - from;
            from = to;
            let across = Vector2::new(-along.y, along.x);
            let (mut low, mut high) = (
                Vector2::repeat(f64::INFINITY),
                Vector2::repeat(-f64::INFINITY),
            );
            for corner in &self.outline {
                let place = Vector2::new(along.dot(corner), across.dot(corner));
                (low, high) = (low.inf(&place), high.sup(&place));
            }
            let sides = high - low;
            let area = sides.x * sides.y / along.norm_squared();
            // Not so for an edge of no length, whose area is no number.
            if area < best.0 {
                best = (area, along);
            }
        }
        best.1.normalize()
    }
}

/// The box's volume, its sides lengthened a little so that flat boxes are told apart too.
fn measure(points: &[Vec3], axes: &Mat3) -> f64 {
    let (low, high) = span(points, axes);
    let sides = high - low;
    let least = 1e-3 * sides.amax();
    sides.iter().map(|side| side + least).product()
}

pub fn span(points: &[Vec3], axes: &Mat3) -> (Vec3, Vec3) {
    let first = axes.tr_mul(&points[0]);
    points
        .iter()
        .map(|p| axes.tr_mul(p))
        .fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)))
}

fn corners_along(points: &[Vec3], axes: &Mat3) -> Vec<Vec3> {
    let (low, high) = span(points, axes);
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
