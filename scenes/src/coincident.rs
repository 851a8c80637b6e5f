//! One quad many times.

use crate::mesh::Mesh;

/// The unit square of the plane z = 0, `polygons` times over, each with vertices of its own.
///
/// The worst case for anything that groups or splits by position.
pub fn coincident(polygons: usize) -> Mesh {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let quad = Mesh {
        vertices: corners.to_vec(),
        faces: vec![vec![0, 1, 2, 3]],
    };
    let mut mesh = Mesh::default();
    for _ in 0..polygons {
        mesh.append(&quad);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_shared() {
        let mesh = coincident(10);
        assert_eq!((mesh.polygons(), mesh.vertices.len()), (10, 40));
    }
}
