//! Checks that faces form the closed boundary of a solid, and orients them consistently.

use std::collections::HashMap;
use std::fmt::Write;

use foldhash::fast::RandomState;

use super::surface_edges::{EdgeUse, Outline, SurfaceEdges};
use crate::error::{Error, ErrorKind, Result};
use crate::pose::Vec3;

/// The most edges that an error message names.
const MAX_NAMED: usize = 3;

/// Orients the faces of a closed surface. Returns for each face 1 as given, -1 reversed, 0 unused (a face without area that
/// the others do not need).
///
/// Closed means that as many faces run along each edge one way as the other. Where exactly two faces share an edge, one of them
/// may be reversed so that they run along it in opposite directions. Faces connected over such edges form a component. Of its
/// faces, those given one way and those given the other way, the part with the larger area keeps its orientation; of equal
/// parts, that of the first face. Fails if edges are open, or if a component is one-sided. Fails too if each face of a
/// component has a reversed copy, for then it bounds nothing.
pub fn closed_surface(faces: &[Outline]) -> Result<Vec<i8>> {
    let mut edges = SurfaceEdges::of(faces);
    let is_kept = edges.closing(faces);
    edges.retain(&is_kept);
    let surface = Surface { faces, edges };
    surface.refuse_open(is_fillable, "open")?;
    let reversed = surface.reversed_faces()?;
    let sign = |face: usize| if reversed[face] { -1 } else { 1 };
    let is_even = |family: &[EdgeUse]| {
        let sum: i32 = family.iter().map(|u| u.net * sign(u.face as usize)).sum();
        sum == 0
    };
    surface.refuse_open(is_even, "used more often one way than the other")?;
    let signs: Vec<i8> = (0..faces.len())
        .map(|face| if is_kept[face] { sign(face) as i8 } else { 0 })
        .collect();
    surface.refuse_cancelled(&signs)?;
    Ok(signs)
}

/// Whether the uses of an edge can balance under some orientation of its faces.
fn is_fillable(family: &[EdgeUse]) -> bool {
    let sum: i32 = family.iter().map(|used| used.net.abs()).sum();
    let largest = family.iter().map(|used| used.net.abs()).max();
    sum % 2 == 0 && largest.is_none_or(|largest| 2 * largest <= sum)
}

struct Surface<'a> {
    faces: &'a [Outline<'a>],
    edges: SurfaceEdges,
}

impl Surface<'_> {
    /// Which faces to reverse; fails for a one-sided surface.
    fn reversed_faces(&self) -> Result<Vec<bool>> {
        let mut sides = Sides::new(self.faces.len());
        for family in self.edges.families() {
            if let [a, b] = family
                && !sides.join(a.face, b.face, a.net == b.net)
            {
                return Err(Error::new(
                    ErrorKind::NotClosed,
                    format!(
                        "the surface has one side only: going round it, one comes back to {} from behind",
                        self.name(family)
                    ),
                ));
            }
        }
        // By root: the area of the faces on the same side as its first face, less that of the others; and the first face's
        // side.
        let mut balance: HashMap<u32, (f64, bool), RandomState> = HashMap::default();
        let found: Vec<(u32, bool)> = (0..self.faces.len() as u32)
            .map(|face| sides.find(face))
            .collect();
        for (face, &(root, side)) in self.faces.iter().zip(&found) {
            let (sum, first) = balance.entry(root).or_insert((0.0, side));
            let area = area_vector(face.vertices).norm();
            *sum += if side == *first { area } else { -area };
        }
        let is_reversed = |&(root, side): &(u32, bool)| {
            let (sum, first) = balance[&root];
            (side != first) != (sum < 0.0)
        };
        Ok(found.iter().map(is_reversed).collect())
    }

    fn refuse_open(&self, is_closed: impl Fn(&[EdgeUse]) -> bool, what: &str) -> Result<()> {
        let open: Vec<&[EdgeUse]> = self.edges.families().filter(|f| !is_closed(f)).collect();
        if open.is_empty() {
            return Ok(());
        }
        let mut message = match open.len() {
            1 => format!("the surface is not closed, 1 edge is {what}: "),
            count => format!("the surface is not closed, {count} edges are {what}: "),
        };
        for (i, family) in open.iter().take(MAX_NAMED).enumerate() {
            let comma = if i == 0 { "" } else { "; " };
            // Writing to a String cannot fail.
            let _ = write!(message, "{comma}{}", self.name(family));
        }
        if open.len() > MAX_NAMED {
            let _ = write!(message, "; and {} more", open.len() - MAX_NAMED);
        }
        Err(Error::new(ErrorKind::NotClosed, message))
    }

    /// The text that names an edge and the faces that use it.
    fn name(&self, family: &[EdgeUse]) -> String {
        let [from, to] = family[0].edge.map(|i| self.edges.points[i as usize]);
        let point = |p: Vec3| format!("({}, {}, {})", p.x, p.y, p.z);
        let mut name = format!("the edge from {} to {} of", point(from), point(to));
        for (i, used) in family.iter().take(MAX_NAMED + 1).enumerate() {
            let face = &self.faces[used.face as usize];
            let comma = if i == 0 { "" } else { "," };
            let _ = match face.primitive {
                _ if i == MAX_NAMED => write!(name, ", ..."),
                Some(primitive) => write!(name, "{comma} primitive {primitive} (tag {})", face.tag),
                None => write!(name, "{comma} a face without area (tag {})", face.tag),
            };
        }
        name
    }

    /// Refuses a component without inside because each face has a reversed copy: a mesh whose faces were all given from both
    /// sides. It would pass as solid but contain nothing.
    fn refuse_cancelled(&self, signs: &[i8]) -> Result<()> {
        let mut sums: HashMap<Vec<u32>, i32, RandomState> = HashMap::default();
        let is_face = |face: usize| self.faces[face].primitive.is_some();
        let keys = self.edges.rings.iter().map(|ring| canonical(ring));
        let keys: Vec<(Vec<u32>, i32)> = keys.collect();
        for (face, (key, way)) in keys.iter().enumerate().filter(|(face, _)| is_face(*face)) {
            *sums.entry(key.clone()).or_insert(0) += way * i32::from(signs[face]);
        }
        let mut sides = Sides::new(self.faces.len());
        for family in self.edges.families() {
            for used in &family[1..] {
                sides.join(family[0].face, used.face, false);
            }
        }
        let mut bounds_something = vec![false; self.faces.len()];
        for (face, (key, _)) in keys.iter().enumerate().filter(|(face, _)| is_face(*face)) {
            bounds_something[sides.find(face as u32).0 as usize] |= sums[key] != 0;
        }
        for (i, face) in self.faces.iter().enumerate() {
            if let Some(primitive) = face.primitive
                && !bounds_something[sides.find(i as u32).0 as usize]
            {
                return Err(Error::new(
                    ErrorKind::Degenerate,
                    format!(
                        "the surface that primitive {primitive} (tag {}) belongs to bounds nothing: each of its faces has a copy that faces the other way",
                        face.tag
                    ),
                ));
            }
        }
        Ok(())
    }
}

