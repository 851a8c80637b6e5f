//! Objects that serve one call at a time.

use std::sync::{Mutex, TryLockError};

use super::boundary::Failure;
use crate::error::{Error, ErrorKind};

/// Runs an action with exclusive access to the object; [`ErrorKind::Busy`] if another call has it. `mend` repairs an object
/// that a panic may have left half changed.
#[inline(always)]
pub fn exclusively<T>(
    object: &Mutex<T>,
    name: &str,
    mend: impl FnOnce(&mut T),
    action: impl FnOnce(&mut T) -> Result<(), Failure>,
) -> Result<(), Failure> {
    match object.try_lock() {
        Ok(mut object) => action(&mut object),
        Err(TryLockError::Poisoned(poisoned)) => {
            let mut inner = poisoned.into_inner();
            mend(&mut inner);
            object.clear_poison();
            action(&mut inner)
        }
        Err(TryLockError::WouldBlock) => Err(busy(name)),
    }
}

#[cold]
fn busy(name: &str) -> Failure {
    Error::new(ErrorKind::Busy, format!("{name} is in use by another call")).into()
}
