//! Panics of the library's own code become errors, and are not printed.

use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use crate::error::{Error, ErrorKind, Result};

thread_local! {
    static CONTAINED: Cell<bool> = const { Cell::new(false) };
}

/// Runs an action. A panic becomes an [`ErrorKind::Internal`]: what the action may have left half changed is the caller's to mend.
pub fn contained<T>(action: impl FnOnce() -> T) -> Result<T> {
    silence_contained_panics();
    // One look-up of the thread's flag: in a shared library each is a call.
    let outcome = CONTAINED.with(|contained| {
        let outer = contained.replace(true);
        let outcome = catch_unwind(AssertUnwindSafe(action));
        contained.set(outer);
        outcome
    });
    outcome.map_err(|payload| {
        let text = payload
            .downcast_ref::<&str>()
            .map(|text| text.to_string())
            .or_else(|| payload.downcast_ref::<String>().cloned())
            .unwrap_or_default();
        Error::new(ErrorKind::Internal, format!("internal fault: {text}"))
    })
}

/// The library never prints: a contained panic reaches the caller as an error and needs no report on stderr.
fn silence_contained_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let previous = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if !CONTAINED.try_with(Cell::get).unwrap_or(false) {
                previous(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_comes_back_as_an_error() {
        assert_eq!(contained(|| 7).unwrap(), 7);
        let error = contained(|| panic!("deliberate {}", 7)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Internal);
        assert_eq!(error.message, "internal fault: deliberate 7");
    }
}