/// The canonical form of a ring, from its lowest vertex towards the lower of its neighbours, and whether the ring runs that
/// way (1) or the other (-1).
fn canonical(ring: &[u32]) -> (Vec<u32>, i32) {
    let n = ring.len();
    let start = (0..n).min_by_key(|&i| ring[i]).unwrap_or(0);
    let forwards = (0..n).map(|k| ring[(start + k) % n]);
    let backwards = (0..n).map(|k| ring[(start + n - k) % n]);
    if n < 2 || ring[(start + 1) % n] <= ring[(start + n - 1) % n] {
        (forwards.collect(), 1)
    } else {
        (backwards.collect(), -1)
    }
}

/// The normal of a face, with twice the area as its length.
fn area_vector(vertices: &[Vec3]) -> Vec3 {
    let origin = vertices[0];
    let pairs = vertices.windows(2);
    pairs
        .map(|two| (two[0] - origin).cross(&(two[1] - origin)))
        .sum()
}

/// Union-find over faces with a parity: which faces are connected, and which of those are on the same side.
struct Sides {
    /// The link towards the root, and whether the linked face is on the other side.
    parents: Vec<(u32, bool)>,
}

impl Sides {
    fn new(count: usize) -> Self {
        Self {
            parents: (0..count as u32).map(|i| (i, false)).collect(),
        }
    }

    /// The root, and whether the face is on its other side.
    fn find(&mut self, face: u32) -> (u32, bool) {
        let (mut root, mut side) = (face, false);
        while self.parents[root as usize].0 != root {
            let (next, other) = self.parents[root as usize];
            (root, side) = (next, side ^ other);
        }
        // Path compression.
        let (mut at, mut rest) = (face, side);
        while at != root {
            let (next, other) = std::mem::replace(&mut self.parents[at as usize], (root, rest));
            (at, rest) = (next, rest ^ other);
        }
        (root, side)
    }

    /// Joins two faces on the same side or, if they differ, on opposite sides; false if that contradicts earlier joins.
    fn join(&mut self, a: u32, b: u32, differ: bool) -> bool {
        let ((root_a, side_a), (root_b, side_b)) = (self.find(a), self.find(b));
        if root_a == root_b {
            return (side_a != side_b) == differ;
        }
        self.parents[root_a.max(root_b) as usize] = (root_a.min(root_b), side_a ^ side_b ^ differ);
        true
    }
}
