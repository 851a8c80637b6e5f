//! Vectors whose clones share what none of them has changed since.

use std::ops::Index;
use std::sync::Arc;

/// Chunks to a block.
const WIDTH: usize = 32;

type Chunk<T, const N: usize> = [T; N];
type Block<T, const N: usize> = [Arc<Chunk<T, N>>; WIDTH];

/// A vector in chunks of `N` items, a power of two. A clone takes no time; a change after it copies the item's chunk, and
/// the words that lead there, one for each 32 `N` items and few more.
#[derive(Clone, Debug)]
pub struct CowVec<T, const N: usize> {
    blocks: Arc<[Arc<Block<T, N>>]>,
    len: usize,
}

impl<T, const N: usize> Default for CowVec<T, N> {
    fn default() -> Self {
        Self {
            blocks: Arc::new([]),
            len: 0,
        }
    }
}

impl<T, const N: usize> CowVec<T, N> {
    pub fn len(&self) -> usize {
        self.len
    }

    pub fn get(&self, index: usize) -> Option<&T> {
        (index < self.len).then(|| &self[index])
    }

    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &T> + Clone {
        (0..self.len).map(|index| &self[index])
    }
}

impl<T: Clone + Default, const N: usize> CowVec<T, N> {
    pub fn get_mut(&mut self, index: usize) -> &mut T {
        assert!(index < self.len, "{index} of {}", self.len);
        self.slot(index)
    }

    pub fn push(&mut self, item: T) {
        if self.len == self.blocks.len() * WIDTH * N {
            let unused = Arc::new(std::array::from_fn(|_| T::default()));
            let block = Arc::new(std::array::from_fn(|_| unused.clone()));
            self.blocks = self.blocks.iter().cloned().chain([block]).collect();
        }
        *self.slot(self.len) = item;
        self.len += 1;
    }

    #[inline]
    fn slot(&mut self, index: usize) -> &mut T {
        let block = &mut Arc::make_mut(&mut self.blocks)[index / N / WIDTH];
        let chunk = &mut Arc::make_mut(block)[index / N % WIDTH];
        &mut Arc::make_mut(chunk)[index % N]
    }
}

impl<T, const N: usize> Index<usize> for CowVec<T, N> {
    type Output = T;

    /// Items beyond the length may or may not be refused.
    #[inline(always)]
    fn index(&self, index: usize) -> &T {
        &self.blocks[index / N / WIDTH][index / N % WIDTH][index % N]
    }
}

impl<T: Clone + Default, const N: usize> FromIterator<T> for CowVec<T, N> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let mut items = items.into_iter().peekable();
        let mut len = 0;
        let unused = Arc::new(std::array::from_fn(|_| T::default()));
        let mut blocks: Vec<Arc<Block<T, N>>> = Vec::new();
        while items.peek().is_some() {
            blocks.push(Arc::new(std::array::from_fn(|_| {
                if items.peek().is_none() {
                    return unused.clone();
                }
                Arc::new(std::array::from_fn(|_| {
                    let item = items.next();
                    len += usize::from(item.is_some());
                    item.unwrap_or_default()
                }))
            })));
        }
        Self {
            blocks: blocks.into(),
            len,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against plain vectors: what a clone holds stays, whatever becomes of the other.
    #[test]
    fn clones_keep_what_they_held() {
        let mut state = 1u64;
        let mut random = move |n: usize| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1);
            (state >> 33) as usize % n
        };
        let mut vector: CowVec<String, 2> = CowVec::default();
        let mut plain: Vec<String> = Vec::new();
        let mut kept = Vec::new();
        for step in 0..3000 {
            match random(4) {
                0 => kept.push((vector.clone(), plain.clone())),
                1 if !plain.is_empty() => {
                    let index = random(plain.len());
                    vector.get_mut(index).push('x');
                    plain[index].push('x');
                }
                _ => {
                    vector.push(step.to_string());
                    plain.push(step.to_string());
                }
            }
        }
        kept.push((vector, plain));
        for (vector, plain) in kept.iter().rev().step_by(40) {
            assert_eq!(vector.len(), plain.len());
            assert!(vector.iter().eq(plain));
            assert!(vector.get(plain.len()).is_none());
            let collected: CowVec<String, 2> = plain.iter().cloned().collect();
            assert!(collected.iter().eq(plain) && collected.len() == plain.len());
        }
    }

    #[test]
    fn only_what_is_changed_is_copied() {
        let first: CowVec<u32, 4> = (0..1000).collect();
        let mut second = first.clone();
        *second.get_mut(500) = 7;
        let shared = |i: usize| std::ptr::eq(&first[i], &second[i]);
        assert_eq!((first[500], second[500]), (500, 7));
        assert_eq!((0..1000).filter(|&i| !shared(i)).count(), 4);
    }
}
