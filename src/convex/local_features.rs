//! The features of two polytopes around a point of each, and the normals that they offer.

use smallvec::SmallVec;

use super::placed::{PlacedPrimitive, Precision};
use super::segment::Segment;
use crate::pose::Vec3;
use crate::tolerance;

/// At most 4096 edge pairs are tried, where fans of very many edges meet at two touching vertices. A larger value takes
/// longer at such vertices, a smaller one leaves contacts just inside without a normal.
const MAX_EDGE_PAIRS: usize = 4096;

/// A list of usually few directions.
pub type Directions = SmallVec<[Vec3; 16]>;

/// The candidate normals of the features around two points: face normals, cross products of edge pairs, and the
/// normals of a flat polygon's edges within its plane. Unit vectors.
pub fn local_normals(
    [r, s]: [&PlacedPrimitive; 2],
    points: &[Vec3; 2],
    precision: &Precision,
) -> Directions {
    let near = tolerance::NEAR_FEATURE * precision.size;
    let local_r = LocalFeatures::around(r, &points[0], near);
    let local_s = LocalFeatures::around(s, &points[1], near);
    let mut found = Directions::new();
    let mut offer = |candidate: Vec3| {
        let in_plane = if precision.planar {
            Vec3::new(candidate.x, candidate.y, 0.0)
        } else {
            candidate
        };
        found.extend(in_plane.try_normalize(tolerance::PARALLEL_EDGES));
    };
    for normal in local_r.normals.iter().chain(&local_s.normals) {
        offer(*normal);
    }
    let pairs = local_r.directions.iter().flat_map(|along_r| {
        local_s
            .directions
            .iter()
            .map(|along_s| along_r.cross(along_s))
    });
    pairs.take(MAX_EDGE_PAIRS).for_each(&mut offer);
    for local in [&local_r, &local_s] {
        if local.is_flat {
            for along in &local.directions {
                for normal in &local.normals {
                    offer(along.cross(normal));
                }
            }
        }
    }
    found
}

/// The face normals and edge directions of the features that hold a point.
pub struct LocalFeatures {
    normals: Directions,
    pub directions: Directions,
    is_flat: bool,
}

impl LocalFeatures {
    pub fn around(placed: &PlacedPrimitive, point: &Vec3, near: f64) -> Self {
        let faces: SmallVec<[usize; 16]> = placed.faces_at(point, near).collect();
        let mut directions = Directions::new();
        for edge in edges_of(placed, &faces) {
            let (p, q) = placed.edge_ends(placed.shape.edges[edge as usize]);
            let (along, arm) = (q - p, point - p);
            // Most edges are farther away than their lines, which is quick to tell.
            let square = 2.0 * near * near * along.norm_squared();
            if arm.cross(&along).norm_squared() > square {
                continue;
            }
            let segment = Segment::new((p, q));
            let nearest = segment.at(segment.nearest_parameter(point));
            if (nearest - point).norm() <= near {
                directions.extend(along.try_normalize(0.0));
            }
        }
        let normals = faces.iter().map(|&face| placed.normal(face)).collect();
        Self {
            normals,
            directions,
            is_flat: placed.shape.faces.len() == 1,
        }
    }
}

/// The edges of some faces, and others that end in their corners, in the order of their numbers: all edges where it is not known which
/// meet in a corner.
fn edges_of(placed: &PlacedPrimitive, faces: &[usize]) -> SmallVec<[u32; 64]> {
    let Some(incidence) = placed.incidence() else {
        return (0..placed.shape.edges.len() as u32).collect();
    };
    // Each once: an apex is a corner of all faces around it.
    let mut corners: SmallVec<[u32; 64]> = faces
        .iter()
        .flat_map(|&face| placed.shape.faces[face].vertices.iter().copied())
        .collect();
    corners.sort_unstable();
    corners.dedup();
    let mut edges: SmallVec<[u32; 64]> = corners
        .iter()
        .flat_map(|&corner| incidence.edges_of(corner))
        .copied()
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
