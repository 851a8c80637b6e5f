//! A box of uncooked spaghetti.

use crate::grid::snapped;
use crate::mesh::Mesh;
use crate::point::{Point, across, minus, plus, times, unit};
use crate::random::Random;

/// Straight square rods that cross the unit box along x, slightly askew: `polygons / 6` of them, rounded up, each of
/// four long quads and two ends.
///
/// The rods begin and end on two opposite sides of the box, together have about a quarter of its cross-section and run
/// through one another here and there. A hard case for grouping by size and nearness ("closely packed like uncooked
/// spaghetti", §3.2.1). Each rod is closed, and its faces are planar to the last bit.
pub fn spaghetti(polygons: usize, seed: u64) -> Mesh {
    let rods = polygons.div_ceil(6);
    let half = 0.25 / (rods as f64).sqrt();
    let mut random = Random::new(seed);
    let mut mesh = Mesh::default();
    for _ in 0..rods {
        let mut end = |x: f64| [x, random.within(0.0, 1.0), random.within(0.0, 1.0)];
        let (from, aim) = (end(0.0), end(1.0));
        let to = [
            1.0,
            0.9 * from[1] + 0.1 * aim[1],
            0.9 * from[2] + 0.1 * aim[2],
        ];
        rod(&mut mesh, from, to, half);
    }
    mesh
}

/// Adds a rod `2 * half` wide and high.
fn rod(mesh: &mut Mesh, from: Point, to: Point, half: f64) {
    let (u, v) = across(unit(minus(to, from)));
    let (u, v) = (snapped(times(half, u)), snapped(times(half, v)));
    let base = mesh.vertices.len() as u32;
    for centre in [snapped(from), snapped(to)] {
        let (right, left) = (plus(centre, u), minus(centre, u));
        mesh.vertices.extend([
            minus(left, v),
            minus(right, v),
            plus(right, v),
            plus(left, v),
        ]);
    }
    for i in 0..4 {
        let j = (i + 1) % 4;
        mesh.faces
            .push(vec![base + i, base + j, base + j + 4, base + i + 4]);
    }
    mesh.faces.push(vec![base + 3, base + 2, base + 1, base]);
    mesh.faces
        .push(vec![base + 4, base + 5, base + 6, base + 7]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn six_faces_for_each_rod() {
        assert_eq!(spaghetti(600, 1).polygons(), 600);
        assert_eq!(spaghetti(601, 1).polygons(), 606);
    }
}
