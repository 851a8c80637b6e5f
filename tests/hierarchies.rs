//! Hierarchies, however they are built: sound and shallow trees, wrappers that leave nothing out, the same tree on any
//! number of threads, the same answers from all of them and from files, covers and statistics, and progress.

mod common;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use cstk::body::{Body, BodyBuilder};
use cstk::error::{Error, ErrorKind};
use cstk::gjk::{PointCloud, gjk};
use cstk::hierarchy::{
    Extent, Grouping, HierarchyOptions, Node, WrapperKind, WrapperTree, build_hierarchy,
};
use cstk::pair::{Pairing, PrimitiveScratch};
use cstk::pose::{Pose, Vec3};
use cstk::query::{DistanceKind, QueryContext};
use cstk_scenes as scenes;

use common::containment::{in_hull, in_sphere};
use common::models::{GROUPINGS, KINDS, builder, built, mixed_primitives, options, pose, squares};
use common::random::Random;
use common::shapes::box_corners;

/// The models, and whether they are small enough for every combination of options.
fn models() -> Vec<(&'static str, BodyBuilder, bool)> {
    vec![
        ("robot base", builder(&scenes::robot_base()), true),
        ("coincident", builder(&scenes::coincident(500)), true),
        ("few spaghetti", builder(&scenes::spaghetti(120, 1)), true),
        ("one square", squares(1), true),
        ("two equal squares", squares(2), true),
        (
            "points, segments and solids",
            mixed_primitives(210, 1),
            true,
        ),
        ("lamp", builder(&scenes::lamp()), false),
        ("five lamps", builder(&scenes::lamps(5, 1)), false),
        ("gear", builder(&scenes::gear()), false),
        ("motor", builder(&scenes::motor()), false),
        (
            "bumpy sphere",
            builder(&scenes::bumpy_sphere(3000, 1)),
            false,
        ),
        ("spaghetti", builder(&scenes::spaghetti(3000, 1)), false),
        (
            "floor and screws",
            builder(&scenes::floor_and_screws(3000, 1)),
            false,
        ),
        (
            "nested shells",
            builder(&scenes::nested_shells(1000)),
            false,
        ),
    ]
}

/// What a node holds: its leaves by rank, from first to last, and its level.
struct Held {
    leaves: std::ops::Range<usize>,
    level: usize,
}

/// What each node holds, and the primitives of the leaves in order; found by walking from the root, which must meet
/// every node once.
fn held(tree: &WrapperTree) -> (Vec<Held>, Vec<u32>) {
    fn walk(
        tree: &WrapperTree,
        node: u32,
        level: usize,
        held: &mut Vec<Option<Held>>,
        leaves: &mut Vec<u32>,
    ) {
        let from = leaves.len();
        match tree.node(node) {
            Node::Leaf { primitive } => leaves.push(primitive),
            Node::Interior { children } => {
                for child in children {
                    walk(tree, child, level + 1, held, leaves);
                }
            }
        }
        let own = Held {
            leaves: from..leaves.len(),
            level,
        };
        assert!(
            held[node as usize].replace(own).is_none(),
            "node {node} has two parents"
        );
    }
    let mut nodes = Vec::new();
    nodes.resize_with(tree.subsets().nodes.len(), || None);
    let mut leaves = Vec::new();
    walk(tree, 0, 0, &mut nodes, &mut leaves);
    let nodes = nodes
        .into_iter()
        .map(|node| node.expect("every node hangs on the root"));
    (nodes.collect(), leaves)
}

