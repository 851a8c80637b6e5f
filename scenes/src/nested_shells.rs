//! Squares one around the other.

use crate::mesh::Mesh;

/// `polygons` squares about the origin in the plane z = 0, sharing no vertices; the half sides are 1, 1 + 10⁻⁶, 1 +
/// 2·10⁻⁶ and so on.
///
/// All have one centre and nearly one size, so each looks like a good partner for every other.
pub fn nested_shells(polygons: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for k in 0..polygons {
        let half = 1.0 + 1e-6 * k as f64;
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
        let face = corners.map(|(x, y)| mesh.add_vertex([x, y, 0.0]));
        mesh.faces.push(face.to_vec());
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_squares_as_asked_for() {
        let mesh = nested_shells(1001);
        assert_eq!(mesh.polygons(), 1001);
        assert_eq!(mesh.bounds().1, [1.001, 1.001, 0.0]);
    }
}
