//! Pairs of links as the broad phase goes through them: one link against eight others at a time.

use std::collections::BTreeMap;

/// Pairs of links, by the places of the links among those that the pairs name.
#[derive(Clone, Debug, Default)]
pub struct LinkRows {
    /// The links, each once.
    pub links: Vec<usize>,
    /// No pair is in two rows.
    pub rows: Vec<LinkRow>,
}

/// The pairs of one link with some of eight links whose places follow each other.
#[derive(Clone, Copy, Debug)]
pub struct LinkRow {
    /// The place of the first link of the pairs.
    pub first: u32,
    /// The second links are among the eight from place `8 * eight` on.
    pub eight: u32,
    /// Which of the eight they are: one bit each.
    pub seconds: u8,
}

impl LinkRows {
    pub(super) fn new(pairs: &[[usize; 2]]) -> Self {
        let mut places = BTreeMap::new();
        let mut links = Vec::new();
        let mut seconds: BTreeMap<(u32, u32), u8> = BTreeMap::new();
        for pair in pairs {
            let [first, second] = pair.map(|link| {
                *places.entry(link).or_insert_with(|| {
                    links.push(link);
                    links.len() as u32 - 1
                })
            });
            *seconds.entry((first, second / 8)).or_default() |= 1 << (second % 8);
        }
        let row = |((first, eight), seconds)| LinkRow {
            first,
            eight,
            seconds,
        };
        Self {
            links,
            rows: seconds.into_iter().map(row).collect(),
        }
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
        let LinkRows { links, rows } = LinkRows::new(&pairs);
        let of_row = |row: &LinkRow| {
            let LinkRow {
                first,
                eight,
                seconds,
            } = *row;
            let places = (0..8).filter(move |lane| seconds >> lane & 1 == 1);
            let links = &links;
            places.map(move |lane| [links[first as usize], links[(8 * eight + lane) as usize]])
        };
        let mut found: Vec<[usize; 2]> = rows.iter().flat_map(of_row).collect();
        let mut pairs = pairs;
        found.sort_unstable();
        pairs.sort_unstable();
        assert_eq!(found, pairs);
    }
}