/// The tree is sound and no deeper than 2 log2 of its leaves.
fn sound_and_shallow(body: &Body, aspect_limit: f64, what: &str) {
    let (tree, count) = (body.tree(), body.primitives().len());
    assert!(tree.subsets().is_sound(count), "{what}");
    let (nodes, leaves) = held(tree);
    assert_eq!(nodes.len(), 2 * leaves.len() - 1, "{what}");
    let mut times_met = vec![0; count];
    for &primitive in &leaves {
        times_met[primitive as usize] += 1;
    }
    assert!(
        times_met.iter().all(|&n| n >= 1),
        "{what}: a primitive without a leaf"
    );
    if aspect_limit == 0.0 {
        assert!(
            times_met.iter().all(|&n| n == 1),
            "{what}: a primitive with two leaves"
        );
    }
    let depth = 1 + nodes.iter().map(|node| node.level).max().unwrap();
    assert_eq!(depth, tree.subsets().depth(), "{what}");
    let limit = (2.0 * (leaves.len() as f64).log2() + 1e-9).floor().max(1.0) as usize;
    assert!(
        depth <= limit,
        "{what}: {depth} levels over {} leaves, at most {limit}",
        leaves.len()
    );
}

#[test]
fn trees_are_sound_and_shallow_and_do_not_depend_on_the_wrappers() {
    for (name, builder, small) in models() {
        for grouping in GROUPINGS {
            for aspect_limit in [0.0, 3.0] {
                if name == "spaghetti" && aspect_limit > 0.0 {
                    // Two thousand faces of 64 slabs each.
                    continue;
                }
                let what = format!("{name}, {grouping:?}, aspect limit {aspect_limit}");
                let build = |kind| built(&builder, &options(grouping, kind, aspect_limit));
                let body = build(WrapperKind::AlignedBox);
                sound_and_shallow(&body, aspect_limit, &what);
                for kind in KINDS.into_iter().filter(|_| small) {
                    let other = build(kind);
                    assert_eq!(
                        other.tree().subsets(),
                        body.tree().subsets(),
                        "{what}, {kind:?}"
                    );
                    assert_eq!(other.tree().kind(), kind);
                }
            }
        }
    }
}

/// Every wrapper holds all vertices of the primitives whose leaves are all below it. Returns how many were looked at.
fn wrappers_hold_vertices(body: &Body, what: &str) -> usize {
    let tree = body.tree();
    let (nodes, leaves) = held(tree);
    let mut reach: Vec<Option<(usize, usize)>> = vec![None; body.primitives().len()];
    for (rank, &primitive) in leaves.iter().enumerate() {
        let own = &mut reach[primitive as usize];
        *own = Some(own.map_or((rank, rank), |(first, _)| (first, rank)));
    }
    let mut looked_at = 0;
    for (i, node) in nodes.iter().enumerate() {
        let wrapper = tree.wrapper(i as u32);
        let mut seen = HashSet::new();
        for rank in node.leaves.clone() {
            let primitive = leaves[rank];
            let whole = reach[primitive as usize]
                .is_some_and(|(first, last)| first == rank && last < node.leaves.end);
            if !whole {
                continue;
            }
            for p in &body.primitives()[primitive as usize].vertices {
                if !seen.insert([p.x, p.y, p.z].map(f64::to_bits)) {
                    continue;
                }
                looked_at += 1;
                assert!(
                    in_sphere(p, &wrapper.center, wrapper.radius),
                    "{what}: node {i} of {} leaves: {p:?} is outside the sphere of {} about {:?}, at {}",
                    node.leaves.len(),
                    wrapper.radius,
                    wrapper.center,
                    (p - wrapper.center).norm()
                );
                assert!(
                    in_hull(p, &wrapper, 0.0),
                    "{what}: node {i} of {} leaves: {p:?} is outside {} corners by {:e} at least, not {:e}",
                    node.leaves.len(),
                    wrapper.corners.len(),
                    gjk(
                        &PointCloud(wrapper.corners),
                        &PointCloud(&[*p]),
                        Vec3::zeros(),
                        f64::INFINITY
                    )
                    .lower,
                    wrapper.excess
                );
            }
        }
    }
    looked_at
}

