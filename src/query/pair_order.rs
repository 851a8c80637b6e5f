//! The order of body pairs in a list. Pairs are many numbers wide, so what they are ordered by is sorted, each key a single number, and
//! each pair is moved once.

use super::answer::SSide;
use super::cache_key::PairIds;
use super::target::Target;

/// The places of pairs, in the order that is wanted. Memory that is used anew for each list.
#[derive(Default)]
pub(super) struct PairOrder {
    /// What orders a pair, above its place in the list, in the lowest [`PLACE_BITS`].
    keys: Vec<u128>,
    /// The places in order of ids: of each rank.
    ranked: Vec<u32>,
}

/// Bits of a place in a list.
const PLACE_BITS: u32 = 32;
/// Bits of a link's number, an object's id, and the kind of an s-side; together with the place's as many as a key has.
const LINK_BITS: u32 = 17;
const ID_BITS: u32 = 39;
const KIND_BITS: u32 = 1;

impl PairOrder {
    /// Orders those pairs that are wanted by ids. Whether some ids are there twice; these are in any order.
    pub fn by_ids(&mut self, targets: &[Target], is_wanted: impl Fn(&Target) -> bool) -> bool {
        let wanted = (0..targets.len()).filter(|&place| is_wanted(&targets[place]));
        self.sort_by_ids(wanted, |place| targets[place].ids())
    }

    fn sort_by_ids(
        &mut self,
        places: impl Iterator<Item = usize>,
        ids: impl Fn(usize) -> PairIds,
    ) -> bool {
        self.keys.clear();
        let mut are_short = true;
        self.keys.extend(places.map(|place| {
            let key = key_of_ids(&ids(place));
            are_short &= key.is_some();
            key.unwrap_or(0) << PLACE_BITS | place as u128
        }));
        match are_short {
            true => self.keys.sort_unstable(),
            false => self.keys.sort_unstable_by_key(|&key| ids(place_of(key))),
        }
        self.take_ranks();
        let neighbours = self.keys.windows(2);
        let mut both = neighbours.map(|two| [two[0], two[1]].map(|key| ids(place_of(key))));
        both.any(|[one, next]| one == next)
    }

    /// Takes this many pairs in the order in which they are.
    pub fn as_they_are(&mut self, count: usize) {
        self.keys.clear();
        self.keys.extend(0..count as u128);
        self.take_ranks();
    }

    fn take_ranks(&mut self) {
        self.ranked.clear();
        self.ranked
            .extend(self.keys.iter().map(|&key| place_of(key) as u32));
    }

    /// Tells the pairs their ranks: their numbers in order of ids.
    pub fn set_ranks(&self, targets: &mut [Target]) {
        for (&place, rank) in self.ranked.iter().zip(0..) {
            targets[place as usize].rank = rank;
        }
    }

    /// Orders the pairs by bounds, those of the same bound by ranks.
    pub fn by_bounds(&mut self, targets: &[Target]) {
        let ranked = self.ranked.iter().zip(0..);
        self.keys.clear();
        self.keys.extend(ranked.map(|(&place, rank): (_, u32)| {
            let bound = ordered_bits(targets[place as usize].bound);
            u128::from(bound) << 64 | u128::from(rank) << PLACE_BITS | u128::from(place)
        }));
        self.keys.sort_unstable();
    }

    /// The places in order.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.keys.iter().map(|&key| place_of(key))
    }
}

fn place_of(key: u128) -> usize {
    key as u32 as usize
}

/// A number whose order is that of ids, of the bits above a place's; `None` for ids that have more bits than are for them.
fn key_of_ids(&(link, r_object, s_side): &PairIds) -> Option<u128> {
    let (kind, s) = match s_side {
        SSide::Object(id) => (0, id),
        SSide::Link(link) => (1, link as u64),
        SSide::PureSet(_) => return None,
    };
    let fits = link < 1 << LINK_BITS && (r_object | s) < 1 << ID_BITS;
    let r = (link as u128) << ID_BITS | u128::from(r_object);
    fits.then_some((r << KIND_BITS | kind) << ID_BITS | u128::from(s))
}

/// Bits whose order is that of `f64::total_cmp`.
fn ordered_bits(number: f64) -> u64 {
    let bits = number.to_bits();
    bits ^ ((bits as i64 >> 63) as u64 | 1 << 63)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ids in order, short ones and long ones, each beside its neighbours by one in one number.
    fn ids() -> Vec<PairIds> {
        let links = [0, 1, (1 << LINK_BITS) - 1, 1 << LINK_BITS];
        let objects = [0, 1, (1 << ID_BITS) - 1, 1 << ID_BITS, u64::MAX];
        let sides: Vec<SSide> = objects
            .map(SSide::Object)
            .into_iter()
            .chain(links.map(SSide::Link))
            .collect();
        let mut all = Vec::new();
        for link in links {
            for r_object in objects {
                all.extend(sides.iter().map(|&side| (link, r_object, side)));
            }
        }
        all
    }

    fn is_short((link, r_object, side): &PairIds) -> bool {
        let is_short_side = match side {
            SSide::Object(id) => id >> ID_BITS == 0,
            _ => true,
        };
        link >> LINK_BITS == 0 && r_object >> ID_BITS == 0 && is_short_side
    }

    /// The places of ids that are in order, given to the sort backwards and from the middle.
    fn places_of(ids: &[PairIds]) -> (bool, Vec<usize>) {
        let mut order = PairOrder::default();
        let middle = ids.len() / 2;
        let mixed = (middle..ids.len()).rev().chain((0..middle).rev());
        let repeats = order.sort_by_ids(mixed, |place| ids[place]);
        (repeats, order.places().collect())
    }

    #[test]
    fn ids_are_sorted_short_or_long() {
        let all = ids();
        assert!(all.is_sorted());
        let short: Vec<PairIds> = all.iter().copied().filter(is_short).collect();
        assert!(short.len() > 50 && short.len() < all.len());
        assert!(short.iter().all(|ids| key_of_ids(ids).is_some()));
        for list in [&short, &all] {
            assert_eq!(places_of(list), (false, (0..list.len()).collect()));
        }
    }

    #[test]
    fn ids_that_are_there_twice_are_told() {
        for mut list in [ids(), vec![(0, 0, SSide::Object(1))]] {
            list.push(*list.last().unwrap());
            assert!(places_of(&list).0);
        }
    }

    #[test]
    fn bits_of_numbers_are_in_their_order() {
        let mut numbers = [
            -0.0,
            0.0,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1.0,
            -1.0,
            f64::MIN_POSITIVE,
            -1e300,
            5e-324,
        ];
        numbers.sort_by(f64::total_cmp);
        assert!(numbers.map(ordered_bits).is_sorted());
    }
}
