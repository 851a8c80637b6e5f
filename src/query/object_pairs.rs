//! The objects of an environment among themselves, or against those of another: which pairs are near, how near, and where.

use super::answer::{Distance, SSide, Witness, WitnessList};
use super::cache_key::CacheKey;
use super::context::{QueryContext, check_threshold};
use super::object_sets::{NearPair, ObjectSets, target, targets};
use super::pairs::OnePrimitive;
use super::target::Target;
use crate::cobject::{Class, Leaf};
use crate::environment::Snapshot;
use crate::error::Result;

/// Two objects that are near each other. Within one environment the first is the one with the lower id.
#[derive(Clone, Debug)]
pub struct ObjectPair {
    /// The ids of the two.
    pub ids: [u64; 2],
    /// The data of the two objects, or of their bodies, or 0.
    pub data: [usize; 2],
    /// Inside where they meet, else in contact.
    pub class: Class,
}

/// Pairs of objects in order of ids.
#[derive(Clone, Debug, Default)]
pub struct ObjectPairList {
    /// The pairs.
    pub pairs: Vec<ObjectPair>,
    /// The distance of each pair, if asked for.
    pub distances: Vec<Distance>,
    /// There are more.
    pub truncated: bool,
    /// The larger version of the environments.
    pub version: u64,
}

/// Which near pairs are looked at together.
#[derive(Clone, Copy)]
struct Blocks {
    /// How near pairs must be, to begin with.
    limit: f64,
    /// So many pairs make a block.
    size: usize,
    /// Only the nearest pair counts: the limit falls with the pairs' upper bounds too.
    nearest_alone: bool,
}

impl Blocks {
    /// All pairs count: so many targets take 3 MB.
    fn of_all(limit: f64) -> Self {
        Self {
            limit,
            size: 1 << 14,
            nearest_alone: false,
        }
    }

    /// One pair decides.
    fn of_any(limit: f64) -> Self {
        Self {
            size: 1 << 6,
            ..Self::of_all(limit)
        }
    }

    /// The nearest pair decides.
    fn of_nearest(limit: f64) -> Self {
        Self {
            nearest_alone: true,
            ..Self::of_any(limit)
        }
    }
}

impl QueryContext {
    /// Whether two objects may be at most `threshold` apart: doubt within rounding counts as within.
    pub fn environment_within(&mut self, sets: &mut ObjectSets, threshold: f64) -> Result<bool> {
        check_threshold(threshold, "threshold")?;
        self.look_at(sets);
        if let Some(recent) = self.recent_pair(sets)?
            && self.target_within(&target(sets.sides(), &recent), threshold)?
        {
            return Ok(true);
        }
        let mut found = false;
        self.in_blocks(sets, Blocks::of_any(threshold), |context, sides, block| {
            for pair in block.drain(..) {
                let target = target(sides, &pair);
                if context.target_within(&target, threshold)? {
                    context.recent = Some(target.key);
                    found = true;
                    return Ok(f64::NEG_INFINITY);
                }
            }
            Ok(threshold)
        })?;
        Ok(found)
    }

    /// The distance of the nearest two objects, up to `max_distance`. Ties go to the lowest ids.
    pub fn environment_distance(
        &mut self,
        sets: &mut ObjectSets,
        max_distance: f64,
    ) -> Result<Distance> {
        check_threshold(max_distance, "max_distance")?;
        self.look_at(sets);
        let version = sets.version();
        let empty = Distance::empty(version);
        if sets.is_empty() {
            return Ok(empty);
        }
        let mut limit = max_distance;
        if let Some(recent) = self.recent_pair(sets)? {
            let target = target(sets.sides(), &recent);
            limit = self.target_distance(&target, limit)?.distance.min(limit);
        }
        let (mut best, mut lower) = (None, f64::INFINITY);
        self.in_blocks(sets, Blocks::of_nearest(limit), |context, sides, block| {
            let targets = targets(sides, block);
            let found = context.nearest(&targets, limit)?;
            lower = found.lower.min(lower);
            let nearest = found.hit.as_ref().map(|(hit, target)| {
                limit = hit.distance;
                block[target.rank as usize]
            });
            block.clear();
            if nearest.is_some() {
                let scratch = context.scratch.for_primitives();
                best = Some(Distance::from_found(
                    &found,
                    limit,
                    |_| Leaf::default(),
                    scratch,
                ));
            }
            // The next block ranks it among its own.
            block.extend(nearest);
            Ok(limit)
        })?;
        let found = match best {
            Some(best) => Distance { lower, ..best },
            // All pairs are left out by the filter, or none is within the maximum.
            None if max_distance == f64::INFINITY => return Ok(empty),
            None => Distance::beyond(max_distance, lower),
        };
        Ok(Distance { version, ..found })
    }

