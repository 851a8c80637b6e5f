//! OctoMap files: random trees written by a writer of our own are read as the cells that their leaves stand for, and no bytes
//! lead to a fault. The tests check overflows.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

use cstk::error::{Error, ErrorKind};
use cstk::octree::Octree;
use cstk::pose::Vec3;

use helpers::random::Random;

fn load(bytes: &[u8], min_occupancy: f64) -> Result<Octree, Error> {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("cstk-octree-{}-{number}", std::process::id());
    let path: PathBuf = std::env::temp_dir().join(name);
    std::fs::write(&path, bytes).unwrap();
    let octree = Octree::load(&path, min_occupancy);
    std::fs::remove_file(&path).unwrap();
    octree
}

/// A node of a tree: of a leaf its probability; children that are missing are not known.
enum Node {
    Leaf(f64),
    Inner(Vec<(usize, Node)>),
}

const RESOLUTION: f64 = 0.05;

impl Node {
    /// Narrow down to the level of cells, where it gets as deep as a file may.
    fn random(random: &mut Random, level: u32) -> Self {
        let may_end = level <= 6;
        if level == 0 || (may_end && random.below(3) == 0) {
            return Self::Leaf([0.1, 0.45, 0.55, 0.7, 0.9][random.below(5)]);
        }
        let mut children = Vec::new();
        for octant in 0..8 {
            let chance = if level > 4 { 6 } else { 3 };
            if random.below(chance) == 0 {
                children.push((octant, Self::random(random, level - 1)));
            }
        }
        match children.is_empty() {
            true => Self::Inner(vec![(3, Self::random(random, level - 1))]),
            false => Self::Inner(children),
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::Leaf(_) => 1,
            Self::Inner(children) => 1 + children.iter().map(|(_, c)| c.count()).sum::<usize>(),
        }
    }

    /// The corners and edges of the leaves at least as likely as this.
    fn occupied(&self, low: Vec3, level: u32, least: f64, to: &mut Vec<(Vec3, f64)>) {
        let edge = f64::from(1u32 << level) * RESOLUTION;
        match self {
            Self::Leaf(p) if *p >= least => to.push((low, edge)),
            Self::Leaf(_) => {}
            Self::Inner(children) => {
                for (octant, child) in children {
                    let at = |bit: usize| ((octant >> bit) & 1) as f64 * 0.5 * edge;
                    let low = low + Vec3::new(at(0), at(1), at(2));
                    child.occupied(low, level - 1, least, to);
                }
            }
        }
    }

    /// Two bits for each child: 01 free, 10 occupied, 11 inner, from the lowest on.
    fn write_binary(&self, bytes: &mut Vec<u8>) {
        let Self::Inner(children) = self else { return };
        let mut bits = 0u16;
        for (octant, child) in children {
            let code = match child {
                Self::Leaf(p) if *p < 0.5 => 1,
                Self::Leaf(_) => 2,
                Self::Inner(_) => 3,
            };
            bits |= code << (2 * octant);
        }
        bytes.extend(bits.to_le_bytes());
        children
            .iter()
            .for_each(|(_, child)| child.write_binary(bytes));
    }

    fn write_full(&self, colour: &[u8], bytes: &mut Vec<u8>) {
        let (p, children) = match self {
            Self::Leaf(p) => (*p, &[][..]),
            Self::Inner(children) => (0.97, &children[..]),
        };
        bytes.extend(((p / (1.0 - p)).ln() as f32).to_le_bytes());
        bytes.extend(colour);
        bytes.push(children.iter().map(|(octant, _)| 1 << octant).sum());
        children
            .iter()
            .for_each(|(_, child)| child.write_full(colour, bytes));
    }

    fn file(&self, first: &str, id: &str, body: &[u8]) -> Vec<u8> {
        let count = self.count();
        let head =
            format!("{first}\n# a comment\n#\nid {id}\nsize {count}\nres {RESOLUTION}\ndata\n");
        [head.as_bytes(), body].concat()
    }

    fn bt(&self) -> Vec<u8> {
        let mut body = Vec::new();
        self.write_binary(&mut body);
        self.file(BINARY, "OcTree", &body)
    }

    fn ot(&self, id: &str, colour: &[u8]) -> Vec<u8> {
        let mut body = Vec::new();
        self.write_full(colour, &mut body);
        self.file("# Octomap OcTree file", id, &body)
    }
}

const BINARY: &str = "# Octomap OcTree binary file";

fn is_same(octree: &Octree, leaves: &[(Vec3, f64)]) {
    assert_eq!(octree.resolution(), RESOLUTION);
    let volume = |edge: f64| (edge / RESOLUTION).round().powi(3);
    let cells: f64 = leaves.iter().map(|leaf| volume(leaf.1)).sum();
    assert_eq!(octree.cell_count() as f64, cells);
    // Leaves do not overlap: with as many cells, and the corners and the middle of each leaf occupied, both are the same.
    let at = |(low, edge): &(Vec3, f64), i: usize| {
        let share = |axis: usize| match (i, (i >> axis) & 1) {
            (8, _) => 0.5 * edge - 0.25 * RESOLUTION,
            (_, 0) => 0.5 * RESOLUTION,
            _ => edge - 0.5 * RESOLUTION,
        };
        low + Vec3::new(share(0), share(1), share(2))
    };
    let points = leaves
        .iter()
        .flat_map(|leaf| (0..9).map(move |i| at(leaf, i)));
    let points: Vec<Vec3> = points.collect();
    let occupied = octree.are_occupied(&points).unwrap();
    assert!(occupied.iter().all(|is| *is));
}

