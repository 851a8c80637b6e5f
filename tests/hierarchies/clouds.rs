//! Clouds of points: small, answered like balls added one by one, and with a hierarchy that can be looked at.

use cstk::body::{Body, BodyBuilder};
use cstk::hierarchy::{Grouping, HierarchyOptions, WrapperKind};
use cstk::pose::{Pose, Vec3};
use cstk::query::QueryContext;
use cstk_scenes as scenes;

use helpers::containment::{in_hull, in_sphere};
use helpers::models::{KINDS, builder, built};
use helpers::random::Random;
use helpers::trees::held;

/// Clouds of many sorts: scattered, on a surface, on a grid, repeated, on lines, all equal, of sizes that fill nodes and that
/// do not.
fn clouds(n: usize, random: &mut Random) -> Vec<(&'static str, Vec<Vec3>)> {
    let side = (n as f64).cbrt().ceil() as usize;
    let node = |i: usize| [i % side, i / side % side, i / side / side].map(|k| k as f64);
    let wave = |x: f64, y: f64| Vec3::new(x, y, 0.2 * (5.0 * x).sin() * (4.0 * y).cos());
    let once: Vec<Vec3> = random.points(n.div_ceil(10), 1.0);
    let slanted = Vec3::new(1.0, 0.7, -0.4);
    vec![
        ("scattered", random.points(n, 1.0)),
        (
            "surface",
            (0..n)
                .map(|_| wave(random.within(-1.0, 1.0), random.within(-1.0, 1.0)))
                .collect(),
        ),
        ("grid", (0..n).map(|i| Vec3::from(node(i))).collect()),
        ("repeated", (0..n).map(|i| once[i % once.len()]).collect()),
        (
            "slanted line",
            (0..n).map(|_| slanted * random.within(-1.0, 1.0)).collect(),
        ),
        (
            "line along x",
            (0..n).map(|i| Vec3::new(i as f64, 0.0, 0.0)).collect(),
        ),
        ("all equal", vec![Vec3::new(3.0, -2.0, 1.0); n]),
        (
            "dense and far",
            (0..n)
                .map(|i| random.point(if i % 50 == 0 { 1e3 } else { 1e-3 }))
                .collect(),
        ),
    ]
}

fn cloud(points: &[Vec3], radius: f64, options: &HierarchyOptions) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_points(points, radius).unwrap();
    built(&builder, options)
}

/// The same set as a body of spheres, which are no cloud.
fn spheres(points: &[Vec3], radius: f64) -> Body {
    let mut builder = BodyBuilder::new(3).unwrap();
    for (i, point) in (0..).zip(points) {
        builder.add_sphere(point, radius, i).unwrap();
    }
    built(&builder, &HierarchyOptions::default())
}

fn size_of(points: &[Vec3]) -> f64 {
    points.iter().map(|p| p.amax()).fold(0.1, f64::max)
}

/// A point takes its coordinates, its place in the order of leaves, and its share of boxes; in memory as in a file.
#[test]
fn a_point_takes_at_most_100_bytes() {
    let file = std::env::temp_dir().join(format!("cstk-cloud-{}.cstk", std::process::id()));
    let mut random = Random::new(1);
    for n in [4096, 10_000, 30_001] {
        for (name, points) in clouds(n, &mut random) {
            for radius in [0.0, 0.01] {
                let body = cloud(&points, radius, &HierarchyOptions::default());
                let bytes = body.tree_statistics().bytes as usize;
                assert!(bytes <= 100 * n, "{name}: {} bytes a point", bytes / n);
                assert!(bytes >= 24 * n, "{name}: {bytes} bytes are too few");
                body.save(&file).unwrap();
                let written = std::fs::metadata(&file).unwrap().len() as usize;
                std::fs::remove_file(&file).unwrap();
                assert!(written <= 100 * n, "{name}: a file of {written} bytes");
            }
        }
    }
}

