//! Finds edge-adjacent polygons that bound a convex part of a closed body (§3.4).

use super::binned_split::{levels_for, split_within};
use super::coplanar_pieces::FlatPiece;
use super::forest::Forest;
use super::shared_edges::SharedEdges;
use crate::boxes::Extent;
use crate::error::Result;
use crate::hierarchy::Progress;
use crate::pose::Vec3;
use crate::primitive::{Convex, convex_polyhedron};
use crate::tolerance;

/// The most faces of a patch: each new face is compared with all, and the hull with every primitive it might contain.
const MAX_FACES: usize = 512;

/// A primitive intrudes into a hull if some of it lies deeper than this times the body's diameter.
const DEPTH: f64 = 1e-9;

/// Joins flat pieces into patches. The faces of a patch are faces of its hull, and the hull lies inside the closed body.
/// Pieces of open surfaces, or of surfaces that are not oriented outwards, stay as they are. Returns the members of each
/// patch.
pub fn convex_patches(
    primitives: &[Convex],
    edges: &SharedEdges,
    pieces: &[FlatPiece],
    diameter: f64,
    progress: &mut Progress,
) -> Result<Vec<Vec<u32>>> {
    let surface = Surface::of(primitives, edges, pieces, diameter);
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    order.sort_by(|&a, &b| {
        let (a_area, b_area) = (pieces[a as usize].area, pieces[b as usize].area);
        b_area.total_cmp(&a_area).then(a.cmp(&b))
    });
    let mut taken = vec![false; pieces.len()];
    let mut patches = Vec::new();
    let count = order.len();
    for (i, seed) in order.into_iter().enumerate() {
        if !std::mem::replace(&mut taken[seed as usize], true) {
            let patch = surface.grow(seed, &taken);
            for &piece in &patch {
                taken[piece as usize] = true;
            }
            let members = patch.iter().flat_map(|&p| &pieces[p as usize].members);
            patches.push(members.copied().collect());
        }
        if i % 64 == 0 {
            progress.at(i as f64 / count as f64)?;
        }
    }
    Ok(patches)
}

struct Surface<'a> {
    primitives: &'a [Convex],
    edges: &'a SharedEdges,
    pieces: &'a [FlatPiece],
    /// The piece of each polygon.
    piece_of: Vec<u32>,
    /// Per piece, whether it is on a closed surface that is oriented outwards.
    outward: Vec<bool>,
    /// Per piece, its vertices as indices into `edges.points`.
    vertices: Vec<Vec<u32>>,
    diameter: f64,
    boxes: BoxTree,
}

impl<'a> Surface<'a> {
    fn of(
        primitives: &'a [Convex],
        edges: &'a SharedEdges,
        pieces: &'a [FlatPiece],
        diameter: f64,
    ) -> Self {
        let mut piece_of = vec![u32::MAX; primitives.len()];
        let mut vertices = Vec::with_capacity(pieces.len());
        for (p, piece) in pieces.iter().enumerate() {
            let members = piece.members.iter();
            let mut own: Vec<u32> = members
                .clone()
                .flat_map(|&i| edges.vertices[i as usize].iter().copied())
                .collect();
            own.sort_unstable();
            own.dedup();
            vertices.push(own);
            for &i in members {
                piece_of[i as usize] = p as u32;
            }
        }
        let mut outward = vec![false; pieces.len()];
        for component in edges.components() {
            let closed = component.iter().all(|&i| edges.closed[i as usize]);
            if closed && volume(primitives, &component) > 0.0 {
                for i in component {
                    outward[piece_of[i as usize] as usize] = true;
                }
            }
        }
        Self {
            primitives,
            edges,
            pieces,
            piece_of,
            outward,
            vertices,
            diameter,
            boxes: BoxTree::of(primitives),
        }
    }

    fn plane(&self, piece: u32) -> (Vec3, f64) {
        let piece = &self.pieces[piece as usize];
        let origin = self.primitives[piece.members[0] as usize].vertices[0];
        (piece.normal, piece.normal.dot(&origin))
    }

    /// Grows a patch from a piece; returns its pieces.
    fn grow(&self, seed: u32, taken: &[bool]) -> Vec<u32> {
        let mut patch = vec![seed];
        if !self.outward[seed as usize] {
            return patch;
        }
        let allowed = tolerance::PLANAR * self.diameter;
        let below = |(normal, offset): &(Vec3, f64), vertices: &[u32]| {
            let height = |&v: &u32| normal.dot(&self.edges.points[v as usize]) - offset;
            vertices.iter().all(|v| height(v) <= allowed)
        };
        let mut planes = vec![self.plane(seed)];
        let mut corners = self.vertices[seed as usize].clone();
        // A piece that does not fit now never will: a larger patch has more constraints.
        let mut seen = std::collections::HashSet::from([seed]);
        let mut next = 0;
        while next < patch.len() && patch.len() < MAX_FACES {
            let members = &self.pieces[patch[next] as usize].members;
            next += 1;
            let around = members
                .iter()
                .flat_map(|&i| &self.edges.neighbours[i as usize]);
            for neighbour in around {
                let other = self.piece_of[neighbour.polygon as usize];
                if patch.len() >= MAX_FACES || !seen.insert(other) || taken[other as usize] {
                    continue;
                }
                let plane = self.plane(other);
                let own = &self.vertices[other as usize];
                if below(&plane, &corners) && planes.iter().all(|plane| below(plane, own)) {
                    patch.push(other);
                    planes.push(plane);
                    let known = |v: &&u32| !corners.contains(v);
                    let new: Vec<u32> = own.iter().filter(known).copied().collect();
                    corners.extend(new);
                }
            }
        }
        // Any first pieces of a patch are a patch too, so bisection finds how many keep the hull inside.
        let (mut good, mut bad) = (1, patch.len() + 1);
        let mut tried = patch.len();
        while bad - good > 1 {
            if self.lies_inside(&patch[..tried]) {
                good = tried;
            } else {
                bad = tried;
            }
            tried = good.midpoint(bad);
        }
        patch.truncate(good);
        patch
    }

