//! The same answers from all hierarchies, and from those that were saved and loaded.

use std::collections::HashSet;
use std::path::PathBuf;

use cstk::body::Body;
use cstk::hierarchy::{Grouping, HierarchyOptions, WrapperKind};
use cstk::pair::{Pairing, PrimitiveScratch};
use cstk::pose::Pose;
use cstk::query::{DistanceKind, QueryContext};
use cstk_scenes as scenes;

use helpers::models::{GROUPINGS, KINDS, builder, built, mixed_primitives, options, pose};
use helpers::random::Random;
use helpers::trees::models;

/// A body of a scene at a pose.
type PlacedPrimitive<'a> = (&'a Body, &'a Pose);

/// Answers in words: numbers are printed so that different bits read differently.
type Answers = Vec<String>;

/// All queries about two bodies, with thresholds around their distance.
fn answers(context: &mut QueryContext, a: PlacedPrimitive, b: PlacedPrimitive) -> Answers {
    let found = context.pair_distance(a, b, f64::INFINITY).unwrap();
    assert_eq!(found.kind, DistanceKind::Exact);
    let d = found.distance;
    let mut answers = vec![format!("{found:?}")];
    for limit in [0.0, 0.5 * d, d, 1.5 * d] {
        answers.push(format!("{:?}", context.pair_distance(a, b, limit).unwrap()));
    }
    for threshold in [
        0.0,
        0.5 * d,
        found.lower,
        d.next_down().max(0.0),
        d,
        d + 1e-3,
    ] {
        answers.push(format!(
            "{threshold}: {}",
            context.pair_within(a, b, threshold).unwrap()
        ));
    }
    for (epsilon, most) in [
        (0.0, usize::MAX),
        (d, usize::MAX),
        (d + 0.02, usize::MAX),
        (d + 0.1, 5),
        (d + 0.05, 0),
    ] {
        let list = context.pair_witnesses(a, b, epsilon, most).unwrap();
        let names: HashSet<_> = list.witnesses.iter().map(|w| w.primitives).collect();
        assert_eq!(names.len(), list.witnesses.len(), "a pair is listed twice");
        assert!(list.witnesses.len() <= most);
        answers.push(format!("{list:?}"));
    }
    answers
}

/// Panics with the first answer that differs.
fn same(found: &Answers, expected: &Answers, what: impl Fn() -> String) {
    if let Some(i) = (0..expected.len()).find(|&i| found[i] != expected[i]) {
        let short = |text: &str| text.chars().take(600).collect::<String>();
        panic!(
            "{}: answer {i} is\n{}\nnot\n{}",
            what(),
            short(&found[i]),
            short(&expected[i])
        );
    }
}

/// All distances of primitives by brute force: what every tree must find. Sorted as witnesses are.
fn all_pairs(a: PlacedPrimitive, b: PlacedPrimitive) -> Vec<(f64, [u32; 2])> {
    let pairing = Pairing::new(a.0, a.1, b.0, b.1);
    let mut scratch = PrimitiveScratch::default();
    let mut pairs = Vec::new();
    let count = |body: &Body| body.packed().primitives().len() as u32;
    for i in 0..count(a.0) {
        for j in 0..count(b.0) {
            let apart = pairing.distance([i, j], f64::INFINITY, &mut scratch);
            let apart = apart.expect("a distance");
            pairs.push((apart, pairing.primitive_pair([i, j], apart).primitives));
        }
    }
    pairs.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    // Slender primitives have several leaves.
    pairs.dedup();
    pairs
}

/// The distance, the witness and the list of witnesses are those of brute force.
fn agrees_with_brute_force(a: PlacedPrimitive, b: PlacedPrimitive) -> f64 {
    let pairs = all_pairs(a, b);
    let mut context = QueryContext::new();
    let found = context.pair_distance(a, b, f64::INFINITY).unwrap();
    assert_eq!(found.distance.to_bits(), pairs[0].0.to_bits());
    assert_eq!(found.witness.unwrap().primitives, pairs[0].1);
    for epsilon in [0.0, found.distance, found.distance + 0.03] {
        let list = context.pair_witnesses(a, b, epsilon, usize::MAX).unwrap();
        let expected = pairs.partition_point(|pair| pair.0 <= epsilon);
        assert_eq!(list.witnesses.len(), expected);
        for (witness, pair) in list.witnesses.iter().zip(&pairs) {
            assert_eq!((witness.distance, witness.primitives), *pair);
        }
        assert!(!list.truncated);
        // Fewer are the first of them.
        for most in [1, 3, expected.saturating_sub(1)] {
            let list = context.pair_witnesses(a, b, epsilon, most).unwrap();
            let names = list.witnesses.iter().map(|w| w.primitives);
            assert!(names.eq(pairs[..expected.min(most)].iter().map(|pair| pair.1)));
            assert_eq!(list.truncated, most < expected);
        }
    }
    found.distance
}

