//! Levels, covers and statistics of hierarchies.

use cstk::body::BodyBuilder;
use cstk::error::ErrorKind;
use cstk::hierarchy::wrapper::WrapperTree;
use cstk::hierarchy::{HierarchyOptions, Node, WrapperKind};
use cstk::pose::Vec3;
use cstk_scenes as scenes;

use helpers::models::{GROUPINGS, KINDS, builder, built, mixed_primitives, options, squares};
use helpers::shapes::box_corners;
use helpers::trees::{Held, held, models, tree_of};

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
