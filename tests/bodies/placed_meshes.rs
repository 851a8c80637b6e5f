//! Meshes that are scaled and moved as they are added, against the same mesh with its vertices moved by hand.

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3, rotation_about};

/// A wedge without any symmetry, its faces counter-clockwise seen from outside.
fn wedge() -> Mesh {
    let points = [(0., 0., 0.), (3., 0., 0.), (0., 2., 0.), (0., 0., 1.)];
    Mesh {
        vertices: points.map(|(x, y, z)| Vec3::new(x, y, z)).to_vec(),
        face_sizes: vec![3; 4],
        indices: vec![0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3],
    }
}

fn pose() -> Pose {
    Pose {
        rotation: rotation_about(&Vec3::new(0.6, 0.0, 0.8), 0.7),
        translation: Vec3::new(5.0, -7.0, 11.0),
    }
}

fn build(builder: &BodyBuilder) -> Body {
    let options = HierarchyOptions::default();
    builder.build(&options, &mut |_| Ok(())).unwrap()
}

/// Six times the signed volume of a mesh's polygons: positive where they face outwards.
fn volume(body: &Body) -> f64 {
    let of = |polygon: &cstk::primitive::Convex| {
        let [a, b, c] = [0, 1, 2].map(|i| polygon.vertices[i]);
        a.dot(&b.cross(&c))
    };
    body.primitives().iter().map(|p| of(p.shape)).sum()
}

#[test]
fn vertices_are_scaled_then_moved() {
    for scale in [Vec3::new(2.0, 0.5, 3.0), Vec3::new(-2.0, 0.5, 3.0)] {
        let placed = wedge().placed(&pose(), &scale).unwrap();
        for (vertex, given) in placed.vertices.iter().zip(&wedge().vertices) {
            let Pose {
                rotation: r,
                translation: t,
            } = pose();
            for axis in 0..3 {
                let scaled = (0..3).map(|k| r[(axis, k)] * (scale[k] * given[k]));
                let expected = scaled.sum::<f64>() + t[axis];
                assert!((vertex[axis] - expected).abs() < 1e-14);
            }
        }
    }
}

/// Mirrored once or three times a face runs the other way round; the solid has its volume, and faces outwards.
#[test]
fn mirrored_meshes_face_outwards() {
    for signs in 0..8 {
        let sign = |k: usize| if signs >> k & 1 == 1 { -1.0 } else { 1.0 };
        let scale = Vec3::new(2.0 * sign(0), 0.5 * sign(1), 3.0 * sign(2));
        let mut builder = BodyBuilder::new(3).unwrap();
        let placed = wedge().placed(&pose(), &scale).unwrap();
        builder.add_mesh(&placed).unwrap();
        builder.set_solid(true);
        // Of the tetrahedron 0, (3 x, 0, 0), (0, 2 y, 0), (0, 0, z), the whole scaled by 3 in volume.
        assert!((volume(&build(&builder)) - 18.0).abs() < 1e-12, "{scale}");
    }
}

#[test]
fn without_scale_and_motion_nothing_changes() {
    let mut mesh = wedge();
    mesh.vertices[0].x = -0.0;
    let same = mesh
        .clone()
        .placed(&Pose::identity(), &Vec3::repeat(1.0))
        .unwrap();
    assert!(same == mesh && same.vertices[0].x.is_sign_negative());
}

#[test]
fn scales_that_leave_no_mesh_are_refused() {
    for (scale, kind) in [
        (0.0, ErrorKind::InvalidArgument),
        (-0.0, ErrorKind::InvalidArgument),
        (1e-60, ErrorKind::InvalidArgument),
        (f64::NAN, ErrorKind::NotFinite),
        (f64::NEG_INFINITY, ErrorKind::NotFinite),
        (1e51, ErrorKind::InvalidArgument),
    ] {
        for axis in 0..3 {
            let mut factors = Vec3::repeat(1.0);
            factors[axis] = scale;
            let error = wedge().placed(&Pose::identity(), &factors).unwrap_err();
            assert_eq!(error.kind, kind);
            assert!(
                error.message.contains(&format!("scale entry {axis}")),
                "{error}"
            );
        }
    }
}

/// Sizes that do not match the indices are refused by who adds the mesh, mirrored or not.
#[test]
fn damaged_meshes_are_refused_mirrored_too() {
    let mut builder = BodyBuilder::new(3).unwrap();
    let mut mesh = wedge();
    mesh.face_sizes[3] = u32::MAX;
    let mirrored = mesh
        .placed(&Pose::identity(), &Vec3::new(1.0, 1.0, -1.0))
        .unwrap();
    let error = builder.add_mesh(&mirrored).unwrap_err();
    assert!(error.kind == ErrorKind::WrongSize && error.message.contains("face 3"));
    assert!(builder.is_empty());
}