/// Small models with all options; large ones with each kind of wrapper, the other options in turn.
#[test]
fn wrappers_leave_no_vertex_out() {
    for (m, (name, builder, small)) in models().into_iter().enumerate() {
        for (k, kind) in KINDS.into_iter().enumerate() {
            for (g, grouping) in GROUPINGS.into_iter().enumerate() {
                for (a, aspect_limit) in [0.0, 3.0].into_iter().enumerate() {
                    let in_turn = g == (m + k) % 3 && a == (m + k) % 2;
                    if !(small || in_turn) || name == "spaghetti" && a > 0 {
                        continue;
                    }
                    let what =
                        format!("{name}, {grouping:?}, {kind:?}, aspect limit {aspect_limit}");
                    let body = built(&builder, &options(grouping, kind, aspect_limit));
                    let looked_at = wrappers_hold_vertices(&body, &what);
                    assert!(looked_at >= body.primitives().len(), "{what}: {looked_at}");
                }
            }
        }
    }
    // Turned, so that no face lies along an axis; and hulls of any size.
    for (m, model) in [scenes::robot_base(), scenes::lamp()].iter().enumerate() {
        let turned = builder(&model.moved(&scenes::Pose::rotation([0.3, -0.5, 0.7], 1.1)));
        for (k, kind) in KINDS.into_iter().enumerate() {
            for hull_vertex_limit in [8, 1000] {
                let grouping = GROUPINGS[(m + k) % 3];
                let given = HierarchyOptions {
                    hull_vertex_limit,
                    ..options(grouping, kind, 0.0)
                };
                let what = format!("turned model {m}, {given:?}");
                wrappers_hold_vertices(&built(&turned, &given), &what);
                if kind != WrapperKind::Hull {
                    break;
                }
            }
        }
    }
}

/// The slabs of slender primitives cover them at every level: a point of a primitive lies in a wrapper that holds one
/// of its leaves.
#[test]
fn the_leaves_of_a_slender_primitive_cover_it_at_every_level() {
    let mut random = Random::new(2);
    let models = [builder(&scenes::spaghetti(60, 1)), mixed_primitives(70, 2)];
    for (m, builder) in models.iter().enumerate() {
        for (k, kind) in KINDS.into_iter().enumerate() {
            let body = built(builder, &options(GROUPINGS[(m + k) % 3], kind, 3.0));
            let tree = body.tree();
            let (nodes, leaves) = held(tree);
            let mut several = 0;
            for level in 0..tree.subsets().depth() {
                let mut holders: HashMap<u32, Vec<u32>> = HashMap::new();
                for node in tree.level(level as u32) {
                    for rank in nodes[node as usize].leaves.clone() {
                        holders.entry(leaves[rank]).or_default().push(node);
                    }
                }
                for (i, primitive) in body.primitives().iter().enumerate() {
                    let holders = &mut holders.get_mut(&(i as u32)).unwrap();
                    holders.dedup();
                    several += usize::from(holders.len() > 1);
                    for _ in 0..4 {
                        let corner = |random: &mut Random| {
                            primitive.vertices[random.below(primitive.vertices.len())]
                        };
                        let (from, to) = (corner(&mut random), corner(&mut random));
                        let p = from.lerp(&to, random.within(0.0, 1.0));
                        // What rounding may have moved p off the segment.
                        let rounded = 4.0 * f64::EPSILON * from.amax().max(to.amax());
                        let holds = |&node: &u32| {
                            let wrapper = tree.wrapper(node);
                            in_sphere(&p, &wrapper.center, wrapper.radius + rounded)
                                && in_hull(&p, &wrapper, rounded)
                        };
                        assert!(
                            holders.iter().any(holds),
                            "model {m}, {kind:?}: no wrapper of level {level} holds {p:?} of primitive {i}"
                        );
                    }
                }
            }
            assert!(several > 100, "{several} primitives were met in parts");
        }
    }
}

fn tree_of(builder: &BodyBuilder, options: &HierarchyOptions) -> WrapperTree {
    built(builder, options).tree().clone()
}

