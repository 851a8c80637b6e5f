//! Statistics of a hierarchy, by which hierarchies are compared.

use super::subset_tree::{Node, SubsetTree};
use crate::boxes::Extent;
use crate::error::{Error, ErrorKind, Result};
use crate::hierarchy::wrapper::WrapperTree;

/// The cost of a primitive test relative to a node test, in the model of the expected cost. It is reported alone: nothing is
/// built by it.
const PRIMITIVE_COST: f64 = 4.0;

/// Size, shape and expected cost of a hierarchy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeStatistics {
    /// Number of nodes of the binary tree, leaves included.
    pub nodes: u64,
    /// Number of leaves.
    pub leaves: u64,
    /// Number of levels.
    pub depth: u64,
    /// Mean level of a leaf; the root's level is 0.
    pub mean_leaf_level: f64,
    /// Mean over interior nodes of eq. 2's Balance, with the diameters of the wrappers' boxes.
    pub balance: f64,
    /// Mean over interior nodes of eq. 2's Fill, with the diameters of the wrappers' boxes.
    pub fill: f64,
    /// Eq. 1 under a simple model: the mean number of tests for a random line through the root's box, a primitive test
    /// counting as four node tests. A node is tested if the line hits its parent's box; the probability of a hit is the
    /// ratio of that box's surface to the root's.
    pub expected_cost: f64,
    /// Number of nodes that hold a maximal convex piece.
    pub pieces: u64,
    /// Bytes of memory of the hierarchy.
    pub bytes: u64,
}

/// The nodes that cover a body at one level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LevelStatistics {
    /// Number of nodes of the level.
    pub nodes: u64,
    /// Number of leaves above the level.
    pub leaves_above: u64,
    /// Sum of the volumes of these nodes' wrappers.
    pub volume: f64,
    /// Sum of the surface areas of these nodes' wrappers.
    pub surface: f64,
}

/// The statistics of a tree, from the axis-aligned boxes of its nodes. The caller fills in pieces and bytes.
pub fn of_extents(subsets: &SubsetTree, extents: &[Extent]) -> TreeStatistics {
    let levels = subsets.levels();
    let root = extents[0].half_surface().max(f64::MIN_POSITIVE);
    let tiny = 1e-9 * extents[0].diameter().max(f64::MIN_POSITIVE);
    let (mut leaves, mut leaf_levels, mut interior) = (0u64, 0u64, 0u64);
    let (mut balance, mut fill, mut cost) = (0.0, 0.0, 1.0);
    for (i, node) in subsets.nodes.iter().enumerate() {
        let hit_probability = extents[i].half_surface() / root;
        match *node {
            Node::Leaf { .. } => {
                leaves += 1;
                leaf_levels += u64::from(levels[i]);
                cost += PRIMITIVE_COST * hit_probability;
            }
            Node::Interior { children } => {
                interior += 1;
                cost += 2.0 * hit_probability;
                let diameter = |i: usize| extents[i].diameter().max(tiny);
                let [a, b] = children.map(|child| diameter(child as usize));
                balance += (a / b).max(b / a);
                fill += diameter(i) / (a + b);
            }
        }
    }
    let mean = |sum: f64| {
        if interior > 0 {
            sum / interior as f64
        } else {
            1.0
        }
    };
    TreeStatistics {
        nodes: levels.len() as u64,
        leaves,
        depth: subsets.depth() as u64,
        mean_leaf_level: leaf_levels as f64 / leaves as f64,
        balance: mean(balance),
        fill: mean(fill),
        expected_cost: cost,
        pieces: 0,
        bytes: 0,
    }
}

impl WrapperTree {
    /// The statistics of the tree.
    pub fn statistics(&self) -> TreeStatistics {
        let extents: Vec<Extent> = (0..self.subsets.nodes.len() as u32)
            .map(|node| self.wrapper(node).extent())
            .collect();
        TreeStatistics {
            pieces: self.pieces.len() as u64,
            bytes: self.bytes() as u64,
            ..of_extents(&self.subsets, &extents)
        }
    }

    /// The statistics of a level, in time proportional to its nodes. Fails for a level the tree does not have.
    pub fn level_statistics(&self, level: u32) -> Result<LevelStatistics> {
        require_level(level, self.subsets.depth())?;
        let mut statistics = LevelStatistics::default();
        let levels = self.subsets.levels();
        for node in self.level(level) {
            let (volume, surface) = self.wrapper(node).volume_and_area();
            statistics.volume += volume;
            statistics.surface += surface;
            if levels[node as usize] == level {
                statistics.nodes += 1;
            } else {
                statistics.leaves_above += 1;
            }
        }
        Ok(statistics)
    }
}

/// Fails for a level that a tree of `depth` levels does not have.
pub fn require_level(level: u32, depth: usize) -> Result<()> {
    if (level as usize) < depth {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::NotFound,
        format!("the hierarchy has no level {level}; its {depth} levels count from 0"),
    ))
}
