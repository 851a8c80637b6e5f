//! Versions, statuses, callbacks.
//!
//! Calls that can fail return a status, and leave a message that names the culprit. Callbacks report the progress of long
//! calls and release user data. In the examples of the sections below, check() stands for a program's own handling of a
//! status, which may begin like this:
//!
//! ```c
//! cstk_status status = cstk_query_create(&query);
//! if (status != CSTK_OK) {
//!     fprintf(stderr, "%s: %s\n", cstk_status_name(status), cstk_last_error_message());
//! }
//! ```

pub mod version;

#[allow(clippy::module_inception)]
pub mod status;

pub mod callbacks;
