//! Versions, statuses, callbacks.
//!
//! Calls that can fail return a status, and leave a message that names the culprit. Long calls report how far they are, and
//! user data are given back, by functions of the caller. In the examples of the sections below, check() stands for what a
//! program does about a status; this is how it may begin.
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
