//! Bottom-up clustering (§3.2.2, §3.2.5): repeatedly merges the cheapest eligible pair of parentless bodies.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::forest::Forest;
use crate::error::Result;
use crate::hierarchy::{Progress, parallel};

/// The most levels that a body may grow in one round. Without this, bodies whose merging hardly changes the diameter (nested
/// shells, a hub with thousands of spikes) form one long chain.
const GROWTH_LIMIT: u8 = 4;

/// The report's DLimit and GLimit: the largest diameter of a body that may merge, and the largest gap to its partner.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    pub diameter: f64,
    pub gap: f64,
}

/// The rule for which bodies may merge. A lower index means an older body.
pub trait Eligibility: Sync {
    /// Starts a round among the active bodies.
    fn begin(&mut self, forest: &Forest, active: &[u32], limits: &Limits);

    /// The cheapest active partner among older bodies, with the cost; ties go to the oldest.
    fn partner(&self, forest: &Forest, body: u32) -> Option<(f64, u32)>;

    /// Notes that two bodies got a parent; `active` says whether the parent takes part in this round.
    fn merged(&mut self, forest: &Forest, children: [u32; 2], parent: u32, active: bool);
}

/// A body and its cheapest older partner. Each pair of bodies is considered once, by the younger. The cheapest of all eligible
/// pairs is therefore among these entries.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    /// The bits of a non-negative double, which order as the number does.
    cost: u64,
    body: u32,
    partner: u32,
}

impl Entry {
    fn of(rule: &impl Eligibility, forest: &Forest, body: u32) -> Option<Reverse<Self>> {
        let (cost, partner) = rule.partner(forest, body)?;
        Some(Reverse(Self {
            cost: (cost + 0.0).to_bits(),
            body,
            partner,
        }))
    }
}

/// Merges the bodies until one is left, or until the limits have passed `last` and no pair is eligible. Returns the
/// parentless bodies.
pub fn cluster(
    forest: &mut Forest,
    bodies: Vec<u32>,
    rule: &mut impl Eligibility,
    first: Limits,
    last: f64,
    threads: usize,
    progress: &mut Progress,
) -> Result<Vec<u32>> {
    let total = bodies.len();
    let mut parentless = bodies;
    let mut limits = first;
    while parentless.len() > 1 {
        let is_small = |&i: &u32| forest.diameters[i as usize] <= limits.diameter;
        let (active, dormant): (Vec<u32>, Vec<u32>) = parentless.iter().partition(|&i| is_small(i));
        let before = parentless.len();
        let mut held_back = false;
        if active.len() > 1 {
            let done = total - before;
            rule.begin(forest, &active, &limits);
            let mut report = |merged: usize| progress.at((done + merged) as f64 / total as f64);
            let mut round = Round::new(forest, rule, &limits, &active, threads)?;
            parentless = round.run(&active, dormant, &mut report)?;
            held_back = round.held_back;
        }
        // A round that held bodies back is repeated with the same limits if it merged more than 1 in 8 bodies.
        let worthwhile = parentless.len() < before - before / 8;
        if !(held_back && worthwhile) {
            if limits.diameter > last && limits.gap > last && parentless.len() == before {
                break;
            }
            limits = widened(&limits, forest, &parentless);
        }
    }
    Ok(parentless)
}

/// Doubles both limits, repeatedly while fewer than two bodies would be active.
fn widened(limits: &Limits, forest: &Forest, parentless: &[u32]) -> Limits {
    let mut least = [f64::INFINITY; 2];
    for &body in parentless {
        let diameter = forest.diameters[body as usize];
        if diameter < least[0] {
            least = [diameter, least[0]];
        } else if diameter < least[1] {
            least[1] = diameter;
        }
    }
    let mut factor = 2.0;
    while limits.diameter * factor < least[1] && least[1].is_finite() {
        factor *= 2.0;
    }
    Limits {
        diameter: limits.diameter * factor,
        gap: limits.gap * factor,
    }
}

