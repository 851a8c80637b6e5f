//! Eligibility by nearness (§3.2.2): bodies whose boxes are within the gap limit, found through a spatial hash of their
//! centres.

use std::collections::{BTreeSet, HashMap};
use std::hash::{BuildHasherDefault, Hasher};

use super::cost::Cost;
use super::forest::Forest;
use super::greedy_clustering::{Eligibility, Limits};
use crate::boxes::Extent;
use crate::pose::Vec3;

/// If more bodies than this have their centres in the 27 voxels around a body, only its neighbours on a space-filling curve
/// are considered. The report's bound on eligible partners fails in such crowds: spaghetti, coincident polygons. A larger value
/// considers more partners, and takes longer.
const CROWD: u32 = 512;

/// How many neighbours before and after a body on the curve are considered in a crowd. More make better groups and take longer.
const WINDOW: usize = 24;

const NONE: u32 = u32::MAX;

/// The bodies whose centres lie in one voxel: the head of a linked list, and its length.
#[derive(Clone, Copy)]
struct Voxel {
    first: u32,
    count: u32,
}

/// Spatial hash of the active bodies, with voxels of edge DLimit + GLimit: partners are in neighbouring voxels.
pub struct Nearby {
    cost: Cost,
    gap_limit: f64,
    edge: f64,
    origin: Vec3,
    curve: MortonCurve,
    voxels: HashMap<u64, Voxel, BuildHasherDefault<KeyHasher>>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// The active bodies in curve order; present while some voxel is crowded.
    crowd: Option<BTreeSet<(u64, u32)>>,
}

impl Nearby {
    pub fn new(cost: Cost, bounds: &Extent) -> Self {
        Self {
            cost,
            gap_limit: 0.0,
            edge: 1.0,
            origin: bounds.low,
            curve: MortonCurve::new(bounds),
            voxels: HashMap::default(),
            next: Vec::new(),
            previous: Vec::new(),
            crowd: None,
        }
    }

    fn cell(&self, center: &Vec3) -> [i64; 3] {
        // The cast saturates. Distant voxels that share a key only add candidates, which `consider` rejects.
        let at = (center - self.origin) / self.edge;
        [at.x, at.y, at.z].map(|x| x.floor() as i64)
    }

    fn insert(&mut self, forest: &Forest, body: u32) {
        let center = forest.center(body);
        let voxel = self.voxels.entry(key(self.cell(&center))).or_insert(Voxel {
            first: NONE,
            count: 0,
        });
        self.next[body as usize] = voxel.first;
        self.previous[body as usize] = NONE;
        if voxel.first != NONE {
            self.previous[voxel.first as usize] = body;
        }
        voxel.first = body;
        voxel.count += 1;
        if let Some(crowd) = &mut self.crowd {
            crowd.insert((self.curve.code(&center), body));
        }
    }

    fn remove(&mut self, forest: &Forest, body: u32) {
        let center = forest.center(body);
        let (next, previous) = (self.next[body as usize], self.previous[body as usize]);
        if next != NONE {
            self.previous[next as usize] = previous;
        }
        let key = key(self.cell(&center));
        if let Some(voxel) = self.voxels.get_mut(&key) {
            voxel.count -= 1;
            if previous == NONE {
                voxel.first = next;
            }
        }
        if previous != NONE {
            self.next[previous as usize] = next;
        }
        if let Some(crowd) = &mut self.crowd {
            crowd.remove(&(self.curve.code(&center), body));
        }
    }
}

impl Eligibility for Nearby {
    fn begin(&mut self, forest: &Forest, active: &[u32], limits: &Limits) {
        self.gap_limit = limits.gap;
        // Finite for any limits, and large enough that neighbouring voxels differ in rounded coordinates.
        self.edge = (limits.diameter + limits.gap).clamp(f64::MIN_POSITIVE, 1e100);
        self.crowd = None;
        self.voxels.clear();
        self.next.clear();
        self.previous.clear();
        // Merging adds fewer bodies than there are active ones.
        let bodies = forest.extents.len() + active.len();
        self.next.resize(bodies, NONE);
        self.previous.resize(bodies, NONE);
        for &body in active {
            self.insert(forest, body);
        }
        if self.voxels.values().any(|voxel| voxel.count > CROWD / 8) {
            let along = active
                .iter()
                .map(|&body| (self.curve.code(&forest.center(body)), body));
            self.crowd = Some(along.collect());
        }
    }

