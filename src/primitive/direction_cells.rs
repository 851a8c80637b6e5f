//! A lookup table from cells of directions to their possible support vertices: a support point in constant time for any number
//! of vertices, as the report asks (§2.3.4).

use crate::pose::Vec3;
use crate::tolerance;

/// The sphere of directions, projected on the sides of a cube, and these divided into square cells; each cell lists its
/// vertices. There are half to twice as many cells as vertices, and most cells list a few vertices.
#[derive(Clone, Debug)]
pub struct DirectionCells {
    /// Cells along a side of the cube.
    side: usize,
    /// The vertices of cell i are `vertices[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    vertices: Vec<u32>,
}

/// A square of directions on a side of the cube, measured in cells.
#[derive(Clone, Copy)]
struct Square {
    face: usize,
    u: usize,
    v: usize,
    width: usize,
}

impl DirectionCells {
    pub fn new(points: &[Vec3]) -> Self {
        let side = 1 << (points.len() / 3).max(1).isqrt().ilog2();
        Self::with_side(points, side)
    }

    /// The table with `side` cells along a side of the cube, or with fewer if its lists would be very long in total: for discs,
    /// thin prisms, and points that coincide up to rounding.
    fn with_side(points: &[Vec3], side: usize) -> Self {
        let middle = points.iter().sum::<Vec3>() / points.len() as f64;
        let sorter = Sorter {
            points,
            middle,
            size: points
                .iter()
                .fold(0.0, |most, p| (p - middle).norm().max(most)),
            side,
        };
        let mut cells = vec![Vec::new(); 6 * side * side];
        let mut left = MAX_ENTRIES * points.len();
        let all: Vec<u32> = (0..points.len() as u32).collect();
        for face in 0..6 {
            let whole = Square {
                face,
                u: 0,
                v: 0,
                width: side,
            };
            let fits = sorter.sort_into(&mut cells, whole, &all, &mut left);
            if !fits && side > 1 {
                return Self::with_side(points, side / 2);
            }
        }
        let mut made = Self {
            side,
            starts: Vec::with_capacity(cells.len() + 1),
            vertices: Vec::new(),
        };
        for cell in cells {
            made.starts.push(made.vertices.len() as u32);
            made.vertices.extend(cell);
        }
        made.starts.push(made.vertices.len() as u32);
        made
    }

    /// The support point along a direction; `points` are those that the cells were built from.
    #[inline(always)]
    pub fn farthest(&self, points: &[Vec3], direction: &Vec3) -> u32 {
        let cell = self.cell(direction);
        let [start, end] = [cell, cell + 1].map(|i| self.starts[i] as usize);
        let (mut best, mut value) = (0, f64::NEG_INFINITY);
        for &i in &self.vertices[start..end] {
            let here = direction.dot(&points[i as usize]);
            best = if here > value { i } else { best };
            value = if here > value { here } else { value };
        }
        best
    }

    /// The cell of a direction, or a neighbour where rounding decides.
    #[inline(always)]
    fn cell(&self, direction: &Vec3) -> usize {
        let [x, y, z] = [direction.x, direction.y, direction.z];
        let (face, most, u, v) = if x.abs() >= y.abs() && x.abs() >= z.abs() {
            (usize::from(x < 0.0), x.abs(), y, z)
        } else if y.abs() >= z.abs() {
            (2 + usize::from(y < 0.0), y.abs(), x, z)
        } else {
            (4 + usize::from(z < 0.0), z.abs(), x, y)
        };
        // For the zero direction the quotient is NaN, which becomes 0 as an integer.
        let scale = 0.5 * self.side as f64;
        let place = |part: f64| ((part / most + 1.0) * scale) as usize;
        let [u, v] = [u, v].map(|part| place(part).min(self.side - 1));
        (face * self.side + u) * self.side + v
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.vertices[..])
    }
}

/// The direction to the point (u, v) on a side of the cube; u and v are from -1 to 1.
fn direction(face: usize, u: f64, v: f64) -> Vec3 {
    let sign = if face.is_multiple_of(2) { 1.0 } else { -1.0 };
    match face / 2 {
        0 => Vec3::new(sign, u, v),
        1 => Vec3::new(u, sign, v),
        _ => Vec3::new(u, v, sign),
    }
}

/// Cells overlap by this fraction of a cell, so that a neighbour chosen by rounding is right too.
const OVERLAP: f64 = 1e-6;

/// At most 16 entries per vertex over all cells, unless there are only six cells, each of which may list all vertices.
const MAX_ENTRIES: usize = 16;

/// The points to be sorted into cells.
struct Sorter<'a> {
    points: &'a [Vec3],
    middle: Vec3,
    /// The largest distance of a point from the middle.
    size: f64,
    /// Cells along a side of the cube.
    side: usize,
}

