//! Data that a caller attaches to an object and gets back with answers (§2.2.3).

use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// A number of the caller's (an address, say) that answers hand back, and an owner that keeps it valid; the owner is dropped
/// when nothing refers to the object any more.
#[derive(Clone)]
pub struct UserData {
    /// Handed back with answers; 0 stands for no data.
    pub value: usize,
    _keeper: Option<Arc<dyn Any + Send + Sync>>,
}

impl UserData {
    pub fn new(value: usize, keeper: Option<Arc<dyn Any + Send + Sync>>) -> Self {
        Self {
            value,
            _keeper: keeper,
        }
    }
}

impl fmt::Debug for UserData {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("UserData").field(&self.value).finish()
    }
}

/// The number, or 0.
pub fn value_of(data: &Option<UserData>) -> usize {
    data.as_ref().map_or(0, |data| data.value)
}