struct Round<'a, R> {
    forest: &'a mut Forest,
    rule: &'a mut R,
    diameter_limit: f64,
    /// The entries at the start of the round, cheapest last. A sorted list is read sequentially, unlike a heap.
    first: Vec<Reverse<Entry>>,
    /// The entries added during the round.
    queue: BinaryHeap<Reverse<Entry>>,
    /// Levels grown in this round by each active parentless body; `None` for other bodies.
    growth: Vec<Option<u8>>,
    held_back: bool,
}

impl<'a, R: Eligibility> Round<'a, R> {
    fn new(
        forest: &'a mut Forest,
        rule: &'a mut R,
        limits: &Limits,
        active: &[u32],
        threads: usize,
    ) -> Result<Self> {
        let mut growth = vec![None; forest.extents.len()];
        for &body in active {
            growth[body as usize] = Some(0);
        }
        const CHUNK: usize = 1024;
        let (search, whole) = (&*rule, &*forest);
        let chunks: Vec<&[u32]> = active.chunks(CHUNK).collect();
        let found = parallel::map(
            threads,
            chunks.len(),
            &mut Progress::new(&mut |_| Ok(())),
            |c| {
                let entries = chunks[c]
                    .iter()
                    .filter_map(|&body| Entry::of(search, whole, body));
                entries.collect::<Vec<_>>()
            },
        )?;
        let mut first: Vec<_> = found.into_iter().flatten().collect();
        first.sort_unstable();
        Ok(Self {
            first,
            queue: BinaryHeap::new(),
            forest,
            rule,
            diameter_limit: limits.diameter,
            growth,
            held_back: false,
        })
    }

    fn run(
        &mut self,
        active: &[u32],
        dormant: Vec<u32>,
        report: &mut dyn FnMut(usize) -> Result<()>,
    ) -> Result<Vec<u32>> {
        let first_new = self.forest.extents.len() as u32;
        let mut rest = dormant;
        while let Some(Reverse(Entry { body, partner, .. })) = self.cheapest() {
            let (Some(own), theirs) = (self.growth[body as usize], self.growth[partner as usize])
            else {
                continue;
            };
            let Some(theirs) = theirs else {
                self.enqueue(body);
                continue;
            };
            self.growth[body as usize] = None;
            self.growth[partner as usize] = None;
            let parent = self.forest.merge(body, partner);
            let grown = own.max(theirs) + 1;
            let small = self.forest.diameters[parent as usize] <= self.diameter_limit;
            let active = small && grown < GROWTH_LIMIT;
            self.held_back |= small && !active;
            self.growth.push(active.then_some(grown));
            if !active {
                rest.push(parent);
            }
            self.rule
                .merged(self.forest, [body, partner], parent, active);
            if active {
                self.enqueue(parent);
            }
            if parent.is_multiple_of(4096) {
                report((parent - first_new) as usize)?;
            }
        }
        let unmerged = active
            .iter()
            .copied()
            .chain(first_new..self.forest.extents.len() as u32);
        rest.extend(unmerged.filter(|&i| self.growth[i as usize].is_some()));
        rest.sort_unstable();
        Ok(rest)
    }

    fn cheapest(&mut self) -> Option<Reverse<Entry>> {
        if self.queue.peek() > self.first.last() {
            self.queue.pop()
        } else {
            self.first.pop()
        }
    }

    fn enqueue(&mut self, body: u32) {
        self.queue.extend(Entry::of(self.rule, self.forest, body));
    }
}

#[cfg(test)]
mod tests {
    use super::super::adjacent::{Adjacent, sibling_pairs};
    use super::super::cost::Cost;
    use super::super::nearby::Nearby;
    use super::*;
    use crate::boxes::Extent;
    use crate::pose::Vec3;

