//! The identity of the leaves of a C-object's tree.

use std::sync::atomic::{AtomicU64, Ordering};

/// Identifies a leaf, an induced or a pure set, in answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Leaf {
    /// The number of the leaf's C-object ([`super::CObject::serial`]); 0 where there is no C-object.
    pub serial: u64,
    /// The value of the user data, or 0.
    pub data: usize,
}

/// A new number for a C-object.
pub(super) fn next_serial() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
