//! Arbitrary faces of a mesh to convex polygons: kept, split or dropped.

use nalgebra::Vector2;

use super::ear_clipping::triangulated;
use super::planar_hull::plane_axes;
use super::polygon::{check_convex_polygon, extent_of, newell_normal};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

/// How a face is represented.
#[derive(Debug, PartialEq)]
pub enum FaceSplit {
    /// It is a convex polygon already.
    Convex,
    /// It is not convex or not planar; these triangles (indices into the face) cover it.
    Triangles(Vec<[u32; 3]>),
    /// It has no area.
    Degenerate,
}

/// Decides how a face given by its vertices in cyclic order is represented. Fails for coordinates that are not finite
/// and for outlines that cross themselves.
pub fn split_face(vertices: &[Vec3]) -> Result<FaceSplit> {
    let trouble = match check_convex_polygon(vertices) {
        Ok(_) => return Ok(FaceSplit::Convex),
        Err(error) => error,
    };
    match trouble.kind {
        ErrorKind::NotConvex | ErrorKind::NotPlanar => {}
        ErrorKind::Degenerate | ErrorKind::Empty if vertices.len() <= 3 => {
            return Ok(FaceSplit::Degenerate);
        }
        ErrorKind::Degenerate => return without_repeats(vertices),
        _ => return Err(trouble),
    }
    let crosses = || {
        Error::new(
            ErrorKind::NotConvex,
            "the outline crosses itself and cannot be split into triangles",
        )
    };
    let normal = newell_normal(vertices).ok_or_else(crosses)?;
    let (x, y) = plane_axes(&normal);
    let origin = vertices[0];
    let size = extent_of(vertices)?.diameter;
    let flat: Vec<_> = vertices
        .iter()
        .map(|v| (v - origin) / size)
        .map(|v| Vector2::new(x.dot(&v), y.dot(&v)))
        .collect();
    let triangles = triangulated(&flat).ok_or_else(crosses)?;
    let at = |i: u32| flat[i as usize];
    let area: f64 = (0..flat.len())
        .map(|i| flat[i].perp(&flat[(i + 1) % flat.len()]))
        .sum();
    let covered: f64 = triangles
        .iter()
        .map(|t| (at(t[1]) - at(t[0])).perp(&(at(t[2]) - at(t[0]))).abs())
        .sum();
    if (covered - area.abs()).abs() > 1e-9 * area.abs() {
        return Err(crosses());
    }
    Ok(FaceSplit::Triangles(triangles))
}

/// Decides about a face with repeated vertices as about the same face without them.
fn without_repeats(vertices: &[Vec3]) -> Result<FaceSplit> {
    let tolerance = extent_of(vertices)?.tolerance;
    let apart = |i: usize, j: u32| (vertices[i] - vertices[j as usize]).norm() > tolerance;
    let mut kept: Vec<u32> = Vec::with_capacity(vertices.len());
    for i in 0..vertices.len() {
        if kept.last().is_none_or(|&last| apart(i, last)) {
            kept.push(i as u32);
        }
    }
    while kept.len() > 1
        && kept
            .last()
            .is_some_and(|&last| !apart(last as usize, kept[0]))
    {
        kept.pop();
    }
    if kept.len() == vertices.len() || kept.len() < 3 {
        return Ok(FaceSplit::Degenerate);
    }
    let reduced: Vec<Vec3> = kept.iter().map(|&i| vertices[i as usize]).collect();
    // No vertex repeats any more, so this recurses only once.
    Ok(match split_face(&reduced)? {
        FaceSplit::Degenerate => FaceSplit::Degenerate,
        FaceSplit::Convex => FaceSplit::Triangles(
            (1..kept.len() - 1)
                .map(|i| [kept[0], kept[i], kept[i + 1]])
                .collect(),
        ),
        FaceSplit::Triangles(triangles) => FaceSplit::Triangles(
            triangles
                .iter()
                .map(|t| t.map(|i| kept[i as usize]))
                .collect(),
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(vertices: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
        let at = |i: u32| vertices[i as usize];
        triangles
            .iter()
            .map(|t| (at(t[1]) - at(t[0])).cross(&(at(t[2]) - at(t[0]))).norm() / 2.0)
            .sum()
    }

    #[test]
    fn an_l_is_split() {
        let l = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)]
            .map(|(x, y)| Vec3::new(x, 0.0, y));
        let FaceSplit::Triangles(triangles) = split_face(&l).unwrap() else {
            panic!("not split");
        };
        assert!((area(&l, &triangles) - 3.0).abs() < 1e-12);
    }

    #[test]
    fn repeats_bow_ties_and_needles() {
        let square =
            [(0., 0.), (1., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| Vec3::new(x, y, 0.));
        let FaceSplit::Triangles(triangles) = split_face(&square).unwrap() else {
            panic!("not split");
        };
        assert!((area(&square, &triangles) - 1.0).abs() < 1e-12);

        let bow_tie = [(0., 0.), (2., 2.), (2., 0.), (0., 1.)].map(|(x, y)| Vec3::new(x, y, 0.));
        assert!(split_face(&bow_tie).is_err());

        let needle = [(0., 0.), (1., 0.), (2., 0.)].map(|(x, y)| Vec3::new(x, y, 0.));
        assert_eq!(split_face(&needle).unwrap(), FaceSplit::Degenerate);
    }

    /// Vertices that alternate by less than the tolerance: linear work, and no recursion.
    #[test]
    fn a_long_run_of_repeats_is_removed_at_once() {
        let mut face = vec![Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)];
        let hair = 0.8e-12;
        face.extend((0..200_000).map(|i| Vec3::new(1.0, 1.0 + hair * f64::from(i % 2), 0.0)));
        face.push(Vec3::new(0.0, 1.0, 0.0));
        let FaceSplit::Triangles(triangles) = split_face(&face).unwrap() else {
            panic!("not split");
        };
        assert!((area(&face, &triangles) - 1.0).abs() < 1e-9);
    }
}
