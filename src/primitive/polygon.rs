//! A planar convex polygon, and the checks that it is one.

use smallvec::SmallVec;

use super::Convex;
use super::planar_hull::planar_ring;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::pose::Vec3;
use crate::tolerance;

/// A polygon from its vertices in cyclic order, clockwise or counter-clockwise. Vertices on a straight edge are kept.
pub fn convex_polygon(vertices: &[Vec3]) -> Result<Convex> {
    let normal = check_convex_polygon(vertices)?;
    // The face is bounded by the strictly convex outline, because the direction of a tiny or straight edge is unreliable.
    let mut corners = planar_ring(vertices, &normal, extent_of(vertices)?.tolerance);
    if corners.len() < 3 {
        corners = (0..vertices.len() as u32).collect();
    }
    corners.sort_unstable();
    Ok(Convex::from_cycle(
        SmallVec::from_slice(vertices),
        corners,
        normal,
    ))
}

/// The size of a set of points: the diameter and longest side of their box, and the tolerance for vertices that follows.
pub(super) struct Extent {
    pub diameter: f64,
    pub spread: f64,
    pub tolerance: f64,
}

/// The extent of a set of points, whose coordinates must be finite and within the accepted range.
pub(super) fn extent_of(points: &[Vec3]) -> Result<Extent> {
    let mut low = points[0];
    let mut high = points[0];
    let mut largest = 0.0f64;
    for (i, point) in points.iter().enumerate() {
        require_finite(point.as_slice(), "coordinate")
            .map_err(|e| e.within(format_args!("vertex {i}")))?;
        low = low.inf(point);
        high = high.sup(point);
        largest = largest.max(point.amax());
    }
    if largest > tolerance::LARGEST_COORDINATE {
        return Err(Error::invalid(format!(
            "a coordinate is too large: {largest:e}; at most {:e}",
            tolerance::LARGEST_COORDINATE
        )));
    }
    let diameter = (high - low).norm();
    Ok(Extent {
        diameter,
        spread: (high - low).amax(),
        tolerance: tolerance::PLANAR * diameter + 4.0 * tolerance::EPSILON * largest,
    })
}

/// Twice the area vector, by Newell's method: robust for any simple polygon.
fn newell_sum(vertices: &[Vec3]) -> Vec3 {
    let origin = vertices[0];
    (0..vertices.len())
        .map(|i| {
            let a = vertices[i] - origin;
            let b = vertices[(i + 1) % vertices.len()] - origin;
            a.cross(&b)
        })
        .sum()
}

/// The unit normal of a simple polygon; `None` if the area vector cancels: the outline crosses itself or has no area.
pub(super) fn newell_normal(vertices: &[Vec3]) -> Option<Vec3> {
    let sum = newell_sum(vertices);
    let (length, width) = length_and_width(vertices);
    (sum.norm() > 1e-9 * length * width)
        .then(|| sum.try_normalize(0.0))
        .flatten()
}

/// A normal without its component along the polygon's longest edge. The cross products of a needle leave a tilt of about
/// EPSILON length / width along the needle, which would lift its far end off the plane.
pub(super) fn upright(normal: &Vec3, vertices: &[Vec3]) -> Vec3 {
    let along = (0..vertices.len())
        .map(|i| vertices[(i + 1) % vertices.len()] - vertices[i])
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
        .and_then(|edge| edge.try_normalize(0.0))
        .unwrap_or_else(Vec3::zeros);
    (normal - along * along.dot(normal)).normalize()
}

/// The largest distance of a vertex from the first one, and of a vertex from the line through these two.
fn length_and_width(vertices: &[Vec3]) -> (f64, f64) {
    let from_first = |v: &Vec3| v - vertices[0];
    let farthest = vertices
        .iter()
        .map(from_first)
        .max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
        .unwrap_or_else(Vec3::zeros);
    let Some(along) = farthest.try_normalize(0.0) else {
        return (0.0, 0.0);
    };
    let width = vertices
        .iter()
        .map(|v| along.cross(&from_first(v)).norm())
        .fold(0.0, f64::max);
    (farthest.norm(), width)
}

