//! A sphere with smooth bumps.

use std::f64::consts::{PI, TAU};

use crate::mesh::Mesh;
use crate::point::{Point, dot, times};
use crate::random::Random;

/// A sphere about the origin with smooth bumps: one closed surface of `polygons` triangles of much the same size, one
/// more if `polygons` is odd; at least 100 and at most a million.
///
/// Its radius stays between 0.76 and 1.24. The vertices lie on circles of latitude that have as many of them as there
/// is room for.
pub fn bumpy_sphere(polygons: usize, seed: u64) -> Mesh {
    let random = &mut Random::new(seed);
    let bumps: Vec<Bump> = (0..8).map(|_| Bump::new(random)).collect();
    let mut mesh = Mesh::default();
    let mut rings: Vec<Vec<u32>> = Vec::new();
    let counts = ring_sizes(polygons.div_ceil(2));
    let last = counts.len() - 1;
    for (k, &count) in counts.iter().enumerate() {
        // Exact at the poles, where sine and cosine are not.
        let latitude = PI * k as f64 / last as f64;
        let (r, z) = match k {
            0 => (0.0, -1.0),
            _ if k == last => (0.0, 1.0),
            _ => (latitude.sin(), -latitude.cos()),
        };
        let ring = (0..count).map(|i| {
            let (s, c) = (TAU * i as f64 / count as f64).sin_cos();
            let direction = [r * c, r * s, z];
            let radius = 1.0 + bumps.iter().map(|b| b.height(direction)).sum::<f64>();
            mesh.add_vertex(times(radius, direction))
        });
        rings.push(ring.collect());
    }
    for pair in rings.windows(2) {
        stitch(&mut mesh, &pair[0], &pair[1]);
    }
    mesh
}

/// A wave over the sphere.
struct Bump {
    direction: Point,
    phase: f64,
}

impl Bump {
    fn new(random: &mut Random) -> Bump {
        Bump {
            direction: times(random.within(3.0, 9.0), random.direction()),
            phase: random.within(0.0, TAU),
        }
    }

    fn height(&self, direction: Point) -> f64 {
        0.03 * (dot(self.direction, direction) + self.phase).sin()
    }
}

/// The numbers of vertices on the circles of latitude from pole to pole, `2 + half` in all; each pole has one.
///
/// With that many vertices a closed surface has `2 * half` triangles.
fn ring_sizes(half: usize) -> Vec<usize> {
    // On circles as far apart as the vertices on them are, a sphere has room for 4/π times the square of their number.
    let circles = ((half as f64 * PI / 4.0).sqrt().round() as usize).max(2);
    let share = |k: usize| (PI * k as f64 / (circles + 1) as f64).sin();
    let room: f64 = (1..=circles).map(share).sum();
    let mut sizes = vec![1];
    let (mut wanted, mut given) = (0.0, 0);
    for k in 1..=circles {
        wanted += half as f64 * share(k) / room;
        let size = (wanted.round() as usize).saturating_sub(given).max(3);
        given += size;
        sizes.push(size);
    }
    // Circles with the least number may have taken more than there was.
    let middle = sizes.len() / 2;
    sizes[middle] = sizes[middle] + half - given;
    sizes.push(1);
    sizes
}

/// Fills the strip between two rings, the lower first, both counter-clockwise seen from above.
fn stitch(mesh: &mut Mesh, lower: &[u32], upper: &[u32]) {
    let (a, b) = (lower.len(), upper.len());
    let (mut i, mut j) = (0, 0);
    // A ring of one point has no edges to go along.
    let (edges_below, edges_above) = (if a > 1 { a } else { 0 }, if b > 1 { b } else { 0 });
    while i < edges_below || j < edges_above {
        let ahead_below = (2 * i + 1) * edges_above;
        let ahead_above = (2 * j + 1) * edges_below;
        if j == edges_above || (i < edges_below && ahead_below <= ahead_above) {
            mesh.faces
                .push(vec![lower[i], lower[(i + 1) % a], upper[j % b]]);
            i += 1;
        } else {
            mesh.faces
                .push(vec![lower[i % a], upper[(j + 1) % b], upper[j]]);
            j += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_triangles_as_asked_for() {
        for polygons in [100, 101, 150, 276, 1000, 4096, 99_999] {
            assert_eq!(
                bumpy_sphere(polygons, 3).polygons(),
                polygons.div_ceil(2) * 2
            );
        }
    }

    #[test]
    fn the_radius_stays_near_one() {
        for p in bumpy_sphere(5000, 9).vertices {
            assert!((0.76..1.24).contains(&dot(p, p).sqrt()));
        }
    }
}
