//! Inputs on which other libraries aborted or returned nonsense: refused by name (A44), or measured like any others.

use std::sync::Arc;

use cstk::body::{BodyBuilder, Mesh};
use cstk::cobject::{CObject, InducedOptions};
use cstk::error::{ErrorKind, Result};
use cstk::hierarchy::HierarchyOptions;
use cstk::pose::{Pose, Vec3};
use cstk::query::{Configuration, QueryContext};
use cstk::robot::{JointKind, LinkDefinition, RobotBuilder};
use cstk::space::{Coordinate, Space, WorldBox};

use helpers::checked::{at, checked, vertices};
use helpers::random::Random;
use helpers::robots::{against, environment, free_planar_body, link, space};
use helpers::shapes::{box_corners, cuboid, hull, pair_size, planar};

/// Expects a kind and a message that holds each of the words.
fn refused<T: std::fmt::Debug>(outcome: Result<T>, kind: ErrorKind, words: &[&str]) {
    let error = outcome.expect_err("accepted");
    assert_eq!(error.kind, kind, "{error}");
    for word in words {
        assert!(
            error.message.contains(word),
            "{:?} lacks {word:?}",
            error.message
        );
    }
}

fn square() -> Vec<Vec3> {
    vertices(&[(0., 0., 0.), (1., 0., 0.), (1., 1., 0.), (0., 1., 0.)])
}

fn with(mut points: Vec<Vec3>, vertex: usize, axis: usize, value: f64) -> Vec<Vec3> {
    points[vertex][axis] = value;
    points
}

fn square_mesh(vertices: Vec<Vec3>) -> Mesh {
    Mesh {
        vertices,
        face_sizes: vec![3, 3],
        indices: vec![0, 1, 2, 0, 2, 3],
    }
}

/// Case A44 of docs/cases.md.
#[test]
fn bad_polygons_are_refused_by_name() {
    let polygon = |points: &[Vec3]| BodyBuilder::new(3).unwrap().add_polygon(points, 0);
    refused(polygon(&[]), ErrorKind::Empty, &["3 vertices"]);
    refused(
        polygon(&square()[..2]),
        ErrorKind::Degenerate,
        &["3 vertices", "2"],
    );
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused(
            polygon(&with(square(), 2, 1, bad)),
            ErrorKind::NotFinite,
            &["vertex 2"],
        );
    }
    refused(
        polygon(&with(square(), 2, 2, 0.5)),
        ErrorKind::NotPlanar,
        &["vertex"],
    );
    let dented = with(with(square(), 2, 0, 0.25), 2, 1, 0.25);
    refused(polygon(&dented), ErrorKind::NotConvex, &["vertex 2"]);
    let repeated = vec![square()[0], square()[1], square()[1], square()[2]];
    refused(
        polygon(&repeated),
        ErrorKind::Degenerate,
        &["vertices 1 and 2"],
    );
    let line: Vec<Vec3> = (0..3).map(|i| Vec3::x() * i as f64).collect();
    refused(polygon(&line), ErrorKind::Degenerate, &["area"]);
    refused(
        polygon(&with(square(), 1, 0, 1e60)),
        ErrorKind::InvalidArgument,
        &["large"],
    );
    let raised = with(square(), 3, 2, 1e-300);
    let mut flat = BodyBuilder::new(2).unwrap();
    refused(
        flat.add_polygon(&raised, 0),
        ErrorKind::NotPlanar,
        &["vertex 3"],
    );
    assert!(flat.is_empty());
}

/// Case A44 of docs/cases.md.
#[test]
fn bad_polyhedra_and_meshes_are_refused_by_name() {
    let mut builder = BodyBuilder::new(3).unwrap();
    refused(builder.add_polyhedron(&[], 0), ErrorKind::Empty, &["point"]);
    for bad in [f64::NAN, f64::INFINITY] {
        let corners = with(box_corners([1.0; 3]), 5, 2, bad);
        refused(
            builder.add_polyhedron(&corners, 0),
            ErrorKind::NotFinite,
            &["vertex 5"],
        );
        // One such vertex used to poison a whole tree; it may not get that far.
        let mesh = square_mesh(with(square(), 3, 0, bad));
        refused(builder.add_mesh(&mesh), ErrorKind::NotFinite, &["face 1"]);
    }
    let mut missing = square_mesh(square());
    missing.indices[4] = 4;
    refused(builder.add_mesh(&missing), ErrorKind::NotFound, &["face 1"]);
    let mut short = square_mesh(square());
    short.indices.pop();
    refused(builder.add_mesh(&short), ErrorKind::WrongSize, &["face 1"]);
    let mut long = square_mesh(square());
    long.indices.push(0);
    refused(
        builder.add_mesh(&long),
        ErrorKind::WrongSize,
        &["1 indices"],
    );
    // A failed call leaves nothing behind.
    assert!(builder.is_empty());
    let nothing = builder.build(&HierarchyOptions::default(), &mut |_| Ok(()));
    refused(nothing, ErrorKind::Empty, &["no primitive"]);
    refused(BodyBuilder::new(4), ErrorKind::InvalidArgument, &["4"]);
    let path = std::path::Path::new("/nonexistent/part.obj");
    let (pose, scale) = (Pose::identity(), Vec3::repeat(1.0));
    refused(
        builder.add_mesh_file(path, &pose, &scale),
        ErrorKind::Io,
        &["part.obj"],
    );
}

