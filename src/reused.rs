//! Reuse of allocated memory.

use std::any::Any;

/// An empty vector in the memory of another whose items have the same layout: for items that borrow, with a new lifetime in
/// each call.
pub fn emptied<A, B>(mut items: Vec<A>) -> Vec<B> {
    items.clear();
    // The standard library collects in place.
    items
        .into_iter()
        .map(|_| unreachable!("there are no items"))
        .collect()
}

/// Memory that is kept from call to call, of a type that its user alone knows.
#[derive(Default)]
pub struct Kept(Option<Box<dyn Any + Send>>);

impl Kept {
    /// What was kept last, if it is of this type; else new memory.
    pub fn take<T: Any + Default>(&mut self) -> Box<T> {
        let kept = self.0.take().and_then(|kept| kept.downcast().ok());
        kept.unwrap_or_default()
    }

    /// Keeps memory for the next call.
    pub fn keep<T: Any + Send>(&mut self, memory: Box<T>) {
        self.0 = Some(memory);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_memory_stays() {
        let numbers: Vec<&u64> = Vec::with_capacity(100);
        let place = numbers.as_ptr().cast::<()>();
        let others: Vec<&u64> = emptied(numbers);
        assert_eq!((others.as_ptr().cast(), others.capacity()), (place, 100));
    }

    #[test]
    fn what_is_kept_is_given_back_to_its_own_kind() {
        let mut kept = Kept::default();
        kept.keep(Box::new(vec![1, 2]));
        assert_eq!(*kept.take::<Vec<i32>>(), [1, 2]);
        assert!(kept.take::<Vec<i32>>().is_empty());
        kept.keep(Box::new(vec![1, 2]));
        assert_eq!(*kept.take::<String>(), "");
    }
}
