//! The tree over boxes that come, move and go: whatever was done to it, each box of a node stands around all that is below.

use std::collections::BTreeSet;

use cstk::boxes::{Extent, PackedBox};
use cstk::environment::box_tree::{BOX, BoxTree, BoxTreeChanges, Boxes, OrientedBox};
use cstk::index_set::IndexSet;
use cstk::pose::{Mat3, Vec3};

use helpers::random::Random;
use helpers::shapes::box_corners;

/// Boxes by their places, and which of them are in the tree.
#[derive(Clone)]
struct Set {
    boxes: Vec<OrientedBox>,
    held: BTreeSet<usize>,
}

impl Boxes for Set {
    fn extent(&self, place: usize) -> Extent {
        Extent::of(&corners(&self.boxes[place]))
    }

    fn oriented(&self, place: usize) -> OrientedBox {
        self.boxes[place]
    }
}

fn corners(given: &OrientedBox) -> [Vec3; 8] {
    let [x, y] = given.axes;
    let axes = Mat3::from_columns(&[x, y, x.cross(&y)]);
    let local = box_corners((2.0 * given.half).into());
    std::array::from_fn(|i| given.center + axes * local[i])
}

fn random_box(random: &mut Random, center: Vec3, size: f64) -> OrientedBox {
    let axes = random.rotation();
    // Orthonormal to within what boxes may be.
    let off = random.within(-1.0, 1.0) / 8192.0;
    let (x, y) = (axes.column(0).into_owned(), axes.column(1).into_owned());
    OrientedBox {
        center,
        axes: [x, y + x * off],
        half: Vec3::new(size, size * random.within(0.1, 1.0), size * 0.1) * 0.5,
    }
}

/// What was found below a node.
#[derive(Default)]
struct Below {
    places: Vec<usize>,
    surface: f64,
    depth: usize,
}

/// Walks all of a tree and checks every box by the corners below it.
fn check(tree: &BoxTree, name: u32, set: &Set, is_root: bool) -> Below {
    let (node, frame) = (tree.node(name), tree.frame());
    let mut found = Below::default();
    let children = node.wide.children();
    assert!(is_root || children.len() >= 2);
    for (lane, &child) in children.iter().enumerate() {
        let below = match child & BOX {
            0 => check(tree, child, set, false),
            _ => Below {
                places: vec![(child & !BOX) as usize],
                ..Below::default()
            },
        };
        for &place in &below.places {
            for corner in &corners(&set.boxes[place]) {
                assert_holds(
                    &node.wide.get(lane),
                    &((corner - frame.center) / frame.scale),
                );
            }
        }
        found.places.extend(below.places);
        found.surface += below.surface;
        found.depth = found.depth.max(below.depth + 1);
    }
    let corners = found.places.iter().flat_map(|&i| corners(&set.boxes[i]));
    found.surface += Extent::of(&corners.collect::<Vec<_>>()).half_surface();
    found
}

/// In both meanings of a box.
fn assert_holds(given: &PackedBox, point: &Vec3) {
    let wide = |v: &[f32; 3]| Vec3::new(v[0].into(), v[1].into(), v[2].into());
    let axes = Mat3::from_columns(&given.axes.map(|axis| wide(&axis)));
    let from_center = point - wide(&given.center);
    let half = wide(&given.half);
    let along = axes.tr_mul(&from_center);
    let places = axes.try_inverse().unwrap() * from_center;
    for k in 0..3 {
        let most = half[k] + 1e-12;
        assert!(along[k].abs() <= most && places[k].abs() <= most);
    }
}

fn check_all(tree: &BoxTree, set: &Set) -> usize {
    let Some(root) = tree.root() else {
        assert!(set.held.is_empty());
        return 0;
    };
    let found = check(tree, root, set, true);
    let mut places = found.places;
    places.sort_unstable();
    assert!(places.iter().eq(&set.held), "{places:?} {:?}", set.held);
    let corners = places.iter().flat_map(|&i| corners(&set.boxes[i]));
    let root = Extent::of(&corners.collect::<Vec<_>>());
    assert_eq!(tree.extent(), Some(&root));
    let below = found.surface - root.half_surface();
    assert!((tree.surface() - below).abs() <= 1e-9 * found.surface);
    found.depth
}

fn built(set: &Set) -> BoxTree {
    let taken: Vec<u32> = set.held.iter().map(|&place| place as u32).collect();
    BoxTree::new(&taken, set.boxes.len(), set)
}