#[test]
fn random_trees_of_both_sorts() {
    let mut random = Random::new(41);
    let low = Vec3::repeat(-32768.0 * RESOLUTION);
    for _ in 0..12 {
        let tree = Node::random(&mut random, 16);
        for least in [0.5, 0.6, 0.3] {
            let mut leaves = Vec::new();
            tree.occupied(low, 16, least, &mut leaves);
            for (id, colour) in [
                ("OcTree", &[][..]),
                ("OcTreeStamped", &[]),
                ("ColorOcTree", &[1, 2, 3]),
            ] {
                is_same(&load(&tree.ot(id, colour), least).unwrap(), &leaves);
            }
            if least == 0.5 {
                is_same(&load(&tree.bt(), 0.9).unwrap(), &leaves);
            }
        }
    }
}

/// Eight leaves that are all occupied are one cube.
#[test]
fn full_cubes_are_merged() {
    let eight = |level| (0..8).map(|octant| (octant, level)).collect::<Vec<_>>();
    let cells = || {
        Node::Inner(
            eight(0)
                .into_iter()
                .map(|(o, _)| (o, Node::Leaf(0.9)))
                .collect(),
        )
    };
    let mut tree = Node::Inner(eight(0).into_iter().map(|(o, _)| (o, cells())).collect());
    for _ in 0..14 {
        tree = Node::Inner(vec![(7, tree)]);
    }
    for bytes in [tree.bt(), tree.ot("OcTree", &[])] {
        let octree = load(&bytes, 0.5).unwrap();
        assert_eq!((octree.cubes().len(), octree.cell_count()), (1, 64));
        let corner = 32764.0 * RESOLUTION;
        assert!((octree.cubes()[0].0 - Vec3::repeat(corner)).amax() < 1e-9);
    }
}

#[test]
fn what_octomap_files_may_not_say() {
    let tree = Node::random(&mut Random::new(6), 16);
    let refused = |bytes: &[u8], kind: ErrorKind, culprit: &str| {
        let error = load(bytes, 0.5).unwrap_err();
        assert!(
            error.kind == kind && error.message.contains(culprit),
            "{error}: not {culprit}"
        );
    };
    let (bt, ot) = (tree.bt(), tree.ot("OcTree", &[]));
    for bytes in [&bt, &ot] {
        refused(&bytes[..bytes.len() - 1], ErrorKind::Parse, "truncated");
        refused(
            &[&bytes[..], &[0]].concat(),
            ErrorKind::Parse,
            "after the last node",
        );
        refused(&bytes[..60], ErrorKind::Parse, "data");
        let swap = |old: &str, new: &str| {
            let at = bytes
                .windows(old.len())
                .position(|w| w == old.as_bytes())
                .unwrap();
            [&bytes[..at], new.as_bytes(), &bytes[at + old.len()..]].concat()
        };
        refused(
            &swap("# Octomap", "# Actomap"),
            ErrorKind::Parse,
            "first line",
        );
        refused(
            &swap("id OcTree", "id Forest"),
            ErrorKind::Unsupported,
            "Forest",
        );
        refused(&swap("id OcTree\n", ""), ErrorKind::Parse, "\"id\"");
        refused(
            &swap("size ", "size 1"),
            ErrorKind::Parse,
            "the header says",
        );
        refused(&swap("size ", "size -"), ErrorKind::Parse, "line 5");
        refused(&swap("res 0.05", "res x"), ErrorKind::Parse, "line 6");
        refused(
            &swap("res 0.05", "res 0"),
            ErrorKind::InvalidArgument,
            "resolution",
        );
        refused(
            &swap("res 0.05", "res nan"),
            ErrorKind::NotFinite,
            "resolution",
        );
        refused(&swap("res 0.05", "rest 5"), ErrorKind::Parse, "line 6");
        for p in [0.0, 1.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(load(bytes, p).unwrap_err().kind, ErrorKind::InvalidArgument);
        }
    }
    // Deeper than 16 levels.
    let head = |first: &str| format!("{first}\nid OcTree\nsize 99\nres 1\ndata\n").into_bytes();
    let deep = [head(BINARY), [3, 0].repeat(1 << 16)].concat();
    refused(&deep, ErrorKind::Parse, "16 levels");
    let deep = [
        head("# Octomap OcTree file"),
        [0, 0, 0, 0, 1].repeat(1 << 16),
    ]
    .concat();
    refused(&deep, ErrorKind::Parse, "16 levels");
    let nan = [head("# Octomap OcTree file"), vec![0, 0, 0xC0, 0x7F, 0]].concat();
    refused(&nan, ErrorKind::NotFinite, "node 1");
    let empty = format!("{BINARY}\nid OcTree\nsize 0\nres 1\ndata\n");
    assert_eq!(load(empty.as_bytes(), 0.5).unwrap().cell_count(), 0);
}

#[test]
fn no_damage_leads_to_a_fault() {
    let mut random = Random::new(12);
    let tree = Node::random(&mut random, 16);
    let files = [tree.bt(), tree.ot("ColorOcTree", &[5, 6, 7])];
    for round in 0..4000 {
        let mut bytes = files[round % 2].clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(bytes.len());
            match random.below(3) {
                0 => bytes[at] = random.next_bits() as u8,
                1 => bytes.truncate(at.max(1)),
                _ => bytes.insert(at, bytes[at]),
            }
        }
        let _ = load(&bytes, 0.5);
    }
}
