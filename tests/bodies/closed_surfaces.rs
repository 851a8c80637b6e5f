//! Which meshes are closed boundaries of solids, which are mended, and what is said of the others.

use cstk::body::BodyBuilder;
use cstk::error::ErrorKind;
use cstk::pair::{RayScratch, winding};
use cstk::pose::Vec3;
use cstk_scenes as scenes;

use helpers::checked::vertices;
use helpers::models;
use helpers::random::Random;
use helpers::surfaces::*;

#[test]
fn an_open_box_is_refused_and_its_edges_named() {
    let lidless = with_faces(&cube(1.0), |faces| {
        faces.remove(1);
    });
    let error = refused(&lidless);
    assert_eq!(error.kind, ErrorKind::NotClosed);
    for text in [
        "4 edges are open",
        "(-1, -1, 1)",
        "primitive 1 (tag 1)",
        "and 1 more",
    ] {
        assert!(error.message.contains(text), "{text}: {}", error.message);
    }
    // As surfaces they may be open.
    surface_one(&lidless);
    // The builder may go on: with the lid it is closed.
    let mut builder = builder(&[lidless]);
    builder.set_solid(true);
    assert!(build(&builder).is_err());
    let lid = vertices(&[(-1., -1., 1.), (1., -1., 1.), (1., 1., 1.), (-1., 1., 1.)]);
    builder.add_polygon(&lid, 7).unwrap();
    let body = build(&builder).unwrap();
    assert!(body.solid().is_some() && body.statistics().is_solid);
    assert_eq!(body.pieces().list.len(), 1);
}

/// A hole as small as one face of many.
#[test]
fn a_missing_triangle_is_found() {
    let given = sphere(1.0, 20);
    let count = given.face_sizes.len();
    for k in [0, 1, count / 2, count - 1] {
        let holed = with_faces(&given, |faces| {
            faces.remove(k);
        });
        let error = refused(&holed);
        assert_eq!(error.kind, ErrorKind::NotClosed);
        assert!(error.message.contains("3 edges are open"), "{error}");
    }
}

#[test]
fn faces_that_are_split_stay_joined() {
    // An L, extruded: its ends are not convex. One of its sides is bent a little: not planar.
    let outline = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
    let mut points: Vec<Vec3> = Vec::new();
    for z in [0.0, 1.0] {
        points.extend(outline.map(|(x, y)| Vec3::new(x, y, z)));
    }
    points[9].z = 1.25;
    let mut faces = vec![vec![5, 4, 3, 2, 1, 0], vec![6, 7, 8, 9, 10, 11]];
    for i in 0..6 {
        let j = (i + 1) % 6;
        faces.push(vec![i, j, j + 6, i + 6]);
    }
    let given = mesh(points, &faces);
    let body = solid_one(&given);
    assert!(body.statistics().faces_split >= 2);
    assert_eq!(number_at(&solid_one(&given), Vec3::new(0.5, 0.5, 0.5)), 1);
    assert_eq!(number_at(&solid_one(&given), Vec3::new(1.5, 1.5, 0.5)), 0);
}

#[test]
fn flipped_faces_are_mended() {
    let given = sphere(1.0, 8);
    let count = given.face_sizes.len();
    let flip = |which: &dyn Fn(usize) -> bool| {
        with_faces(&given, |faces| {
            for (k, face) in faces.iter_mut().enumerate() {
                if which(k) {
                    face.reverse();
                }
            }
        })
    };
    let cases: [(&dyn Fn(usize) -> bool, i32); 5] = [
        (&|k| k == 0, 1),
        (&|k| k % 3 == 1, 1),
        (&|k| k < count / 4, 1),
        (&|k| k % 3 != 1, -1),
        (&|_| true, -1),
    ];
    let mut random = Random::new(61);
    for (which, number) in cases {
        let body = solid(&[flip(which)]);
        let mut scratch = RayScratch::default();
        let mut around = |p: Vec3| winding(&body, &(p - body.center()), &mut scratch).number;
        for _ in 0..300 {
            let direction = random.unit();
            // The faces are between 0.9 and 1 from the middle.
            assert_eq!(around(direction * random.within(0.0, 0.9)), number);
            assert_eq!(around(direction * random.within(1.0, 1.7)), 0);
        }
    }
}

/// A half of the faces each way, by area too: the first face stays.
#[test]
fn of_equal_parts_the_first_face_stays() {
    for (first, number) in [(true, 1), (false, -1)] {
        let half = with_faces(&cube(1.0), |faces| {
            for (k, face) in faces.iter_mut().enumerate() {
                if (k % 2 == 0) != first {
                    face.reverse();
                }
            }
        });
        assert_eq!(number_at(&solid_one(&half), Vec3::zeros()), number);
    }
}

