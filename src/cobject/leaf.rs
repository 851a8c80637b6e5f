//! The leaves of a C-object's tree, as answers name them.

use std::sync::atomic::{AtomicU64, Ordering};

/// Names a leaf: an induced or a pure set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Leaf {
    /// The C-object's number, which no other of this process has; 0 where there is no C-object.
    pub serial: u64,
    /// The user data's number, or 0.
    pub data: usize,
}

/// A number for a C-object.
pub(super) fn next_serial() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