    /// Boxes of sizes from 0.01 to 1 in a cube of 10.
    fn boxes(count: usize) -> Vec<Extent> {
        let mut state = 1u64;
        let mut random = move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..count)
            .map(|_| {
                let low = Vec3::new(random(), random(), random()) * 10.0;
                let size = 0.01f64.powf(random());
                let high = low + Vec3::new(random(), random(), random()) * size;
                Extent { low, high }
            })
            .collect()
    }

    /// Eligibility by nearness, by brute force; checks that each merged pair was the cheapest of all.
    struct AllPairs {
        cost: Cost,
        gap_limit: f64,
        active: Vec<u32>,
        merges: usize,
    }

    impl AllPairs {
        fn cost(&self, forest: &Forest, a: u32, b: u32) -> Option<f64> {
            let [own, theirs] = [a, b].map(|i| forest.extents[i as usize]);
            let diameters = [a, b].map(|i| forest.diameters[i as usize]);
            let merged = own.union(&theirs).diameter();
            let merged = merged.max(diameters[0]).max(diameters[1]);
            let near = own.gap(&theirs) <= self.gap_limit;
            near.then(|| self.cost.of(merged, diameters))
        }
    }

    impl Eligibility for AllPairs {
        fn begin(&mut self, _forest: &Forest, active: &[u32], limits: &Limits) {
            self.gap_limit = limits.gap;
            self.active = active.to_vec();
        }

        fn partner(&self, forest: &Forest, body: u32) -> Option<(f64, u32)> {
            let older = self.active.iter().filter(|&&other| other < body);
            older
                .filter_map(|&other| Some((self.cost(forest, body, other)?, other)))
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
        }

        fn merged(&mut self, forest: &Forest, children: [u32; 2], parent: u32, active: bool) {
            let taken = self.cost(forest, children[0], children[1]).unwrap();
            for (i, &a) in self.active.iter().enumerate() {
                for &b in &self.active[..i] {
                    let other = self.cost(forest, a, b);
                    assert!(
                        other.is_none_or(|cost| cost >= taken),
                        "{a}, {b} is cheaper"
                    );
                }
            }
            self.active.retain(|body| !children.contains(body));
            self.active.extend(active.then_some(parent));
            self.merges += 1;
        }
    }

    fn run(boxes: &[Extent], rule: &mut impl Eligibility, threads: usize) -> (Forest, Vec<u32>) {
        let mut forest = Forest::new(boxes.to_vec());
        let first = Limits {
            diameter: 0.05,
            gap: 0.0125,
        };
        let mut ignored = |_| Ok(());
        let left = cluster(
            &mut forest,
            (0..boxes.len() as u32).collect(),
            rule,
            first,
            20.0,
            threads,
            &mut Progress::new(&mut ignored),
        );
        (forest, left.unwrap())
    }

    #[test]
    fn the_cheapest_pair_of_all_is_merged_first_and_the_hash_finds_it() {
        let boxes = boxes(120);
        let bounds = boxes.iter().fold(boxes[0], |all, e| all.union(e));
        for cost in [
            Cost::default(),
            Cost {
                diameter: 2.0,
                fill: 0.5,
                balance: 1.0,
            },
        ] {
            let mut all = AllPairs {
                cost,
                gap_limit: 0.0,
                active: Vec::new(),
                merges: 0,
            };
            let (expected, left) = run(&boxes, &mut all, 1);
            assert_eq!((all.merges, left.len()), (119, 1));
            for threads in [1, 3] {
                let (found, _) = run(&boxes, &mut Nearby::new(cost, &bounds), threads);
                assert_eq!(found.children, expected.children);
            }
        }
    }

    /// Two strips of squares that share no edge are two chunks, however near.
    #[test]
    fn chunks_are_connected_parts() {
        let square = |i: usize, y: f64| {
            let x = i as f64;
            [(x, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0)]
                .map(|(x, y)| Vec3::new(x, y, 0.0))
        };
        let squares: Vec<[Vec3; 4]> = (0..40)
            .map(|i| square(i % 20, if i < 20 { 0.0 } else { 1.001 }))
            .collect();
        let extents: Vec<Extent> = squares.iter().map(|s| Extent::of(s)).collect();
        let siblings = sibling_pairs(0..40, |part, visit| {
            let s = squares[part as usize];
            for k in 0..4 {
                visit([s[k], s[(k + 1) % 4]]);
            }
        });
        assert_eq!(siblings.len(), 38);
        let mut rule = Adjacent::new(Cost::default(), 40, &siblings);
        let (forest, chunks) = run(&extents, &mut rule, 1);
        assert_eq!(chunks.len(), 2);
        let spans = chunks.iter().map(|&chunk| forest.extents[chunk as usize]);
        assert!(spans.clone().any(|e| e.low.y == 0.0 && e.high.y == 1.0));
        assert!(spans.clone().any(|e| e.low.y == 1.001));
    }
}