impl Sorter<'_> {
    /// Fills each cell of a square with those candidates that may be the support point along one of its directions. Returns
    /// false if the entries exceed `left`.
    fn sort_into(
        &self,
        cells: &mut [Vec<u32>],
        square: Square,
        candidates: &[u32],
        left: &mut usize,
    ) -> bool {
        let Square { face, u, v, width } = square;
        let side = self.side;
        let place = |cell: usize, end: usize| {
            let end = end as f64 * width as f64;
            let overlap = if end > 0.0 { OVERLAP } else { -OVERLAP };
            2.0 * (cell as f64 + end + overlap) / side as f64 - 1.0
        };
        let corners = [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(i, j)| direction(face, place(u, i), place(v, j)));
        let kept = self.undominated(&corners, candidates);
        if width == 1 {
            let fits = kept.len() <= *left;
            *left = left.saturating_sub(kept.len());
            cells[(face * side + u) * side + v] = kept;
            return fits || side == 1;
        }
        let width = width / 2;
        let quarters = [
            (u, v),
            (u, v + width),
            (u + width, v),
            (u + width, v + width),
        ];
        quarters.into_iter().all(|(u, v)| {
            let quarter = Square { face, u, v, width };
            self.sort_into(cells, quarter, &kept, left)
        })
    }

    /// Drops the candidates that another point exceeds along all four corners of a square of directions: it then does so along
    /// all directions between them.
    fn undominated(&self, corners: &[Vec3; 4], candidates: &[u32]) -> Vec<u32> {
        let heights = |i: &u32| {
            let offset = self.points[*i as usize] - self.middle;
            corners.map(|corner| corner.dot(&offset))
        };
        let all: Vec<[f64; 4]> = candidates.iter().map(heights).collect();
        let mean = |h: &[f64; 4]| h[0] + h[1] + h[2] + h[3];
        // The support points along the corners and along the middle dominate most others.
        let farthest = |value: &dyn Fn(&[f64; 4]) -> f64| {
            all.iter()
                .max_by(|a, b| value(a).total_cmp(&value(b)))
                .copied()
        };
        let best = [
            farthest(&|h| h[0]),
            farthest(&|h| h[1]),
            farthest(&|h| h[2]),
            farthest(&|h| h[3]),
            farthest(&mean),
            farthest(&|h| h.iter().copied().fold(f64::INFINITY, f64::min)),
        ];
        // The corner directions are at most sqrt(3) long.
        let rounding = 8.0 * tolerance::EPSILON * self.size;
        let is_dominated = |h: &[f64; 4]| {
            let mut by = best.iter().flatten();
            by.any(|other| (0..4).all(|k| other[k] - h[k] > rounding))
        };
        let kept = candidates
            .iter()
            .zip(&all)
            .filter(|(_, h)| !is_dominated(h));
        kept.map(|(i, _)| *i).collect()
    }
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;
    use crate::gjk::{PointCloud, Support};

    /// Points that coincide up to rounding, and discs, of which each vertex may be the support point in many cells.
    #[test]
    fn cells_have_few_vertices() {
        for (count, flat, far) in [(20_000, 0.0, 0.0), (5000, 1e-3, 0.0), (4000, 1.0, 1e20)] {
            let on_circle = |i: usize| {
                let (sin, cos) = (i as f64).sin_cos();
                Vec3::new(cos + far, sin + far, flat * ((i % 2) as f64) + far)
            };
            let points: Vec<Vec3> = (0..count).map(on_circle).collect();
            let cells = DirectionCells::new(&points);
            assert!(cells.bytes() <= 80 * count, "{}", cells.bytes());
            let found = cells.farthest(&points, &Vec3::x());
            let truth = PointCloud(&points).support(&Vec3::x());
            assert_eq!(points[found as usize].x, truth.x);
        }
    }

    #[test]
    fn cells_know_the_farthest() {
        let mut random = Random::new(1);
        let mut random = || random.within(-1.0, 1.0);
        for count in [1, 2, 3, 20, 50, 500, 3000] {
            let flat = if count == 20 { 0.0 } else { 1.0 };
            let points: Vec<Vec3> = (0..count)
                .map(|_| {
                    Vec3::new(random(), random(), random())
                        .normalize()
                        .component_mul(&Vec3::new(1.0, 0.3, 2.0 * flat))
                })
                .collect();
            let cells = DirectionCells::new(&points);
            let mut directions: Vec<Vec3> = (0..5000)
                .map(|_| Vec3::new(random(), random(), random()))
                .collect();
            // Directions on the borders of cells, and along the axes.
            for i in 0..64 {
                let at = |n: i32| f64::from(n) / 4.0 - 1.0;
                directions.push(Vec3::new(at(i % 9), 1.0, at(i / 9 + 1)));
                directions.push(-Vec3::new(at(i % 9), at(i / 9 + 1), 1.0));
            }
            directions.extend([
                Vec3::x(),
                -Vec3::y(),
                Vec3::z(),
                Vec3::new(0.0, -0.0, -1.0),
                Vec3::zeros(),
            ]);
            for direction in directions {
                let found = points[cells.farthest(&points, &direction) as usize];
                let truth = PointCloud(&points).support(&direction);
                assert!(direction.dot(&found) >= direction.dot(&truth) - 1e-15 * direction.norm());
            }
            assert!(
                cells.bytes() < 200 + 80 * count,
                "{count}: {}",
                cells.bytes()
            );
        }
    }
}