    /// All pairs of objects at most `distance` apart, in order of ids, at most `max_count` of them: doubt within rounding counts
    /// as within.
    pub fn environment_pairs(
        &mut self,
        sets: &mut ObjectSets,
        distance: f64,
        max_count: usize,
        with_distances: bool,
    ) -> Result<ObjectPairList> {
        check_threshold(distance, "distance")?;
        self.look_at(sets);
        let mut found: Vec<NearPair> = Vec::new();
        let mut truncated = false;
        let mut trim = |found: &mut Vec<NearPair>| {
            found.sort_unstable_by_key(|pair| pair.places);
            truncated |= found.len() > max_count;
            found.truncate(max_count);
            found.last().map(|last| last.places)
        };
        // Once more than enough were found, what comes behind the last is not asked about.
        let mut last: Option<[usize; 2]> = None;
        self.in_blocks(sets, Blocks::of_all(distance), |context, sides, block| {
            for pair in block.drain(..) {
                let is_behind = last.is_some_and(|last| pair.places > last);
                if !is_behind && context.target_within(&target(sides, &pair), distance)? {
                    found.push(pair);
                }
            }
            if found.len() <= max_count.saturating_mul(2) {
                return Ok(distance);
            }
            last = trim(&mut found);
            // Without a last one, none is listed and no more need be known.
            Ok(last.map_or(f64::NEG_INFINITY, |_| distance))
        })?;
        trim(&mut found);
        let mut list = ObjectPairList {
            truncated,
            version: sets.version(),
            ..Default::default()
        };
        list.pairs.reserve(found.len());
        for pair in &found {
            let target = target(sets.sides(), pair);
            let (_, a, b) = target.ids();
            let meet = if with_distances {
                let measured = self.target_distance(&target, f64::INFINITY)?;
                let meet = measured.distance == 0.0;
                list.distances.push(Distance {
                    version: list.version,
                    ..measured
                });
                meet
            } else {
                distance == 0.0 || self.target_within(&target, 0.0)?
            };
            list.pairs.push(ObjectPair {
                ids: [a, object_of(b)],
                data: target.data,
                class: if meet { Class::Inside } else { Class::Contact },
            });
        }
        Ok(list)
    }

    /// All primitive pairs of different objects at most `epsilon` apart, nearest first, at most `max_count` of them.
    pub fn environment_witnesses(
        &mut self,
        sets: &mut ObjectSets,
        epsilon: f64,
        max_count: usize,
    ) -> Result<WitnessList> {
        check_threshold(epsilon, "epsilon")?;
        self.look_at(sets);
        let (mut lists, mut limit) = (Vec::new(), epsilon);
        let mut count = 0;
        self.in_blocks(sets, Blocks::of_all(epsilon), |context, sides, block| {
            let targets = targets(sides, block);
            let list = context.list_of_bodies(&targets, limit, max_count)?;
            block.clear();
            count += list.witnesses.len();
            lists.push(list);
            if count > max_count.saturating_mul(2) {
                let merged = merged(&lists, max_count);
                // What is farther than the last is not listed.
                let last = merged.witnesses.last().filter(|_| merged.truncated);
                limit = last.map_or(limit, |last| last.distance);
                count = merged.witnesses.len();
                lists = vec![merged];
            }
            let nothing_more = max_count == 0 && lists.iter().any(|list| list.truncated);
            Ok(if nothing_more {
                f64::NEG_INFINITY
            } else {
                limit
            })
        })?;
        let list = match lists.len() {
            0 | 1 => lists.pop().unwrap_or_default(),
            _ => merged(&lists, max_count),
        };
        Ok(WitnessList {
            version: sets.version(),
            ..list
        })
    }

