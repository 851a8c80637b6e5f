//! Extreme points of a set along fixed directions.

use std::sync::LazyLock;

use crate::pose::Vec3;

/// Number of sampled directions. Each gives two extreme points, so a hull with many vertices shows more of them than any
/// usual vertex limit.
const LINES: usize = 48;

static DIRECTIONS: LazyLock<[Vec3; LINES]> = LazyLock::new(|| {
    // Evenly spread over a hemisphere, none along a coordinate axis, where the vertices of a face would tie.
    std::array::from_fn(|i| {
        let height = 1.0 - (i as f64 + 0.37) / LINES as f64;
        let azimuth = 2.399_963_229_728_653 * i as f64 + 0.5;
        let across = (1.0 - height * height).sqrt();
        Vec3::new(across * azimuth.cos(), across * azimuth.sin(), height)
    })
});

/// Points are processed in blocks of this many, structure of arrays, that fit the L1 cache.
const BLOCK: usize = 256;

/// The extreme points along all directions, both ways: vertices of the points' hull, each once.
pub fn extremes(points: &[Vec3]) -> Vec<Vec3> {
    extremes_along(points, 1)
}

/// The same along every third direction, which is enough to fit a box.
pub fn few_extremes(points: &[Vec3]) -> Vec<Vec3> {
    extremes_along(points, 3)
}

/// The extreme points along every `step`-th direction.
fn extremes_along(points: &[Vec3], step: usize) -> Vec<Vec3> {
    let mut low = [(0, f64::INFINITY); LINES];
    let mut high = [(0, f64::NEG_INFINITY); LINES];
    for (b, block) in points.chunks(BLOCK).enumerate() {
        let mut along = [0.0; BLOCK];
        let mut coordinates = [[0.0; BLOCK]; 3];
        for (i, p) in block.iter().enumerate() {
            for axis in 0..3 {
                coordinates[axis][i] = p[axis];
            }
        }
        let [x, y, z] = &coordinates;
        for (k, direction) in DIRECTIONS.iter().step_by(step).enumerate() {
            for i in 0..BLOCK {
                along[i] = direction.x * x[i] + direction.y * y[i] + direction.z * z[i];
            }
            let along = &along[..block.len()];
            let (least, most) = min_max(along);
            let index =
                |value: f64| b * BLOCK + along.iter().position(|&a| a == value).unwrap_or(0);
            if least < low[k].1 {
                low[k] = (index(least), least);
            }
            if most > high[k].1 {
                high[k] = (index(most), most);
            }
        }
    }
    let count = LINES.div_ceil(step);
    let ends = low[..count].iter().chain(&high[..count]);
    let mut indices: Vec<usize> = ends.map(|end| end.0).collect();
    indices.sort_unstable();
    indices.dedup();
    indices.into_iter().map(|i| points[i]).collect()
}

/// The least and the largest value. Four independent chains of comparisons hide their latency.
fn min_max(values: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    let (fours, rest) = values.as_chunks::<4>();
    for four in fours {
        for lane in 0..4 {
            low[lane] = if four[lane] < low[lane] {
                four[lane]
            } else {
                low[lane]
            };
            high[lane] = if four[lane] > high[lane] {
                four[lane]
            } else {
                high[lane]
            };
        }
    }
    let all = |lanes: [f64; 4]| lanes.into_iter().chain(rest.iter().copied());
    (
        all(low).fold(f64::INFINITY, f64::min),
        all(high).fold(f64::NEG_INFINITY, f64::max),
    )
}
