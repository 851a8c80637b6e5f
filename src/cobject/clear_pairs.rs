//! What is proved of the link pairs of a set.

use super::clear_cells::ClearCells;

/// Grids of the pairs of links that few coordinates move relative to each other.
#[derive(Clone, Debug)]
pub struct ClearPairs {
    /// Where the entries of each link begin, and where those of the last end.
    starts: Vec<u32>,
    /// For the lower link of each pair the higher one and the place of the grid.
    entries: Vec<[u32; 2]>,
    grids: Vec<ClearCells>,
}

impl ClearPairs {
    /// Of pairs of different links of a space with so many, either link first; no pair twice.
    pub fn new(links: usize, pairs: Vec<([usize; 2], ClearCells)>) -> Self {
        let mut order: Vec<([usize; 2], u32)> = (pairs.iter().zip(0..))
            .map(|(([r, s], _), place)| ([*r.min(s), *r.max(s)], place))
            .collect();
        order.sort_unstable();
        let first = |link: usize| order.partition_point(|([lower, _], _)| *lower < link) as u32;
        Self {
            starts: (0..=links).map(first).collect(),
            entries: (order.iter())
                .map(|([_, higher], place)| [*higher as u32, *place])
                .collect(),
            grids: pairs.into_iter().map(|(_, grid)| grid).collect(),
        }
    }

    /// The grid of a pair.
    #[inline]
    pub fn of(&self, [r, s]: [usize; 2]) -> Option<&ClearCells> {
        let (lower, higher) = (r.min(s), r.max(s) as u32);
        let [first, end] = [self.starts[lower], self.starts[lower + 1]];
        let mut own = self.entries[first as usize..end as usize].iter();
        let [_, place] = own.find(|[link, _]| *link == higher)?;
        Some(&self.grids[*place as usize])
    }

    /// All grids, in the order in which they were given.
    pub fn grids(&self) -> &[ClearCells] {
        &self.grids
    }
}

#[cfg(test)]
mod tests {
    use super::super::CellAxis;
    use super::*;

    #[test]
    fn each_pair_has_its_own_grid() {
        let grid = |coordinate: usize| {
            let axis = CellAxis {
                coordinate,
                velocity: coordinate,
                low: 0.0,
                width: 1.0,
                count: 1,
                is_periodic: false,
            };
            ClearCells::new([axis].into_iter().collect())
        };
        let given = [[3, 1], [0, 4], [1, 2], [4, 3], [0, 1]];
        let pairs = given.into_iter().zip(0..).map(|(pair, k)| (pair, grid(k)));
        let pairs = ClearPairs::new(5, pairs.collect());
        for r in 0..5 {
            for s in 0..5 {
                let place = given
                    .iter()
                    .position(|pair| *pair == [r, s] || *pair == [s, r]);
                let found = pairs.of([r, s]).map(|grid| grid.axes()[0].coordinate);
                assert_eq!(found, place, "{r} {s}");
            }
        }
        assert_eq!(pairs.grids().len(), 5);
        assert!(ClearPairs::new(3, Vec::new()).of([0, 2]).is_none());
    }
}
