//! The points of a set that lie farthest out in fixed directions.

use std::sync::LazyLock;

use super::Extent;
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

/// Vertices of the hull of a set, each once, and its box.
pub struct Extremes {
    pub points: Vec<Vec3>,
    pub extent: Extent,
}

/// The points farthest out along the directions, both ways.
pub fn extremes(points: &[Vec3]) -> Extremes {
    let mut indices: Vec<usize> = Vec::with_capacity(2 * LINES);
    for direction in DIRECTIONS.iter() {
        let (mut low, mut high) = ((0, f64::INFINITY), (0, f64::NEG_INFINITY));
        for (i, p) in points.iter().enumerate() {
            let along = direction.dot(p);
            if along < low.1 {
                low = (i, along);
            }
            if along > high.1 {
                high = (i, along);
            }
        }
        indices.extend([low.0, high.0]);
    }
    indices.sort_unstable();
    indices.dedup();
    Extremes {
        points: indices.iter().map(|&i| points[i]).collect(),
        extent: Extent::of(points),
    }
}
