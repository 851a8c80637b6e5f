//! Reuse of allocated memory.

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
}
