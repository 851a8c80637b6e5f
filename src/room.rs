//! Memory whose size a caller's input decides: too little of it is an error.

use crate::error::{Error, Result};

/// An empty list with room for as many items.
pub fn room_for<T>(count: usize) -> Result<Vec<T>> {
    let mut room = Vec::new();
    room.try_reserve_exact(count).map_err(Error::memory)?;
    Ok(room)
}
