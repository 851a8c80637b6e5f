//! Lists of a primitive's topology, which primitives share: those of polygons are constants for up to eight corners, and a
//! primitive whose vertices have moved has the lists of the one before.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

/// The most corners of a polygon whose lists are constants.
const MAX_CONSTANT: usize = 8;

const NUMBERS: [u32; MAX_CONSTANT] = [0, 1, 2, 3, 4, 5, 6, 7];

/// For each number of corners up to eight, the edges from each corner to the next.
const CYCLES: [[[u32; 2]; MAX_CONSTANT]; MAX_CONSTANT + 1] = {
    let mut cycles = [[[0; 2]; MAX_CONSTANT]; MAX_CONSTANT + 1];
    let mut count = 1;
    while count <= MAX_CONSTANT {
        let mut i = 0;
        while i < count {
            cycles[count][i] = [i as u32, ((i + 1) % count) as u32];
            i += 1;
        }
        count += 1;
    }
    cycles
};

/// What a constant list may hold.
pub trait Constants: Sized + 'static {
    /// The constant list of so many items; empty beyond [`MAX_CONSTANT`].
    fn constant(count: u8) -> &'static [Self];
}

impl Constants for u32 {
    /// The numbers from 0 on.
    #[inline(always)]
    fn constant(count: u8) -> &'static [Self] {
        static ALL: [u32; MAX_CONSTANT] = NUMBERS;
        ALL.get(..count as usize).unwrap_or_default()
    }
}

impl Constants for [u32; 2] {
    /// The edges of a polygon: from each vertex to the next.
    #[inline(always)]
    fn constant(count: u8) -> &'static [Self] {
        static ALL: [[[u32; 2]; MAX_CONSTANT]; MAX_CONSTANT + 1] = CYCLES;
        let cycle = ALL
            .get(count as usize)
            .and_then(|cycle| cycle.get(..count as usize));
        cycle.unwrap_or_default()
    }
}

/// An immutable list; a clone shares its items.
#[derive(Clone)]
pub struct SharedList<T: Constants>(Items<T>);

/// A constant is known by its length alone, so that the two take 16 bytes together: each triangle has two such lists.
#[derive(Clone)]
enum Items<T: Constants> {
    Constant(u8),
    Counted(Arc<[T]>),
}

impl SharedList<u32> {
    /// The numbers from 0 on.
    pub fn numbers(count: usize) -> Self {
        match count {
            0..=MAX_CONSTANT => Self(Items::Constant(count as u8)),
            _ => Self((0..count as u32).collect()),
        }
    }

    /// The numbers of a face's corners.
    pub fn of_corners(corners: Vec<u32>) -> Self {
        match corners.iter().copied().eq(0..corners.len() as u32) {
            true => Self::numbers(corners.len()),
            false => corners.into(),
        }
    }
}

impl SharedList<[u32; 2]> {
    /// The edges of a polygon: from each vertex to the next.
    pub fn cycle(count: usize) -> Self {
        match count {
            0..=MAX_CONSTANT => Self(Items::Constant(count as u8)),
            _ => {
                let n = count as u32;
                Self((0..n).map(|i| [i, (i + 1) % n]).collect())
            }
        }
    }

    /// Edges of a primitive.
    pub fn of_edges(edges: Vec<[u32; 2]>) -> Self {
        let cycle = Self::cycle(edges.len());
        match *cycle == edges[..] {
            true => cycle,
            false => edges.into(),
        }
    }
}

impl<T: Constants> FromIterator<T> for Items<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        Self::Counted(items.into_iter().collect())
    }
}

impl<T: Constants> From<Vec<T>> for SharedList<T> {
    fn from(items: Vec<T>) -> Self {
        Self(Items::Counted(items.into()))
    }
}

impl<T: Constants> Default for SharedList<T> {
    fn default() -> Self {
        Self(Items::Constant(0))
    }
}

impl<T: Constants> Deref for SharedList<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        match &self.0 {
            Items::Constant(count) => T::constant(*count),
            Items::Counted(items) => items,
        }
    }
}

impl<'a, T: Constants> IntoIterator for &'a SharedList<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<T: Constants + PartialEq> PartialEq for SharedList<T> {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl<T: Constants + fmt::Debug> fmt::Debug for SharedList<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_of_polygons() {
        for count in 0..12 {
            let edges: Vec<[u32; 2]> = (0..count).map(|i| [i, (i + 1) % count]).collect();
            assert_eq!(*SharedList::cycle(count as usize), edges[..]);
            assert_eq!(*SharedList::of_edges(edges.clone()), edges[..]);
            let numbers: Vec<u32> = (0..count).collect();
            assert_eq!(*SharedList::numbers(count as usize), numbers[..]);
            assert_eq!(*SharedList::of_corners(numbers.clone()), numbers[..]);
        }
        assert_eq!(*SharedList::of_corners(vec![0, 2]), [0, 2]);
        assert_eq!(*SharedList::of_edges(vec![[0, 1]]), [[0, 1]]);
        assert_eq!(size_of::<SharedList<u32>>(), 16);
    }
}