    /// Whether no other part of the surface intrudes into the hull of a patch. Then the whole hull is inside the body, since
    /// its faces are faces of the surface and point outwards.
    fn lies_inside(&self, patch: &[u32]) -> bool {
        let mut corners: Vec<u32> = patch
            .iter()
            .flat_map(|&piece| &self.vertices[piece as usize])
            .copied()
            .collect();
        corners.sort_unstable();
        corners.dedup();
        let points: Vec<Vec3> = corners
            .iter()
            .map(|&v| self.edges.points[v as usize])
            .collect();
        let Ok(hull) = convex_polyhedron(&points) else {
            return false;
        };
        if !hull.is_solid() {
            return false;
        }
        let depth = DEPTH * self.diameter;
        let planes: Vec<(Vec3, f64)> = hull
            .faces
            .iter()
            .map(|face| {
                let corner = hull.vertices[face.vertices[0] as usize];
                (face.normal, face.normal.dot(&corner) - depth)
            })
            .collect();
        let extent = Extent::of(&points);
        !self.boxes.any(&extent, |i| {
            !patch.contains(&self.piece_of[i as usize])
                && intrudes(&self.primitives[i as usize], &planes)
        })
    }
}

/// Whether some of a primitive lies below all the planes. Polygons are clipped; other primitives count as inside unless all
/// their points lie above one plane.
fn intrudes(primitive: &Convex, planes: &[(Vec3, f64)]) -> bool {
    let height = |(normal, offset): &(Vec3, f64), p: &Vec3| normal.dot(p) - offset;
    if !primitive.is_flat() {
        let beyond = |plane| {
            primitive
                .bounding_points()
                .iter()
                .all(|v| height(plane, v) >= 0.0)
        };
        return !planes.iter().any(beyond);
    }
    let mut outline = primitive.vertices.to_vec();
    for plane in planes {
        let mut clipped = Vec::with_capacity(outline.len() + 1);
        for (k, from) in outline.iter().enumerate() {
            let to = &outline[(k + 1) % outline.len()];
            let (at_from, at_to) = (height(plane, from), height(plane, to));
            if at_from < 0.0 {
                clipped.push(*from);
            }
            if (at_from < 0.0) != (at_to < 0.0) {
                clipped.push(from.lerp(to, at_from / (at_from - at_to)));
            }
        }
        if clipped.is_empty() {
            return false;
        }
        outline = clipped;
    }
    true
}

/// The signed volume inside a closed surface of flat polygons.
fn volume(primitives: &[Convex], component: &[u32]) -> f64 {
    let origin = primitives[component[0] as usize].vertices[0];
    component
        .iter()
        .filter_map(|&i| Some((i, primitives[i as usize].faces.first()?)))
        .flat_map(|(i, face)| {
            let corner =
                move |k: usize| primitives[i as usize].vertices[face.vertices[k] as usize] - origin;
            (1..face.vertices.len() - 1)
                .map(move |k| corner(0).dot(&corner(k).cross(&corner(k + 1))) / 6.0)
        })
        .sum()
}

/// A tree over the primitives' boxes, to find those that intersect a box.
struct BoxTree {
    forest: Forest,
    root: u32,
}

impl BoxTree {
    fn of(primitives: &[Convex]) -> Self {
        let extents = primitives
            .iter()
            .map(|p| Extent::of(p.bounding_points()))
            .collect();
        let mut forest = Forest::new(extents);
        let all: Vec<u32> = (0..primitives.len() as u32).collect();
        let levels = levels_for(all.len());
        let root = split_within(&mut forest, all, levels);
        Self { forest, root }
    }

    /// Whether any primitive whose box intersects `extent` satisfies a condition.
    fn any(&self, extent: &Extent, condition: impl Fn(u32) -> bool) -> bool {
        let mut stack = vec![self.root];
        while let Some(body) = stack.pop() {
            if self.forest.extents[body as usize].gap(extent) > 0.0 {
                continue;
            }
            match (body as usize).checked_sub(self.forest.leaves) {
                None if condition(body) => return true,
                None => {}
                Some(pair) => stack.extend(self.forest.children[pair]),
            }
        }
        false
    }
}
