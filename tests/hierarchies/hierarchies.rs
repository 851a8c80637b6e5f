//! Hierarchies, however they are built: sound and shallow trees, wrappers that leave nothing out, the same tree on any
//! number of threads, and progress.

use std::collections::{HashMap, HashSet};

use cstk::body::Body;
use cstk::boxes::Extent;
use cstk::error::{Error, ErrorKind};
use cstk::gjk::{DistanceLimits, PointCloud, gjk};
use cstk::hierarchy::{HierarchyOptions, Node, WrapperKind, build_hierarchy};
use cstk::pose::Vec3;
use cstk_scenes as scenes;

use helpers::containment::{in_hull, in_sphere};
use helpers::models::{GROUPINGS, KINDS, builder, built, mixed_primitives, options};
use helpers::random::Random;
use helpers::trees::{held, models, tree_of};

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
            for p in body.primitives().get(primitive as usize).vertices {
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
                        DistanceLimits::EXACT
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
                assert_eq!(body.primitives().get(f).vertices, given);
            }
            // A leaf bounds the primitive it names, and nothing else.
            for node in 0..body.tree().subsets().nodes.len() as u32 {
                if let Node::Leaf { primitive } = body.tree().node(node) {
                    let own = Extent::of(body.primitives().get(primitive as usize).vertices);
                    assert_eq!(body.tree().wrapper(node).extent(), own);
                }
            }
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
    let built = build_hierarchy(body.primitives(), &HierarchyOptions::default(), &mut |_| {
        Ok(())
    })
    .unwrap();
    let times = built.times;
    assert!(built.wrappers.tree(body.primitives()) == body.tree());
    assert!(built.packed == *body.packed());
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