#[test]
fn any_number_of_threads_gives_the_same_tree() {
    let models = [
        builder(&scenes::lamps(5, 1)),
        builder(&scenes::bumpy_sphere(20_000, 1)),
    ];
    for (m, builder) in models.iter().enumerate() {
        for grouping in GROUPINGS {
            let kinds = if m == 0 {
                &KINDS[..]
            } else {
                &[WrapperKind::AlignedBox]
            };
            for &kind in kinds {
                let tree = |threads| {
                    let base = options(grouping, kind, 0.0);
                    tree_of(builder, &HierarchyOptions { threads, ..base })
                };
                let alone = tree(1);
                for threads in [2, 3, 8] {
                    // Not `assert_eq`: that would print both.
                    assert!(
                        tree(threads) == alone,
                        "model {m}, {grouping:?}, {kind:?}, {threads} threads"
                    );
                }
            }
        }
    }
    // The default kind on a large model, where the tasks of threads differ most.
    let tree = |threads| {
        let base = HierarchyOptions::default();
        tree_of(&models[1], &HierarchyOptions { threads, ..base })
    };
    let alone = tree(1);
    assert!(tree(3) == alone);
    assert!(tree(8) == alone);
}

#[test]
fn the_same_input_gives_the_same_tree_and_keeps_its_names() {
    for (name, mesh) in [
        ("robot base", scenes::robot_base()),
        ("coincident", scenes::coincident(500)),
        ("floor and screws", scenes::floor_and_screws(1000, 1)),
        ("spaghetti", scenes::spaghetti(300, 1)),
    ] {
        for (k, kind) in KINDS.into_iter().enumerate() {
            for grouping in GROUPINGS {
                let given = options(grouping, kind, if k % 2 == 0 { 0.0 } else { 3.0 });
                let first = builder(&mesh);
                let tree = tree_of(&first, &given);
                assert!(tree_of(&first, &given) == tree, "{name}, {given:?}");
                assert!(
                    tree_of(&builder(&mesh), &given) == tree,
                    "{name}, {given:?}"
                );
            }
        }
        for grouping in GROUPINGS {
            let body = built(
                &builder(&mesh),
                &options(grouping, WrapperKind::AlignedBox, 0.0),
            );
            assert_eq!(body.primitives().len(), mesh.faces.len());
            for (f, face) in mesh.faces.iter().enumerate() {
                assert_eq!(body.tag(f as u32), f as u64);
                let given: Vec<Vec3> = face
                    .iter()
                    .map(|&v| Vec3::from(mesh.vertices[v as usize]) - body.center())
                    .collect();
                assert_eq!(body.primitives()[f].vertices, given);
            }
            // A leaf bounds the primitive it names, and nothing else.
            for node in 0..body.tree().subsets().nodes.len() as u32 {
                if let Node::Leaf { primitive } = body.tree().node(node) {
                    let own = Extent::of(&body.primitives()[primitive as usize].vertices);
                    assert_eq!(body.tree().wrapper(node).extent(), own);
                }
            }
        }
    }
}

/// A body of a scene at a pose.
type Placed<'a> = (&'a Body, &'a Pose);

/// Answers in words: numbers are printed so that different bits read differently.
type Answers = Vec<String>;