/// The unit normal of a convex planar polygon, or an error with the reason why it is not one.
pub(super) fn check_convex_polygon(vertices: &[Vec3]) -> Result<Vec3> {
    let n = vertices.len();
    if n < 3 {
        return Err(Error::new(
            if n == 0 {
                ErrorKind::Empty
            } else {
                ErrorKind::Degenerate
            },
            format!("a polygon needs at least 3 vertices, got {n}"),
        ));
    }
    let extent = extent_of(vertices)?;
    if extent.diameter < tolerance::SMALLEST_DIAMETER {
        return Err(Error::new(
            ErrorKind::Degenerate,
            format!(
                "the polygon has no extent: its diameter is {:e}",
                extent.diameter
            ),
        ));
    }
    let edge = |i: usize| vertices[(i + 1) % n] - vertices[i % n];
    for i in 0..n {
        if edge(i).norm() <= extent.tolerance {
            return Err(Error::new(
                ErrorKind::Degenerate,
                format!("vertices {i} and {} coincide", (i + 1) % n),
            ));
        }
    }
    let (length, width) = length_and_width(vertices);
    if width <= extent.tolerance {
        return Err(Error::new(
            ErrorKind::Degenerate,
            format!("the polygon has no area: its width is {width:e}"),
        ));
    }
    // A convex outline has at least the area of the triangle of this length and width; the area of one that crosses itself may
    // cancel.
    let sum = newell_sum(vertices);
    if sum.norm() < 0.5 * length * width {
        return Err(Error::new(
            ErrorKind::NotConvex,
            "the outline turns inwards or crosses itself",
        ));
    }
    let normal = upright(&sum.normalize(), vertices);
    for (i, vertex) in vertices.iter().enumerate() {
        let height = normal.dot(&(vertex - vertices[0])).abs();
        if height > extent.tolerance {
            return Err(Error::new(
                ErrorKind::NotPlanar,
                format!(
                    "vertex {i} is {height:.3e} off the plane of the polygon (allowed {:.1e}); add it as a mesh to have it split",
                    extent.tolerance
                ),
            ));
        }
    }
    let mut turning = 0.0;
    for i in 0..n {
        let (before, after) = (edge(i + n - 1), edge(i));
        let sine = normal.dot(&before.cross(&after));
        if sine < -extent.tolerance * before.norm().max(after.norm()) {
            return Err(Error::new(
                ErrorKind::NotConvex,
                format!("the polygon turns inwards at vertex {i}"),
            ));
        }
        turning += sine.atan2(before.dot(&after));
    }
    if turning > 2.5 * std::f64::consts::PI {
        return Err(Error::new(
            ErrorKind::NotConvex,
            "the polygon winds around more than once",
        ));
    }
    Ok(normal)
}

/// The unit normal of a triangle that is far from having no area, without most of the work of [`check_convex_polygon`];
/// `None` if that should decide.
pub(super) fn quick_triangle_normal([a, b, c]: [&Vec3; 3]) -> Option<Vec3> {
    /// The least height, times the longest edge. The normal of such a triangle needs no correction: its tilt lifts no vertex
    /// off the plane by more than some 100 EPSILON of the longest edge.
    const LEAST_HEIGHT: f64 = 0.02;
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let (x, y, z) = (ab.norm_squared(), ac.norm_squared(), bc.norm_squared());
    let longest = x.max(y).max(z);
    let sum = ab.cross(&ac);
    let square = sum.norm_squared();
    let largest = a.amax().max(b.amax()).max(c.amax());
    // The height is the root of square / longest. Comparisons with NaN are false.
    let is_tall = square > LEAST_HEIGHT * LEAST_HEIGHT * longest * longest;
    let is_clear =
        longest > 1e-12 * largest * largest && longest > 1e-60 && largest < 1e40 && is_tall;
    is_clear.then(|| sum / square.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(points: &[(f64, f64, f64)]) -> ErrorKind {
        let points: Vec<_> = points.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect();
        convex_polygon(&points).unwrap_err().kind
    }

    #[test]
    fn says_what_is_wrong() {
        assert_eq!(kind(&[]), ErrorKind::Empty);
        assert_eq!(kind(&[(0., 0., 0.), (1., 0., 0.)]), ErrorKind::Degenerate);
        assert_eq!(
            kind(&[(0., 0., 0.), (1., 0., 0.), (2., 0., 0.)]),
            ErrorKind::Degenerate
        );
        assert_eq!(
            kind(&[(0., 0., 0.), (1., 0., 0.), (1., 0., 0.), (0., 1., 0.)]),
            ErrorKind::Degenerate
        );
        assert_eq!(
            kind(&[(0., 0., 0.), (1., f64::NAN, 0.), (0., 1., 0.)]),
            ErrorKind::NotFinite
        );
        assert_eq!(
            kind(&[(0., 0., 0.), (1., 0., 0.), (1., 1., 0.1), (0., 1., 0.)]),
            ErrorKind::NotPlanar
        );
        assert_eq!(
            kind(&[(0., 0., 0.), (2., 0., 0.), (0.5, 0.5, 0.), (0., 2., 0.)]),
            ErrorKind::NotConvex
        );
        let star: Vec<_> = (0..5)
            .map(|i| {
                let angle = 4.0 * std::f64::consts::PI * i as f64 / 5.0;
                (angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        assert_eq!(kind(&star), ErrorKind::NotConvex);
    }

    /// A vertex just outside a straight edge must not become a corner of the face.
    #[test]
    fn tiny_edges_do_not_bound_the_face() {
        let points = [
            (0., 0.),
            (0.5, 0.),
            (0.5 + 2e-12, 1e-12),
            (1., 0.),
            (1., 1.),
            (0., 1.),
        ]
        .map(|(x, y)| Vec3::new(x, y, 0.0));
        let polygon = convex_polygon(&points).unwrap();
        assert_eq!(polygon.edges.len(), 6);
        assert_eq!(*polygon.faces[0].vertices, [0, 3, 4, 5]);
    }

    #[test]
    fn accepts_all_scales_and_straight_vertices() {
        for scale in [1e-23, 1e-6, 1.0, 1e6] {
            let points = [(0., 0.), (1., 0.), (2., 0.), (2., 1.), (0., 1.)]
                .map(|(x, y)| Vec3::new(x, y, 1.0) * scale);
            let polygon = convex_polygon(&points).unwrap();
            assert!((polygon.faces[0].normal - Vec3::z()).amax() < 1e-15);
        }
    }
}
