//! The order of body pairs in a list. Pairs are many numbers wide, so what they are ordered by is sorted, and each is moved once.

use super::cache_key::PairIds;
use super::target::Target;

/// The places of pairs, in the order that is wanted. Memory that is used anew for each list.
#[derive(Default)]
pub(super) struct PairOrder {
    by_ids: Vec<(PairIds, u32, u32)>,
    order: Vec<Ordered>,
}

struct Ordered {
    bound: f64,
    rank: u32,
    place: u32,
}

impl PairOrder {
    /// Orders those pairs that are wanted by ids, and by terms where several hold a pair. Whether some ids are there twice.
    pub fn by_ids(&mut self, targets: &[Target], is_wanted: impl Fn(&Target) -> bool) -> bool {
        let numbered = targets.iter().zip(0..);
        let wanted = numbered.filter(|(target, _)| is_wanted(target));
        self.by_ids.clear();
        self.by_ids
            .extend(wanted.map(|(target, place)| (target.ids(), target.term, place)));
        self.by_ids.sort_unstable();
        let places = self.by_ids.iter().map(|&(_, _, place)| place);
        self.order.clear();
        self.order.extend(ranked(places));
        self.by_ids.windows(2).any(|two| two[0].0 == two[1].0)
    }

    /// Takes this many pairs in the order in which they are.
    pub fn as_they_are(&mut self, count: usize) {
        self.order.clear();
        self.order.extend(ranked(0..count as u32));
    }

    /// Tells the pairs their ranks: their numbers in the order so far.
    pub fn set_ranks(&self, targets: &mut [Target]) {
        for ordered in &self.order {
            targets[ordered.place as usize].rank = ordered.rank;
        }
    }

    /// Orders the pairs by bounds, those of the same bound by ranks.
    pub fn by_bounds(&mut self, targets: &[Target]) {
        for ordered in &mut self.order {
            ordered.bound = targets[ordered.place as usize].bound;
        }
        self.order
            .sort_unstable_by(|a, b| a.bound.total_cmp(&b.bound).then(a.rank.cmp(&b.rank)));
    }

    /// The places in order.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.order.iter().map(|ordered| ordered.place as usize)
    }
}

fn ranked(places: impl Iterator<Item = u32>) -> impl Iterator<Item = Ordered> {
    places.zip(0..).map(|(place, rank)| Ordered {
        bound: 0.0,
        rank,
        place,
    })
}