/// All queries about two bodies, with thresholds around their distance.
fn answers(context: &mut QueryContext, a: Placed, b: Placed) -> Answers {
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
fn all_pairs(a: Placed, b: Placed) -> Vec<(f64, [u32; 2])> {
    let pairing = Pairing::new(a.0, a.1, b.0, b.1);
    let mut scratch = PrimitiveScratch::default();
    let mut pairs = Vec::new();
    let count = |body: &Body| body.packed().primitives().len() as u32;
    for i in 0..count(a.0) {
        for j in 0..count(b.0) {
            let apart = pairing.distance([i, j], f64::INFINITY, &mut scratch);
            let apart = apart.expect("a distance");
            pairs.push((apart, pairing.met([i, j], apart).primitives));
        }
    }
    pairs.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    // Slender primitives have several leaves.
    pairs.dedup();
    pairs
}

/// The distance, the witness and the list of witnesses are those of brute force.
fn agrees_with_brute_force(a: Placed, b: Placed) -> f64 {
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
fn pose_touching(pose: &Pose, a: &Body, b: Placed) -> Pose {
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
fn poses_around(random: &mut Random, a: &Body, b: Placed, overlapping: &[f64]) -> Vec<Pose> {
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

/// Nodes that hold every leaf exactly once.
fn partition_leaves(held: &[Held], nodes: &[u32]) -> bool {
    let mut ranges: Vec<_> = nodes
        .iter()
        .map(|&node| held[node as usize].leaves.clone())
        .collect();
    ranges.sort_by_key(|range| range.start);
    let end = ranges
        .iter()
        .try_fold(0, |end, range| (range.start == end).then_some(range.end));
    end == Some(held[0].leaves.end)
}

#[test]
fn levels_partition_the_leaves() {
    for (m, (name, builder, _)) in models().into_iter().enumerate() {
        if ["spaghetti", "gear", "motor", "five lamps"].contains(&name) {
            continue;
        }
        let body = built(
            &builder,
            &options(GROUPINGS[m % 3], WrapperKind::AlignedBox, [0.0, 3.0][m % 2]),
        );
        let tree = body.tree();
        let (nodes, _) = held(tree);
        let depth = tree.subsets().depth();
        let leaves = (0..nodes.len() as u32).filter(|&i| nodes[i as usize].leaves.len() == 1);
        let leaves: Vec<u32> = leaves.collect();
        for k in 0..depth + 2 {
            let level = tree.level(k as u32);
            let expected = |i: &u32| {
                let node = &nodes[*i as usize];
                node.level == k || node.level < k && node.leaves.len() == 1
            };
            let expected: Vec<u32> = (0..nodes.len() as u32).filter(expected).collect();
            assert_eq!(level, expected, "{name}, level {k}");
            assert!(partition_leaves(&nodes, &level), "{name}, level {k}");
            if k + 1 >= depth {
                assert_eq!(level, leaves);
            }
            match tree.level_statistics(k as u32) {
                Ok(statistics) => {
                    assert!(k < depth);
                    let above = level
                        .iter()
                        .filter(|&&i| nodes[i as usize].level < k)
                        .count() as u64;
                    assert_eq!(statistics.leaves_above, above);
                    assert_eq!(statistics.nodes + above, level.len() as u64);
                }
                Err(error) => assert!(k >= depth && error.kind == ErrorKind::NotFound),
            }
        }
    }
}

/// The volume of a wrapper's box, its sides lengthened by a hundredth of the longest, as covers measure it.
fn bulk(tree: &WrapperTree, node: u32) -> f64 {
    let size = tree.wrapper(node).extent().size();
    size.iter().map(|side| side + 0.01 * size.amax()).product()
}

/// The least total bulk of exactly 1, 2, … `most` nodes that hold all leaves, by dynamic programming from the leaves
/// up; infinite where there are not so many leaves.
fn best_covers(tree: &WrapperTree, most: usize) -> Vec<f64> {
    let count = tree.subsets().nodes.len();
    let mut best: Vec<Vec<f64>> = vec![Vec::new(); count];
    for node in (0..count as u32).rev() {
        let mut own = vec![f64::INFINITY; most];
        own[0] = bulk(tree, node);
        if let Node::Interior { children: [a, b] } = tree.node(node) {
            for n in 2..=most {
                for of_a in 1..n {
                    let both = best[a as usize][of_a - 1] + best[b as usize][n - of_a - 1];
                    own[n - 1] = own[n - 1].min(both);
                }
            }
        }
        best[node as usize] = own;
    }
    best.swap_remove(0)
}

/// Always opening the largest node is not the best: a node that hardly shrinks when it is opened takes the places of
/// others that would. Measured over these models, the worst factor over the best cover of as many nodes is 2.53 for
/// hulls and boxes (hulls of spaghetti) and 9.44 for spheres (24 tight spheres of the lamp: those of a long arm shrink
/// only after many openings). Where opening gains nothing, as with coincident squares, fewer nodes than asked for would
/// do.
#[test]
fn covers_are_not_far_from_the_best() {
    let models = [
        ("lamp", builder(&scenes::lamp())),
        ("robot base", builder(&scenes::robot_base())),
        ("bumpy sphere", builder(&scenes::bumpy_sphere(500, 1))),
        ("floor", builder(&scenes::floor_and_screws(600, 1))),
        ("spaghetti", builder(&scenes::spaghetti(300, 1))),
        ("coincident", builder(&scenes::coincident(100))),
        ("nested shells", builder(&scenes::nested_shells(200))),
        ("all sorts", mixed_primitives(210, 4)),
        ("one square", squares(1)),
    ];
    for (name, builder) in &models {
        for (grouping, kind) in GROUPINGS
            .into_iter()
            .flat_map(|g| KINDS.map(|kind| (g, kind)))
        {
            let tree = tree_of(builder, &options(grouping, kind, 0.0));
            let leaves = tree.statistics().leaves as usize;
            let accepted = match kind {
                WrapperKind::TightSphere | WrapperKind::MergedSphere => 10.0,
                _ => 3.0,
            };
            let best = best_covers(&tree, 24);
            let (nodes, _) = held(&tree);
            for n in 1..=24 {
                let what = format!("{name}, {grouping:?}, {kind:?}, {n} nodes");
                let cover = tree.cover(n).unwrap();
                assert_eq!(cover.len(), n.min(leaves), "{what}");
                assert!(cover.is_sorted_by(|a, b| a < b), "{what}");
                assert!(partition_leaves(&nodes, &cover), "{what}");
                let total: f64 = cover.iter().map(|&node| bulk(&tree, node)).sum();
                let factor = total / best[cover.len() - 1];
                assert!(factor <= accepted, "{what}: {factor} times the best");
            }
        }
    }
    let tree = tree_of(&squares(1), &HierarchyOptions::default());
    assert_eq!(tree.cover(0).unwrap_err().kind, ErrorKind::InvalidArgument);
    let tree = tree_of(&models[0].1, &HierarchyOptions::default());
    assert_eq!(tree.cover(usize::MAX).unwrap(), tree.level(u32::MAX));
}

fn cuboids(sides: [f64; 3], centers: impl Iterator<Item = Vec3>) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).unwrap();
    for (tag, center) in centers.enumerate() {
        let corners: Vec<Vec3> = box_corners(sides).iter().map(|c| c + center).collect();
        builder.add_polyhedron(&corners, tag as u64).unwrap();
    }
    builder
}

/// The surface of a box of squares, each side divided into n by n.
fn divided_box(sides: [f64; 3], n: usize) -> BodyBuilder {
    let mut builder = BodyBuilder::new(3).unwrap();
    let along = |axis: usize, k: usize| sides[axis] * (k as f64 / n as f64 - 0.5);
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for end in [0, n] {
            for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                    let mut corner = Vec3::zeros();
                    (corner[axis], corner[u], corner[v]) =
                        (along(axis, end), along(u, i), along(v, j));
                    corner
                });
                builder.add_polygon(&corners, 0).unwrap();
            }
        }
    }
    builder
}