/// Answers are those of single spheres bit for bit, though their hierarchy is another; and those of brute force.
#[test]
fn clouds_answer_as_single_spheres_do() {
    let mut random = Random::new(2);
    let (mut apart, mut meeting) = (0, 0);
    for n in [1, 2, 7, 8, 9, 64, 65, 600] {
        for (name, points) in clouds(n, &mut random) {
            let size = size_of(&points);
            for radius in [0.0, 0.02 * size] {
                let cloud = cloud(&points, radius, &HierarchyOptions::default());
                let single = spheres(&points, radius);
                assert_eq!(cloud.radius(), single.radius());
                assert_eq!(cloud.center(), single.center());
                assert_eq!(cloud.deviation(), single.deviation());
                assert_eq!(cloud.statistics().low, single.statistics().low);
                assert_eq!(cloud.statistics().high, single.statistics().high);
                let mut box_builder = BodyBuilder::new(3).unwrap();
                let half = Vec3::new(0.1, 0.2, 0.15) * size;
                box_builder.add_box(&Pose::identity(), &half, 0).unwrap();
                let block = built(&box_builder, &HierarchyOptions::default());
                let still = Pose::identity();
                for k in 0..12 {
                    let mut pose = random.pose(1.5 * size);
                    if k % 3 == 0 {
                        let near = points[random.below(n)];
                        pose.translation = near + random.point(0.05 * size);
                    }
                    let ask = |body: &Body| {
                        let mut query = QueryContext::new();
                        let found =
                            query.pair_distance((&block, &pose), (body, &still), f64::INFINITY);
                        let found = found.unwrap();
                        let list =
                            query.pair_witnesses((&block, &pose), (body, &still), 0.3 * size, 40);
                        format!("{found:?} {:?}", list.unwrap())
                    };
                    assert_eq!(ask(&cloud), ask(&single), "{name}, {n} points");
                    let mut query = QueryContext::new();
                    let found =
                        query.pair_distance((&block, &pose), (&cloud, &still), f64::INFINITY);
                    let found = found.unwrap();
                    let from_box = |p: &Vec3| {
                        let local = pose.inverse().transform_point(p);
                        let beyond = (local.abs() - half).sup(&Vec3::zeros());
                        (beyond.norm() - radius).max(0.0)
                    };
                    let truth = points.iter().map(from_box).fold(f64::INFINITY, f64::min);
                    assert!(
                        (found.distance - truth).abs() <= 1e-12 * 10.0 * size,
                        "{name}, {n} points: {} and not {truth}",
                        found.distance
                    );
                    *if truth > 0.0 {
                        &mut apart
                    } else {
                        &mut meeting
                    } += 1;
                }
            }
        }
    }
    assert!(apart > 300 && meeting > 300, "{apart} {meeting}");
}

/// Points are numbered and tagged in the order in which they came, through several calls and with other shapes between.
#[test]
fn points_keep_their_numbers_tags_and_places() {
    let mut random = Random::new(3);
    let mut builder = BodyBuilder::new(3).unwrap();
    let mut expected: Vec<(u64, Vec3, f64)> = Vec::new();
    for (round, (count, radius)) in [(5, 0.1), (3, 0.1), (0, 0.2), (4, 0.0), (1, 0.3)]
        .into_iter()
        .enumerate()
    {
        let points = random.points(count, 2.0);
        builder.add_points(&points, radius).unwrap();
        let tagged = (0..).zip(&points);
        expected.extend(tagged.map(|(tag, point)| (tag, *point, radius)));
        if round % 2 == 1 {
            let center = random.point(1.0);
            builder.add_sphere(&center, 0.5, 1000).unwrap();
            expected.push((1000, center, 0.5));
        }
    }
    assert!(builder.add_points(&[Vec3::zeros()], -1.0).is_err());
    assert!(
        builder
            .add_points(&[Vec3::zeros(), Vec3::repeat(f64::NAN)], 0.1)
            .is_err()
    );
    assert_eq!(builder.len(), expected.len());
    let body = built(&builder, &HierarchyOptions::default());
    for (i, (tag, point, radius)) in expected.iter().enumerate() {
        let primitive = body.primitives().get(i);
        assert_eq!(body.tag(i as u32), *tag);
        assert_eq!(primitive.vertices, [point - body.center()]);
        assert_eq!(primitive.shape.radius(), *radius);
    }
    assert_eq!(body.piece_count(), expected.len());
    assert!(body.primitives().try_get(expected.len()).is_none());
}

