//! Bodies of many kinds of primitives: clouds of points, height fields, meshes with balls; their files, their gradients.

use std::sync::Arc;

use cstk::body::{Body, BodyBuilder, HeightField};
use cstk::pose::{Pose, Vec3};
use cstk::query::{Distance, QueryContext};

use helpers::differences::agrees_at_many;
use helpers::models::built;
use helpers::oracle::hull_distance;
use helpers::random::Random;
use helpers::robots::{against, environment, free_body, free_planar_body, space};
use helpers::shapes::dented_ball;

fn body(builder: &BodyBuilder) -> Arc<Body> {
    Arc::new(built(builder, &Default::default()))
}

fn distance(a: &Body, b: &Body, pose_b: &Pose) -> Distance {
    QueryContext::new()
        .pair_distance((a, &Pose::identity()), (b, pose_b), f64::INFINITY)
        .unwrap()
}

#[test]
fn a_cloud_of_points_against_brute_force() {
    let mut random = Random::new(41);
    let points = random.points(10_000, 1.0);
    for radius in [0.0, 0.01] {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_points(&points, radius).unwrap();
        let cloud = body(&builder);
        let mut rod = BodyBuilder::new(3).unwrap();
        let half = 0.3;
        rod.add_capsule(&(-Vec3::x() * half), &(Vec3::x() * half), 0.02, 0)
            .unwrap();
        let rod = body(&rod);
        let mut met = 0;
        for _ in 0..100 {
            let pose = random.pose(1.6);
            let back = pose.inverse();
            let apart = |p: &Vec3| {
                let local = back.transform_point(p);
                (local - Vec3::x() * local.x.clamp(-half, half)).norm() - radius - 0.02
            };
            let (nearest, least) = points
                .iter()
                .map(apart)
                .enumerate()
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .unwrap();
            let found = distance(&cloud, &rod, &pose);
            assert!(
                (found.distance - least.max(0.0)).abs() < 1e-14,
                "{least} {found:?}"
            );
            if least > 0.0 {
                assert_eq!(found.witness.unwrap().tags[0], nearest as u64);
            } else {
                met += 1;
            }
            let epsilon = least.max(0.0) + 0.02;
            let list = QueryContext::new()
                .pair_witnesses((&cloud, &Pose::identity()), (&rod, &pose), epsilon, 20_000)
                .unwrap();
            let within = points.iter().filter(|p| apart(p) <= epsilon).count();
            assert_eq!(list.witnesses.len(), within);
        }
        assert!((5..95).contains(&met), "{met}");
    }
}

#[test]
fn height_fields_against_their_triangles_and_prisms() {
    let mut random = Random::new(42);
    let nodes = [9, 7];
    let heights: Vec<f64> = (0..63).map(|_| random.within(0.0, 1.0)).collect();
    let mut field = HeightField {
        nodes,
        heights: &heights,
        cell: [0.5, 0.4],
        base: None,
    };
    let node = |i: usize, j: usize| Vec3::new(0.5 * i as f64, 0.4 * j as f64, heights[9 * j + i]);
    let mut triangles = Vec::new();
    for j in 0..6 {
        for i in 0..8 {
            triangles.push([node(i, j), node(i + 1, j), node(i + 1, j + 1)]);
            triangles.push([node(i, j), node(i + 1, j + 1), node(i, j + 1)]);
        }
    }
    let corners = random.points(5, 0.3);
    let mut probe = BodyBuilder::new(3).unwrap();
    probe.add_polyhedron(&corners, 0).unwrap();
    let probe = body(&probe);
    for base in [None, Some(-0.5)] {
        field.base = base;
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_height_field(&field).unwrap();
        let ground = body(&builder);
        assert_eq!(ground.primitives().len(), 96);
        assert_eq!((ground.tag(0), ground.tag(1), ground.tag(95)), (0, 0, 47));
        let mut met = 0;
        for _ in 0..60 {
            let mut pose = random.pose(1.0);
            pose.translation += Vec3::new(2.0, 1.2, 1.2);
            let moved: Vec<Vec3> = corners.iter().map(|p| pose.transform_point(p)).collect();
            let want = triangles
                .iter()
                .map(|triangle| {
                    let mut part = triangle.to_vec();
                    if let Some(base) = base {
                        part.extend(triangle.map(|p| Vec3::new(p.x, p.y, base)));
                    }
                    hull_distance(&part, &moved).upper
                })
                .fold(f64::INFINITY, f64::min);
            let found = distance(&ground, &probe, &pose).distance;
            assert!((found - want).abs() < 1e-12, "{base:?} {found} {want}");
            met += usize::from(found == 0.0);
        }
        assert!((10..55).contains(&met), "{met}");
    }
}