#[test]
fn statistics_count_and_measure() {
    for (m, (name, builder, _)) in models().into_iter().enumerate() {
        if name == "spaghetti" {
            continue;
        }
        let given = options(GROUPINGS[m % 3], KINDS[m % 5], [0.0, 3.0][m % 2]);
        let body = built(&builder, &given);
        let tree = body.tree();
        let (nodes, leaves) = held(tree);
        let statistics = tree.statistics();
        assert_eq!(statistics.nodes, nodes.len() as u64, "{name}");
        assert_eq!(statistics.leaves, leaves.len() as u64);
        assert_eq!(statistics.depth, tree.subsets().depth() as u64);
        let at_leaves = nodes
            .iter()
            .filter(|node| node.leaves.len() == 1)
            .map(|node| node.level);
        let mean = at_leaves.sum::<usize>() as f64 / leaves.len() as f64;
        assert!(
            (statistics.mean_leaf_level - mean).abs() <= 1e-12 * mean,
            "{name}"
        );
        assert!(
            statistics.balance >= 1.0 && statistics.fill > 0.0 && statistics.fill < f64::INFINITY
        );
        assert!(statistics.expected_cost >= 1.0 && statistics.expected_cost < f64::INFINITY);
        assert_eq!((statistics.pieces, tree.pieces().len()), (0, 0));
        assert!(statistics.bytes as usize >= nodes.len() * size_of::<Node>());
        let of_body = body.statistics();
        assert_eq!(
            (of_body.nodes, of_body.depth),
            (statistics.nodes, statistics.depth)
        );
        assert_eq!(of_body.primitives, body.primitives().len() as u64);
    }
    let sides = [2.0, 3.0, 0.5];
    let (volume, area) = (3.0, 2.0 * (6.0 + 1.5 + 1.0));
    let diagonal = Vec3::from(sides).norm();
    for n in [1, 4] {
        let builder = divided_box(sides, n);
        for (grouping, kind) in GROUPINGS
            .into_iter()
            .flat_map(|g| KINDS.map(|kind| (g, kind)))
        {
            let tree = tree_of(&builder, &options(grouping, kind, 0.0));
            assert_eq!(tree.statistics().leaves, 6 * (n * n) as u64);
            let root = tree.level_statistics(0).unwrap();
            assert_eq!((root.nodes, root.leaves_above), (1, 0));
            match kind {
                WrapperKind::Hull | WrapperKind::OrientedBox | WrapperKind::AlignedBox => {
                    assert!(
                        (root.volume - volume).abs() <= 1e-12 * volume,
                        "{kind:?}: {root:?}"
                    );
                    assert!(
                        (root.surface - area).abs() <= 1e-12 * area,
                        "{kind:?}: {root:?}"
                    );
                }
                WrapperKind::TightSphere | WrapperKind::MergedSphere => {
                    let radius = 0.5 * diagonal;
                    let least = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
                    // The tight sphere is within a few percent; merged ones grow with every level.
                    let most = if kind == WrapperKind::TightSphere {
                        1.1
                    } else {
                        8.0
                    };
                    assert!(
                        root.volume >= least && root.volume <= most * least,
                        "{kind:?}: {root:?}"
                    );
                }
            }
            let leaves = tree
                .level_statistics(tree.subsets().depth() as u32 - 1)
                .unwrap();
            if kind == WrapperKind::Hull {
                // Flat leaves have two sides.
                assert!(
                    leaves.volume == 0.0 && (leaves.surface - 2.0 * area).abs() <= 1e-12 * area
                );
            }
        }
    }
}

