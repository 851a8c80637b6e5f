//! Eligibility by adjacency (§3.2.5): bodies may merge if they own edges of one family, which are edges at the same place.

use foldhash::{HashMap, HashMapExt};

use super::cost::Cost;
use super::forest::Forest;
use super::greedy_clustering::{Eligibility, Limits};
use crate::pose::Vec3;

/// The largest ratio of the diameters of two bodies that merge here. Smaller bodies are left to the basic algorithm, which
/// merges them among themselves; otherwise a plate would take in its thousands of rivets one by one.
const LARGEST_BALANCE: f64 = 4.0;

/// Which bodies are adjacent. The relation is given between leaves, and parents inherit it from their children. It may be
/// any relation; shared edges are one.
pub struct Adjacent {
    cost: Cost,
    /// The bodies adjacent to each body when it was created; after merges their owners replace them.
    neighbours: Vec<Vec<u32>>,
    /// Union-find links to the parentless body that contains each body.
    owners: Vec<u32>,
    active: Vec<bool>,
}

impl Adjacent {
    /// Builds the relation from pairs of adjacent leaves.
    pub fn new(cost: Cost, leaves: usize, siblings: &[[u32; 2]]) -> Self {
        let mut neighbours = vec![Vec::new(); leaves];
        for &[a, b] in siblings {
            neighbours[a as usize].push(b);
            neighbours[b as usize].push(a);
        }
        Self {
            cost,
            neighbours,
            owners: (0..leaves as u32).collect(),
            active: vec![false; leaves],
        }
    }

    fn owner(&self, mut body: u32) -> u32 {
        while self.owners[body as usize] != body {
            body = self.owners[body as usize];
        }
        body
    }

    /// The owner, with path compression.
    fn find(&mut self, body: u32) -> u32 {
        let owner = self.owner(body);
        let mut at = body;
        while self.owners[at as usize] != owner {
            at = std::mem::replace(&mut self.owners[at as usize], owner);
        }
        owner
    }

    /// The owners of a body's neighbours, each once.
    fn resolve(&mut self, body: u32, list: Vec<u32>) -> Vec<u32> {
        let mut list: Vec<u32> = list.into_iter().map(|other| self.find(other)).collect();
        list.sort_unstable();
        list.dedup();
        list.retain(|&other| other != body);
        list
    }
}

impl Eligibility for Adjacent {
    fn begin(&mut self, _forest: &Forest, active: &[u32], _limits: &Limits) {
        self.active.fill(false);
        for &body in active {
            self.active[body as usize] = true;
            let list = std::mem::take(&mut self.neighbours[body as usize]);
            self.neighbours[body as usize] = self.resolve(body, list);
        }
    }

    fn partner(&self, forest: &Forest, body: u32) -> Option<(f64, u32)> {
        let extent = &forest.extents[body as usize];
        let mut best: Option<(f64, u32)> = None;
        for &other in &self.neighbours[body as usize] {
            let other = self.owner(other);
            if other >= body || !self.active[other as usize] {
                continue;
            }
            let diameters = [body, other].map(|i| forest.diameters[i as usize]);
            if diameters[0] > LARGEST_BALANCE * diameters[1]
                || diameters[1] > LARGEST_BALANCE * diameters[0]
            {
                continue;
            }
            let merged = extent.union(&forest.extents[other as usize]).diameter();
            let merged = merged.max(diameters[0]).max(diameters[1]);
            let cost = self.cost.of(merged, diameters);
            if best.is_none_or(|best| (cost, other) < best) {
                best = Some((cost, other));
            }
        }
        best
    }

    fn merged(&mut self, _forest: &Forest, children: [u32; 2], parent: u32, active: bool) {
        self.owners.push(parent);
        self.active.push(active);
        let mut list = Vec::new();
        for child in children {
            self.owners[child as usize] = parent;
            self.active[child as usize] = false;
            list.append(&mut self.neighbours[child as usize]);
        }
        let list = self.resolve(parent, list);
        self.neighbours.push(list);
    }
}

/// The pairs of parts that share an edge: both ends have the same coordinates. If many parts share an edge, each is paired
/// with the next only. `edges` visits the edges of a part.
pub fn sibling_pairs(
    parts: impl Iterator<Item = u32>,
    edges: impl Fn(u32, &mut dyn FnMut([Vec3; 2])),
) -> Vec<[u32; 2]> {
    let mut vertices: HashMap<[u64; 3], u32> = HashMap::new();
    let mut families: Vec<([u32; 2], u32)> = Vec::new();
    for (index, part) in parts.enumerate() {
        edges(part, &mut |ends| {
            let [a, b] = ends.map(|p| {
                // Adding 0 makes -0 the same as 0.
                let key = [p.x, p.y, p.z].map(|x| (x + 0.0).to_bits());
                let next = vertices.len() as u32;
                *vertices.entry(key).or_insert(next)
            });
            if a != b {
                families.push(([a.min(b), a.max(b)], index as u32));
            }
        });
    }
    families.sort_unstable();
    families.dedup();
    let mut pairs: Vec<[u32; 2]> = families
        .windows(2)
        .filter(|w| w[0].0 == w[1].0)
        .map(|w| [w[0].1, w[1].1])
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