    fn partner(&self, forest: &Forest, body: u32) -> Option<(f64, u32)> {
        let mut best = Best::new(self, forest, body);
        let [x, y, z] = self.cell(&best.center);
        let voxels = NEIGHBOURS.map(|[i, j, k]| {
            let cell = [x + i, y + j, z + k];
            self.voxels
                .get(&key(cell))
                .filter(|voxel| voxel.count > 0)
                .map(|voxel| (cell, *voxel))
        });
        if let Some(crowd) = &self.crowd {
            let around: u32 = voxels.iter().flatten().map(|(_, voxel)| voxel.count).sum();
            if around > CROWD {
                let place = (self.curve.code(&best.center), body);
                let after = crowd.range(place..).skip(1).take(WINDOW);
                let before = crowd.range(..place).rev().take(WINDOW);
                for &(_, other) in after.chain(before) {
                    best.consider(other);
                }
                return best.found;
            }
        }
        for (cell, voxel) in voxels.into_iter().flatten() {
            if self.distance(cell, &best.center) > best.largest {
                continue;
            }
            let mut other = voxel.first;
            while other != NONE {
                best.consider(other);
                other = self.next[other as usize];
            }
        }
        best.found
    }

    fn merged(&mut self, forest: &Forest, children: [u32; 2], parent: u32, active: bool) {
        for child in children {
            self.remove(forest, child);
        }
        if active {
            self.insert(forest, parent);
        }
    }
}

impl Nearby {
    /// A lower bound of the distance of a point from a voxel.
    fn distance(&self, cell: [i64; 3], point: &Vec3) -> f64 {
        let low = self.origin + Vec3::from(cell.map(|x| x as f64)) * self.edge;
        let high = low.add_scalar(self.edge);
        let apart = (low - point).sup(&(point - high)).sup(&Vec3::zeros());
        // Slack for the rounded bounds of the voxel.
        apart.norm() - 1e-9 * self.edge
    }
}

/// The cheapest partner found so far.
struct Best<'a> {
    index: &'a Nearby,
    forest: &'a Forest,
    body: u32,
    extent: Extent,
    center: Vec3,
    diameter: f64,
    found: Option<(f64, u32)>,
    /// Merged bodies of a larger diameter cannot be cheaper than `found`.
    largest: f64,
}

impl<'a> Best<'a> {
    fn new(index: &'a Nearby, forest: &'a Forest, body: u32) -> Self {
        Self {
            index,
            forest,
            body,
            extent: forest.extents[body as usize],
            center: forest.center(body),
            diameter: forest.diameters[body as usize],
            found: None,
            largest: f64::INFINITY,
        }
    }

    fn consider(&mut self, other: u32) {
        if other >= self.body {
            return;
        }
        let theirs = &self.forest.extents[other as usize];
        let merged = self.extent.union(theirs).diameter();
        if merged > self.largest || self.extent.gap(theirs) > self.index.gap_limit {
            return;
        }
        let diameters = [self.diameter, self.forest.diameters[other as usize]];
        let merged = merged.max(diameters[0]).max(diameters[1]);
        let cost = self.index.cost.of(merged, diameters);
        if self.found.is_none_or(|best| (cost, other) < best) {
            self.found = Some((cost, other));
            self.largest = self.index.cost.largest_diameter(cost);
        }
    }
}

/// A voxel and its 26 neighbours, itself first.
const NEIGHBOURS: [[i64; 3]; 27] = {
    let mut all = [[0; 3]; 27];
    let mut count = 1;
    let mut i = 0;
    while i < 27 {
        if i != 13 {
            all[count] = [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1];
            count += 1;
        }
        i += 1;
    }
    all
};

fn key(cell: [i64; 3]) -> u64 {
    let [x, y, z] = cell.map(|c| c as u64 & 0x1f_ffff);
    x | y << 21 | z << 42
}

/// Hashes voxel keys: one multiplication, its high and low halves combined by xor.
#[derive(Default)]
struct KeyHasher(u64);

impl Hasher for KeyHasher {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(self.0 ^ u64::from(byte));
        }
    }

    fn write_u64(&mut self, key: u64) {
        let product = u128::from(key ^ 0x243f_6a88_85a3_08d3) * 0x9e37_79b9_7f4a_7c15_u128;
        self.0 = (product as u64) ^ (product >> 64) as u64;
    }
}

/// A space-filling curve (Morton order) through a box.
pub struct MortonCurve {
    low: Vec3,
    scale: f64,
}

impl MortonCurve {
    pub fn new(bounds: &Extent) -> Self {
        let size = bounds.size().amax();
        Self {
            low: bounds.low,
            scale: if size > 0.0 {
                f64::from(1 << 21) / size
            } else {
                0.0
            },
        }
    }

    /// The position of a point along the curve.
    pub fn code(&self, point: &Vec3) -> u64 {
        let at = (point - self.low) * self.scale;
        spread(at.x) | spread(at.y) << 1 | spread(at.z) << 2
    }
}

/// Spreads the 21 bits of a coordinate, with two zero bits after each.
fn spread(coordinate: f64) -> u64 {
    let mut x = (coordinate.max(0.0) as u64).min(0x1f_ffff);
    x = (x | x << 32) & 0x001f_0000_0000_ffff;
    x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}