/// A hull lies in the hulls above it, so its volume is no larger; two such children have twice their parent's at most.
/// Of boxes in a row, the levels' volumes fall from the whole row's to the sum of the boxes'.
#[test]
fn volumes_of_hulls_fall() {
    let rounding = 1.0 + 1e-9;
    for (g, mesh) in [
        scenes::lamp(),
        scenes::robot_base(),
        scenes::bumpy_sphere(800, 1),
    ]
    .iter()
    .enumerate()
    {
        let given = HierarchyOptions {
            hull_vertex_limit: 10_000,
            ..options(GROUPINGS[g], WrapperKind::Hull, 0.0)
        };
        let tree = tree_of(&builder(mesh), &given);
        for node in 0..tree.subsets().nodes.len() as u32 {
            if let Node::Interior { children } = tree.node(node) {
                let volume = |node| tree.wrapper(node).volume_and_area().0;
                // What the excess of a flat hull may hide.
                let hidden = 1e-5 * tree.wrapper(node).radius.powi(3);
                for child in children {
                    assert!(
                        volume(child) <= volume(node) * rounding + hidden,
                        "node {node} of model {g}"
                    );
                }
            }
        }
        let levels = 0..tree.subsets().depth() as u32;
        let volumes: Vec<f64> = levels
            .map(|k| tree.level_statistics(k).unwrap().volume)
            .collect();
        assert!(
            volumes.windows(2).all(|w| w[1] <= 2.0 * w[0] * rounding),
            "{volumes:?}"
        );
    }
    let row = cuboids(
        [1.0, 0.5, 0.25],
        (0..40).map(|i| Vec3::x() * (1.5 * f64::from(i))),
    );
    for grouping in GROUPINGS {
        for kind in [
            WrapperKind::Hull,
            WrapperKind::OrientedBox,
            WrapperKind::AlignedBox,
        ] {
            let tree = tree_of(&row, &options(grouping, kind, 0.0));
            let levels = 0..tree.subsets().depth() as u32;
            let volumes: Vec<f64> = levels
                .map(|k| tree.level_statistics(k).unwrap().volume)
                .collect();
            assert!(
                volumes.windows(2).all(|w| w[1] <= w[0] * rounding),
                "{volumes:?}"
            );
            let (whole, parts) = (volumes[0], volumes[volumes.len() - 1]);
            assert!((whole - 59.5 * 0.125).abs() <= 1e-12 * whole, "{whole}");
            assert!((parts - 40.0 * 0.125).abs() <= 1e-12 * parts, "{parts}");
        }
    }
}

