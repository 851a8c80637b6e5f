//! Pairs of links as the broad phase goes through them: the body of one against those of eight others at a time.

use std::collections::BTreeMap;

use crate::index_set::IndexSet;

/// Pairs of bodies by their numbers in a space.
#[derive(Clone, Debug, Default)]
pub struct LinkRows {
    /// The bodies of all pairs.
    pub bodies: IndexSet,
    /// No pair is in two rows.
    /// In order of first bodies, then of eights.
    pub rows: Vec<LinkRow>,
}

/// The pairs of one body with some of eight whose numbers follow each other.
#[derive(Clone, Copy, Debug)]
pub struct LinkRow {
    /// The first body of the pairs.
    pub first: u32,
    /// The second bodies are among the eight from number `8 * eight` on.
    pub eight: u32,
    /// Which of the eight they are: one bit each.
    pub seconds: u8,
}

impl LinkRows {
    /// Of pairs of the first `count` bodies.
    pub(super) fn new(count: usize, pairs: impl IntoIterator<Item = [usize; 2]>) -> Self {
        let mut bodies = IndexSet::new(count);
        let mut seconds: BTreeMap<(u32, u32), u8> = BTreeMap::new();
        for pair in pairs {
            for body in pair {
                bodies.insert(body);
            }
            let [first, second] = pair.map(|body| body as u32);
            *seconds.entry((first, second / 8)).or_default() |= 1 << (second % 8);
        }
        let row = |((first, eight), seconds)| LinkRow {
            first,
            eight,
            seconds,
        };
        Self {
            bodies,
            rows: seconds.into_iter().map(row).collect(),
        }
    }

    /// Whether two bodies are a pair, in this order.
    pub fn contain(&self, [first, second]: [usize; 2]) -> bool {
        let key = (first as u32, second as u32 / 8);
        let found = (self.rows).binary_search_by_key(&key, |row| (row.first, row.eight));
        found.is_ok_and(|at| self.rows[at].seconds >> (second % 8) & 1 == 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_hold_each_pair_once() {
        let pairs: Vec<[usize; 2]> = (0..40)
            .flat_map(|i| [[i, (7 * i + 3) % 40], [i, (i + 20) % 40]])
            .collect();
        let rows = LinkRows::new(40, pairs.iter().copied());
        for pair in (0..40).flat_map(|i| (0..40).map(move |j| [i, j])) {
            assert_eq!(rows.contain(pair), pairs.contains(&pair), "{pair:?}");
        }
        let LinkRows { bodies, rows } = rows;
        assert!(bodies.iter().eq(0..40));
        let of_row = |row: &LinkRow| {
            let LinkRow {
                first,
                eight,
                seconds,
            } = *row;
            let places = (0..8).filter(move |lane| seconds >> lane & 1 == 1);
            places.map(move |lane| [first as usize, (8 * eight + lane) as usize])
        };
        let mut found: Vec<[usize; 2]> = rows.iter().flat_map(of_row).collect();
        let mut pairs = pairs;
        found.sort_unstable();
        pairs.sort_unstable();
        assert_eq!(found, pairs);
    }
}