/// A cloud's hierarchy is sound, as shallow as any, of the kind that was asked for, and its wrappers hold the points.
#[test]
fn the_hierarchy_of_a_cloud_can_be_looked_at() {
    let mut random = Random::new(4);
    for n in [1, 9, 500] {
        for (name, points) in clouds(n, &mut random) {
            let radius = 0.02 * size_of(&points);
            for kind in KINDS {
                let options = HierarchyOptions {
                    wrapper: kind,
                    ..Default::default()
                };
                let body = cloud(&points, radius, &options);
                let before = body.tree_statistics();
                assert_eq!(body.wrapper_kind(), kind);
                let tree = body.tree();
                assert_eq!(tree.kind(), kind);
                assert!(tree.subsets().is_sound(n));
                let (nodes, leaves) = held(tree);
                assert_eq!(body.statistics().nodes as usize, nodes.len());
                assert_eq!(body.statistics().depth as usize, tree.subsets().depth());
                let limit = (2.0 * (n as f64).log2() + 1e-9).floor().max(1.0);
                assert!(
                    body.statistics().depth as f64 <= limit,
                    "{name}, {n} points"
                );
                for (i, node) in nodes.iter().enumerate() {
                    let wrapper = tree.wrapper(i as u32);
                    for &leaf in &leaves[node.leaves.clone()] {
                        let primitive = body.primitives().get(leaf as usize);
                        // The hull of these holds the ball.
                        for p in primitive.moved(&Vec3::zeros()).bounding_points() {
                            assert!(in_sphere(p, &wrapper.center, wrapper.radius), "{name}");
                            assert!(in_hull(p, &wrapper, 0.0), "{name}, {n}, {kind:?}");
                        }
                    }
                }
                // Looking at it adds the memory of the wrappers, and changes nothing else.
                let after = body.tree_statistics();
                assert!(after.bytes > before.bytes);
                assert_eq!(after.depth, before.depth);
                assert_eq!(after.expected_cost, before.expected_cost);
                assert_eq!(after.nodes as usize, nodes.len());
            }
        }
    }
}

/// Clustering is done where it is asked for by name; answers do not depend on it.
#[test]
fn clustering_can_be_had_for_points() {
    let mut random = Random::new(5);
    let points = random.points(300, 1.0);
    let with = |grouping| {
        let options = HierarchyOptions {
            grouping,
            ..Default::default()
        };
        cloud(&points, 0.01, &options)
    };
    let [basic, hybrid, top_down] =
        [Grouping::Basic, Grouping::Hybrid, Grouping::TopDown].map(with);
    assert!(basic.tree().subsets() != hybrid.tree().subsets());
    assert!(top_down.tree() == hybrid.tree());
    let probe = spheres(&[Vec3::zeros()], 0.1);
    for _ in 0..20 {
        let pose = random.pose(1.5);
        let ask = |body: &Body| {
            let mut query = QueryContext::new();
            let found =
                query.pair_distance((&probe, &pose), (body, &Pose::identity()), f64::INFINITY);
            format!("{:?}", found.unwrap())
        };
        assert_eq!(ask(&basic), ask(&hybrid));
    }
}

/// Any number of threads builds the same body, progress rises to 1, and an error ends the build.
#[test]
fn threads_and_progress() {
    let points = Random::new(6).points(40_000, 1.0);
    let mut builder = BodyBuilder::new(3).unwrap();
    builder.add_points(&points, 0.001).unwrap();
    let mut bodies = Vec::new();
    for threads in [1, 3] {
        let options = HierarchyOptions {
            threads,
            wrapper: WrapperKind::AlignedBox,
            ..Default::default()
        };
        let mut heard = Vec::new();
        let hear = &mut |fraction| {
            heard.push(fraction);
            Ok(())
        };
        bodies.push(builder.build(&options, hear).unwrap());
        assert!(heard.is_sorted() && heard.len() >= 4, "{heard:?}");
        assert_eq!((heard[0], heard.last()), (0.0, Some(&1.0)));
        for stop in 0..heard.len() {
            let mut count = 0;
            let outcome = builder.build(&options, &mut |_| {
                count += 1;
                match count == stop + 1 {
                    true => Err(cstk::error::Error::invalid("enough")),
                    false => Ok(()),
                }
            });
            // Two threads may tell less often than they did.
            assert!(outcome.is_err() || threads > 1 && count <= stop);
        }
    }
    assert!(bodies[0].packed() == bodies[1].packed());
    assert!(bodies[0].tree() == bodies[1].tree());
}

