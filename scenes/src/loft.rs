//! Surfaces spanned between rings of points.

use crate::mesh::Mesh;
use crate::point::Point;

/// What happens at the first and the last ring of a loft.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Ends {
    /// Each is closed by one face, unless it is a single point.
    Capped,
    /// The last is joined to the first.
    Joined,
}

/// The closed surface through `rings`, all of one length or a single point (a pole).
///
/// A ring runs counter-clockwise seen from the next ring. Neighbouring rings are joined by quads, or by triangles at a
/// pole; the caller sees to it that quads and caps are planar.
pub(crate) fn loft(rings: &[Vec<Point>], ends: Ends) -> Mesh {
    let mut mesh = Mesh::default();
    let rings: Vec<Vec<u32>> = rings
        .iter()
        .map(|ring| ring.iter().map(|&p| mesh.add_vertex(p)).collect())
        .collect();
    let (first, last) = (&rings[0], &rings[rings.len() - 1]);
    for pair in rings.windows(2) {
        join(&mut mesh, &pair[0], &pair[1]);
    }
    match ends {
        Ends::Joined => join(&mut mesh, last, first),
        Ends::Capped => {
            if first.len() > 1 {
                mesh.faces.push(first.iter().rev().copied().collect());
            }
            if last.len() > 1 {
                mesh.faces.push(last.clone());
            }
        }
    }
    mesh
}

fn join(mesh: &mut Mesh, lower: &[u32], upper: &[u32]) {
    let sides = lower.len().max(upper.len());
    for i in 0..sides {
        let j = (i + 1) % sides;
        mesh.faces.push(match (lower.len(), upper.len()) {
            (1, _) => vec![lower[0], upper[j], upper[i]],
            (_, 1) => vec![lower[i], lower[j], upper[0]],
            _ => vec![lower[i], lower[j], upper[j], upper[i]],
        });
    }
}
