//! A convex polyhedron from points: hull, faces and edges, of any dimension from a point to a solid.

use std::collections::{HashMap, HashSet};

use smallvec::{SmallVec, smallvec};

use super::hull::{CheckedHull, checked_hull_that};
use super::planar_hull::planar_ring;
use super::point_tree::PointTree;
use super::polygon::{extent_of, upright};
use super::{Convex, Face, SharedList};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;
use crate::tolerance;

/// The convex hull of `points`. Points that all coincide give a point, collinear ones a segment, coplanar ones a flat
/// polygon, others a solid. Only points that are corners of the hull are kept; how far others may lie from what is kept is its
/// deviation.
pub fn convex_polyhedron(points: &[Vec3]) -> Result<Convex> {
    if points.is_empty() {
        return Err(Error::new(
            ErrorKind::Empty,
            "a polyhedron needs at least one point",
        ));
    }
    let extent = extent_of(points)?;
    if extent.spread > 0.0 && extent.spread < tolerance::SMALLEST_DIAMETER {
        return Err(Error::new(
            ErrorKind::Degenerate,
            format!(
                "the points are {:e} apart, but at least {:e} is needed",
                extent.spread,
                tolerance::SMALLEST_DIAMETER
            ),
        ));
    }
    let tolerance = extent.tolerance;
    let farthest = |measure: &dyn Fn(&Vec3) -> f64| {
        points
            .iter()
            .map(|p| (measure(p), *p))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, points[0]))
    };
    let (length, second) = farthest(&|p| (p - points[0]).norm());
    if length <= tolerance {
        return Ok(Convex {
            vertices: smallvec![points[0]],
            edges: SharedList::cycle(1),
            faces: SmallVec::new(),
            deviation: length,
            curve: None,
        });
    }
    let (_, first) = farthest(&|p| (p - second).norm());
    let along = (second - first).normalize();
    let (width, third) = farthest(&|p| along.cross(&(p - first)).norm());
    if width <= tolerance {
        return Ok(Convex {
            vertices: smallvec![first, second],
            edges: vec![[0, 1]].into(),
            faces: SmallVec::new(),
            // Beside the line, and beyond its ends by less.
            deviation: 2.0 * width,
            curve: None,
        });
    }
    let normal = along.cross(&(third - first)).normalize();
    let normal = (normal - along * along.dot(&normal)).normalize();
    let (thickness, _) = farthest(&|p| normal.dot(&(p - first)).abs());
    if thickness <= tolerance {
        let ring = planar_ring(points, &normal, tolerance);
        let corners = (0..ring.len() as u32).collect();
        let vertices = ring.iter().map(|&i| points[i as usize]).collect();
        let mut polygon = Convex::from_cycle(vertices, corners, normal);
        // Off the plane of a corner that may be as far on its other side, and beside the outline.
        let keeps_all = planar_ring(points, &normal, 0.0).len() == ring.len();
        let beside = if keeps_all { 0.0 } else { 2.0 * tolerance };
        polygon.deviation = polygon.deviation.max(2.0 * thickness + beside);
        return Ok(polygon);
    }
    solid(points, extent.diameter)
}

fn solid(points: &[Vec3], diameter: f64) -> Result<Convex> {
    let accepted = tolerance::HULL_EXCESS * diameter;
    let mut made = Err(Error::new(
        ErrorKind::NotConverged,
        format!(
            "the hull of the {} points could not be certified",
            points.len()
        ),
    ));
    checked_hull_that(points, accepted, points.len(), |hull| {
        made = of_hull(points, hull, diameter);
        made.is_ok()
    });
    made
}

/// The polyhedron of a hull whose excess is accepted, checked.
fn of_hull(points: &[Vec3], hull: &CheckedHull, diameter: f64) -> Result<Convex> {
    let accepted = tolerance::HULL_EXCESS * diameter;
    let vertices: Vec<Vec3> = hull.vertices.iter().map(|&i| points[i as usize]).collect();
    let faces = merge_coplanar(&vertices, &hull.triangles, 4.0 * accepted);
    check_closed_and_convex(&vertices, &faces, diameter)?;
    let mut edges: Vec<[u32; 2]> = Vec::new();
    let mut seen = HashSet::new();
    for face in &faces {
        for (i, &a) in face.vertices.iter().enumerate() {
            let b = face.vertices[(i + 1) % face.vertices.len()];
            if seen.insert((a.min(b), a.max(b))) {
                edges.push([a.min(b), a.max(b)]);
            }
        }
    }
    let deviation = hull.excess + deviation_of(&vertices, &faces, 4.0 * accepted);
    Ok(Convex {
        vertices: vertices.into(),
        edges: edges.into(),
        faces: faces.into(),
        deviation,
        curve: None,
    })
}