/// Case A44 of docs/cases.md.
#[test]
fn faces_without_area_are_dropped_and_counted() {
    let mut builder = BodyBuilder::new(3).unwrap();
    let mut mesh = square_mesh(square());
    mesh.indices[5] = 0;
    builder.add_mesh(&mesh).unwrap();
    let body = builder
        .build(&HierarchyOptions::default(), &mut |_| Ok(()))
        .unwrap();
    assert_eq!(
        (
            body.statistics().primitives,
            body.statistics().faces_dropped
        ),
        (1, 1)
    );
}

/// Case A44 of docs/cases.md.
#[test]
fn bad_robots_poses_and_spaces_are_refused_by_name() {
    let mut builder = RobotBuilder::new(3).unwrap();
    refused(builder.build(), ErrorKind::Empty, &["no link"]);
    let named = |axis| LinkDefinition {
        name: "elbow".into(),
        ..link(None, JointKind::Revolute, axis)
    };
    refused(
        builder.add_link(named(Vec3::zeros())),
        ErrorKind::Degenerate,
        &["elbow", "axis"],
    );
    let nan = Vec3::new(0.0, f64::NAN, 1.0);
    refused(
        builder.add_link(named(nan)),
        ErrorKind::NotFinite,
        &["elbow", "axis"],
    );
    let orphan = LinkDefinition {
        parent: Some(3),
        ..named(Vec3::x())
    };
    refused(
        builder.add_link(orphan),
        ErrorKind::NotFound,
        &["elbow", "parent 3"],
    );
    let gap = LinkDefinition {
        coordinate: Some(2),
        ..named(Vec3::x())
    };
    refused(
        builder.add_link(gap),
        ErrorKind::InvalidArgument,
        &["elbow", "coordinate 2"],
    );
    let flat = LinkDefinition {
        body: Some(planar(&[square()]).body),
        ..named(Vec3::x())
    };
    refused(
        builder.add_link(flat),
        ErrorKind::InvalidArgument,
        &["elbow", "dimension 2"],
    );
    builder.add_link(named(Vec3::x())).unwrap();
    refused(
        builder.add_link(named(Vec3::x())),
        ErrorKind::InvalidArgument,
        &["elbow", "name"],
    );

    let mut entries = Pose::identity().to_row_major();
    entries[7] = f64::NAN;
    refused(
        Pose::from_row_major(&entries),
        ErrorKind::NotFinite,
        &["pose"],
    );
    entries[7] = 0.0;
    entries[5] = 2.0;
    refused(
        Pose::from_row_major(&entries),
        ErrorKind::NotARotation,
        &["rotation"],
    );

    let robot = Arc::new(builder.build().unwrap());
    let world = WorldBox::unbounded();
    refused(Space::new(vec![], &[], world), ErrorKind::Empty, &["robot"]);
    let empty = Coordinate::Interval {
        lower: 1.0,
        upper: 0.0,
    };
    let with_range = Space::new(vec![robot.clone()], &[Some(empty)], world);
    refused(with_range, ErrorKind::InvalidArgument, &["range 0"]);
    let two = Space::new(vec![robot], &[Some(Coordinate::Circle); 2], world);
    refused(two, ErrorKind::WrongSize, &["2 ranges"]);
}