#[test]
fn boxes_stand_around_all_that_is_below() {
    let mut random = Random::new(1);
    for case in 0..24 {
        let half = [1.0, 1e-3, 1e5][case % 3];
        let size = half * [0.1, 1e-4, 2.0][case / 3 % 3];
        let count = 1 + random.below(100);
        let away = random.point(10.0 * half);
        let place = |random: &mut Random| {
            let center = away + random.point(half);
            random_box(random, center, size)
        };
        let mut set = Set {
            boxes: (0..count).map(|_| place(&mut random)).collect(),
            held: (0..count).collect(),
        };
        let mut tree = built(&set);
        check_all(&tree, &set);
        let mut kept = Vec::new();
        for step in 0..600 {
            let index = random.below(set.boxes.len());
            if step % 97 == 0 {
                kept.push((tree.clone(), set.clone()));
            }
            // Now more come, now more go, at times all.
            let going = step % 200 > 120;
            if !set.held.contains(&index) || (!going && random.below(3) == 0) {
                set.boxes.push(place(&mut random));
                let index = set.boxes.len() - 1;
                set.held.insert(index);
                BoxTreeChanges {
                    tree: &mut tree,
                    boxes: &set,
                }
                .insert(index);
            } else if going {
                set.held.remove(&index);
                let mut changes = BoxTreeChanges {
                    tree: &mut tree,
                    boxes: &set,
                };
                changes.remove(index);
                assert!(!tree.holds(index));
            } else {
                // One, some or all, by little or to anywhere.
                let held: Vec<usize> = set.held.iter().copied().collect();
                let count = [1, 1 + random.below(held.len()), held.len()][random.below(3)];
                let mut moved = IndexSet::new(set.boxes.len());
                for _ in 0..count {
                    moved.insert(held[random.below(held.len())]);
                }
                let near = random.below(3) > 0;
                for index in moved.iter() {
                    let center = if near {
                        set.boxes[index].center + random.point(0.1 * size)
                    } else {
                        away + random.point(half)
                    };
                    set.boxes[index] = random_box(&mut random, center, size);
                }
                let mut changes = BoxTreeChanges {
                    tree: &mut tree,
                    boxes: &set,
                };
                if count == 1 && !near {
                    for index in moved.iter() {
                        changes.remove(index);
                        changes.insert(index);
                    }
                } else {
                    changes.refit(&moved);
                }
            }
            if step % 61 == 60 {
                let held: Vec<u32> = set.held.iter().map(|&place| place as u32).collect();
                let ball = (Vec3::zeros(), 100.0 * half);
                tree.rebuild_in_haste(&held, set.boxes.len(), &set, ball);
            }
            if step % 7 == 0 || step % 61 == 60 {
                check_all(&tree, &set);
            }
        }
        for (tree, set) in &kept {
            check_all(tree, set);
        }
        for index in std::mem::take(&mut set.held) {
            BoxTreeChanges {
                tree: &mut tree,
                boxes: &set,
            }
            .remove(index);
        }
        check_all(&tree, &set);
        assert_eq!(tree.surface(), 0.0);
    }
}

/// Two trees take turns, as the states of an environment do: the one before becomes the next.
#[test]
fn a_tree_that_follows_another_is_equal_to_it() {
    let mut random = Random::new(3);
    let place = |random: &mut Random| {
        let center = random.point(1.0);
        random_box(random, center, 0.1)
    };
    let mut set = Set {
        boxes: (0..200).map(|_| place(&mut random)).collect(),
        held: (0..200).collect(),
    };
    let mut now = built(&set);
    let mut before = now.clone();
    let mut kept = Vec::new();
    for step in 0..300 {
        before.follow(&now);
        check_all(&before, &set);
        std::mem::swap(&mut before, &mut now);
        if step % 23 == 0 {
            kept.push((now.clone(), set.clone()));
        }
        if step % 50 == 49 {
            now = built(&set);
        }
        if step % 7 == 3 {
            let held: Vec<u32> = set.held.iter().map(|&place| place as u32).collect();
            now.rebuild_in_haste(&held, set.boxes.len(), &set, (Vec3::zeros(), 10.0));
        }
        let mut moved = IndexSet::new(set.boxes.len());
        for _ in 0..random.below(30) {
            let index = random.below(set.boxes.len());
            set.boxes[index] = place(&mut random);
            moved.insert(index);
        }
        let added = place(&mut random);
        set.boxes.push(added);
        set.held.insert(set.boxes.len() - 1);
        let mut changes = BoxTreeChanges {
            tree: &mut now,
            boxes: &set,
        };
        changes.refit(&moved);
        changes.insert(set.boxes.len() - 1);
        // What goes is taken out before its box changes, as an object that moves while it is not in the world.
        let gone = random.below(set.boxes.len());
        if set.held.contains(&gone) {
            changes.remove(gone);
            set.held.remove(&gone);
        }
    }
    for (tree, set) in &kept {
        check_all(tree, set);
    }
}

/// Boxes that come in the worst order do not make the tree deep: it grows by a level when the root is split, and each node
/// of a split has three children or more.
#[test]
fn rows_of_boxes_make_no_deep_tree() {
    let mut random = Random::new(2);
    let count = 3000;
    let along: [fn(f64) -> Vec3; 3] = [
        |x| Vec3::new(x, 0.0, 0.0),
        |x| Vec3::new(x, x * x * 1e-3, -x),
        |_| Vec3::zeros(),
    ];
    for line in along {
        let mut set = Set {
            boxes: (0..count)
                .map(|i| random_box(&mut random, line(0.01 * f64::from(i)), 0.02))
                .collect(),
            held: [0, count as usize - 1].into(),
        };
        let mut tree = built(&set);
        for index in 1..count as usize - 1 {
            set.held.insert(index);
            BoxTreeChanges {
                tree: &mut tree,
                boxes: &set,
            }
            .insert(index);
        }
        let depth = check_all(&tree, &set);
        // Three to the eighth are more.
        assert!(depth <= 9, "{depth}");
    }
}
