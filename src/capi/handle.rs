//! Handles: what C holds instead of an `Arc`.
//!
//! A handle points to a slot that names the kind of object and counts the references C holds. Slots of released objects
//! are kept and marked for a long while before they are used again, so that a released handle, like one of another
//! kind, is found out instead of followed.

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
    /// A number of its own.
    const KIND: u32;
    /// What messages call it.
    const NAME: &'static str;
}

/// Marks a slot whose object was released.
const RELEASED: u32 = 0x4445_4144;
/// Begins every kind number, so that foreign memory is unlikely to look like a slot.
const KIND_BASE: u32 = 0x4353_5400;
/// So many released slots wait before one is used again.
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
    let mut waiting = QUARANTINED.lock().unwrap_or_else(PoisonError::into_inner);
    let reused = (waiting.0.len() > QUARANTINE)
        .then(|| waiting.0.pop_front())
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

/// A share of the object behind a handle, to be kept, or for the time of a call: functions of the caller that it calls may
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

/// The object behind a handle, for the time of a call that runs no function of the caller's: only that could release the
/// handle meanwhile.
pub fn borrowed<'a, T: Noun>(handle: *const T::Handle, argument: &str) -> Result<&'a T, Failure> {
    let slot = slot_of::<T>(handle, argument)?;
    // SAFETY: a slot of this kind holds a pointer from Arc::into_raw, and the caller holds a reference for the time of the call.
    Ok(unsafe { &*slot.value.load(Ordering::Relaxed).cast::<T>() })
}

/// One more reference.
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

/// One reference less; the last one lets go of the object. NULL is a no-op.
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
    let mut waiting = QUARANTINED.lock().unwrap_or_else(PoisonError::into_inner);
    waiting.0.push_back(handle.cast());
    Ok(())
}
