//! Sets of small integers, as bit sets.

/// A set of integers below a capacity.
#[derive(Clone, Debug, Default)]
pub struct IndexSet {
    words: Vec<u64>,
}

impl IndexSet {
    pub fn new(capacity: usize) -> Self {
        Self {
            words: vec![0; capacity.div_ceil(64)],
        }
    }

    /// Takes all out, for another capacity.
    pub fn clear(&mut self, capacity: usize) {
        self.words.clear();
        self.words.resize(capacity.div_ceil(64), 0);
    }

    /// Takes in those of another set's numbers that are below a limit; all of them must be below this one's capacity.
    pub fn extend_below(&mut self, other: &Self, limit: usize) {
        for (place, (word, more)) in self.words.iter_mut().zip(&other.words).enumerate() {
            let below = match limit.saturating_sub(64 * place) {
                count @ 0..64 => (1 << count) - 1,
                _ => u64::MAX,
            };
            *word |= more & below;
        }
    }

    /// The bits of the numbers, 64 in a word.
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Adds a number. Returns whether it is new.
    #[inline]
    pub fn insert(&mut self, index: usize) -> bool {
        let word = &mut self.words[index / 64];
        let bit = 1 << (index % 64);
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    pub fn remove(&mut self, index: usize) {
        if let Some(word) = self.words.get_mut(index / 64) {
            *word &= !(1 << (index % 64));
        }
    }

    #[inline]
    pub fn contains(&self, index: usize) -> bool {
        let word = self.words.get(index / 64);
        word.is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// The numbers in ascending order.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        let words = self.words.iter().enumerate();
        words.flat_map(|(place, &word)| bits(word).map(move |bit| 64 * place + bit))
    }
}

/// The places of the bits of a word, in order.
#[inline(always)]
pub fn bits(word: u64) -> impl Iterator<Item = usize> {
    let mut rest = word;
    std::iter::from_fn(move || {
        let bit = (rest != 0).then(|| rest.trailing_zeros() as usize)?;
        rest &= rest - 1;
        Some(bit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_held_once_and_listed_in_order() {
        let mut set = IndexSet::new(200);
        let given = [199, 3, 64, 0, 63, 3, 128];
        let news: Vec<bool> = given.iter().map(|&index| set.insert(index)).collect();
        assert_eq!(news, [true, true, true, true, true, false, true]);
        assert!(set.iter().eq([0, 3, 63, 64, 128, 199]));
        assert!(set.contains(64) && !set.contains(65) && !set.contains(1000));
        set.remove(64);
        set.remove(1000);
        assert!(set.iter().eq([0, 3, 63, 128, 199]));
        for (limit, count) in [
            (0, 0),
            (1, 1),
            (63, 2),
            (64, 3),
            (128, 3),
            (129, 4),
            (500, 5),
        ] {
            let mut below = IndexSet::new(200);
            below.extend_below(&set, limit);
            assert!(below.iter().eq(set.iter().take(count)), "{limit}");
        }
    }
}
