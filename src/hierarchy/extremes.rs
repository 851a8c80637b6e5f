//! The points of a set that lie farthest out in fixed directions.

use std::sync::LazyLock;

use crate::pose::Vec3;

/// Enough lines that a set with many hull vertices shows more than any usual limit of them.
const LINES: usize = 48;

static DIRECTIONS: LazyLock<[Vec3; LINES]> = LazyLock::new(|| {
    // Evenly spread over half a sphere, and along no axis of coordinates, where faces of models would tie.
    std::array::from_fn(|i| {
        let height = 1.0 - (i as f64 + 0.37) / LINES as f64;
        let azimuth = 2.399_963_229_728_653 * i as f64 + 0.5;
        let across = (1.0 - height * height).sqrt();
        Vec3::new(across * azimuth.cos(), across * azimuth.sin(), height)
    })
});

/// Points are taken in blocks that fit the nearest cache, their coordinates apart.
const BLOCK: usize = 256;

/// The points farthest out along the directions, both ways: vertices of their hull, each once.
pub fn extremes(points: &[Vec3]) -> Vec<Vec3> {
    extremes_along(points, 1)
}

/// The same along a third of the directions, which are enough to fit a box.
pub fn few_extremes(points: &[Vec3]) -> Vec<Vec3> {
    extremes_along(points, 3)
}

/// Along each direction of so many.
fn extremes_along(points: &[Vec3], of: usize) -> Vec<Vec3> {
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
        for (k, direction) in DIRECTIONS.iter().step_by(of).enumerate() {
            for i in 0..BLOCK {
                along[i] = direction.x * x[i] + direction.y * y[i] + direction.z * z[i];
            }
            let along = &along[..block.len()];
            let (least, most) = ends(along);
            let place =
                |value: f64| b * BLOCK + along.iter().position(|&a| a == value).unwrap_or(0);
            if least < low[k].1 {
                low[k] = (place(least), least);
            }
            if most > high[k].1 {
                high[k] = (place(most), most);
            }
        }
    }
    let asked = LINES.div_ceil(of);
    let ends = low[..asked].iter().chain(&high[..asked]);
    let mut indices: Vec<usize> = ends.map(|end| end.0).collect();
    indices.sort_unstable();
    indices.dedup();
    indices.into_iter().map(|i| points[i]).collect()
}

/// The least and the largest value; several at a time, so that they do not wait for each other.
fn ends(values: &[f64]) -> (f64, f64) {
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
