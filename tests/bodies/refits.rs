//! Bodies refitted to moved vertices, against bodies built of the moved primitives.

use std::sync::Arc;
use std::time::Instant;

use cstk::body::{Body, BodyBuilder, Mesh};
use cstk::error::ErrorKind;
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Mat3, Pose, Vec3};
use cstk_scenes as scenes;

use crate::given::{Given, answers_are_equal, body_of, boxes_bound_their_primitives};
use helpers::files::loaded;
use helpers::models::{GROUPINGS, KINDS, built, options};
use helpers::random::Random;
use helpers::surfaces::*;

fn moved_body(body: &Body, moved: impl Fn(&Vec3) -> Vec3) -> Body {
    let vertices: Vec<Vec3> = body.vertices().map(|vertex| moved(&vertex)).collect();
    assert_eq!(vertices.len(), body.vertex_count());
    body.refit(&vertices).unwrap()
}

/// Linear maps keep polygons planar and polyhedra convex.
#[test]
fn refitted_bodies_answer_as_those_built_anew() {
    let mut random = Random::new(11);
    for case in 0..40 {
        let how = match case % 3 {
            0 => HierarchyOptions::default(),
            1 => options(
                GROUPINGS[case % GROUPINGS.len()],
                KINDS[case % KINDS.len()],
                0.0,
            ),
            _ => options(
                GROUPINGS[case % GROUPINGS.len()],
                KINDS[0],
                3.0 * (case % 2) as f64,
            ),
        };
        let are_points = case % 7 == 3;
        let given: Vec<Given> = (0..1 + random.below(30))
            .map(|i| Given::random(&mut random, if are_points { 7 + 8 * i } else { i + case }))
            .collect();
        let old = body_of(&given, &how);
        let turn = random.rotation();
        let shift = random.point(3.0);
        let bend = Mat3::from_fn(|_, _| random.within(-0.2, 0.2));
        let map = move |p: &Vec3| turn * (p + bend * p) + shift;
        let refitted = moved_body(&old, map);
        let anew: Vec<Given> = given.iter().map(|one| one.with_vertices(map)).collect();
        let anew = body_of(&anew, &how);
        assert_eq!(refitted.primitives().len(), anew.primitives().len());
        for i in 0..anew.primitives().len() as u32 {
            assert_eq!(refitted.tag(i), anew.tag(i));
        }
        for k in 0..3 {
            let [a, b] = [&refitted, &*anew].map(|body| {
                let statistics = body.statistics();
                [statistics.low[k], statistics.high[k]]
            });
            assert!((a[0] - b[0]).abs() < 1e-10 && (a[1] - b[1]).abs() < 1e-10);
        }
        boxes_bound_their_primitives(&refitted);
        assert!(
            refitted
                .tree()
                .subsets()
                .is_sound(refitted.primitives().len())
        );
        answers_are_equal(&refitted, &anew, &mut random, 12);
        let read = loaded(&refitted);
        assert_eq!(read.packed(), refitted.packed());
        assert_eq!(read.tree(), refitted.tree());
        assert_eq!(read.primitives(), refitted.primitives());
    }
}

fn wave(at: f64) -> impl Fn(&Vec3) -> Vec3 {
    move |p| p * (1.0 + 0.2 * (5.0 * p.x + at).sin() * (4.0 * p.y - at).cos())
}

/// A ball whose surface waves: triangles may move at will.
#[test]
fn waving_triangles_and_the_solid_they_bound() {
    let mut random = Random::new(12);
    let ball = scenes::bumpy_sphere(600, 3);
    let mesh = Mesh {
        vertices: ball.vertices.iter().map(|p| Vec3::from(*p)).collect(),
        face_sizes: vec![3; ball.faces.len()],
        indices: ball.faces.concat(),
    };
    assert!(ball.faces.iter().all(|face| face.len() == 3));
    let first = solid_one(&mesh);
    let mut body = first;
    let mut mesh = mesh;
    for step in 0..6 {
        let move_one = wave(f64::from(step));
        body = Arc::new(moved_body(&body, &move_one));
        for vertex in &mut mesh.vertices {
            *vertex = move_one(vertex);
        }
        let anew = solid_one(&mesh);
        boxes_bound_their_primitives(&body);
        answers_are_equal(&body, &anew, &mut random, 20);
        assert_eq!(body.piece_count(), 1);
        let read = loaded(&body);
        for _ in 0..300 {
            let p = random.point(1.2);
            let expected = number_at(&anew, p);
            assert_eq!(number_at(&body, p), expected);
            assert_eq!(number_at(&read, p), expected);
        }
    }
}

