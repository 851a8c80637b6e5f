//! Copy-on-write vectors: clones share unchanged chunks, and one vector can catch up with the changes of another.

use std::iter::Peekable;
use std::ops::Index;
use std::sync::Arc;

/// Chunks per block.
const WIDTH: usize = 32;

type Chunk<T, const N: usize> = [T; N];
type Block<T, const N: usize> = [Arc<Chunk<T, N>>; WIDTH];

/// A vector in chunks of `N` items, a power of two. A clone takes constant time. The first change after a clone copies the
/// pointers to all blocks; the first in a block copies its 32 pointers to chunks, and the first in a chunk its `N` items.
#[derive(Debug)]
pub struct CowVec<T, const N: usize> {
    blocks: Arc<[Arc<Block<T, N>>]>,
    len: usize,
    /// The indices changed since this vector became equal to another by `clone` or `follow`, in any order. `None` if it never
    /// did.
    changed: Option<Vec<u32>>,
}

impl<T, const N: usize> Clone for CowVec<T, N> {
    fn clone(&self) -> Self {
        Self {
            blocks: self.blocks.clone(),
            len: self.len,
            changed: Some(Vec::new()),
        }
    }
}

impl<T, const N: usize> Default for CowVec<T, N> {
    fn default() -> Self {
        Self {
            blocks: Arc::new([]),
            len: 0,
            changed: None,
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
        self.note(index);
        &mut self.chunk(index)[index % N]
    }

    /// Changes the items of some indices. Fastest where indices of one chunk follow one another: the chunk is then looked up
    /// once.
    #[inline(always)]
    pub fn update(
        &mut self,
        indices: impl IntoIterator<Item = usize>,
        mut change: impl FnMut(usize, &mut T),
    ) {
        let mut indices = indices.into_iter().peekable();
        while let Some(mut run) = self.next_run(&mut indices) {
            while let Some((index, item)) = run.next() {
                change(index, item);
            }
        }
    }

    /// The next items to change that lie in one chunk. Code that runs in lanes loops over these, as [`CowVec::update`] does,
    /// instead of passing a closure, which would not be compiled for its instruction set.
    #[inline(always)]
    pub fn next_run<'a, I: Iterator<Item = usize>>(
        &'a mut self,
        indices: &'a mut Peekable<I>,
    ) -> Option<Run<'a, T, N, I>> {
        let first = *indices.peek()?;
        let of_chunk = first / N;
        let block = &mut Arc::make_mut(&mut self.blocks)[of_chunk / WIDTH];
        let chunk = &mut Arc::make_mut(block)[of_chunk % WIDTH];
        Some(Run {
            indices,
            of_chunk,
            chunk: Arc::make_mut(chunk),
            len: self.len,
            changed: self.changed.as_mut(),
        })
    }

    /// Becomes equal to `other`, which was cloned from this vector, or followed it, and was then changed. Only the changed
    /// items are copied, in place where a chunk is not shared.
    pub fn follow(&mut self, other: &Self) {
        self.follow_by(other, |_, own, now| own.clone_from(now));
    }

    /// The same, with a caller's copy function: `follow` copies an item, or may skip one that the caller changes next.
    pub fn follow_by(&mut self, other: &Self, mut follow: impl FnMut(usize, &mut T, &T)) {
        let Some(changed) = other.changed.as_ref() else {
            *self = other.clone();
            return;
        };
        if self.blocks.len() != other.blocks.len() {
            *self = other.clone();
            return;
        }
        self.len = other.len;
        let mut own = self.changed.take().unwrap_or_default();
        own.clear();
        self.update(
            changed.iter().map(|&index| index as usize),
            |index, item| {
                follow(index, item, &other[index]);
            },
        );
        self.changed = Some(own);
    }

    pub fn push(&mut self, item: T) {
        let index = self.len;
        self.make_room(index + 1);
        self.len = index + 1;
        self.note(index);
        self.chunk(index)[index % N] = item;
    }

    /// Changes the length. New items must be written before they are read.
    pub fn resize(&mut self, len: usize) {
        self.make_room(len);
        self.len = len;
        if let Some(changed) = &mut self.changed {
            changed.retain(|&index| (index as usize) < len);
        }
    }

    fn make_room(&mut self, len: usize) {
        let blocks = len.div_ceil(WIDTH * N);
        if blocks > self.blocks.len() {
            let unused = Arc::new(std::array::from_fn(|_| T::default()));
            let block = Arc::new(std::array::from_fn(|_| unused.clone()));
            let more = (self.blocks.len()..blocks).map(|_| block.clone());
            self.blocks = self.blocks.iter().cloned().chain(more).collect();
        }
    }

    /// Changes all items.
    pub fn set_all(&mut self, items: impl IntoIterator<Item = T>) {
        let mut items = items.into_iter();
        self.update(0..self.len, |_, own| {
            if let Some(item) = items.next() {
                *own = item;
            }
        });
    }

    #[inline]
    fn note(&mut self, index: usize) {
        if let Some(changed) = &mut self.changed {
            changed.push(index as u32);
        }
    }

    /// The chunk of an item, copied first if it is shared.
    #[inline]
    fn chunk(&mut self, index: usize) -> &mut Chunk<T, N> {
        let block = &mut Arc::make_mut(&mut self.blocks)[index / N / WIDTH];
        Arc::make_mut(&mut Arc::make_mut(block)[index / N % WIDTH])
    }
}

