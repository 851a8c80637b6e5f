//! The way from two links to what carries both.

/// The links that carry one of two links but not both, themselves included, those with larger numbers first: each with which of the two
/// it carries, 0 or 1. Parents have smaller numbers, and no number is the world's.
pub struct ToCarrier<F> {
    ends: [Option<usize>; 2],
    parent: F,
}

impl<F: Fn(usize) -> Option<usize>> ToCarrier<F> {
    /// From two links, or the world, with the parent of each link.
    pub fn new(ends: [Option<usize>; 2], parent: F) -> Self {
        Self { ends, parent }
    }

    /// The last link that carries both; it may be one of them. `None` for the world.
    pub fn carrier(mut self) -> Option<usize> {
        self.by_ref().for_each(drop);
        self.ends[0]
    }
}

impl<F: Fn(usize) -> Option<usize>> Iterator for ToCarrier<F> {
    type Item = (usize, usize);

    fn next(&mut self) -> Option<(usize, usize)> {
        let [first, second] = self.ends;
        if first == second {
            return None;
        }
        let end = usize::from(second > first);
        let link = self.ends[end]?;
        self.ends[end] = (self.parent)(link);
        Some((end, link))
    }
}