    /// Begins a call, and records the versions of the environments.
    fn look_at(&mut self, sets: &ObjectSets) {
        let [a, b] = sets.environments;
        let [first, second] = sets.sides().map(|side| side.version);
        let mut seen = [(a, first), (b, second)];
        seen.sort_unstable();
        self.start_looking(seen.into_iter().skip(usize::from(a == b)));
    }

    /// The pair of objects found last, if both are there still and are asked about.
    fn recent_pair(&mut self, sets: &mut ObjectSets) -> Result<Option<NearPair>> {
        let Some(CacheKey::Candidate {
            space: 0,
            r_object,
            s_side: SSide::Object(s_object),
            ..
        }) = self.recent
        else {
            return Ok(None);
        };
        let [a, b] = sets.sides();
        let (Some(a), Some(b)) = (a.place_of(r_object), b.place_of(s_object)) else {
            return Ok(None);
        };
        // Found between two environments, a pair may be one object twice, or have its higher id first.
        let places = [a, b];
        if sets.second.is_none() && a >= b || !sets.admits(places)? {
            return Ok(None);
        }
        let bound = f64::NEG_INFINITY;
        Ok(Some(NearPair { places, bound }))
    }

    /// Hands the pairs that may be within the limit to `each`, block by block, in any order. `each` takes pairs out of the block,
    /// and returns the limit from then on.
    fn in_blocks(
        &mut self,
        sets: &mut ObjectSets,
        asked: Blocks,
        mut each: impl FnMut(&mut Self, [&Snapshot; 2], &mut Vec<NearPair>) -> Result<f64>,
    ) -> Result<()> {
        let mut scratch = std::mem::take(&mut self.near_pairs);
        let mut block = Vec::new();
        let (mut limit, mut done) = (asked.limit, Ok(()));
        let (first, second) = (sets.first.clone(), sets.second.clone());
        let sides = [&*first, second.as_deref().unwrap_or(&first)];
        let mut offer = |context: &mut Self, places: [usize; 2], at_least: f64| -> Result<f64> {
            context.count_body_pair()?;
            let [a, b] = [sides[0].bounds(places[0]), sides[1].bounds(places[1])];
            let [lower, upper] = a.distance(b);
            let bound = lower.max(at_least);
            if bound <= limit && sets.admits(places)? {
                if asked.nearest_alone {
                    limit = limit.min(upper);
                }
                block.push(NearPair { places, bound });
                if block.len() >= asked.size {
                    limit = each(context, sides, &mut block)?;
                }
            }
            Ok(limit)
        };
        first.visit_near_pairs(
            second.as_deref(),
            asked.limit,
            &mut scratch,
            |places, lower| {
                if done.is_err() {
                    return f64::NEG_INFINITY;
                }
                offer(self, places, lower).unwrap_or_else(|error| {
                    done = Err(error);
                    f64::NEG_INFINITY
                })
            },
        );
        self.near_pairs = scratch;
        done?;
        if !block.is_empty() {
            each(self, sides, &mut block)?;
        }
        Ok(())
    }

    /// Whether the distance of two objects may be at most `threshold`.
    fn target_within(&mut self, target: &Target, threshold: f64) -> Result<bool> {
        let [(a, _), (b, _)] = target.sides;
        if let Some(only) = OnePrimitive::of([a, b]) {
            return self.only_within(only, &target.pairing(), threshold);
        }
        self.any_within(std::slice::from_ref(target), |_| threshold)
    }
}

/// The nearest witnesses of some lists; ties go to the lowest ids, as within a block.
fn merged(lists: &[WitnessList], max_count: usize) -> WitnessList {
    let key = |w: &Witness| (w.r_object, w.s_side, w.primitives, w.contained);
    let mut merged = WitnessList::default();
    merged.take_nearest(lists, max_count, |a, b| key(a).cmp(&key(b)));
    merged
}

fn object_of(side: SSide) -> u64 {
    match side {
        SSide::Object(id) => id,
        SSide::Link(_) | SSide::PureSet(_) => 0,
    }
}