/// Every grouping, kind of wrapper, aspect limit and hull limit.
fn all_options() -> Vec<HierarchyOptions> {
    let mut all = Vec::new();
    for grouping in GROUPINGS {
        for kind in KINDS {
            for aspect_limit in [0.0, 3.0] {
                let limits: &[u32] = if kind == WrapperKind::Hull {
                    &[32, 8, 1000]
                } else {
                    &[32]
                };
                for &hull_vertex_limit in limits {
                    let base = options(grouping, kind, aspect_limit);
                    all.push(HierarchyOptions {
                        hull_vertex_limit,
                        ..base
                    });
                }
            }
        }
    }
    all
}

/// A pose at which the two bodies' centres are `apart` times the sum of their radii from each other.
fn pose_apart(random: &mut Random, a: &Body, b: &Body, apart: f64) -> Pose {
    let rotation = random.rotation();
    let away = random.unit() * (apart * (a.radius() + b.radius()));
    Pose {
        rotation,
        translation: b.center() + away - rotation * a.center(),
    }
}

/// `pose` with `a` moved so that it just touches `b`, or nearly.
fn pose_touching(pose: &Pose, a: &Body, b: PlacedPrimitive) -> Pose {
    let mut pose = *pose;
    for _ in 0..3 {
        let found = QueryContext::new()
            .pair_distance((a, &pose), b, f64::INFINITY)
            .unwrap();
        pose.translation += found.points[1] - found.points[0];
    }
    pose
}

/// Poses of `a` that overlap `b`, touch it, are near it and far from it.
fn poses_around(
    random: &mut Random,
    a: &Body,
    b: PlacedPrimitive,
    overlapping: &[f64],
) -> Vec<Pose> {
    let mut poses = Vec::new();
    for &apart in overlapping {
        poses.push(pose_apart(random, a, b.0, apart));
    }
    for apart in [0.8, 1.1, 1.5, 8.0] {
        poses.push(pose_apart(random, a, b.0, apart));
        poses.push(pose_touching(&poses[poses.len() - 1], a, b));
    }
    poses
}

/// A small robot and a lamp, built in every way, against each other in turn and crosswise; and by brute force.
#[test]
fn answers_do_not_depend_on_options() {
    let models = [builder(&scenes::lamp()), builder(&scenes::robot_base())];
    let all = all_options();
    let bodies: Vec<[Body; 2]> = all
        .iter()
        .map(|options| [0, 1].map(|m| built(&models[m], options)))
        .collect();
    let mut random = Random::new(5);
    let here = Pose::identity();
    let [a, b] = &bodies[0];
    let poses = poses_around(&mut random, a, (b, &here), &[0.3, 0.5]);
    let (mut zeros, mut positive) = (0, 0);
    let mut contexts: Vec<QueryContext> = Vec::new();
    contexts.resize_with(all.len(), QueryContext::new);
    for (p, pose) in poses.iter().enumerate() {
        let d = agrees_with_brute_force((a, pose), (b, &here));
        zeros += usize::from(d == 0.0);
        positive += usize::from(d > 0.0);
        let expected = answers(&mut QueryContext::new(), (a, pose), (b, &here));
        // Both bodies are built alike at the first pose, and differently at the others.
        for (i, [a, _]) in bodies.iter().enumerate() {
            let other = (i + 11 * p) % all.len();
            let b = &bodies[other][1];
            // Contexts keep what they remember from pose to pose.
            let found = answers(&mut contexts[i], (a, pose), (b, &here));
            same(&found, &expected, || {
                format!("{:?} at {pose:?}, with {:?}", all[i], all[other])
            });
        }
    }
    assert!(
        zeros >= 3 && positive >= 4,
        "{zeros} touching, {positive} apart"
    );
}

/// Options that have each value of each in turn.
fn some_options() -> Vec<HierarchyOptions> {
    (0..KINDS.len())
        .map(|k| HierarchyOptions {
            hull_vertex_limit: [32, 8, 1000][k % 3],
            threads: 1 + k as u32 % 2,
            ..options(GROUPINGS[k % 3], KINDS[k], [0.0, 3.0][(k + 1) % 2])
        })
        .chain([HierarchyOptions {
            hull_vertex_limit: 8,
            ..options(Grouping::TopDown, WrapperKind::Hull, 0.0)
        }])
        .collect()
}

