//! Faces without area, which are left out of bodies, and what they do to closed surfaces.

use cstk::body::BodyBuilder;
use cstk::error::ErrorKind;
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;

use helpers::checked::at;
use helpers::surfaces::*;

/// A vertex in the middle of a neighbour's edge: near, but not joined.
#[test]
fn a_t_junction_is_open() {
    let mut given = cube(1.0);
    given.vertices.push(Vec3::new(0.0, -1.0, 1.0));
    // The top in two, the front as it was.
    let split = with_faces(&given, |faces| {
        faces[1] = vec![4, 8, 6];
        faces.push(vec![8, 5, 7, 6]);
    });
    let error = refused(&split);
    assert_eq!(error.kind, ErrorKind::NotClosed);
    assert!(error.message.contains("3 edges are open"), "{error}");
    assert!(error.message.contains("(0, -1, 1)"), "{error}");
    // A sliver between, without area, joins them: it is left out, but it closes.
    let joined = with_faces(&split, |faces| faces.push(vec![8, 4, 5]));
    let body = solid_one(&joined);
    assert_eq!(body.statistics().faces_dropped, 1);
    assert_eq!(body.solid().unwrap().scraps().len(), 1);
    assert_eq!(number_at(&solid_one(&joined), Vec3::zeros()), 1);
    // So does one the other way round, and one too many does no harm.
    let turned = with_faces(&split, |faces| faces.extend([vec![4, 8, 5], vec![8, 4, 5]]));
    assert_eq!(number_at(&solid_one(&turned), Vec3::zeros()), 1);
    // A chain of slivers, each on the next.
    let mut given = joined;
    given.vertices.push(Vec3::new(0.5, -1.0, 1.0));
    let chain = with_faces(&given, |faces| {
        faces[6] = vec![8, 9, 5, 7, 6];
        faces.push(vec![9, 8, 5]);
    });
    assert_eq!(number_at(&solid_one(&chain), Vec3::zeros()), 1);
    // A net of slivers, one in the middle of others: the top has vertices that the front has not, and the other way round.
    let mut given = cube(1.0);
    for x in [-0.5, 0.5, -0.3, 0.3] {
        given.vertices.push(Vec3::new(x, -1.0, 1.0));
    }
    let net = with_faces(&given, |faces| {
        faces[1] = vec![4, 8, 9, 5, 7, 6];
        faces[2] = vec![0, 1, 5, 11, 10, 4];
        faces.extend([
            vec![9, 8, 4],
            vec![11, 5, 9],
            vec![4, 10, 11],
            vec![4, 11, 9],
        ]);
    });
    let body = solid_one(&net);
    assert_eq!(body.solid().unwrap().scraps().len(), 4);
    assert_eq!(number_at(&solid_one(&net), Vec3::zeros()), 1);
    // And those that nothing needs.
    let idle = with_faces(&cube(1.0), |faces| {
        faces.extend([vec![0, 0, 1], vec![0, 1, 0], vec![3, 3, 3]]);
    });
    assert_eq!(number_at(&solid_one(&idle), Vec3::zeros()), 1);
    let mut given = cube(1.0);
    given.vertices.push(Vec3::new(0.0, -1.0, 1.0));
    let idle = with_faces(&given, |faces| faces.push(vec![4, 8, 5]));
    assert_eq!(number_at(&solid_one(&idle), Vec3::zeros()), 1);
}

/// Vertices that repeat others nearly: the face is reduced, its neighbours are not.
#[test]
fn nearly_repeated_vertices_do_not_open_the_surface() {
    let mut given = cube(1.0);
    given.vertices.push(Vec3::new(1.0, -1.0, 1.0 + 1e-13));
    // The top has corner 5 and, a hair above, 8; the right side and the front follow the hair.
    let hairy = with_faces(&given, |faces| {
        faces[1] = vec![4, 5, 8, 7, 6];
        faces[5] = vec![1, 3, 7, 8, 5];
    });
    let body = solid_one(&hairy);
    assert_eq!(number_at(&solid_one(&hairy), Vec3::zeros()), 1);
    assert!(body.statistics().faces_split > 0);
}

/// In front of a cube the top of which reaches over by a hair: there the sliver between is all that says so, whichever way
/// round it was given.
#[test]
fn slivers_count_as_the_boundary() {
    let given = with_sliver(4e-13);
    let turned = with_faces(&given, |faces| faces[7].reverse());
    for given in [given, turned] {
        let body = solid_one(&given);
        assert_eq!(body.statistics().faces_dropped, 1);
        let below = |y: f64| Vec3::new(0.0, y, 1.0 - 1e-13);
        let number = |y: f64| number_at(&solid_one(&given), below(y));
        assert_eq!(number(-1.0 - 2e-13), 0);
        assert_eq!(number(-1.0 + 2e-13), 1);
        assert_eq!(number(-1.0 - 5e-13), 0);
        // A stick that stands there is outside.
        let mut builder = BodyBuilder::new(3).unwrap();
        let ends = [-1.0, -1e-13].map(|z| Vec3::new(0.0, 0.0, z));
        builder.add_polyhedron(&ends, 0).unwrap();
        let stick = build(&builder).unwrap();
        let stick = (&*stick, &at(0.0, -1.0 - 2e-13, 1.0));
        let cube = (&*body, &Pose::identity());
        for (a, b) in [(stick, cube), (cube, stick)] {
            let found = QueryContext::new().pair_distance(a, b, 1.0).unwrap();
            assert!(found.lower > 0.0 && found.distance < 2.1e-13);
            assert!(!found.witness.unwrap().contained);
        }
    }
}

/// Two halves that have no vertex in common: slivers alone make them one piece.
#[test]
fn slivers_join_pieces() {
    let mut given = cube(1.0);
    for i in [0, 1, 3, 2] {
        let mut vertex = given.vertices[i];
        for z in [0.0, 1e-13] {
            vertex.z = z;
            given.vertices.push(vertex);
        }
    }
    let halves = with_faces(&given, |faces| {
        faces.truncate(2);
        for k in 0..4u32 {
            let [i, j] = [k, (k + 1) % 4];
            let below = [0, 1, 3, 2].map(|i| i as u32);
            let (a, b) = (below[i as usize], below[j as usize]);
            faces.push(vec![a, b, 8 + 2 * j, 8 + 2 * i]);
            faces.push(vec![9 + 2 * i, 9 + 2 * j, b + 4, a + 4]);
            faces.push(vec![8 + 2 * i, 8 + 2 * j, 9 + 2 * j, 9 + 2 * i]);
        }
    });
    let body = solid_one(&halves);
    assert_eq!(body.statistics().faces_dropped, 4);
    assert_eq!(body.pieces().list.len(), 1);
    for z in [-0.9, 0.9] {
        assert_eq!(number_at(&solid_one(&halves), Vec3::new(0.0, 0.1, z)), 1);
    }
    // As surfaces they are two.
    assert_eq!(surface(&[halves]).pieces().list.len(), 2);
}
