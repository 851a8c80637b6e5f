//! An oriented box of about the least volume: the wrapper if a hull has too many vertices (§2.3.4).

use nalgebra::{SymmetricEigen, Vector2};

use crate::pose::{Mat3, Vec3};
use crate::primitive::outline;

/// The eight corners of a box that covers the points, up to rounding.
///
/// Starts from the coordinate axes and from the principal axes of the extreme points `few`. Each start is rotated about its
/// own axes, each at most twice, to the least rectangle around the projection, which has a side along an edge of the
/// projection's hull.
pub fn oriented_box(points: &[Vec3], few: &[Vec3]) -> Vec<Vec3> {
    corners_along(points, &least_volume_axes(few))
}

/// The axes of the box of [`oriented_box`].
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
                // Another rotation about the same axis would gain nothing.
                (fruitless, enough) = (0, 2);
            } else {
                fruitless += 1;
            }
            if fruitless == enough {
                break;
            }
        }
        // The coordinate axes are kept unless another start gains: their boxes are exact.
        if size < best.0 * (1.0 - 1e-9) {
            best = (size, axes);
        }
    }
    best.1
}

/// Reorders axes, the one of the shortest extent first: rotations about it gain most.
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

/// Rotates axes; holds the scratch memory for that.
#[derive(Default)]
struct Turner {
    flat: Vec<Vector2<f64>>,
    outline: Vec<Vector2<f64>>,
}

impl Turner {
    /// The axes rotated about one of them to the least rectangle around the projection along it.
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
        // Orthonormalized again, or errors would add up over the rotations.
        let first = (u * along.x + v * along.y).normalize();
        let w = (w - first * first.dot(&w)).normalize();
        let mut turned = Mat3::zeros();
        turned.set_column(about, &w);
        turned.set_column((about + 1) % 3, &first);
        turned.set_column((about + 2) % 3, &w.cross(&first));
        turned
    }

    /// The direction of the outline's edge along which the bounding rectangle is least.
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
            // False for an edge without length, whose area is NaN.
            if area < best.0 {
                best = (area, along);
            }
        }
        best.1.normalize()
    }
}

/// The box's volume, its sides padded by 0.1 % of the longest so that flat boxes compare too.
fn measure(points: &[Vec3], axes: &Mat3) -> f64 {
    let (low, high) = span(points, axes);
    let sides = high - low;
    let padding = 1e-3 * sides.amax();
    sides.iter().map(|side| side + padding).product()
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
