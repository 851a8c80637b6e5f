//! Which cells of a grid are occupied: an octree whose full cubes are leaves.

use crate::error::{Error, ErrorKind, Result};

/// The levels of the octree: level 0 are the cells, level 16 is the whole grid. As many as OctoMap has.
pub const LEVELS: u32 = 16;

/// The cells along an edge of the grid.
pub const GRID: u32 = 1 << LEVELS;

/// The most inner nodes. They take 0.5 GB.
const MAX_NODES: usize = 1 << 24;

/// A cube of cells, aligned to its own size: all of them occupied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cube {
    /// Its lowest cell, each coordinate below 2^16.
    pub low: [u32; 3],
    /// It has 2^level cells along an edge.
    pub level: u32,
}

/// What a node's child holds: nothing, everything, or the node with this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Child(u32);

impl Child {
    const EMPTY: Self = Self(u32::MAX);
    const FULL: Self = Self(u32::MAX - 1);

    fn node(self) -> Option<usize> {
        (self != Self::EMPTY && self != Self::FULL).then_some(self.0 as usize)
    }
}

/// The occupied cells. A cube whose cells are all occupied is one leaf, whatever the order of the changes: equal sets of
/// cells have equal cubes.
#[derive(Clone, Debug)]
pub struct Cells {
    root: Child,
    nodes: Vec<[Child; 8]>,
    /// The numbers of unused nodes.
    free: Vec<u32>,
    count: u64,
}

impl Default for Cells {
    fn default() -> Self {
        Self {
            root: Child::EMPTY,
            nodes: Vec::new(),
            free: Vec::new(),
            count: 0,
        }
    }
}

/// Which child of a cube of this level a cell lies in: bit 0 is the upper half in x, bit 1 in y, bit 2 in z.
fn octant(cell: [u32; 3], level: u32) -> usize {
    let bit = |axis: usize| ((cell[axis] >> (level - 1)) & 1) as usize;
    bit(0) | bit(1) << 1 | bit(2) << 2
}

impl Cube {
    /// The cube of a level around a cell.
    pub fn around(cell: [u32; 3], level: u32) -> Self {
        let low = cell.map(|c| (c >> level) << level);
        Self { low, level }
    }

    /// Its child in an octant.
    pub fn child(self, octant: usize) -> Self {
        let level = self.level - 1;
        let low = [0, 1, 2].map(|axis| self.low[axis] + (((octant >> axis) as u32 & 1) << level));
        Self { low, level }
    }

    /// The cells along an edge.
    pub fn edge(self) -> u32 {
        1 << self.level
    }

    /// Whether it holds another cube.
    pub fn holds(self, other: Self) -> bool {
        self.level >= other.level && Self::around(other.low, self.level) == self
    }
}

impl Cells {
    /// The number of occupied cells.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Whether a cell is occupied.
    pub fn get(&self, cell: [u32; 3]) -> bool {
        self.leaf(cell).1
    }

    /// The level of the largest cube around a cell that is all occupied or all empty, and which of both.
    pub fn leaf(&self, cell: [u32; 3]) -> (u32, bool) {
        let (mut child, mut level) = (self.root, LEVELS);
        while let Some(node) = child.node() {
            child = self.nodes[node][octant(cell, level)];
            level -= 1;
        }
        (level, child == Child::FULL)
    }

    /// Makes a cell occupied or empty. Returns whether it changed.
    pub fn set(&mut self, cell: [u32; 3], is_occupied: bool) -> Result<bool> {
        let cube = Cube {
            low: cell,
            level: 0,
        };
        if self.get(cell) == is_occupied {
            return Ok(false);
        }
        self.set_cube(cube, is_occupied)?;
        Ok(true)
    }

    /// Makes the cells of a cube occupied or empty.
    pub fn set_cube(&mut self, cube: Cube, is_occupied: bool) -> Result<()> {
        // A node may be needed at each level on the way.
        if self.nodes.len() - self.free.len() + LEVELS as usize > MAX_NODES {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("the octree has {MAX_NODES} nodes; no more are possible"),
            ));
        }
        self.put_cube(cube, is_occupied);
        Ok(())
    }

    /// As [`Cells::set_cube`], whatever the number of nodes: takes back changes that succeeded.
    pub fn put_cube(&mut self, cube: Cube, is_occupied: bool) {
        self.root = self.with_cube(self.root, LEVELS, cube, is_occupied);
    }

    /// What becomes of a child of this level. The depth of the recursion is that of the octree.
    fn with_cube(&mut self, child: Child, level: u32, cube: Cube, is_occupied: bool) -> Child {
        let whole = match is_occupied {
            true => Child::FULL,
            false => Child::EMPTY,
        };
        if child == whole {
            return whole;
        }
        if level == cube.level {
            self.count -= self.volume(child, level);
            self.release(child);
            self.count += if is_occupied { 1 << (3 * level) } else { 0 };
            return whole;
        }
        let node = match child.node() {
            Some(node) => node,
            None => self.new_node(child),
        };
        let i = octant(cube.low, level);
        let changed = self.with_cube(self.nodes[node][i], level - 1, cube, is_occupied);
        self.nodes[node][i] = changed;
        if self.nodes[node] == [whole; 8] {
            self.free.push(node as u32);
            return whole;
        }
        Child(node as u32)
    }

    /// The number of occupied cells of a child of this level.
    fn volume(&self, child: Child, level: u32) -> u64 {
        match child.node() {
            None if child == Child::FULL => 1 << (3 * level),
            None => 0,
            Some(node) => {
                let children = self.nodes[node].iter();
                children.map(|&child| self.volume(child, level - 1)).sum()
            }
        }
    }

    fn new_node(&mut self, content: Child) -> usize {
        match self.free.pop() {
            Some(node) => {
                self.nodes[node as usize] = [content; 8];
                node as usize
            }
            None => {
                self.nodes.push([content; 8]);
                self.nodes.len() - 1
            }
        }
    }

    fn release(&mut self, child: Child) {
        if let Some(node) = child.node() {
            for child in self.nodes[node] {
                self.release(child);
            }
            self.free.push(node as u32);
        }
    }

    /// Visits what is occupied within a cube, in the order of the octants: the largest full cubes, clipped to it. Below
    /// `last` levels are not parted: a cube of that level is visited if any of its cells is occupied.
    pub fn visit(&self, within: Cube, last: u32, visit: &mut dyn FnMut(Cube)) {
        let (mut child, mut level) = (self.root, LEVELS);
        while level > within.level
            && let Some(node) = child.node()
        {
            child = self.nodes[node][octant(within.low, level)];
            level -= 1;
        }
        self.visit_child(child, within, last, visit);
    }

    fn visit_child(&self, child: Child, cube: Cube, last: u32, visit: &mut dyn FnMut(Cube)) {
        match child.node() {
            None if child == Child::FULL => visit(cube),
            None => {}
            Some(_) if cube.level <= last => visit(cube),
            Some(node) => {
                for (i, &child) in self.nodes[node].iter().enumerate() {
                    self.visit_child(child, cube.child(i), last, visit);
                }
            }
        }
    }
}

/// The whole grid.
pub const WHOLE: Cube = Cube {
    low: [0; 3],
    level: LEVELS,
};
