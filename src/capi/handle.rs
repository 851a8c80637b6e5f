//! Handles: what C holds instead of an `Arc`.
//!
//! A handle points to a slot that holds the kind of the object and the number of references that C holds. Slots of released
//! objects stay marked for a long time before they are reused, so that a released handle, or one of another kind, is
//! detected instead of followed.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicPtr, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::boundary::Failure;
use super::input::null;
use crate::capi::status::status::cstk_status;

/// A type that C holds by handle.
pub trait Noun: Send + Sync + 'static {
    /// The opaque type of the header.
    type Handle;
    /// Unique among the handle types.
    const KIND: u32;
    /// The name in error messages.
    const NAME: &'static str;
}

/// Marks a slot whose object was released.
const RELEASED: u32 = 0x4445_4144;
/// The base of all kind numbers: makes it unlikely that foreign memory looks like a slot.
const KIND_BASE: u32 = 0x4353_5400;
/// The number of released slots that are kept back before one is reused.
const QUARANTINE: usize = 4096;

struct Slot {
    kind: AtomicU32,
    references: AtomicU32,
    value: AtomicPtr<()>,
}

struct Quarantine(VecDeque<*mut Slot>);
// SAFETY: slots in the queue belong to the queue alone, and all their fields are atomic.
unsafe impl Send for Quarantine {}

static QUARANTINED: Mutex<Quarantine> = Mutex::new(Quarantine(VecDeque::new()));

/// A new handle with one reference.
pub fn create<T: Noun>(value: Arc<T>) -> *mut T::Handle {
    let value = Arc::into_raw(value).cast_mut().cast();
    let mut quarantine = QUARANTINED.lock().unwrap_or_else(PoisonError::into_inner);
    let reused = (quarantine.0.len() > QUARANTINE)
        .then(|| quarantine.0.pop_front())
        .flatten();
    let slot = reused.unwrap_or_else(|| {
        Box::into_raw(Box::new(Slot {
            kind: AtomicU32::new(RELEASED),
            references: AtomicU32::new(0),
            value: AtomicPtr::default(),
        }))
    });
    // SAFETY: the slot is a leaked box that nobody else uses.
    let fields = unsafe { &*slot };
    fields.value.store(value, Ordering::Relaxed);
    fields.references.store(1, Ordering::Relaxed);
    fields.kind.store(KIND_BASE + T::KIND, Ordering::Release);
    slot.cast()
}

#[inline(always)]
fn slot_of<'a, T: Noun>(handle: *const T::Handle, argument: &str) -> Result<&'a Slot, Failure> {
    let slot: *const Slot = handle.cast();
    if slot.is_null() {
        return Err(null(argument));
    }
    if !slot.is_aligned() {
        return Err(wrong::<T>(argument, "not a handle of this library"));
    }
    // SAFETY: the caller passes a handle of this library; slots are never freed.
    let slot = unsafe { &*slot };
    match slot.kind.load(Ordering::Acquire) {
        kind if kind == KIND_BASE + T::KIND => Ok(slot),
        RELEASED => Err(wrong::<T>(argument, "it was released")),
        _ => Err(wrong::<T>(argument, "a handle of another kind")),
    }
}

#[cold]
fn wrong<T: Noun>(argument: &str, what: &str) -> Failure {
    Failure::new(
        cstk_status::CSTK_ERROR_WRONG_HANDLE,
        format!("{argument} is not a {}: {what}", T::NAME),
    )
}

/// Shared ownership of the object behind a handle, to keep it, or for the time of a call that runs callbacks: they may
/// release the handle.
pub fn share<T: Noun>(handle: *const T::Handle, argument: &str) -> Result<Arc<T>, Failure> {
    let slot = slot_of::<T>(handle, argument)?;
    let value: *const T = slot.value.load(Ordering::Relaxed).cast::<T>();
    // SAFETY: a slot of this kind holds a pointer from Arc::into_raw, and the caller holds a reference, so it is alive.
    unsafe {
        Arc::increment_strong_count(value);
        Ok(Arc::from_raw(value))
    }
}

/// The object behind a handle, for the time of a call that runs no callbacks: only they could release the handle during it.
#[inline(always)]
pub fn borrowed<'a, T: Noun>(handle: *const T::Handle, argument: &str) -> Result<&'a T, Failure> {
    let slot = slot_of::<T>(handle, argument)?;
    // SAFETY: a slot of this kind holds a pointer from Arc::into_raw, and the caller holds a reference during the call.
    Ok(unsafe { &*slot.value.load(Ordering::Relaxed).cast::<T>() })
}

/// Adds a reference.
pub fn retain<T: Noun>(handle: *const T::Handle, argument: &str) -> Result<(), Failure> {
    let references = &slot_of::<T>(handle, argument)?.references;
    if references.fetch_add(1, Ordering::Relaxed) > u32::MAX / 2 {
        references.fetch_sub(1, Ordering::Relaxed);
        return Err(Failure::new(
            cstk_status::CSTK_ERROR_INVALID_ARGUMENT,
            format!("{argument} has been retained two thousand million times"),
        ));
    }
    Ok(())
}

/// Drops a reference; the last one releases the object. NULL is a no-op.
pub fn release<T: Noun>(handle: *mut T::Handle, argument: &str) -> Result<(), Failure> {
    if handle.is_null() {
        return Ok(());
    }
    let slot = slot_of::<T>(handle, argument)?;
    if slot.references.fetch_sub(1, Ordering::AcqRel) > 1 {
        return Ok(());
    }
    slot.kind.store(RELEASED, Ordering::Release);
    let value = slot.value.swap(std::ptr::null_mut(), Ordering::AcqRel);
    if !value.is_null() {
        // SAFETY: the slot held this Arc, and the last reference to the slot is gone.
        drop(unsafe { Arc::from_raw(value.cast::<T>()) });
    }
    let mut quarantine = QUARANTINED.lock().unwrap_or_else(PoisonError::into_inner);
    quarantine.0.push_back(handle.cast());
    Ok(())
}