#[test]
fn one_sided_surfaces_are_refused() {
    // A Moebius strip is open along its rim.
    let sides = 12;
    let mut points = Vec::new();
    for i in 0..sides {
        let u = std::f64::consts::TAU * i as f64 / sides as f64;
        for v in [-0.4, 0.4] {
            let out = 1.0 + v * (0.5 * u).cos();
            points.push(Vec3::new(out * u.cos(), out * u.sin(), v * (0.5 * u).sin()));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..sides as u32 {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = match i as usize + 1 == sides {
            true => [1, 0],
            false => [2 * i + 2, 2 * i + 3],
        };
        triangles.extend([vec![a, b, d], vec![a, d, c]]);
    }
    let error = refused(&mesh(points, &triangles));
    assert_eq!(error.kind, ErrorKind::NotClosed);
    assert!(error.message.contains("24 edges are open"), "{error}");
    // A projective plane of six vertices in general places has no rim, but one side only.
    let points = vertices(&[
        (0., 0., 1.),
        (1., 0.1, 0.),
        (0.3, 1., 0.2),
        (-0.8, 0.6, -0.3),
        (-0.9, -0.7, 0.4),
        (0.2, -1., -0.6),
    ]);
    let triangles = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    let error = refused(&mesh(points, &triangles.map(Vec::from)));
    assert_eq!(error.kind, ErrorKind::NotClosed);
    assert!(error.message.contains("one side only"), "{error}");
}

#[test]
fn duplicated_faces_are_refused() {
    for copies in [1, 2] {
        let doubled = with_faces(&cube(1.0), |faces| {
            for _ in 0..copies {
                faces.push(faces[0].clone());
            }
        });
        let error = refused(&doubled);
        assert_eq!(error.kind, ErrorKind::NotClosed);
        assert!(error.message.contains("4 edges are"), "{error}");
        assert!(error.message.contains("primitive 6 (tag 6)"), "{error}");
    }
    // All of it twice is the same solid; from both sides it would bound nothing.
    assert_eq!(number_at(&solid(&[cube(1.0), cube(1.0)]), Vec3::zeros()), 2);
    for part in [
        vec![cube(1.0)],
        vec![cube(1.0), shifted(&cube(1.0), [9.0, 0.0, 0.0])],
    ] {
        let mut twice = builder(&part);
        twice.add_mesh(&inside_out(&part[0])).unwrap();
        let error = solid_of(twice).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Degenerate);
        assert!(error.message.contains("bounds nothing"), "{error}");
        assert!(error.message.contains("primitive 0 (tag 0)"), "{error}");
    }
}

#[test]
fn cubes_may_share_edges_faces_and_vertices() {
    for by in [[2., 2., 0.], [2., 0., 0.], [2., 2., 2.], [0.5, 0.5, 0.5]] {
        let two = [cube(1.0), shifted(&cube(1.0), by)];
        assert_eq!(number_at(&solid(&two), Vec3::new(-0.9, -0.9, -0.9)), 1);
        let back = [cube(1.0), inside_out(&two[1])];
        assert_eq!(number_at(&solid(&back), Vec3::new(-0.9, -0.9, -0.9)), 1);
    }
}

/// Polyhedra take no part, whatever they are; bodies without polygons have no boundary to close.
#[test]
fn polyhedra_take_no_part() {
    let mut mixed = builder(&[cube(1.0)]);
    let corners = helpers::shapes::box_corners([1.0; 3]);
    mixed.add_polyhedron(&corners, 0).unwrap();
    mixed.add_polyhedron(&corners[..4], 0).unwrap();
    mixed.add_polyhedron(&corners[..2], 0).unwrap();
    let body = solid_of(mixed).unwrap();
    assert_eq!(body.pieces().list.len(), 4);
    let mut alone = BodyBuilder::new(3).unwrap();
    alone.add_polyhedron(&corners, 0).unwrap();
    alone.add_polyhedron(&corners[..4], 0).unwrap();
    let body = solid_of(alone).unwrap();
    assert!(body.solid().is_none() && body.statistics().is_solid);
}

/// The models that are unions of closed surfaces are closed, the others are not.
#[test]
fn generated_models() {
    let closed = [
        scenes::robot_base(),
        scenes::lamp(),
        scenes::teapot(),
        scenes::gear(),
        scenes::plate(),
        scenes::motor(),
        scenes::bumpy_sphere(1000, 1),
        scenes::spaghetti(2000, 1),
        scenes::lamps(3, 1),
    ];
    for (k, model) in closed.iter().enumerate() {
        solid_of(models::builder(model)).unwrap_or_else(|error| panic!("model {k}: {error}"));
    }
    for model in [
        scenes::nested_shells(10),
        scenes::coincident(9),
        scenes::floor_and_screws(3000, 1),
    ] {
        let error = solid_of(models::builder(&model)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::NotClosed);
    }
}