/// Faces without area that close a solid move along with the vertices they share.
#[test]
fn solids_closed_by_slivers_are_refitted() {
    let sliver = with_sliver(0.0);
    let body = solid_one(&sliver);
    assert_eq!(body.solid().unwrap().scraps().len(), 1);
    let map = |p: &Vec3| Vec3::new(2.0 * p.x + 0.3 * p.y, p.y - 1.0, 0.5 * p.z);
    let refitted = moved_body(&body, map);
    assert_eq!(refitted.solid().unwrap().scraps().len(), 1);
    let mut random = Random::new(13);
    for _ in 0..500 {
        let p = random.point(1.2);
        assert_eq!(number_at(&refitted, map(&p)), number_at(&body, p), "{p}");
    }
}

#[test]
fn what_is_no_body_any_more_is_refused() {
    let cube = solid_one(&cube(1.0));
    let vertices: Vec<Vec3> = cube.vertices().collect();
    let refused = |vertices: &[Vec3]| cube.refit(vertices).unwrap_err();
    assert_eq!(refused(&vertices[1..]).kind, ErrorKind::WrongSize);
    let mut apart = vertices.clone();
    apart[0] += (vertices[1] - vertices[0]) * 0.1;
    let error = refused(&apart);
    assert_eq!(error.kind, ErrorKind::NotClosed, "{}", error.message);
    assert!(error.message.contains("primitive 0"), "{}", error.message);
    let mut bent = vertices.clone();
    for vertex in &mut bent {
        if *vertex == vertices[5] {
            *vertex *= 1.1;
        }
    }
    let error = refused(&bent);
    assert_eq!(error.kind, ErrorKind::NotPlanar, "{}", error.message);
    assert!(error.message.contains("primitive"), "{}", error.message);
    let flat: Vec<Vec3> = vertices.iter().map(|p| Vec3::new(p.x, p.y, 0.0)).collect();
    assert_eq!(refused(&flat).kind, ErrorKind::Degenerate);
}

/// The extent of the vertices is computed before they are checked.
#[test]
fn vertices_that_are_no_numbers_are_refused() {
    let triangle = [Vec3::x(), Vec3::y(), Vec3::z()];
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polygon(&triangle, 0).unwrap();
    builder.add_points(&triangle, 0.0).unwrap();
    let hulls = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    builder.add_capsule(&Vec3::x(), &Vec3::y(), 0.5, 0).unwrap();
    let curved = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    for body in [hulls.unwrap(), curved.unwrap()] {
        let vertices: Vec<Vec3> = body.vertices().collect();
        assert!(body.refit(&vertices).is_ok());
        for (i, bad) in [(0, f64::NAN), (2, f64::INFINITY), (5, -f64::INFINITY)] {
            let mut given = vertices.clone();
            given[i].y = bad;
            let error = body.refit(&given).unwrap_err();
            assert_eq!(error.kind, ErrorKind::NotFinite, "{}", error.message);
            let named = format!("primitive {}", i.saturating_sub(2));
            assert!(error.message.contains(&named), "{}", error.message);
        }
    }
}

/// Parts keep their places, and a body with solid parts stays the union of them.
#[test]
fn bodies_with_parts_are_refitted() {
    let mut random = Random::new(14);
    let mut builder = BodyBuilder::new(3).unwrap();
    builder
        .add_body(&solid_one(&cube(0.5)), &Pose::identity(), 1)
        .unwrap();
    let pose = random.pose(0.4);
    builder
        .add_body(&solid_one(&inside_out(&cube(0.5))), &pose, 2)
        .unwrap();
    let whole = built(&builder, &HierarchyOptions::default());
    let shear = |p: &Vec3| Vec3::new(p.x + 0.5 * p.z, p.y, p.z) * 1.5;
    let refitted = moved_body(&whole, shear);
    assert_eq!(refitted.parts(), whole.parts());
    let mut inside = 0;
    for _ in 0..500 {
        let p = random.point(0.8);
        let is_inside = number_at(&whole, p) != 0;
        assert_eq!(number_at(&refitted, shear(&p)) != 0, is_inside);
        inside += usize::from(is_inside);
    }
    assert!(inside > 50);
}

/// Prints the ratio that docs/benchmarks.md gives; `scripts/bench.sh builds` measures it on a quiet machine.
#[test]
fn refits_take_a_part_of_a_build() {
    let ball = scenes::bumpy_sphere(5_000, 3);
    let builder = helpers::models::builder(&ball);
    let mut best = [f64::INFINITY; 2];
    for step in 0..3 {
        let start = Instant::now();
        let body = built(&builder, &HierarchyOptions::default());
        best[0] = best[0].min(start.elapsed().as_secs_f64());
        let vertices: Vec<Vec3> = body.vertices().map(|p| wave(f64::from(step))(&p)).collect();
        let start = Instant::now();
        let refitted = body.refit(&vertices).unwrap();
        best[1] = best[1].min(start.elapsed().as_secs_f64());
        assert_eq!(refitted.primitives().len(), body.primitives().len());
    }
    println!(
        "build {:.4} s, refit {:.4} s, {:.1} times",
        best[0],
        best[1],
        best[0] / best[1]
    );
}