#[test]
fn answers_in_scenes_do_not_depend_on_options() {
    let mut counts = [0; 2];
    for scene in [scenes::free_lamp(), scenes::teapot_contacts_seeded(3)] {
        let mut obstacles = scenes::Mesh::default();
        scene
            .obstacles
            .iter()
            .for_each(|mesh| obstacles.append(mesh));
        let models = [builder(&scene.moving), builder(&obstacles)];
        let all = some_options();
        let bodies: Vec<[Body; 2]> = all
            .iter()
            .map(|options| [0, 1].map(|m| built(&models[m], options)))
            .collect();
        let mut contexts: Vec<QueryContext> = Vec::new();
        contexts.resize_with(all.len(), QueryContext::new);
        let here = Pose::identity();
        let frames = [0, 1, 23, 47, 71, 99, 100, 121, 150, 167, 180, 195, 198, 199];
        for pose in frames.map(|k| pose(&scene.poses[k])) {
            let [a, b] = &bodies[0];
            let expected = answers(&mut QueryContext::new(), (a, &pose), (b, &here));
            let d = QueryContext::new().pair_distance((a, &pose), (b, &here), f64::INFINITY);
            counts[usize::from(d.unwrap().distance > 0.0)] += 1;
            for i in 0..all.len() {
                // The other body of the next options.
                let (a, b) = (&bodies[i][0], &bodies[(i + 1) % all.len()][1]);
                let found = answers(&mut contexts[i], (a, &pose), (b, &here));
                same(&found, &expected, || {
                    format!("{}, {:?} at {pose:?}", scene.name, all[i])
                });
            }
        }
    }
    assert!(counts[0] >= 4 && counts[1] >= 18, "{counts:?}");
}

/// Points, segments and solids, of which some have many leaves.
#[test]
fn answers_of_all_sorts_of_primitives_do_not_depend_on_options() {
    let models = [mixed_primitives(42, 7), mixed_primitives(35, 8)];
    let all = all_options();
    let bodies: Vec<[Body; 2]> = all
        .iter()
        .map(|options| [0, 1].map(|m| built(&models[m], options)))
        .collect();
    let here = Pose::identity();
    let mut random = Random::new(9);
    let [a, b] = &bodies[0];
    for pose in poses_around(&mut random, a, (b, &here), &[0.1, 0.3]) {
        agrees_with_brute_force((a, &pose), (b, &here));
        let expected = answers(&mut QueryContext::new(), (a, &pose), (b, &here));
        for (i, [a, b]) in bodies.iter().enumerate() {
            let found = answers(&mut QueryContext::new(), (a, &pose), (b, &here));
            same(&found, &expected, || format!("{:?} at {pose:?}", all[i]));
        }
    }
}

/// A file that is removed in the end.
struct TemporaryFile(PathBuf);

impl TemporaryFile {
    fn new(name: &str) -> Self {
        let name = format!("cstk-hierarchies-{}-{name}", std::process::id());
        Self(std::env::temp_dir().join(name))
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn saved_bodies_are_loaded_as_they_were() {
    let files = [0, 1].map(|k| TemporaryFile::new(&format!("{k}.cstk")));
    let there_and_back = |body: &Body| {
        body.save(&files[0].0).unwrap();
        let loaded = Body::load(&files[0].0).unwrap();
        loaded.save(&files[1].0).unwrap();
        let [first, second] = [0, 1].map(|k| std::fs::read(&files[k].0).unwrap());
        assert!(first == second, "saved again, the file differs");
        assert!(loaded.tree() == body.tree());
        assert_eq!(loaded.primitives(), body.primitives());
        let all = |body: &Body| {
            let tags: Vec<u64> = (0..body.primitives().len() as u32)
                .map(|i| body.tag(i))
                .collect();
            let sizes = (
                body.dimension(),
                *body.center(),
                body.radius(),
                body.deviation(),
            );
            format!(
                "{tags:?} {sizes:?} {:?} {:?}",
                body.statistics(),
                body.tree().statistics()
            )
        };
        assert_eq!(all(&loaded), all(body));
        loaded
    };
    for (name, builder, _) in models() {
        if ["gear", "spaghetti"].contains(&name) {
            continue;
        }
        there_and_back(&built(&builder, &HierarchyOptions::default()));
    }
    let models = [builder(&scenes::lamp()), mixed_primitives(70, 3)];
    let here = Pose::identity();
    let mut random = Random::new(6);
    for options in all_options() {
        let saved = [0, 1].map(|m| built(&models[m], &options));
        let loaded = [0, 1].map(|m| there_and_back(&saved[m]));
        let [a, b] = &saved;
        let poses = [0.2, 0.6, 1.2].map(|apart| pose_apart(&mut random, a, b, apart));
        for pose in poses {
            let expected = answers(&mut QueryContext::new(), (a, &pose), (b, &here));
            let found = answers(
                &mut QueryContext::new(),
                (&loaded[0], &pose),
                (&loaded[1], &here),
            );
            same(&found, &expected, || format!("{options:?} at {pose:?}"));
        }
    }
}