/// Items of one chunk that the caller changes.
pub struct Run<'a, T, const N: usize, I: Iterator<Item = usize>> {
    indices: &'a mut Peekable<I>,
    of_chunk: usize,
    chunk: &'a mut Chunk<T, N>,
    len: usize,
    changed: Option<&'a mut Vec<u32>>,
}

impl<T, const N: usize, I: Iterator<Item = usize>> Run<'_, T, N, I> {
    #[inline(always)]
    pub fn next(&mut self) -> Option<(usize, &mut T)> {
        let of_chunk = self.of_chunk;
        let index = self.indices.next_if(|index| index / N == of_chunk)?;
        assert!(index < self.len, "{index} of {}", self.len);
        if let Some(changed) = &mut self.changed {
            changed.push(index as u32);
        }
        Some((index, &mut self.chunk[index % N]))
    }
}

impl<T, const N: usize> Index<usize> for CowVec<T, N> {
    type Output = T;

    /// An index beyond the length may or may not panic.
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
            changed: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use cstk_scenes::Random;

    use super::*;

    /// Against plain vectors: a clone keeps its items when the other is changed.
    #[test]
    fn clones_keep_what_they_held() {
        let mut random = Random::new(1);
        let mut random = move |n: usize| (random.bits() % n as u64) as usize;
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

    /// Two vectors that take turns, like the states of an environment, with clones of some states kept.
    #[test]
    fn a_vector_that_follows_another_is_equal_to_it() {
        let mut random = Random::new(7);
        let mut random = move |n: usize| (random.bits() % n as u64) as usize;
        let mut now: CowVec<String, 2> = (0..20).map(|i: u32| i.to_string()).collect();
        let mut before = CowVec::default();
        let mut plain: Vec<String> = now.iter().cloned().collect();
        let mut kept = Vec::new();
        for step in 0..500 {
            before.follow(&now);
            std::mem::swap(&mut before, &mut now);
            assert!(now.iter().eq(&plain) && now.len() == plain.len());
            if random(5) == 0 {
                kept.push((now.clone(), plain.clone()));
            }
            for _ in 0..random(4) {
                now.push(step.to_string());
                plain.push(step.to_string());
            }
            let indices: Vec<usize> = (0..random(6)).map(|_| random(plain.len())).collect();
            now.update(indices.iter().copied(), |_, item| item.push('x'));
            indices.iter().for_each(|&i| plain[i].push('x'));
            if random(50) == 0 {
                now = plain.iter().cloned().collect();
            }
        }
        for (now, plain) in kept {
            assert!(now.iter().eq(&plain));
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
