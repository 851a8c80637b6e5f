//! Where the answers of a batch go: arrays that threads fill run by run.

/// Arrays with room for the answers of consecutive items. They are cut into runs, each filled by one thread. Implemented for slices,
/// which are absent where they are empty, for pairs of such arrays, and for none.
pub trait Slots: Send + Sized {
    /// Called once, on the whole, when the batch has been found in order and begins.
    fn begin(&mut self) {}

    /// The slots of the first `count` items, and of the others.
    fn split(self, count: usize) -> (Self, Self);
}

impl<T: Send> Slots for &mut [T] {
    fn split(self, count: usize) -> (Self, Self) {
        let count = count.min(self.len());
        self.split_at_mut(count)
    }
}

impl Slots for () {
    fn split(self, _: usize) -> (Self, Self) {
        ((), ())
    }
}

impl<A: Slots, B: Slots> Slots for (A, B) {
    fn begin(&mut self) {
        self.0.begin();
        self.1.begin();
    }

    fn split(self, count: usize) -> (Self, Self) {
        let (a, other_a) = self.0.split(count);
        let (b, other_b) = self.1.split(count);
        ((a, b), (other_a, other_b))
    }
}
