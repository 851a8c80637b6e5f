//! A teapot.

use crate::curve::bezier;
use crate::lathe::lathe;
use crate::mesh::Mesh;
use crate::point::{Point, between};
use crate::tube::tube;

/// A teapot, 1920 polygons: body and lid of revolution, a bent spout along x and a handle opposite.
///
/// About 1.7 from handle to spout, 1 wide and 0.8 high, standing on z = 0; the body is solid. A union of closed parts
/// that overlap. Reconstructs the model of figure 4 (§2.3.5), of which the report gives the count.
pub fn teapot() -> Mesh {
    Mesh::union([body(), lid(), spout(), handle()])
}

fn body() -> Mesh {
    let mut profile = vec![[0.30, 0.0], [0.32, 0.02]];
    let belly = [[0.31, 0.05], [0.62, 0.12], [0.58, 0.46], [0.34, 0.56]];
    profile.extend(bezier(belly, 22));
    profile.extend([[0.34, 0.58], [0.32, 0.58]]);
    lathe(&profile, 40)
}

fn lid() -> Mesh {
    let mut profile = vec![[0.31, 0.565]];
    let dome = [[0.31, 0.59], [0.27, 0.66], [0.10, 0.66], [0.05, 0.68]];
    profile.extend(bezier(dome, 5));
    let knob = [[0.05, 0.68], [0.02, 0.71], [0.14, 0.79], [0.03, 0.79]];
    profile.extend(&bezier(knob, 6)[1..]);
    lathe(&profile, 40)
}

fn spout() -> Mesh {
    let path: [Point; 4] = [
        [0.36, 0.0, 0.20],
        [0.72, 0.0, 0.16],
        [0.66, 0.0, 0.50],
        [0.86, 0.0, 0.62],
    ];
    let radii: Vec<f64> = (0..=16)
        .map(|k| between([0.10], [0.045], f64::from(k) / 16.0)[0])
        .collect();
    tube(&bezier(path, 16), &radii, 14)
}

fn handle() -> Mesh {
    let path: [Point; 4] = [
        [-0.38, 0.0, 0.46],
        [-0.95, 0.0, 0.60],
        [-0.95, 0.0, 0.05],
        [-0.42, 0.0, 0.16],
    ];
    tube(&bezier(path, 14), &[0.04; 15], 12)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn count_of_the_report() {
        assert_eq!(teapot().polygons(), 1920);
    }
}
