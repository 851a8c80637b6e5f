//! Objects that serve one call at a time.

use try_lock::TryLock;

use crate::error::{Error, ErrorKind};

/// An object that one call at a time may have. Nobody waits for it, so that letting go of it is a plain store: to a [`std::sync::Mutex`] it
/// is an exchange, which shows in calls as short as those of two spheres.
#[derive(Default)]
pub struct Exclusive<T>(TryLock<Guarded<T>>);

#[derive(Default)]
struct Guarded<T> {
    object: T,
    /// A call that began has not ended: while it runs, and after a panic.
    is_changing: bool,
}

impl<T> Exclusive<T> {
    pub fn new(object: T) -> Self {
        Self(TryLock::new(Guarded {
            object,
            is_changing: false,
        }))
    }

    /// Runs an action with the object; [`ErrorKind::Busy`] if another call has it. `mend` repairs an object that a panic may have
    /// left half changed.
    #[inline(always)]
    pub fn with<E: From<Error>>(
        &self,
        name: &str,
        mend: impl FnOnce(&mut T),
        action: impl FnOnce(&mut T) -> Result<(), E>,
    ) -> Result<(), E> {
        let Some(mut guarded) = self.0.try_lock() else {
            return Err(busy(name).into());
        };
        if guarded.is_changing {
            mend(&mut guarded.object);
        }
        guarded.is_changing = true;
        let answer = action(&mut guarded.object);
        guarded.is_changing = false;
        answer
    }
}

#[cold]
fn busy(name: &str) -> Error {
    Error::new(ErrorKind::Busy, format!("{name} is in use by another call"))
}

#[cfg(test)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};

    use super::*;

    #[test]
    fn what_a_panic_left_is_mended_once() {
        let number = Exclusive::new(1);
        let mut mended = 0;
        let mut ask = |panics: bool| {
            catch_unwind(AssertUnwindSafe(|| {
                let mend = |number: &mut i32| {
                    *number = 1;
                    mended += 1;
                };
                let action = |number: &mut i32| {
                    assert_eq!(*number, 1);
                    *number = 2;
                    assert!(!panics);
                    *number = 1;
                    Ok::<(), Error>(())
                };
                number.with("it", mend, action)
            }))
        };
        for panics in [false, true, false, false] {
            assert_eq!(ask(panics).is_err(), panics);
        }
        assert_eq!(mended, 1);
    }

    #[test]
    fn one_call_at_a_time_has_it() {
        let outer = Exclusive::new(());
        let called = outer.with(
            "it",
            |()| {},
            |()| {
                let taken = |_: &mut ()| -> Result<(), Error> { unreachable!("it is taken") };
                let within = outer.with("it", |()| {}, taken);
                assert_eq!(within.unwrap_err().kind, ErrorKind::Busy);
                Ok::<(), Error>(())
            },
        );
        assert!(called.is_ok());
        let again = outer.with("it", |()| {}, |()| Ok::<(), Error>(()));
        assert!(again.is_ok());
    }
}
