//! Finds coplanar neighbours whose union is a convex polygon (§3.4).

use std::collections::HashMap;

use nalgebra::Vector2;

use super::shared_edges::{SharedEdges, is_flat};
use crate::pose::Vec3;
use crate::primitive::{Convex, monotone_chain, plane_axes};
use crate::tolerance;

/// The largest relative difference between the areas of a union and its hull for which the union counts as convex: 100
/// times the rounding of the sums. Pieces are only bounds, so a sliver more or less changes no answer.
const SAME_AREA: f64 = 1e-11;

/// Polygons whose union is one convex polygon.
#[derive(Clone, Debug)]
pub struct FlatPiece {
    /// Ascending.
    pub members: Vec<u32>,
    /// Unit normal, in the direction of the members' normals.
    pub normal: Vec3,
    pub area: f64,
}

/// Puts every flat polygon into exactly one piece; the pieces are ordered by their lowest members.
pub fn coplanar_pieces(
    primitives: &[Convex],
    edges: &SharedEdges,
    diameter: f64,
) -> Vec<FlatPiece> {
    let areas: Vec<f64> = primitives.iter().map(area_of).collect();
    let mut order: Vec<u32> = (0..primitives.len() as u32)
        .filter(|&i| is_flat(&primitives[i as usize]))
        .collect();
    order.sort_by(|&a, &b| {
        areas[b as usize]
            .total_cmp(&areas[a as usize])
            .then(a.cmp(&b))
    });
    let mut taken = vec![false; primitives.len()];
    let mut pieces = Vec::new();
    for seed in order {
        if !taken[seed as usize] {
            let region = coplanar_region(primitives, edges, diameter, seed, &mut taken);
            pieces.extend(split_region(primitives, edges, &areas, region));
        }
    }
    pieces.sort_by_key(|piece| piece.members[0]);
    pieces
}

fn area_of(primitive: &Convex) -> f64 {
    let Some(face) = primitive.faces.first() else {
        return 0.0;
    };
    let corner = |k: usize| primitive.vertices[face.vertices[k] as usize];
    (1..face.vertices.len() - 1)
        .map(|k| {
            (corner(k) - corner(0))
                .cross(&(corner(k + 1) - corner(0)))
                .norm()
                / 2.0
        })
        .sum()
}

/// The polygons that are connected to `seed` over shared edges, lie in its plane and face the same way.
fn coplanar_region(
    primitives: &[Convex],
    edges: &SharedEdges,
    diameter: f64,
    seed: u32,
    taken: &mut [bool],
) -> Vec<u32> {
    let start = &primitives[seed as usize];
    let (normal, origin) = (start.faces[0].normal, start.vertices[0]);
    let level = |p: &Vec3| normal.dot(&(p - origin)).abs() <= tolerance::PLANAR * diameter;
    taken[seed as usize] = true;
    let mut region = vec![seed];
    let mut next = 0;
    while next < region.len() {
        for neighbour in &edges.neighbours[region[next] as usize] {
            let other = &primitives[neighbour.polygon as usize];
            let same_side = other.faces[0].normal.dot(&normal) > 0.0;
            if !taken[neighbour.polygon as usize]
                && neighbour.opposite
                && same_side
                && other.vertices.iter().all(level)
            {
                taken[neighbour.polygon as usize] = true;
                region.push(neighbour.polygon);
            }
        }
        next += 1;
    }
    region
}

/// A convex polygon in the region's plane.
#[derive(Clone)]
struct Outline {
    corners: Vec<Vector2<f64>>,
    area: f64,
}

impl Outline {
    /// The hull of two outlines, if they fill it.
    fn joined(&self, other: &Outline) -> Option<Outline> {
        let both = self.corners.iter().chain(&other.corners).copied().collect();
        hull_if_filled(both, self.area + other.area)
    }
}

fn hull_if_filled(points: Vec<Vector2<f64>>, area: f64) -> Option<Outline> {
    let hull = monotone_chain(&points, (0..points.len() as u32).collect(), 0.0);
    let corners: Vec<Vector2<f64>> = hull.into_iter().map(|i| points[i as usize]).collect();
    let origin = *corners.first()?;
    let twice: f64 = (1..corners.len().max(2) - 1)
        .map(|k| (corners[k] - origin).perp(&(corners[k + 1] - origin)))
        .sum();
    ((0.5 * twice - area).abs() <= SAME_AREA * area).then_some(Outline { corners, area })
}