/// Every kind of primitive in one body.
fn mixture(random: &mut Random) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).unwrap();
    let size = |random: &mut Random| random.within(0.1, 0.3);
    builder
        .add_sphere(&random.point(0.6), size(random), 0)
        .unwrap();
    let ends = [random.point(0.6), random.point(0.6)];
    builder
        .add_capsule(&ends[0], &ends[1], size(random), 1)
        .unwrap();
    let half = Vec3::new(size(random), size(random), size(random));
    builder.add_box(&random.pose(0.6), &half, 2).unwrap();
    builder
        .add_cylinder(&random.pose(0.6), size(random), size(random), 3)
        .unwrap();
    builder
        .add_cone(&random.pose(0.6), size(random), size(random), 4)
        .unwrap();
    builder.add_ellipsoid(&random.pose(0.6), &half, 5).unwrap();
    let points = random.points(6, 0.4);
    builder.add_rounded_polyhedron(&points, 0.1, 6).unwrap();
    builder
        .add_rounded_polygon(&random.points(3, 0.5), 0.05, 7)
        .unwrap();
    builder
}

/// A body of one primitive, of any kind; hulls also with corners so near that their faces are needles.
fn single(random: &mut Random, kind: usize) -> Arc<Body> {
    let mut builder = BodyBuilder::new(3).unwrap();
    let size = |random: &mut Random| random.within(0.1, 0.4);
    let half = Vec3::new(size(random), size(random), 0.3 * size(random));
    let here = Pose::identity();
    let added = match kind {
        0 => builder.add_sphere(&Vec3::zeros(), size(random), 0),
        1 => builder.add_capsule(&random.point(0.4), &random.point(0.4), size(random), 0),
        2 => builder.add_box(&here, &half, 0),
        3 => builder.add_cylinder(&here, half.x, half.y, 0),
        4 => builder.add_cone(&here, half.x, half.y, 0),
        5 => builder.add_ellipsoid(&here, &half, 0),
        6 => builder.add_polyhedron(&random.points(12, 0.5), 0),
        7 => builder.add_polygon(&random.points(3, 0.5), 0),
        _ => {
            let corners = random.points(5, 0.5);
            let mut beside = |p: &Vec3| p + random.point(1e-4);
            let others: Vec<Vec3> = corners.iter().map(&mut beside).collect();
            builder.add_polyhedron(&[corners, others].concat(), 0)
        }
    };
    added.unwrap();
    body(&builder)
}

/// Searches for anything within a threshold stop as soon as they may; they say what the distance says.
#[test]
fn thresholds_of_single_shapes_agree_with_distances() {
    let mut random = Random::new(45);
    let mut touching = 0;
    for case in 0..9 * 9 * 40 {
        let (a, b) = (
            single(&mut random, case % 9),
            single(&mut random, case / 9 % 9),
        );
        let (here, pose) = (Pose::identity(), random.pose(0.7));
        let mut query = QueryContext::new();
        let found = query
            .pair_distance((&a, &here), (&b, &pose), f64::INFINITY)
            .unwrap();
        touching += usize::from(found.distance == 0.0);
        let Distance { lower, upper, .. } = found;
        let thresholds = [0.0, 0.5 * lower, 0.99 * lower, lower, upper, 1.01 * upper];
        for threshold in thresholds.into_iter().chain([f64::INFINITY]) {
            let within = query.pair_within((&a, &here), (&b, &pose), threshold);
            let is_near = lower <= threshold;
            assert_eq!(
                within.unwrap(),
                is_near,
                "case {case} {threshold} {found:?}"
            );
        }
    }
    assert!(touching > 500, "{touching}");
}

