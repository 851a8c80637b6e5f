//! User data, attached to objects and returned with answers (§2.2.3).

use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::user_data::UserData;

/// The caller's address and the function that releases it.
pub(super) struct CallerData {
    data: *mut c_void,
    destroy: cstk_destroy_fn,
    /// Whether the library must release the data.
    owned: AtomicBool,
}

// SAFETY: the address is only handed back, and the header says that any thread may give it back.
unsafe impl Send for CallerData {}
// SAFETY: as above.
unsafe impl Sync for CallerData {}

impl CallerData {
    pub fn new(data: *mut c_void, destroy: cstk_destroy_fn) -> Arc<Self> {
        Arc::new(Self {
            data,
            destroy,
            owned: AtomicBool::new(false),
        })
    }

    /// The caller's address, which the caller's functions are called with.
    pub fn address(&self) -> *mut c_void {
        self.data
    }

    /// The data in the form that objects carry; `None` if there is neither an address nor a function.
    pub fn as_user_data(self: &Arc<Self>) -> Option<UserData> {
        let is_something = !self.data.is_null() || self.destroy.is_some();
        is_something.then(|| UserData::new(self.data as usize, Some(self.clone())))
    }

    /// From now on the data are released when nothing refers to them. Call it when nothing can fail any more.
    pub fn take_ownership(&self) {
        self.owned.store(true, Ordering::Release);
    }
}

impl Drop for CallerData {
    fn drop(&mut self) {
        if let Some(destroy) = self.destroy
            && self.owned.load(Ordering::Acquire)
        {
            // SAFETY: given back once, as nothing refers to the data any more.
            unsafe { destroy(self.data) }
        }
    }
}

/// The address behind a value of user data.
pub(super) fn address(value: usize) -> *mut c_void {
    value as *mut c_void
}
