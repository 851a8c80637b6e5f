//! Tiny screws on a huge floor.

use crate::grid::snapped;
use crate::loft::{Ends, loft};
use crate::mesh::Mesh;
use crate::point::{Point, across, plus, times};
use crate::random::Random;

/// Polygons of one screw.
const SCREW: usize = 25;

/// One square floor, 10 wide, in the plane z = 0, and on it as many screws at random poses as `polygons` allows: 25
/// polygons each, so the count is up to 24 short.
///
/// A screw is 0.02 to 0.04 long, closed, with a hexagonal head and shaft and a point; its lowest vertex is 1e-6 above
/// the floor. Screws may run into one another. The extreme ratio of sizes is a hard case for grouping by size. Faces
/// are planar to the last bit.
pub fn floor_and_screws(polygons: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut mesh = Mesh {
        vertices: vec![
            [-5.0, -5.0, 0.0],
            [5.0, -5.0, 0.0],
            [5.0, 5.0, 0.0],
            [-5.0, 5.0, 0.0],
        ],
        faces: vec![vec![0, 1, 2, 3]],
    };
    for _ in 0..polygons.saturating_sub(1) / SCREW {
        let screw = screw(random.within(0.02, 0.04), random.direction());
        let place = [random.within(-4.9, 4.9), random.within(-4.9, 4.9), 1e-6];
        let lift = [place[0], place[1], place[2] - screw.bounds().0[2]];
        mesh.append(&shifted(&screw, snapped(lift)));
    }
    mesh
}

/// A screw with the point towards `axis`, made of whole and half multiples of three vectors.
fn screw(length: f64, axis: Point) -> Mesh {
    let (x, y) = across(axis);
    let radius = 0.2 * length;
    let u = snapped(times(radius, x));
    // At 60 degrees to u, so that u, v, v - u and their opposites are a regular hexagon.
    let v = snapped(plus(
        times(radius / 2.0, x),
        times(radius * 0.75f64.sqrt(), y),
    ));
    let along = |share: f64| snapped(times(share * length, axis));
    let hexagon = |size: f64, centre: Point| {
        [
            (1.0, 0.0),
            (0.0, 1.0),
            (-1.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (1.0, -1.0),
        ]
        .map(|(a, b)| plus(centre, plus(times(size * a, u), times(size * b, v))))
        .to_vec()
    };
    let rings = [
        hexagon(1.0, along(0.0)),
        hexagon(1.0, along(0.2)),
        hexagon(0.5, along(0.2)),
        hexagon(0.5, along(0.85)),
        vec![along(1.0)],
    ];
    loft(&rings, Ends::Capped)
}

fn shifted(mesh: &Mesh, by: Point) -> Mesh {
    Mesh {
        vertices: mesh.vertices.iter().map(|&p| plus(p, by)).collect(),
        faces: mesh.faces.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_screw_has_25_polygons_and_lies_on_the_floor() {
        let mesh = floor_and_screws(1001, 4);
        assert_eq!(mesh.polygons(), 1001);
        assert_eq!(floor_and_screws(1000, 4).polygons(), 976);
        let lowest = mesh.vertices[4..].iter().map(|p| p[2]);
        let lowest = lowest.fold(f64::INFINITY, f64::min);
        assert!(lowest > 0.0 && lowest < 2e-6);
    }
}
