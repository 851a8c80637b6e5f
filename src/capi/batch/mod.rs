//! Batches.
//!
//! Many configurations, motions or pairs of poses in one call, on several threads, all in the state that the environments are in at the
//! call. Answers stand in order of the items, equal to those of single calls bit for bit, whatever the number of threads.
//!
//! Every item has a status. One that fails (a NaN among its coordinates, say) fails alone: the others are answered, and the call returns
//! CSTK_OK; cstk_last_error_message() then names the first that failed. Entries of items with another status than CSTK_OK mean nothing.
//! Where progress or the first hit ends a batch, the items that were not reached have CSTK_ERROR_CANCELLED, and those with CSTK_OK are
//! answered: unlike other calls, a batch that its progress function cancels has written to its arrays, and its cstk_batch_result, which
//! counts what was answered until then and has no hit. A call that fails otherwise has written nothing.
//!
//! Progress is told between items, every 20 milliseconds or more often, also while the last items are with other threads; an item that
//! has begun is answered before a cancelled call returns.
//!
//! The arrays are the caller's, and nobody else may use them during the call. What a batch reads may overlap; what it writes overlaps
//! nothing else, which CSTK_ERROR_INVALID_ARGUMENT refuses. Callbacks of C-objects and bodies
//! are called from the batch's threads, several at once.
//!
//! ```c
//! double configurations[1000 * 6] = {0};
//! cstk_class classes[1000];
//! cstk_status statuses[1000];
//! cstk_batch_result done;
//! cstk_batch *batch;
//! check(cstk_batch_create(&batch));
//! check(cstk_classify_batch(batch, cobject, configurations, 1000, 6, NULL, NULL, NULL, classes, statuses, &done));
//! if (done.failed > 0) {
//!     fprintf(stderr, "%s\n", cstk_last_error_message());
//! }
//! check(cstk_batch_release(batch));
//! ```

#[allow(clippy::module_inception)]
pub mod batch;

mod arrays;
mod call;

pub mod configurations;

pub mod motions;

pub mod pairs;
