//! Batches: answers equal to those of single queries, whatever the number of threads; what fails, hits and cancels.

mod answers;
mod ends;
mod scene;