/// Of a body of one primitive the walk asks for the primitive's own support along a direction, in either place of the pair. What it
/// prunes by that is no nearer than what it finds: the nearest triangle of a surface, each a body of its own, for hulls by brute
/// force too.
#[test]
fn single_shapes_are_as_near_to_a_surface_as_to_its_nearest_triangle() {
    let mut random = Random::new(46);
    let mut surface = BodyBuilder::new(3).unwrap();
    let triangles: Vec<Vec<Vec3>> = (0..200)
        .map(|_| {
            let at = random.unit() * random.within(0.7, 1.0);
            random.points(3, 0.15).iter().map(|p| at + p).collect()
        })
        .collect();
    for triangle in &triangles {
        surface.add_polygon(triangle, 0).unwrap();
    }
    let surface = body(&surface);
    let part = |triangle: &Vec<Vec3>| {
        let mut builder = BodyBuilder::new(3).unwrap();
        builder.add_polygon(triangle, 0).unwrap();
        body(&builder)
    };
    let parts: Vec<Arc<Body>> = triangles.iter().map(part).collect();
    let here = Pose::identity();
    let (mut touching, mut apart) = (0, 0);
    for case in 0..9 * 60 {
        let shape = single(&mut random, case % 9);
        let pose = random.pose(1.2);
        let mut query = QueryContext::new();
        let mut asked = |other: &Arc<Body>| {
            query
                .pair_distance((other, &here), (&shape, &pose), f64::INFINITY)
                .unwrap()
        };
        let found = asked(&surface);
        let each = parts.iter().map(&mut asked);
        let nearest = each.min_by(|a, b| a.distance.total_cmp(&b.distance));
        let nearest = nearest.unwrap().distance;
        let turned = query.pair_distance((&shape, &pose), (&surface, &here), f64::INFINITY);
        for distance in [found.distance, turned.unwrap().distance] {
            let error = (distance - nearest).abs();
            assert!(error < 1e-9, "case {case}: {distance} {nearest}");
        }
        if case % 9 == 6 {
            let moved = shape.primitives().get(0).vertices.iter();
            let center = shape.center();
            let moved: Vec<Vec3> = moved.map(|p| pose.transform_point(&(p + center))).collect();
            let truth = triangles.iter().map(|t| hull_distance(t, &moved).upper);
            let truth = truth.fold(f64::INFINITY, f64::min);
            assert!((found.distance - truth).abs() < 1e-12, "{found:?} {truth}");
        }
        for factor in [0.0, 0.5, 0.9, 0.999, 1.001, 1.1] {
            let threshold = factor * nearest;
            let is_near = nearest == 0.0 || factor > 1.0;
            for within in [
                query.pair_within((&surface, &here), (&shape, &pose), threshold),
                query.pair_within((&shape, &pose), (&surface, &here), threshold),
            ] {
                assert_eq!(within.unwrap(), is_near, "case {case} {factor} {found:?}");
            }
        }
        touching += usize::from(nearest == 0.0);
        apart += usize::from(nearest > 0.0);
    }
    assert!(touching > 100 && apart > 100, "{touching} {apart}");
}

/// The whole is as far away as the nearest of its parts, each a body of its own: pruning loses nothing.
#[test]
fn a_mixture_is_as_near_as_its_nearest_part() {
    let mut random = Random::new(43);
    for seed in 0..10 {
        let whole = body(&mixture(&mut Random::new(seed)));
        let other = match seed % 2 {
            0 => dented_ball(|| random.within(0.3, 0.5)).body,
            _ => body(&mixture(&mut Random::new(100 + seed))),
        };
        for _ in 0..40 {
            let pose = random.pose(1.8);
            let mut query = QueryContext::new();
            let here = Pose::identity();
            let all = query
                .pair_witnesses((&whole, &here), (&other, &pose), f64::INFINITY, 1_000_000)
                .unwrap();
            let pairs = whole.primitives().len() * other.primitives().len();
            assert_eq!(all.witnesses.len(), pairs);
            let found = query
                .pair_distance((&whole, &here), (&other, &pose), f64::INFINITY)
                .unwrap();
            assert_eq!(found.distance, all.witnesses[0].distance);
            let epsilon = found.distance + 0.2;
            let near = query
                .pair_witnesses((&whole, &here), (&other, &pose), epsilon, 1_000_000)
                .unwrap();
            let within = all.witnesses.iter().filter(|w| w.distance <= epsilon);
            let named = |w: &cstk::query::Witness| (w.primitives, w.distance.to_bits());
            let want: Vec<_> = within.map(named).collect();
            assert_eq!(near.witnesses.iter().map(named).collect::<Vec<_>>(), want);
        }
    }
}

#[test]
fn gradients_agree_with_differences() {
    let mut random = Random::new(44);
    for seed in 0..4 {
        let moving = body(&mixture(&mut random));
        let obstacles = [
            dented_ball(|| random.within(0.5, 0.8)).body,
            body(&mixture(&mut random)),
        ];
        let placed: Vec<(&Arc<Body>, Pose)> = obstacles
            .iter()
            .map(|o| (o, Pose::from_translation(random.unit() * 3.0)))
            .collect();
        let cobject = against(&space(vec![free_body(&moving)]), &environment(&placed).0);
        agrees_at_many(&cobject, &[1.5, 1.5, 1.5, 3.0, 1.5, 3.0], 40, seed);
    }
    let mut flat = BodyBuilder::new(2).unwrap();
    let corner = Vec3::new(0.5, 0.3, 0.0);
    flat.add_capsule(&Vec3::zeros(), &corner, 0.2, 0).unwrap();
    flat.add_sphere(&-corner, 0.3, 1).unwrap();
    let flat = body(&flat);
    let placed = [(&flat, Pose::from_translation(Vec3::new(1.5, 0.5, 0.0)))];
    let cobject = against(
        &space(vec![free_planar_body(&flat)]),
        &environment(&placed).0,
    );
    agrees_at_many(&cobject, &[2.0, 2.0, 3.0], 40, 9);
}

