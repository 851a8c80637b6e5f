//! Boxes. Their features are numbered by their axes, so that no hull has to be found.

use std::sync::LazyLock;

use super::polygon::{extent_of, upright};
use super::polyhedron::{convex_polyhedron, deviation_of};
use super::ready_made::require_size;
use super::{Convex, Face, SharedList};
use crate::error::Result;
use crate::pose::{Pose, Vec3};
use crate::tolerance;

/// A box thinner than this part of its largest coordinate may have lost its shape to rounding: the hull of its corners tells.
const THIN: f64 = 1e-6;

/// The corners of each face, counter-clockwise seen from outside: at the low and at the high end of x, of y and of z. Bit k of a corner's
/// number is set if it is at the high end of axis k.
pub const BLOCK_FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// The edges along x, along y and along z.
const EDGES: [[u32; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// The lists that all boxes share.
static EDGE_LIST: LazyLock<SharedList<[u32; 2]>> = LazyLock::new(|| EDGES.to_vec().into());
static FACE_LISTS: LazyLock<[SharedList<u32>; 6]> =
    LazyLock::new(|| BLOCK_FACES.map(|corners| corners.to_vec().into()));

/// The box of these half extents around the origin of the pose, along its axes.
pub fn block(pose: &Pose, half_extents: &Vec3) -> Result<Convex> {
    for (axis, &half) in ["x", "y", "z"].iter().zip(half_extents.iter()) {
        require_size(half, &format!("half extent {axis}"))?;
    }
    let corners: [Vec3; 8] = std::array::from_fn(|i| {
        let signs = [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 });
        pose.transform_point(&Vec3::from(signs).component_mul(half_extents))
    });
    let extent = extent_of(&corners)?;
    let largest = corners.iter().fold(0.0, |most, c| c.amax().max(most));
    if extent.spread < tolerance::SMALLEST_DIAMETER || half_extents.min() <= THIN * largest {
        return convex_polyhedron(&corners);
    }
    let faces: Vec<Face> = FACE_LISTS.iter().map(|list| face(&corners, list)).collect();
    Ok(Convex {
        vertices: corners[..].into(),
        edges: EDGE_LIST.clone(),
        deviation: deviation_of(&corners, &faces, 0.0),
        faces: faces.into(),
        curve: None,
    })
}

fn face(corners: &[Vec3; 8], list: &SharedList<u32>) -> Face {
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| corners[list[i] as usize]);
    let across = (c - a).cross(&(d - b)).normalize();
    Face {
        vertices: list.clone(),
        normal: upright(&across, &[a, b, c, d]),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use cstk_scenes::Random;

    use super::*;
    use crate::pose::rotation_about;

    /// Against the hull of the corners: the same features in another order.
    #[test]
    fn boxes_are_the_hulls_of_their_corners() {
        let mut random = Random::new(1);
        for case in 0..500 {
            let scale = 10f64.powf(random.within(-6.0, 6.0));
            let half = Vec3::from([0; 3].map(|_| scale * 10f64.powf(random.within(-2.0, 0.0))));
            let mut vector = || Vec3::from([0; 3].map(|_| random.within(-1.0, 1.0)));
            let pose = match case % 3 {
                0 => Pose::from_translation(vector() * scale),
                _ => Pose {
                    rotation: rotation_about(&vector().normalize(), 3.0 * vector().x),
                    translation: vector() * 100.0 * scale,
                },
            };
            let made = block(&pose, &half).unwrap();
            let hull = convex_polyhedron(&made.vertices).unwrap();
            let largest = made.vertices.iter().fold(0.0, |most, v| v.amax().max(most));
            let rounding = 8.0 * tolerance::EPSILON * largest;
            assert_eq!((made.edges.len(), made.faces.len()), (12, 6));
            let place = |shape: &Convex, i: u32| {
                let of_vertex = |v: &Vec3| *v == shape.vertices[i as usize];
                made.vertices.iter().position(of_vertex).unwrap()
            };
            let edges = |shape: &Convex| -> BTreeSet<BTreeSet<usize>> {
                let ends = shape.edges.iter();
                ends.map(|ends| ends.iter().map(|&i| place(shape, i)).collect())
                    .collect()
            };
            assert_eq!(edges(&made), edges(&hull));
            for face in &made.faces {
                let corners = |shape: &Convex, face: &Face| -> BTreeSet<usize> {
                    face.vertices.iter().map(|&i| place(shape, i)).collect()
                };
                let own = corners(&made, face);
                let mut same = hull.faces.iter().filter(|f| corners(&hull, f) == own);
                let normal = same.next().unwrap().normal;
                assert!((normal - face.normal).norm() <= rounding / half.min());
            }
            assert!(made.deviation <= rounding);
        }
    }

    #[test]
    fn flat_boxes_are_what_their_corners_span() {
        let pose = Pose::from_translation(Vec3::new(1.0, 2.0, 3.0));
        let flat = block(&pose, &Vec3::new(1.0, 1.0, 1e-17)).unwrap();
        assert_eq!((flat.vertices.len(), flat.faces.len()), (4, 1));
        assert!(block(&pose, &Vec3::new(1.0, 0.0, 1.0)).is_err());
        let tiny = Vec3::repeat(0.1 * tolerance::SMALLEST_DIAMETER);
        assert!(block(&Pose::identity(), &tiny).is_err());
    }
}
