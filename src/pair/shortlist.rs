//! The first few of many items in an order.

use std::cmp::Ordering;

/// An item of a shortlist. Items that compare equal are the same item, found twice.
pub trait Ranked {
    fn order(&self, other: &Self) -> Ordering;
}

/// The first `max_count` of the offered items, each once. Memory grows with the items kept, not with those offered.
pub struct Shortlist<T> {
    /// Sorted up to the last cut, then in the order of offers.
    items: Vec<T>,
    max_count: usize,
    /// The number of items at which the next cut is due.
    full: usize,
    is_truncated: bool,
}

/// At least this many items beyond `max_count` are kept until the next cut. The fewest, so that a search for 1 or 16 items soon
/// gets the bound of the last one: with 8, one for a single item took a third longer.
const MIN_SPARE: usize = 1;

/// With a larger `max_count`, lists shorter than this are not cut: most searches end before. A smaller value sorts more often,
/// a larger one holds more items that are not kept.
const MIN_CUT: usize = 1024;

impl<T: Ranked> Shortlist<T> {
    pub fn new(max_count: usize) -> Self {
        let mut list = Self {
            items: Vec::new(),
            max_count,
            full: 0,
            is_truncated: false,
        };
        list.plan_cut();
        list
    }

    /// Adds an item. Returns true if the list was cut, so that [`Shortlist::last`] may have changed.
    pub fn offer(&mut self, item: T) -> bool {
        self.items.push(item);
        let is_full = self.items.len() >= self.full;
        if is_full {
            self.cut();
        }
        is_full
    }

    /// Whether more than `max_count` items were found.
    pub fn is_truncated(&self) -> bool {
        self.is_truncated
    }

    /// The last item kept: only items before it matter. `None` until more than `max_count` were found, or if none is kept.
    pub fn last(&self) -> Option<&T> {
        let last = self.max_count.checked_sub(1)?;
        self.is_truncated.then(|| &self.items[last])
    }

    /// The items in order, and whether there were more than `max_count`.
    pub fn finish(mut self) -> (Vec<T>, bool) {
        self.cut();
        (self.items, self.is_truncated)
    }

    fn cut(&mut self) {
        // A stable sort merges the part that is already sorted.
        self.items.sort_by(T::order);
        self.items.dedup_by(|a, b| a.order(b).is_eq());
        if self.items.len() > self.max_count {
            self.items.truncate(self.max_count);
            self.is_truncated = true;
        }
        self.plan_cut();
    }

    /// Plans the next cut for when the list has grown by a fraction of its length, so that an item costs a few comparisons.
    fn plan_cut(&mut self) {
        let spare = MIN_SPARE.max(self.max_count / 4);
        let with_spare = self.max_count.saturating_add(spare);
        self.full = with_spare.min(MIN_CUT.max(2 * self.items.len()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, PartialEq)]
    struct Number(u64);

    impl Ranked for Number {
        fn order(&self, other: &Self) -> Ordering {
            self.0.cmp(&other.0)
        }
    }

    /// Numbers in a mixed order, each of them three times.
    fn numbers(count: u64) -> impl Iterator<Item = u64> {
        (0..3 * count).map(move |i| (i * 7919) % count)
    }

    #[test]
    fn the_first_are_kept_whatever_the_order_and_the_repeats() {
        for count in [1, 5, 16, 17, 40, 3001] {
            for max_count in [0, 1, 3, 16, 17, 3000, 3001, usize::MAX] {
                let mut list = Shortlist::new(max_count);
                for number in numbers(count) {
                    list.offer(Number(number));
                }
                let (found, is_truncated) = list.finish();
                let kept = count.min(max_count as u64);
                assert_eq!(found, (0..kept).map(Number).collect::<Vec<_>>());
                assert_eq!(is_truncated, count > kept, "{count} {max_count}");
            }
        }
    }

    #[test]
    fn no_more_is_held_than_a_part_beyond_what_is_kept() {
        for max_count in [0, 1, 16, 5000] {
            let mut list = Shortlist::new(max_count);
            for number in numbers(30_001) {
                list.offer(Number(number));
                assert!(list.items.len() <= max_count + MIN_SPARE.max(max_count / 4));
            }
        }
        let mut all = Shortlist::new(usize::MAX);
        for number in numbers(3001) {
            all.offer(Number(number));
            assert!(all.items.len() <= 2 * 3001);
        }
    }
}