/// A body of a mesh and points answers as the two bodies do.
#[test]
fn points_beside_a_mesh() {
    let mut random = Random::new(7);
    let points = random.points(2000, 3.0);
    let mesh = builder(&scenes::robot_base());
    let mut both = builder(&scenes::robot_base());
    both.add_points(&points, 0.02).unwrap();
    let both = built(&both, &HierarchyOptions::default());
    let mesh = built(&mesh, &HierarchyOptions::default());
    let points = cloud(&points, 0.02, &HierarchyOptions::default());
    assert!(both.tree_statistics().bytes > points.tree_statistics().bytes);
    let probe = spheres(&[Vec3::zeros()], 0.1);
    let still = Pose::identity();
    for _ in 0..200 {
        let pose = random.pose(3.0);
        let distance = |body: &Body| {
            let mut query = QueryContext::new();
            let found = query.pair_distance((&probe, &pose), (body, &still), f64::INFINITY);
            found.unwrap().distance
        };
        let expected = distance(&mesh).min(distance(&points));
        assert!((distance(&both) - expected).abs() <= 1e-11);
    }
}

/// Discs of the plane, too, are as exact as their centres.
#[test]
fn clouds_of_discs() {
    let mut random = Random::new(8);
    for radius in [0.0, 0.03] {
        let points: Vec<Vec3> = (0..500)
            .map(|_| Vec3::new(random.within(-1.0, 1.0), random.within(-1.0, 1.0), 0.0))
            .collect();
        let mut builder = BodyBuilder::new(2).unwrap();
        builder.add_points(&points, radius).unwrap();
        let cloud = built(&builder, &HierarchyOptions::default());
        let mut builder = BodyBuilder::new(2).unwrap();
        builder.add_sphere(&Vec3::zeros(), 0.05, 0).unwrap();
        let disc = built(&builder, &HierarchyOptions::default());
        for _ in 0..100 {
            let pose = random.planar_pose(1.5);
            let mut query = QueryContext::new();
            let found =
                query.pair_distance((&disc, &pose), (&cloud, &Pose::identity()), f64::INFINITY);
            let between = |p: &Vec3| (p - pose.translation).norm() - radius - 0.05;
            let truth = points.iter().map(between).fold(f64::INFINITY, f64::min);
            assert!((found.unwrap().distance - truth.max(0.0)).abs() <= 1e-11);
        }
    }
}

/// A saved cloud is read back as it was, with the hierarchy it shows; a damaged one is refused.
#[test]
fn clouds_in_files() {
    let file = std::env::temp_dir().join(format!("cstk-clouds-{}.cstk", std::process::id()));
    let mut random = Random::new(9);
    for n in [1, 300] {
        for (name, points) in clouds(n, &mut random) {
            for wrapper in [WrapperKind::Hull, WrapperKind::TightSphere] {
                let options = HierarchyOptions {
                    wrapper,
                    hull_vertex_limit: 20,
                    ..Default::default()
                };
                let mut builder = BodyBuilder::new(3).unwrap();
                builder.add_points(&points, 0.25).unwrap();
                builder.add_points(&points[..n / 2], 0.0).unwrap();
                let saved = built(&builder, &options);
                saved.save(&file).unwrap();
                let loaded = Body::load(&file).unwrap();
                assert!(loaded.packed() == saved.packed(), "{name}");
                assert_eq!(loaded.primitives(), saved.primitives(), "{name}");
                let [a, b] = [&loaded, &saved].map(|body| format!("{:?}", body.statistics()));
                assert_eq!(a, b);
                assert_eq!(loaded.tree_statistics(), saved.tree_statistics());
                assert!(loaded.tree() == saved.tree(), "{name}");
                // Whether the wrappers were made does not show in a file.
                let first = std::fs::read(&file).unwrap();
                saved.save(&file).unwrap();
                assert!(std::fs::read(&file).unwrap() == first);
            }
        }
    }
    let bytes = std::fs::read(&file).unwrap();
    for length in [40, bytes.len() / 2, bytes.len() - 1] {
        std::fs::write(&file, &bytes[..length]).unwrap();
        assert!(Body::load(&file).is_err());
    }
    std::fs::remove_file(&file).unwrap();
}
