//! Models of all sorts for hierarchies, and what their trees hold.

use cstk::body::BodyBuilder;
use cstk::hierarchy::wrapper::WrapperTree;
use cstk::hierarchy::{HierarchyOptions, Node};
use cstk_scenes as scenes;

use super::models::{builder, built, mixed_primitives, squares};

/// The models, and whether they are small enough for every combination of options.
pub fn models() -> Vec<(&'static str, BodyBuilder, bool)> {
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
pub struct Held {
    pub leaves: std::ops::Range<usize>,
    pub level: usize,
}

/// What each node holds, and the primitives of the leaves in order; found by walking from the root, which must meet
/// every node once.
pub fn held(tree: &WrapperTree) -> (Vec<Held>, Vec<u32>) {
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

pub fn tree_of(builder: &BodyBuilder, options: &HierarchyOptions) -> WrapperTree {
    built(builder, options).tree().clone()
}