/// Case A44 of docs/cases.md.
#[test]
fn bad_questions_are_refused_by_name() {
    let shape = planar(&[square()]);
    let space = space(vec![free_planar_body(&shape.body)]);
    let (surroundings, _) = environment(&[(&shape.body, at(3., 0., 0.))]);
    let cobject = against(&space, &surroundings);
    let mut context = QueryContext::new();
    let mut ask =
        |q: &[f64], limit: f64| context.distance(&cobject, Configuration::Coordinates(q), limit);
    refused(ask(&[0.0; 2], 1.0), ErrorKind::WrongSize, &["2", "3"]);
    refused(
        ask(&[0.0, f64::NAN, 0.0], 1.0),
        ErrorKind::NotFinite,
        &["configuration entry"],
    );
    refused(
        ask(&[0.0, 0.0, 1e60], 1.0),
        ErrorKind::InvalidArgument,
        &["entry 2"],
    );
    refused(
        ask(&[0.0; 3], f64::NAN),
        ErrorKind::NotFinite,
        &["max_distance"],
    );
    refused(
        ask(&[0.0; 3], -1.0),
        ErrorKind::InvalidArgument,
        &["max_distance"],
    );
    let q = Configuration::Coordinates(&[0.0; 3]);
    refused(
        context.within(&cobject, q, f64::NAN),
        ErrorKind::NotFinite,
        &["threshold"],
    );
    refused(
        context.witnesses(&cobject, q, -1.0, 1),
        ErrorKind::InvalidArgument,
        &["epsilon"],
    );
    let too_few = context.classify(&cobject, Configuration::LinkPoses(&[Pose::identity()]));
    refused(too_few, ErrorKind::WrongSize, &["1 link poses", "3 links"]);
    for (contact_epsilon, margin, name) in [(-1.0, 0.0, "contact_epsilon"), (0.0, -1.0, "margin")] {
        let options = InducedOptions {
            contact_epsilon,
            margin,
        };
        let bad = CObject::induced_links(space.clone(), &[[2, 1]], options);
        refused(bad, ErrorKind::InvalidArgument, &[name]);
    }
    let none = InducedOptions::default();
    let links = |pairs: &[[usize; 2]]| CObject::induced_links(space.clone(), pairs, none);
    refused(
        links(&[[2, 2]]),
        ErrorKind::InvalidArgument,
        &["pair 0", "link 2"],
    );
    refused(links(&[[2, 7]]), ErrorKind::NotFound, &["pair 0", "link 7"]);
    refused(links(&[[2, 0]]), ErrorKind::Empty, &["pair 0", "link 0"]);
    let solid = cuboid([1.0; 3]);
    let here = Pose::identity();
    let mixed = context.pair_distance((&shape.body, &here), (&solid.body, &here), 1.0);
    refused(mixed, ErrorKind::InvalidArgument, &["dimension"]);
    let tilted = Pose::from_euler(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.1]);
    let off = context.pair_distance((&shape.body, &here), (&shape.body, &tilted), 1.0);
    refused(off, ErrorKind::InvalidArgument, &["pose_b", "z = 0"]);
}

/// dimforge/parry#49: four points of size 1e-23.
/// Case A44 of docs/cases.md.
#[test]
fn tiny_points_measure_like_any_others() {
    let points = vertices(&[
        (2.3624029, 1.3771984, 0.22062083),
        (1.3807439, 1.8596945, -0.1784406),
        (1.4174896, -0.3200329, 0.4664615),
        (1.3685897, 0.46402988, 0.22509113),
    ]);
    let want = {
        let shape = hull(&points);
        checked((&shape, &Pose::identity()), (&shape, &at(5., 1., 2.))).distance
    };
    let scale = 1e-23;
    let shape = hull(&points.iter().map(|p| p * scale).collect::<Vec<_>>());
    let away = Pose::from_translation(Vec3::new(5., 1., 2.) * scale);
    let found = checked((&shape, &Pose::identity()), (&shape, &away)).distance;
    assert!(
        (found - want * scale).abs() <= 1e-12 * want * scale,
        "{found:e} {want}"
    );
}

/// A whole scene a million times smaller or larger has a million times smaller or larger distances.
/// Case A44 of docs/cases.md.
#[test]
fn answers_scale_with_the_scene() {
    let mut random = Random::new(44);
    for _ in 0..40 {
        let (points_a, points_b) = (random.points(9, 1.0), random.points(9, 1.0));
        let (pose_a, pose_b) = (random.pose(1.0), random.pose(4.0));
        let measure = |scale: f64| {
            let scaled =
                |points: &[Vec3]| hull(&points.iter().map(|p| p * scale).collect::<Vec<_>>());
            let moved = |pose: &Pose| Pose {
                translation: pose.translation * scale,
                ..*pose
            };
            let (a, b) = (scaled(&points_a), scaled(&points_b));
            let (pose_a, pose_b) = (moved(&pose_a), moved(&pose_b));
            let size = pair_size(&a, &pose_a, &b, &pose_b);
            (checked((&a, &pose_a), (&b, &pose_b)), size)
        };
        let (plain, size) = measure(1.0);
        for scale in [1e-6, 1e6] {
            let (found, _) = measure(scale);
            assert!((found.distance / scale - plain.distance).abs() <= 1e-12 * size);
            assert_eq!(found.distance == 0.0, plain.distance == 0.0);
        }
    }
}