/// The whole region if it is convex; otherwise its polygons are joined, longest shared edges first (Hertel and Mehlhorn).
fn split_region(
    primitives: &[Convex],
    edges: &SharedEdges,
    areas: &[f64],
    region: Vec<u32>,
) -> Vec<FlatPiece> {
    let normal = primitives[region[0] as usize].faces[0].normal;
    let piece = |mut members: Vec<u32>| {
        members.sort_unstable();
        FlatPiece {
            normal,
            area: members.iter().map(|&i| areas[i as usize]).sum(),
            members,
        }
    };
    if region.len() == 1 {
        return vec![piece(region)];
    }
    let outlines = outlines_in_plane(primitives, areas, &region, &normal);
    let corners = outlines.iter().flat_map(|outline| &outline.corners);
    let total = region.iter().map(|&i| areas[i as usize]).sum();
    if hull_if_filled(corners.copied().collect(), total).is_some() {
        return vec![piece(region)];
    }
    let shared = shared_within(edges, &region);
    let joined = join_outlines(&region, outlines, shared);
    joined.into_iter().map(piece).collect()
}

/// The outlines of a region's polygons in coordinates of its plane.
fn outlines_in_plane(
    primitives: &[Convex],
    areas: &[f64],
    region: &[u32],
    normal: &Vec3,
) -> Vec<Outline> {
    let origin = primitives[region[0] as usize].vertices[0];
    let (x, y) = plane_axes(normal);
    let in_plane = |vertex: &Vec3| {
        let v = vertex - origin;
        Vector2::new(x.dot(&v), y.dot(&v))
    };
    let outline = |&polygon: &u32| Outline {
        corners: primitives[polygon as usize]
            .vertices
            .iter()
            .map(in_plane)
            .collect(),
        area: areas[polygon as usize],
    };
    region.iter().map(outline).collect()
}

/// The pairs of a region's polygons that share an edge, by their indices in the region, longest edges first.
fn shared_within(edges: &SharedEdges, region: &[u32]) -> Vec<[usize; 2]> {
    let place: HashMap<u32, usize> = region.iter().enumerate().map(|(k, &i)| (i, k)).collect();
    let mut shared: Vec<(f64, usize, usize)> = Vec::new();
    for (k, &polygon) in region.iter().enumerate() {
        for neighbour in &edges.neighbours[polygon as usize] {
            match place.get(&neighbour.polygon) {
                Some(&other) if k < other => shared.push((neighbour.length, k, other)),
                _ => {}
            }
        }
    }
    shared.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    shared.into_iter().map(|(_, a, b)| [a, b]).collect()
}

/// Joins neighbours whose union is convex, in the order of `shared`. Returns the polygons of each union.
fn join_outlines(
    region: &[u32],
    mut outlines: Vec<Outline>,
    mut shared: Vec<[usize; 2]>,
) -> Vec<Vec<u32>> {
    let mut owners: Vec<usize> = (0..region.len()).collect();
    let mut groups: Vec<Vec<u32>> = region.iter().map(|&i| vec![i]).collect();
    // A union that was not convex may be after other joins, so the pass is repeated until nothing joins.
    loop {
        let mut joined = false;
        shared.retain(|pair| {
            let [a, b] = pair.map(|k| owner(&mut owners, k));
            if a == b {
                return false;
            }
            let Some(outline) = outlines[a].joined(&outlines[b]) else {
                return true;
            };
            let (kept, gone) = if groups[a].len() >= groups[b].len() {
                (a, b)
            } else {
                (b, a)
            };
            let members = std::mem::take(&mut groups[gone]);
            groups[kept].extend(members);
            outlines[kept] = outline;
            owners[gone] = kept;
            joined = true;
            false
        });
        if !joined {
            break;
        }
    }
    groups.retain(|group| !group.is_empty());
    groups
}

/// The polygon that stands for the union that polygon `k` belongs to.
fn owner(owners: &mut [usize], mut k: usize) -> usize {
    while owners[k] != k {
        owners[k] = owners[owners[k]];
        k = owners[k];
    }
    k
}