#[test]
fn progress_rises_to_one_and_an_error_ends_the_build() {
    let large = builder(&scenes::bumpy_sphere(8100, 1));
    let crossing = builder(&scenes::lamps(7, 1));
    let small = builder(&scenes::robot_base());
    for (m, builder) in [&large, &crossing, &small].into_iter().enumerate() {
        for grouping in GROUPINGS {
            for threads in [1, 2] {
                let what = format!("model {m}, {grouping:?}, {threads} threads");
                let base = options(grouping, WrapperKind::AlignedBox, 0.0);
                let given = HierarchyOptions { threads, ..base };
                let mut heard: Vec<f64> = Vec::new();
                let hear = &mut |fraction| {
                    heard.push(fraction);
                    Ok(())
                };
                builder.build(&given, hear).unwrap();
                assert!(
                    heard.iter().all(|f| (0.0..=1.0).contains(f)),
                    "{what}: {heard:?}"
                );
                assert!(heard.is_sorted(), "{what}: {heard:?}");
                assert_eq!(heard.last(), Some(&1.0), "{what}");
                assert!(heard.len() >= 4, "{what}: {heard:?}");
                let calls = heard.len();
                for stop in [0, 1, calls / 2, calls * 2 / 3, calls - 1] {
                    let mut count = 0;
                    let outcome = builder.build(&given, &mut |_| {
                        count += 1;
                        if count == stop + 1 {
                            return Err(Error::new(
                                ErrorKind::Cancelled,
                                format!("stopped at {stop}"),
                            ));
                        }
                        assert!(count <= stop, "{what}: asked again after the error");
                        Ok(())
                    });
                    match outcome {
                        Err(error) => {
                            assert_eq!(error.kind, ErrorKind::Cancelled, "{what}");
                            assert_eq!(error.message, format!("stopped at {stop}"), "{what}");
                        }
                        // Two threads may tell less often than they did.
                        Ok(_) => assert!(
                            threads > 1 && count <= stop,
                            "{what}: the error at call {stop} is lost"
                        ),
                    }
                }
            }
        }
    }
    // The builder is as it was.
    assert!(
        tree_of(&small, &HierarchyOptions::default())
            == tree_of(
                &builder(&scenes::robot_base()),
                &HierarchyOptions::default()
            )
    );
}

/// What is built over given primitives is the body's tree.
#[test]
fn a_hierarchy_can_be_built_of_primitives_alone() {
    let body = built(&builder(&scenes::lamp()), &HierarchyOptions::default());
    let (tree, times) =
        build_hierarchy(body.primitives(), &HierarchyOptions::default(), &mut |_| {
            Ok(())
        })
        .unwrap();
    assert!(tree == *body.tree());
    assert!(
        [times.preparation, times.grouping, times.construction]
            .iter()
            .all(|t| *t >= 0.0)
    );
}

#[test]
fn large_hard_models_have_shallow_trees() {
    for (name, mesh) in [
        ("spaghetti", scenes::spaghetti(20_000, 1)),
        ("coincident", scenes::coincident(20_000)),
        ("floor and screws", scenes::floor_and_screws(20_000, 1)),
        ("nested shells", scenes::nested_shells(20_000)),
    ] {
        let builder = builder(&mesh);
        for grouping in GROUPINGS {
            let body = built(&builder, &options(grouping, WrapperKind::AlignedBox, 0.0));
            sound_and_shallow(&body, 0.0, &format!("{name}, {grouping:?}"));
        }
    }
}