#[test]
fn a_file_keeps_every_kind_of_primitive() {
    let mut random = Random::new(45);
    let file = std::env::temp_dir().join(format!("cstk-shapes-{}.cstk", std::process::id()));
    let other = dented_ball(|| random.within(0.3, 0.5)).body;
    for dimension in [3, 2] {
        let builder = if dimension == 3 {
            mixture(&mut random)
        } else {
            let mut flat = BodyBuilder::new(2).unwrap();
            flat.add_capsule(&Vec3::x(), &Vec3::y(), 0.2, 5).unwrap();
            flat
        };
        let saved = built(&builder, &Default::default());
        saved.save(&file).unwrap();
        let loaded = Body::load(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert_eq!(saved.primitives(), loaded.primitives());
        assert_eq!(saved.radius(), loaded.radius());
        assert_eq!(saved.deviation(), loaded.deviation());
        if dimension == 2 {
            continue;
        }
        for _ in 0..30 {
            let pose = random.pose(1.8);
            let [a, b] = [&saved, &loaded].map(|body| distance(body, &other, &pose));
            assert_eq!(a.distance.to_bits(), b.distance.to_bits());
            assert_eq!(a.points, b.points);
        }
    }
}

/// Whatever can be drawn is, and its corners lie on the body.
#[test]
fn pictures_of_round_bodies() {
    let mut random = Random::new(46);
    let body = built(&mixture(&mut random), &Default::default());
    let nodes: Vec<u32> = (0..body.tree().subsets().nodes.len() as u32).collect();
    let surfaces = cstk::show::node_surfaces(&body, &nodes).unwrap();
    let mut point = BodyBuilder::new(3).unwrap();
    point.add_sphere(&Vec3::zeros(), 0.0, 0).unwrap();
    let point = built(&point, &Default::default());
    for (surface, &node) in surfaces.iter().zip(&nodes) {
        if let cstk::hierarchy::Node::Leaf { .. } = body.tree().node(node) {
            for corner in &surface.vertices {
                let off = distance(&body, &point, &Pose::from_translation(*corner));
                assert!(off.distance < 1e-12, "{off:?}");
            }
        }
    }
    let file = std::env::temp_dir().join(format!("cstk-shapes-{}.glb", std::process::id()));
    cstk::show::show_nodes(&body, &nodes, &file).unwrap();
    assert!(std::fs::metadata(&file).unwrap().len() > 100_000);
    std::fs::remove_file(&file).unwrap();
}

/// A side of a polygon so short that its ends become one where the polygon is far from the other body's middle: a ball in the
/// polygon's middle meets it all the same.
#[test]
fn balls_meet_polygons_whose_short_sides_vanish() {
    let (half, short) = (0.5, 1e-11);
    let corners = [
        (-half, -half),
        (half, -half),
        (half, half - short),
        (half - short, half),
        (-half, half),
    ];
    let corners = corners.map(|(x, y)| Vec3::new(x, y, 0.0));
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_polygon(&corners, 0).unwrap();
    let polygon = body(&builder);
    let mut builder = BodyBuilder::new(3).unwrap();
    let far = Vec3::new(2e6, 2e6, 0.0);
    for at in [Vec3::zeros(), far] {
        builder.add_sphere(&at, 0.1, 0).unwrap();
    }
    let balls = body(&builder);
    let here = Pose::identity();
    let mut query = QueryContext::new();
    for height in [0.0, 0.05] {
        let there = Pose::from_translation(Vec3::new(0.0, 0.0, height));
        for (a, b) in [
            ((&*balls, &here), (&*polygon, &there)),
            ((&*polygon, &there), (&*balls, &here)),
        ] {
            assert!(query.pair_within(a, b, 0.0).unwrap());
            let found = query.pair_distance(a, b, f64::INFINITY).unwrap();
            assert_eq!((found.distance, found.lower), (0.0, 0.0));
        }
    }
}
