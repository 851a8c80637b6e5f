//! Curved primitives as meshes.

use crate::hierarchy::wrapper::Surface;
use crate::pose::Vec3;
use crate::primitive::Convex;

/// Circles of latitude of the sampled directions.
const RINGS: usize = 16;
/// Directions on each circle.
const SECTORS: usize = 32;

/// Meshes a curved primitive: support points along evenly spread directions, connected as the directions are. The mesh lies
/// within the set, its vertices on the surface. For a planar set it is the outline.
pub fn curved_surface(primitive: &Convex) -> Surface {
    use std::f64::consts::{PI, TAU};
    let at = |ring: usize, sector: usize| {
        let (polar, azimuth) = (
            PI * ring as f64 / RINGS as f64,
            TAU * sector as f64 / SECTORS as f64,
        );
        // The sine of pi is not 0 in floating point: the support point of a flat bottom would be on its rim, and leave it open.
        let sine = if ring == RINGS { 0.0 } else { polar.sin() };
        let direction = Vec3::new(sine * azimuth.cos(), sine * azimuth.sin(), polar.cos());
        primitive.farthest(&direction)
    };
    if primitive.curve.as_ref().is_some_and(|curve| curve.planar) {
        return Surface {
            vertices: (0..SECTORS).map(|s| at(RINGS / 2, s)).collect(),
            faces: vec![(0..SECTORS as u32).collect()],
        };
    }
    let mut vertices = Vec::with_capacity((RINGS + 1) * SECTORS);
    for ring in 0..=RINGS {
        vertices.extend((0..SECTORS).map(|sector| at(ring, sector)));
    }
    let mut faces = Vec::with_capacity(2 * RINGS * SECTORS);
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let node = |ring: usize, sector: usize| (ring * SECTORS + sector % SECTORS) as u32;
            let [a, b] = [node(ring, sector), node(ring + 1, sector)];
            let [c, d] = [node(ring + 1, sector + 1), node(ring, sector + 1)];
            faces.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    Surface { vertices, faces }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose::Pose;
    use crate::primitive::{cone, cylinder, ellipsoid};
    use std::collections::HashMap;

    /// Every edge of the mesh is used as often one way as the other.
    #[test]
    fn meshes_are_closed() {
        let pose = Pose::identity();
        let shapes = [
            cylinder(&pose, 1.0, 1.0).unwrap(),
            cone(&pose, 1.0, 2.0).unwrap(),
            ellipsoid(&pose, &Vec3::new(1.0, 2.0, 3.0)).unwrap(),
        ];
        for shape in shapes {
            let surface = curved_surface(&shape);
            let key = |i: u32| surface.vertices[i as usize].map(|x| (x * 1e9).round() as i64);
            let mut uses: HashMap<_, i32> = HashMap::new();
            for face in &surface.faces {
                for (i, &from) in face.iter().enumerate() {
                    let to = face[(i + 1) % face.len()];
                    let [from, to] = [key(from), key(to)].map(|p| [p.x, p.y, p.z]);
                    if from != to {
                        *uses.entry((from.min(to), from.max(to))).or_default() +=
                            if from < to { 1 } else { -1 };
                    }
                }
            }
            assert!(uses.values().all(|count| *count == 0));
        }
    }
}
