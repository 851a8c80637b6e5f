//! Data of the caller's, attached to objects and handed back with answers (§2.2.3).

use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::capi::status::callbacks::cstk_destroy_fn;
use crate::user_data::UserData;

/// The caller's address and how to give it back.
pub(super) struct CallerData {
    data: *mut c_void,
    destroy: cstk_destroy_fn,
    /// Whether the data are the library's to give back.
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

    /// The data as objects carry them; `None` where there is neither an address nor a function.
    pub fn as_user_data(self: &Arc<Self>) -> Option<UserData> {
        let is_something = !self.data.is_null() || self.destroy.is_some();
        is_something.then(|| UserData::new(self.data as usize, Some(self.clone())))
    }

    /// From now on the data are given back when nothing refers to them: to be called when nothing can fail any more.
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

/// The address that a number of user data stands for.
pub(super) fn address(value: usize) -> *mut c_void {
    value as *mut c_void
}