/// Merges the triangles that lie in one plane into one face, starting from the largest, whose planes are most accurate.
fn merge_coplanar(vertices: &[Vec3], triangles: &[[u32; 3]], tolerance: f64) -> Vec<Face> {
    let corner = |t: usize, k: usize| vertices[triangles[t][k] as usize];
    let area_vector =
        |t: usize| (corner(t, 1) - corner(t, 0)).cross(&(corner(t, 2) - corner(t, 0)));
    let mut by_edge: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for (t, triangle) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            by_edge.entry((a.min(b), a.max(b))).or_default().push(t);
        }
    }
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by(|&s, &t| {
        let by_area = area_vector(t).norm().total_cmp(&area_vector(s).norm());
        by_area.then(s.cmp(&t))
    });
    let mut taken = vec![false; triangles.len()];
    let mut faces = Vec::new();
    for seed in order {
        if taken[seed] {
            continue;
        }
        taken[seed] = true;
        let Some(normal) = area_vector(seed).try_normalize(0.0) else {
            continue;
        };
        let normal = upright(
            &normal,
            &[corner(seed, 0), corner(seed, 1), corner(seed, 2)],
        );
        let origin = corner(seed, 0);
        let mut members: Vec<u32> = triangles[seed].to_vec();
        let mut front = vec![seed];
        while let Some(t) = front.pop() {
            for k in 0..3 {
                let (a, b) = (triangles[t][k], triangles[t][(k + 1) % 3]);
                for &next in &by_edge[&(a.min(b), a.max(b))] {
                    let level = |k: usize| normal.dot(&(corner(next, k) - origin)).abs();
                    if !taken[next] && (0..3).all(|k| level(k) <= tolerance) {
                        taken[next] = true;
                        members.extend(triangles[next]);
                        front.push(next);
                    }
                }
            }
        }
        members.sort_unstable();
        members.dedup();
        let corners: Vec<Vec3> = members.iter().map(|&i| vertices[i as usize]).collect();
        let ring = planar_ring(&corners, &normal, tolerance);
        if ring.len() < 3 {
            continue;
        }
        faces.push(Face {
            vertices: ring
                .iter()
                .map(|&i| members[i as usize])
                .collect::<Vec<u32>>()
                .into(),
            normal,
        });
    }
    faces
}

/// The largest distance of a vertex from a face it bounds; if merging left a vertex without a face, the merging tolerance is
/// added.
pub(super) fn deviation_of(vertices: &[Vec3], faces: &[Face], merging: f64) -> f64 {
    let mut bounds_a_face = vec![false; vertices.len()];
    let mut deviation = 0.0f64;
    for face in faces {
        let origin = vertices[face.vertices[0] as usize];
        for &i in &face.vertices {
            bounds_a_face[i as usize] = true;
            deviation = deviation.max(face.normal.dot(&(vertices[i as usize] - origin)).abs());
        }
    }
    if bounds_a_face.contains(&false) {
        deviation += merging;
    }
    deviation
}

/// Refuses faces that are not the boundary of the vertices' hull: all vertices must lie below all faces, and the area vectors
/// must cancel.
fn check_closed_and_convex(vertices: &[Vec3], faces: &[Face], diameter: f64) -> Result<()> {
    let tree = PointTree::new(vertices);
    let mut sum = Vec3::zeros();
    for (f, face) in faces.iter().enumerate() {
        let origin = vertices[face.vertices[0] as usize];
        let (above, _) = tree.farthest(&face.normal, &origin);
        if above > 10.0 * tolerance::HULL_EXCESS * diameter {
            return Err(Error::new(
                ErrorKind::NotConverged,
                format!("hull face {f} has a vertex {above:.3e} above it"),
            ));
        }
        for i in 1..face.vertices.len() - 1 {
            let a = vertices[face.vertices[i] as usize] - origin;
            let b = vertices[face.vertices[i + 1] as usize] - origin;
            sum += a.cross(&b) * 0.5;
        }
    }
    if faces.len() < 4 || sum.norm() > 1e-9 * diameter * diameter {
        return Err(Error::new(
            ErrorKind::NotConverged,
            format!("the hull's {} faces do not close", faces.len()),
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(scale: f64) -> Vec<Vec3> {
        (0..8)
            .map(|i| Vec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64) * scale)
            .collect()
    }

    #[test]
    fn a_cube_has_six_squares() {
        for scale in [1e-23, 1e-6, 1.0, 1e6] {
            let mut points = cube(scale);
            points.push(Vec3::new(0.5, 0.5, 0.5) * scale);
            points.push(Vec3::new(0.5, 0.5, 0.0) * scale);
            points.push(points[3]);
            let shape = convex_polyhedron(&points).unwrap();
            assert_eq!(
                (shape.vertices.len(), shape.edges.len(), shape.faces.len()),
                (8, 12, 6)
            );
            assert!(shape.faces.iter().all(|face| face.vertices.len() == 4));
        }
    }

    #[test]
    fn lower_dimensions_are_kept() {
        let point = convex_polyhedron(&[Vec3::new(1.0, 2.0, 3.0); 4]).unwrap();
        assert_eq!(
            (point.vertices.len(), point.edges.len(), point.faces.len()),
            (1, 1, 0)
        );
        let line: Vec<_> = (0..4)
            .map(|i| Vec3::new(1.0, 2.0, 3.0) * i as f64)
            .collect();
        let segment = convex_polyhedron(&line).unwrap();
        assert_eq!(
            (
                segment.vertices.len(),
                segment.edges.len(),
                segment.faces.len()
            ),
            (2, 1, 0)
        );
        let flat = convex_polyhedron(&cube(1.0)[..4]).unwrap();
        assert_eq!(
            (flat.vertices.len(), flat.edges.len(), flat.faces.len()),
            (4, 4, 1)
        );
    }

    /// dimforge/parry#49: four points of size 1e-23 on which a hull once panicked.
    #[test]
    fn tiny_points_have_a_hull() {
        let points = [
            (2.3624029, 1.3771984, 0.22062083),
            (1.3807439, 1.8596945, -0.1784406),
            (1.4174896, -0.3200329, 0.4664615),
            (1.3685897, 0.46402988, 0.22509113),
        ]
        .map(|(x, y, z)| Vec3::new(x, y, z) * 1e-23);
        let shape = convex_polyhedron(&points).unwrap();
        assert_eq!(
            (shape.vertices.len(), shape.edges.len(), shape.faces.len()),
            (4, 6, 4)
        );
    }
}
